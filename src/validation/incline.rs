//! A patch of cloth on an incline sticks if tan a <= mu, and slides with g (sin a - mu cos a)
//! otherwise.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::{Claim, Experiment, ExperimentError, GRAVITY, fabric, stage};
use crate::scene::{Pose, Scene};
use crate::sim::{SimSettings, Simulation, SizingMode};

/// (kg/m^2).
const DENSITY: f64 = 0.2;

/// How long it is watched (frames), and when its acceleration is taken.
const FRAMES: u32 = 50;
const SETTLED_FRAME: u32 = 25;

/// What moves slower at the end sticks (m/s): a slope 0.001 too steep would make it faster.
const STICKING_SPEED: f64 = 0.01;

/// Halvings of the range of slopes.
const HALVINGS: u32 = 9;

/// How much steeper than mu the slope is on which it slides.
const SLIDING_EXCESS: f64 = 0.2;

pub fn experiments() -> Vec<Experiment> {
    let of = |mu: f64| {
        let claims = vec![
            Claim::absolute(format!("incline/mu-{mu}/steepest-without-sliding"), mu, 0.02),
            Claim::absolute(format!("incline/mu-{mu}/friction-while-sliding"), mu, 0.02),
        ];
        Experiment::new(claims, move || Ok(vec![steepest(mu)?, sliding_friction(mu)?]))
    };
    [0.1, 0.3, 0.6].map(of).into()
}

/// tan a of the steepest slope on which the patch sticks.
fn steepest(mu: f64) -> Result<f64, ExperimentError> {
    let (mut sticks, mut slides) = (0.0, 2.0 * mu);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (sticks + slides);
        let speed = speeds(mu, middle)?[FRAMES as usize];
        *if speed < STICKING_SPEED { &mut sticks } else { &mut slides } = middle;
    }
    Ok(0.5 * (sticks + slides))
}

/// (g sin a - acceleration) / (g cos a) on a slope that is too steep.
fn sliding_friction(mu: f64) -> Result<f64, ExperimentError> {
    let slope = mu + SLIDING_EXCESS;
    let speeds = speeds(mu, slope)?;
    let duration = f64::from(FRAMES - SETTLED_FRAME) * scene(mu, slope).frame_time();
    let acceleration = (speeds[FRAMES as usize] - speeds[SETTLED_FRAME as usize]) / duration;
    let (sine, cosine) = slope.atan().sin_cos();
    Ok((GRAVITY * sine - acceleration) / (GRAVITY * cosine))
}

/// The mean speed of the patch down the slope after every frame (m/s).
fn speeds(mu: f64, slope: f64) -> Result<Vec<f64>, ExperimentError> {
    let settings = SimSettings { sizing: SizingMode::Uniform { edge_length: None } };
    let (mut simulation, _) = Simulation::start(Arc::new(scene(mu, slope)), settings)?;
    let mut speeds = vec![0.0];
    for _ in 0..FRAMES {
        let frame = simulation.advance()?;
        let mesh = &frame.garments[0];
        let sum: f64 = mesh.velocity.iter().map(|v| v.x).sum();
        speeds.push(sum / mesh.node_count() as f64);
    }
    Ok(speeds)
}

/// The slope lies level and gravity is turned instead. The patch begins pressed in as its weight asks.
fn scene(mu: f64, slope: f64) -> Scene {
    let (sine, cosine) = slope.atan().sin_cos();
    let (size, layout) = (DVec2::new(0.2, 0.1), Layout::Irregular);
    let sheet = Sheet { origin: DVec2::ZERO, size, cell: 0.04, layout, columns: Vec::new() };
    let mut scene = stage::scene(Vec::new());
    let sunk = DENSITY * GRAVITY * cosine / scene.contact.stiffness;
    let mesh = sheet.mesh(|u| u.extend(scene.contact.thickness - sunk));
    scene.garments = vec![stage::garment(mesh, fabric::plain(1e-4, 1000.0, DENSITY))];
    scene.contact.friction_obstacle = mu;
    scene.gravity = DVec3::new(sine, 0.0, -cosine) * GRAVITY;
    let half = DVec3::new(5.0, 5.0, 0.5);
    let below = Pose { translation: DVec3::NEG_Z * half.z, ..Pose::IDENTITY };
    scene.obstacles = vec![stage::obstacle(stage::block(half), below)];
    scene
}
