//! Two balls that close on a hanging sheet, to a narrower and narrower gap.

use glam::DVec3;

use super::stage::{self, moving, straight};
use super::stress::{Stress, Trial};

/// (m).
const RADIUS: f64 = 0.1;
/// Of each ball's surface from the sheet at first (m).
const APART: f64 = 0.05;

/// (s).
const DURATION: f64 = 0.2;
/// Frames after the balls have stopped.
const REST: u32 = 12;

pub fn stress() -> Stress {
    Stress {
        name: "pinch",
        about: "two balls close on a hanging sheet; gap left between them, in thicknesses",
        values: &[4.0, 2.0, 1.0, 0.5, 0.1, 0.0, -2.0],
        label: |gap| format!("{gap} h"),
        trial,
    }
}

fn trial(gap: f64) -> Trial {
    let mut scene = stage::curtain();
    let half = 0.5 * gap * scene.contact.thickness;
    let from_side = |side: f64| {
        let place = |off: f64| DVec3::new(0.013, side * (RADIUS + off), 0.021);
        straight([place(APART), place(half)], DURATION)
    };
    scene.motions = vec![from_side(-1.0), from_side(1.0)];
    scene.obstacles = [0, 1].map(|motion| moving(stage::ball(RADIUS), motion)).into();
    Trial::driven(scene, stage::FIXED, [(APART - half) / DURATION, DURATION], REST)
}
