//! A sheet pulled by its middle through a narrower and narrower ring.

use glam::{DVec2, DVec3};

use super::stage::{self, straight};
use super::stress::{Stress, Trial};

/// Of the ring's wire (m).
const TUBE: f64 = 0.01;
/// Of the sheet above the wire (m).
const ABOVE: f64 = 0.01;

/// Of the mesh (m): a sheet that goes through a ring lies in small folds.
const CELL: f64 = 0.02;

/// Of the patch that is pulled (m): pulled by a node, cloth of this kind tears.
const PATCH: f64 = 0.045;

/// How far the middle is pulled down (m), and in what time (s).
const WAY: f64 = 0.7;
const DURATION: f64 = 1.0;
/// Frames after the pull.
const REST: u32 = 5;

pub fn stress() -> Stress {
    Stress {
        name: "ring",
        about: "sheet of 600 mm pulled through a ring by its middle; radius of the opening",
        values: &[0.2, 0.15, 0.12, 0.1, 0.08, 0.06],
        label: |radius| format!("{:.0} mm", 1e3 * radius),
        trial,
    }
}

/// The ring lies in the plane z = 0; the sheet is a little aside.
fn trial(opening: f64) -> Trial {
    let aside = DVec2::new(0.003, 0.002);
    let mesh = stage::square(CELL, |u| (u + aside).extend(TUBE + ABOVE));
    let middle = stage::nodes(&mesh, |u| u.length() < PATCH);
    let mut scene = stage::scene(mesh, stage::cotton());
    scene.motions = vec![straight([DVec3::ZERO, DVec3::NEG_Z * WAY], DURATION)];
    scene.handles = vec![stage::held(middle, Some(0))];
    let ring = stage::torus(opening + TUBE, TUBE);
    scene.obstacles = vec![stage::obstacle(ring, stage::at(DVec3::ZERO))];
    Trial::driven(scene, stage::FIXED, [WAY / DURATION, DURATION], REST)
}
