//! Cloth that nothing holds falls like a stone.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::{Claim, Experiment, ExperimentError, GRAVITY, fabric, stage};
use crate::sim::{Frame, SimSettings, Simulation, SizingMode};

const FRAMES: u32 = 10;

/// What rounding leaves of a fall of a metre.
const TOLERANCE: f64 = 1e-11;

pub fn experiments() -> Vec<Experiment> {
    let scene = stage::scene(Vec::new());
    let (steps, dt) = (f64::from(FRAMES * scene.steps_per_frame), scene.step_time());
    let speed = GRAVITY * dt * steps;
    // Backward Euler: x_n = g h^2 n (n + 1) / 2.
    let way = GRAVITY * dt * dt * steps * (steps + 1.0) / 2.0;
    let of = |name: &str, sizing: SizingMode| {
        let claims = vec![
            Claim::relative(format!("free-fall/{name}/speed"), speed, TOLERANCE),
            Claim::relative(format!("free-fall/{name}/way"), way, TOLERANCE),
        ];
        Experiment::new(claims, move || measure(sizing))
    };
    vec![
        of("fixed", SizingMode::Uniform { edge_length: None }),
        of("remeshed", SizingMode::Adaptive),
    ]
}

/// Speed (m/s) and way (m) of the node that is farthest off what is expected of either.
fn measure(sizing: SizingMode) -> Result<Vec<f64>, ExperimentError> {
    let size = DVec2::new(0.4, 0.3);
    let layout = Layout::Irregular;
    let sheet = Sheet { origin: DVec2::ZERO, size, cell: 0.05, layout, columns: Vec::new() };
    let mesh = sheet.mesh(|u| u.extend(0.0));
    let mut scene = stage::scene(vec![stage::garment(mesh, fabric::plain(1e-5, 500.0, 0.2))]);
    scene.stages.remeshing = sizing == SizingMode::Adaptive;
    let (mut simulation, _) = Simulation::start(Arc::new(scene), SimSettings { sizing })?;
    let mut last = simulation.advance()?;
    for _ in 1..FRAMES {
        last = simulation.advance()?;
    }
    Ok(vec![extreme(&last, |_, v| -v.z), extreme(&last, |x, _| -x.z)])
}

/// The value farthest from the mean over the nodes.
fn extreme(frame: &Frame, value: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let mesh = &frame.garments[0];
    let values: Vec<f64> =
        mesh.node_ids().map(|n| value(mesh.position[n], mesh.velocity[n])).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let off = |value: &f64| (value - mean).abs();
    values.iter().copied().max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(f64::NAN)
}
