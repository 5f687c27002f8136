//! A camera over the frames of a shot.

use glam::{DMat4, DVec3};
use thiserror::Error;

use super::{Lens, View};

/// A camera path as files give it.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    pub name: String,
    /// Width and height of the shot's image (px).
    pub resolution: [u32; 2],
    /// Width over height of a pixel.
    pub pixel_aspect: f64,
    /// Distances of the near and the far plane (m).
    pub near: f64,
    pub far: f64,
    pub track: Track,
}

/// How the camera moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Track {
    /// In order of frame, at least one; the first key is no cut.
    Keys(Vec<CameraKey>),
    /// Per frame from frame 0 a world_from_camera matrix and a lens: the baked form. The frames in
    /// `cuts` begin a new run.
    Matrices { samples: Vec<(DMat4, Lens)>, cuts: Vec<u32> },
}

/// Where the camera stands at a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    pub frame: f64,
    /// (m), world.
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    pub lens: Lens,
    /// The camera jumps to this key.
    pub cut: bool,
}

/// What is wrong with a camera path.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CameraPathError {
    #[error("the camera path has no keys")]
    Empty,
}

impl CameraPath {
    /// The view at a frame (need not be whole); at a cut the new one.
    pub fn view(&self, _frame: f64) -> View {
        todo!()
    }
}
