//! A sheet held at one edge, in more and more wind.

use glam::{DVec2, DVec3};

use super::stage::{self, CELL, SIDE};
use super::stress::{Stress, Trial};
use crate::scene::Air;

/// (kg/m^3).
const AIR_DENSITY: f64 = 1.2;

const FRAMES: u32 = 25;

pub fn stress() -> Stress {
    Stress {
        name: "wind",
        about: "flag held at one edge; speed of the wind (25 m/s is a storm)",
        values: &[5.0, 10.0, 25.0, 50.0, 100.0],
        label: |speed| format!("{speed} m/s"),
        trial,
    }
}

/// The wind comes across the sheet at an angle and from a little below.
fn trial(speed: f64) -> Trial {
    let mesh = stage::square(CELL, |u| DVec3::new(u.x, 0.0, u.y));
    let edge = stage::nodes(&mesh, |u: DVec2| u.x < -0.499 * SIDE);
    let mut scene = stage::scene(mesh, stage::cotton());
    scene.handles = vec![stage::held(edge, None)];
    let velocity = DVec3::new(0.9, 0.4, 0.1).normalize() * speed;
    scene.air = Air { density: AIR_DENSITY, velocity, tangential_drag: 0.0 };
    let trial = Trial::passive(scene, stage::FIXED, FRAMES);
    Trial { passive_from: None, drive_speed: speed, ..trial }
}
