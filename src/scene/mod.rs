//! What is simulated: garments, fabrics, obstacles, motions, handles, air. Plain data in SI units,
//! as [`load()`] resolves it from a [`native`] shot file or an imported scene.

mod arcsim;
mod deformation;
mod document;
mod error;
mod fabric;
mod load;
mod mot;
mod motion;
pub mod native;
mod numbered;
mod obj;
mod pose;
mod resolve;
mod settings;
mod source;
mod surface;

pub use deformation::{Deformation, DeformationError, PointKey};
pub(crate) use document::{Known, SYNTAX, from_json};
pub use error::{LoadError, Place, Problem};
#[cfg(test)]
pub use fabric::testing;
pub use fabric::{
    BendingModel, ElasticFabric, Fabric, IsotropicSheet, MeasuredFabric, PRESETS, PlateCompliance,
    Preset, StretchStiffness,
};
pub use load::{LoadOptions, LoadedShot, load, shot_schema};
pub use motion::{Motion, MotionError, MotionKey};
pub use pose::{Pose, PoseVelocity};
pub use resolve::{contact_thickness_most, load_camera, recorded_viewers};
pub use settings::{
    Air, Contact, Dynamics, SizingSettings, SolverChoice, StageSwitches, ViewRule, ViewSettings,
};
pub use source::{EmbeddedFiles, FileRead, FileRole, FileSource, FileSystem};
pub(crate) use source::{content_hash, joined};
pub use surface::{Surface, Welding};

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::mesh::Mesh;
use crate::shot::CameraPath;

/// A shot, resolved: everything a simulation depends on, and nothing else.
#[derive(Clone, Debug)]
pub struct Scene {
    /// For captions and messages: the shot's file name without folders and extension.
    pub name: String,
    /// Frames per second.
    pub fps: f64,
    /// Steps a frame is divided into, at least 1.
    pub steps_per_frame: u32,
    /// The last frame the scene itself asks for; `None` if it runs until told to stop.
    pub last_frame: Option<u32>,
    /// What frame 0 is called where frames are shown and written.
    pub first_frame: i64,
    /// Acceleration (m/s^2).
    pub gravity: DVec3,
    pub air: Air,
    pub contact: Contact,
    pub dynamics: Dynamics,
    /// Stiffness of the springs that hold handle nodes (N/m).
    pub handle_stiffness: f64,
    /// How far every node is moved at frame 0, each in a direction of its own (m).
    pub start_perturbation: f64,
    pub stages: StageSwitches,
    pub garments: Vec<Garment>,
    pub obstacles: Vec<Obstacle>,
    pub motions: Vec<Motion>,
    pub handles: Vec<Handle>,
    /// The cameras that watch; the first is the shot camera. Empty: nobody watches, and view
    /// sizing is the same as adaptive sizing.
    pub viewers: Vec<CameraPath>,
}

/// A piece of cloth.
#[derive(Clone, Debug)]
pub struct Garment {
    pub name: String,
    /// As it is at frame 0, in the world.
    pub mesh: Mesh,
    pub fabric: Fabric,
    /// Distance at which the cloth is held off obstacles; off other cloth it is the mean of both (m).
    /// `None`: that of the scene's [`Contact`]; else at most that, and at least a fifth of it.
    pub contact_thickness: Option<f64>,
    pub sizing: SizingSettings,
    pub view: ViewSettings,
    /// Both sides are meant to be seen, so that `nu_back` applies to no face in frame.
    pub two_sided: bool,
}

/// A solid that the cloth must not enter: a closed surface, moved rigidly, or deformed, or both.
#[derive(Clone, Debug)]
pub struct Obstacle {
    pub name: String,
    /// In the obstacle's own space; where its points move by themselves, as they are at first.
    pub surface: Arc<Surface>,
    /// How the points of the surface move by themselves.
    pub deformation: Option<Arc<Deformation>>,
    /// From the obstacle's own space to the space of its motion, or to the world if it has none.
    pub placement: Pose,
    /// Index into the scene's motions.
    pub motion: Option<usize>,
}

/// Nodes of a garment that are held, or led along a motion.
#[derive(Clone, Debug)]
pub struct Handle {
    /// Index into the scene's garments.
    pub garment: usize,
    /// Indices of the nodes in the garment's input.
    pub nodes: Vec<u32>,
    /// Index into the scene's motions; `None` holds the nodes where they are.
    pub motion: Option<usize>,
    /// When the handle takes hold (s).
    pub start_time: f64,
    /// When it lets go (s); infinite if never.
    pub end_time: f64,
}

impl Scene {
    /// (s).
    pub fn frame_time(&self) -> f64 {
        1.0 / self.fps
    }

    /// (s).
    pub fn step_time(&self) -> f64 {
        self.frame_time() / f64::from(self.steps_per_frame)
    }

    /// The points at a time (s) of the obstacles whose points move by themselves (m, own space), by
    /// the obstacle's number.
    pub fn moved_points(&self, time: f64) -> BTreeMap<u32, Arc<Vec<DVec3>>> {
        let of = |(number, obstacle): (u32, &Obstacle)| {
            let deformation = obstacle.deformation.as_ref()?;
            Some((number, Arc::new(deformation.positions(time))))
        };
        (0..).zip(&self.obstacles).filter_map(of).collect()
    }

    /// From an obstacle's own space to the world at a time (s).
    pub fn obstacle_pose(&self, obstacle: &Obstacle, time: f64) -> Pose {
        match obstacle.motion {
            Some(motion) => self.motions[motion].pose(time) * obstacle.placement,
            None => obstacle.placement,
        }
    }
}
