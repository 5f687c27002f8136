//! A camera that turns about itself, faster and faster, beside a sheet that falls on a ball.

use glam::DVec3;

use super::drape;
use super::stage;
use super::stress::{Stress, Trial};
use crate::mesh::Mesh;
use crate::shot::{CameraKey, CameraPath, Lens, Track};
use crate::sim::{SimSettings, SizingMode};

/// (m).
const EYE: DVec3 = DVec3::new(0.2, -1.4, 0.4);

/// Shortest and longest edge that the remesher makes before the view coarsens it (m).
const FINEST: f64 = 0.02;
const COARSEST: f64 = 0.1;

/// Of the mesh as it is given (m).
const CELL: f64 = 0.06;

pub fn stress() -> Stress {
    Stress {
        name: "whip pan",
        about: "camera that turns about itself beside a sheet dropped on a ball; turn in a frame",
        values: &[2.0, 10.0, 45.0, 90.0, 170.0],
        label: |degrees| format!("{degrees} deg"),
        trial,
    }
}

fn trial(degrees: f64) -> Trial {
    let key = |k: u32| CameraKey {
        frame: f64::from(k),
        target: EYE + glam::DQuat::from_rotation_z((f64::from(k) * degrees).to_radians()) * -EYE,
        ..looking(k)
    };
    watched(|last| (0..=last).map(key).collect())
}

/// At the middle, through a lens of 40 degrees.
pub fn looking(frame: u32) -> CameraKey {
    let lens = Lens::FieldOfView { fov_y: 40f64.to_radians() };
    CameraKey {
        frame: f64::from(frame),
        eye: EYE,
        target: DVec3::ZERO,
        up: DVec3::Z,
        lens,
        cut: false,
    }
}

/// The sheet remeshed for a camera whose keys are given up to a last frame.
pub fn watched(keys: impl Fn(u32) -> Vec<CameraKey>) -> Trial {
    let mesh: Mesh = stage::square(CELL, drape::placed);
    let mut trial = drape::of_mesh(mesh);
    trial.settings = SimSettings { sizing: SizingMode::View };
    let scene = &mut trial.scene;
    scene.stages.remeshing = true;
    scene.garments[0].sizing.edge_length_min = FINEST;
    scene.garments[0].sizing.edge_length_max = COARSEST;
    scene.viewers = vec![CameraPath {
        name: "shot".into(),
        resolution: [960, 540],
        pixel_aspect: 1.0,
        near: 0.05,
        far: 20.0,
        track: Track::Keys(keys(trial.frames)),
    }];
    trial
}
