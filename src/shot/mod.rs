//! Who looks: cameras, their paths with cuts, and the part of space they see.

mod camera;
mod frustum;
mod path;

pub use camera::{Lens, View};
pub use frustum::Frustum;
pub use path::{CameraKey, CameraPath, CameraPathError, Track};
