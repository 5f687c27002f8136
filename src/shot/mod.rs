//! Who looks: cameras, their paths with cuts, and the part of space they see.

mod baked;
mod camera;
mod check;
mod distance;
mod frustum;
mod interpolate;
mod path;

pub use camera::{Lens, View};
pub use check::CameraPathError;
pub use frustum::Frustum;
pub use path::{CameraKey, CameraPath, Track};

#[cfg(test)]
pub(crate) mod tests {
    use glam::{DVec2, DVec3};

    use super::*;

    /// A path of one key.
    pub fn still(eye: DVec3, target: DVec3) -> CameraPath {
        path(vec![key(0.0, eye, target)])
    }

    pub fn path(keys: Vec<CameraKey>) -> CameraPath {
        CameraPath {
            name: "shot".to_owned(),
            resolution: [960, 540],
            pixel_aspect: 1.0,
            near: 0.05,
            far: 20.0,
            track: Track::Keys(keys),
        }
    }

    pub fn key(frame: f64, eye: DVec3, target: DVec3) -> CameraKey {
        let lens = Lens::FieldOfView { fov_y: 40f64.to_radians() };
        CameraKey { frame, eye, target, up: DVec3::Z, lens, cut: false }
    }

    /// An off-centre lens, turned about all axes, with a near plane large enough to matter.
    pub fn sample_view() -> View {
        let lens = Lens::FilmBack {
            focal_mm: 35.0,
            aperture_mm: DVec2::new(36.0, 24.0),
            offset_mm: DVec2::new(3.0, -2.0),
        };
        let eye = DVec3::new(1.0, -2.0, 0.5);
        let only = CameraKey { lens, up: DVec3::new(0.2, 0.1, 1.0), ..key(0.0, eye, DVec3::Y) };
        CameraPath { near: 0.5, far: 4.0, ..path(vec![only]) }.view(0.0)
    }
}
