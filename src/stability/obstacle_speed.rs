//! A ball that flies into a hanging sheet, faster and faster.

use glam::DVec3;

use super::stage::{self, moving, straight};
use super::stress::{Stress, Trial};

/// (m).
const RADIUS: f64 = 0.1;
const FROM: f64 = -0.25;
const TO: f64 = 0.3;

/// Frames after the ball has stopped.
const REST: u32 = 12;

pub fn stress() -> Stress {
    Stress {
        name: "obstacle speed",
        about: "ball flies into a hanging sheet; way in a step, in thicknesses",
        values: &[1.0, 5.0, 20.0, 50.0, 100.0],
        label: |thicknesses| format!("{thicknesses} h/step"),
        trial,
    }
}

fn trial(thicknesses: f64) -> Trial {
    let mut scene = stage::curtain();
    let speed = thicknesses * scene.contact.thickness / scene.step_time();
    let duration = (TO - FROM) / speed;
    // A little aside, so that nothing is symmetric.
    let ends = [FROM, TO].map(|y| DVec3::new(0.013, y, 0.021));
    scene.motions = vec![straight(ends, duration)];
    scene.obstacles = vec![moving(stage::ball(RADIUS), 0)];
    Trial::driven(scene, stage::FIXED, [speed, duration], REST)
}
