//! A sheet dropped on a ball: the scene of the stresses that change no more than one thing of it.

use glam::{DVec2, DVec3};

use super::stage::{self, CELL};
use super::stress::Trial;
use crate::mesh::Mesh;
use crate::scene::{ElasticFabric, Scene};

/// (m).
pub const RADIUS: f64 = 0.15;

/// How far above the ball it begins (m).
const HEIGHT: f64 = 0.05;

/// What drapes in cotton comes down by 170 mm; flat on the ball it would by 50 mm (m).
const FALL_MIN: f64 = 0.1;

/// A second: it falls, folds around the ball and comes nearly to rest or slides off.
const FRAMES: u32 = 25;

/// A square of a fabric, which need not be one that drapes.
pub fn trial(fabric: ElasticFabric) -> Trial {
    Trial::passive(scene(stage::square(CELL, placed), fabric), stage::FIXED, FRAMES)
}

/// A mesh that is [`placed`], over the ball.
pub fn scene(mesh: Mesh, fabric: ElasticFabric) -> Scene {
    let mut scene = stage::scene(mesh, fabric);
    scene.obstacles = vec![stage::obstacle(stage::ball(RADIUS), stage::at(DVec3::NEG_Z * RADIUS))];
    scene
}

/// A little aside and turned, so that nothing is symmetric.
pub fn placed(u: DVec2) -> DVec3 {
    (DVec2::from_angle(0.2).rotate(u) + DVec2::new(0.013, 0.021)).extend(HEIGHT)
}

/// A mesh of cotton that is placed, over the ball: it must drape.
pub fn of_mesh(mesh: Mesh) -> Trial {
    let trial = Trial::passive(scene(mesh, stage::cotton()), stage::FIXED, FRAMES);
    Trial { fall_min: FALL_MIN, ..trial }
}
