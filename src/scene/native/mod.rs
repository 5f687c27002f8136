//! The native shot file as it is written: JSON with comments, first key `"shotsilk": 1`.
//!
//! The doc comment of each field is its help text in the schema and in the program.

mod camera;
mod fabric;
mod parts;
mod setup;

pub use camera::{CameraFile, KeyFile, MatrixFile, SampleFile};
pub use fabric::{ElasticFile, FabricFile, WarpWeft};
pub use parts::{
    GarmentFile, HandleFile, KeyframeFile, MeshKeyFile, MeshSequenceFile, MotionFile, ObstacleFile,
    TransformFile, VelocityFile,
};
pub(super) use setup::stages;
pub use setup::{AirFile, ContactFile, DynamicsFile, SizingFile, StageName, ViewFile};

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of the shot file which this program reads.
pub const SHOT_VERSION: u32 = 1;

/// A shot: what is simulated, how finely, and who looks. Lengths are in metres, times in seconds,
/// masses in kilograms, Z is up; relative paths start at the shot file's folder.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ShotFile {
    /// Version of the format: 1. Its presence is what makes the file a shot.
    pub shotsilk: u32,
    /// An ARCSim scene to start from; everything said here replaces what it says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub import: Option<String>,
    /// Frames per second. Default 24.
    #[serde(default = "default_fps")]
    pub fps: f64,
    /// Time steps a frame is divided into. Default 8. More: stiffer contact and less damping, at
    /// proportionally higher cost.
    #[serde(default = "default_steps_per_frame")]
    pub steps_per_frame: u32,
    /// The last frame, counted from 0; absent: as far as the shot camera goes.
    pub frames: Option<u32>,
    /// What frame 0 is called where frames are shown and written, for example 1001. Default 0.
    #[serde(default)]
    pub first_frame: i64,
    /// Acceleration of gravity (m/s^2). Default [0, 0, -9.81].
    #[serde(default = "default_gravity")]
    pub gravity: [f64; 3],
    /// The air around the cloth. At rest and of density 1 unless said otherwise.
    #[serde(default)]
    pub air: AirFile,
    /// Contact between cloth and cloth and between cloth and obstacles.
    #[serde(default)]
    pub contact: ContactFile,
    /// How the equations of a step are solved.
    #[serde(default)]
    pub dynamics: DynamicsFile,
    /// Stiffness of the springs that hold handle nodes (N/m). Default 1e6; softer: held nodes lag
    /// behind their motion.
    #[serde(default = "default_handle_stiffness")]
    pub handle_stiffness: f64,
    /// How far every node is moved before frame 1, each in a direction of its own (m). Default 0.
    /// Two runs that differ by a hair in this tell where chaos takes over.
    #[serde(default)]
    pub start_perturbation: f64,
    /// Stages to leave out. Default none.
    #[serde(default)]
    pub disable: Vec<StageName>,
    /// How the view coarsens all garments.
    #[serde(default)]
    pub view: ViewFile,
    /// The shot camera: the name of a camera file, or the camera itself. Absent: nobody looks, and
    /// nothing is coarsened for the view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<CameraChoice>")]
    pub camera: Option<serde_json::Value>,
    /// Several cameras that watch at once, as `camera`; the first is the shot camera.
    #[serde(default)]
    #[schemars(with = "Vec<CameraChoice>")]
    pub viewers: Vec<serde_json::Value>,
    /// Fabrics by name.
    #[serde(default)]
    pub fabrics: BTreeMap<String, FabricFile>,
    /// The pieces of cloth.
    #[serde(default)]
    pub garments: Vec<GarmentFile>,
    /// Motions by name, for obstacles and handles.
    #[serde(default)]
    pub motions: BTreeMap<String, MotionFile>,
    /// The solids that cloth must not enter.
    #[serde(default)]
    pub obstacles: Vec<ObstacleFile>,
    /// Nodes that are held or led.
    #[serde(default)]
    pub handles: Vec<HandleFile>,
    /// Reserved: repeated garments and bodies. Not supported yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instances: Option<serde_json::Value>,
    /// Reserved: named takes. Not supported yet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub takes: Option<serde_json::Value>,
}

/// The name of a camera file, or a camera.
#[derive(JsonSchema)]
#[serde(untagged)]
#[allow(dead_code)]
enum CameraChoice {
    File(String),
    Inline(CameraFile),
}

fn default_fps() -> f64 {
    24.0
}

fn default_steps_per_frame() -> u32 {
    8
}

fn default_gravity() -> [f64; 3] {
    [0.0, 0.0, -9.81]
}

fn default_handle_stiffness() -> f64 {
    1e6
}
