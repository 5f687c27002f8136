//! The parts of a shot file that make things: garments, motions, obstacles, handles.

use glam::{DQuat, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{SizingFile, ViewFile};
use crate::scene::{Pose, PoseVelocity};

/// x' = translate + scale R x.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct TransformFile {
    /// (m). Default [0, 0, 0].
    pub translate: [f64; 3],
    /// Angle (degrees) and axis: [degrees, x, y, z]. Default no rotation.
    pub rotate: [f64; 4],
    /// Factor above 0. Default 1. Scaling a garment scales its material coordinates as well.
    pub scale: f64,
}

impl Default for TransformFile {
    fn default() -> Self {
        Self { translate: [0.0; 3], rotate: [0.0, 1.0, 0.0, 0.0], scale: 1.0 }
    }
}

impl TransformFile {
    pub(in crate::scene) fn pose(self) -> Pose {
        let [degrees, x, y, z] = self.rotate;
        let rotation = match DVec3::new(x, y, z).try_normalize() {
            Some(axis) => DQuat::from_axis_angle(axis, degrees.to_radians()),
            None => DQuat::IDENTITY,
        };
        Pose { scale: self.scale, rotation, translation: DVec3::from_array(self.translate) }
    }
}

/// A piece of cloth.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GarmentFile {
    /// For messages and file names. Default the mesh file's name.
    pub name: Option<String>,
    /// An OBJ file: `v` are nodes in the world, `vt` the flat cloth (m), `f node/vert`.
    pub mesh: String,
    /// Placement of the mesh in the world.
    #[serde(default)]
    pub transform: TransformFile,
    /// The name of a fabric.
    pub fabric: String,
    /// How fine the garment must be, whoever looks.
    #[serde(default)]
    pub sizing: SizingFile,
    /// What differs from the shot's own `view`.
    #[serde(default)]
    pub view: ViewFile,
    /// Both sides are meant to be seen (flag, cape): the far side is not coarsened. Default true
    /// for a garment without seams.
    pub two_sided: Option<bool>,
}

/// A motion: keyframes, or a body of a motion file.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionFile {
    /// Keyframes in order of time; between them a smooth curve, before the first and after the
    /// last at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keys: Option<Vec<KeyframeFile>>,
    /// A `.mot` file, instead of keys.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Samples a second in the file. Default 30.
    pub fps: Option<f64>,
    /// Which body of the file, from 0. Default 0.
    pub body: Option<usize>,
    /// Applied after the file's own placement.
    pub transform: TransformFile,
}

/// Where a motion is at a time.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct KeyframeFile {
    /// (s).
    pub time: f64,
    /// The placement at that time.
    #[serde(default)]
    pub transform: TransformFile,
    /// The velocity at that time. Default from the neighbouring keys, and rest at both ends.
    #[serde(default)]
    pub velocity: Option<VelocityFile>,
}

/// How fast a placement changes.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct VelocityFile {
    /// (m/s). Default 0.
    pub translate: [f64; 3],
    /// Angular speed (degrees/s) and axis: [degrees/s, x, y, z]. Default 0.
    pub rotate: [f64; 4],
    /// Change of the scale factor (1/s). Default 0.
    pub scale: f64,
}

impl VelocityFile {
    pub(in crate::scene) fn velocity(self) -> PoseVelocity {
        let [degrees, x, y, z] = self.rotate;
        let axis = DVec3::new(x, y, z).normalize_or_zero();
        PoseVelocity {
            scale: self.scale,
            angular: axis * degrees.to_radians(),
            translation: DVec3::from_array(self.translate),
        }
    }
}

/// A solid that cloth must not enter.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleFile {
    /// For messages. Default the mesh file's name.
    pub name: Option<String>,
    /// An OBJ file of a closed surface, counter-clockwise seen from outside.
    pub mesh: Option<String>,
    /// Instead of `mesh`, for a surface whose points move: meshes with the same triangles, in order
    /// of time. Points move on straight lines between them, and rest before and after.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meshes: Option<Vec<MeshKeyFile>>,
    /// Instead of `meshes`: files with a number in their names.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_sequence: Option<MeshSequenceFile>,
    /// Placement in the space of the motion, or in the world without one.
    #[serde(default)]
    pub transform: TransformFile,
    /// The name of a motion.
    pub motion: Option<String>,
}

/// A mesh at a time.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MeshKeyFile {
    /// (s).
    pub time: f64,
    /// An OBJ file.
    pub mesh: String,
}

/// Numbered OBJ files, one after another.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MeshSequenceFile {
    /// The files' name with one `%d` or `%04d` for the number.
    pub pattern: String,
    /// Files a second.
    pub fps: f64,
    /// The first number. Default 0.
    #[serde(default)]
    pub first: u32,
    /// The last number. Default as far as there are files.
    pub last: Option<u32>,
    /// When the first file holds (s). Default 0.
    #[serde(default)]
    pub start_time: f64,
}

/// Nodes of a garment that are held where they are, or led along a motion.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct HandleFile {
    /// Which garment, by its place in the list from 0. Default 0.
    #[serde(default)]
    pub garment: usize,
    /// Indices of nodes in the garment's OBJ file, from 0.
    pub nodes: Vec<u32>,
    /// The name of a motion.
    pub motion: Option<String>,
    /// When the handle takes hold (s). Default 0.
    #[serde(default)]
    pub start_time: f64,
    /// When it lets go (s). Default never.
    pub end_time: Option<f64>,
}
