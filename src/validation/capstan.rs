//! A strip pulled over a drum: T2 / T1 = exp(mu phi) while it slips.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::stage::Step;
use super::{Claim, Experiment, ExperimentError, fabric, stage};
use crate::mesh::{Id, Mesh};
use crate::scene::{Dynamics, Handle, Motion, MotionKey, Pose, Scene, SolverChoice, Surface};
use crate::sim::{SimSettings, Simulation, SizingMode};

/// Of the drum (m).
const RADIUS: f64 = 0.05;
const SIDES: u32 = 180;

/// Of the strip on either side below the drum's axis (m).
const TAIL: f64 = 0.05;
const WIDTH: f64 = 0.02;
const CELL: f64 = 0.005;

/// The strip hardly stretches under its pull, 1 to 10 N/m.
const STRETCHING: f64 = 2e4;
const RIGIDITY: f64 = 1e-6;

/// Of the springs at each node of the ends (N/m): soft, so that they are scales as well.
const SPRING: f64 = 10.0;

/// Both ends are pulled down so far (m), then one of them farther, at this speed (m/s).
const PRETENSION: f64 = 0.02;
const PRETENSION_TIME: f64 = 0.4;
const SPEED: f64 = 0.05;
const DURATION: f64 = 1.6;

pub fn experiments() -> Vec<Experiment> {
    let of = |(mu, step): (f64, Step)| {
        let claim = Claim::absolute(format!("capstan/{}mu-{mu}", step.prefix()), mu, 0.02);
        Experiment::new(vec![claim], move || Ok(vec![slipping_friction(mu, step)?]))
    };
    Step::ALL.into_iter().flat_map(|step| [0.1, 0.3].map(|mu| of((mu, step)))).collect()
}

/// ln(T2 / T1) / phi over half a turn, at the end of the pull.
fn slipping_friction(mu: f64, step: Step) -> Result<f64, ExperimentError> {
    let settings = SimSettings { sizing: SizingMode::Uniform { edge_length: None } };
    let scene = Arc::new(scene(mu, step));
    let (mut simulation, first) = Simulation::start(scene.clone(), settings)?;
    let starts = [0, 1].map(|end| end_height(&first.garments[0], end));
    let frames = (DURATION / scene.frame_time()) as u32;
    let mut friction = f64::NAN;
    for _ in 0..frames {
        let frame = simulation.advance()?;
        let pulls = [0, 1].map(|end| {
            let target = starts[end] + scene.motions[end].pose(frame.time).translation.z;
            end_height(&frame.garments[0], end) - target
        });
        friction = (pulls[1] / pulls[0]).ln() / PI;
    }
    Ok(friction)
}

/// Half the length of the strip (m).
fn half_length() -> f64 {
    0.5 * PI * (RADIUS + stage::scene(Vec::new()).contact.thickness) + TAIL
}

/// The mean height of one of the two ends (m).
fn end_height(mesh: &Mesh, end: usize) -> f64 {
    let nodes = end_nodes(mesh, end);
    nodes.iter().map(|&n| mesh.position.as_slice()[n as usize].z).sum::<f64>() / nodes.len() as f64
}

fn end_nodes(mesh: &Mesh, end: usize) -> Vec<u32> {
    let line = [-half_length(), half_length()][end];
    let at_end = mesh.vertex_ids().filter(|&v| mesh.material(v).x == line);
    at_end.map(|v| mesh.node_of(v).index() as u32).collect()
}

/// The strip hangs over the drum with u = 0 on top; there is no gravity.
fn scene(mu: f64, step: Step) -> Scene {
    let half = half_length();
    let sheet = Sheet {
        origin: DVec2::new(-half, -0.5 * WIDTH),
        size: DVec2::new(2.0 * half, WIDTH),
        cell: CELL,
        layout: Layout::Irregular,
        columns: Vec::new(),
    };
    let mut scene = stage::scene(Vec::new());
    let radius = RADIUS + scene.contact.thickness;
    let mesh = sheet.mesh(|u| {
        let angle = (u.x / radius).clamp(-0.5 * PI, 0.5 * PI);
        let below = u.x.abs() - 0.5 * PI * radius;
        let height = if below > 0.0 { -below } else { radius * angle.cos() };
        DVec3::new(radius * angle.sin(), u.y, height)
    });
    let hold = |end: usize| Handle {
        garment: 0,
        nodes: end_nodes(&mesh, end),
        motion: Some(end),
        start_time: 0.0,
        end_time: f64::INFINITY,
    };
    scene.handles = vec![hold(0), hold(1)];
    scene.motions = vec![pulled(0.0), pulled(SPEED)];
    scene.handle_stiffness = SPRING;
    scene.garments = vec![stage::garment(mesh, fabric::plain(RIGIDITY, STRETCHING, 0.2))];
    scene.gravity = DVec3::ZERO;
    scene.contact.friction_obstacle = mu;
    scene.contact.stiffness = 1e7;
    let iterated = Dynamics { iterations: 5, tolerance: 1e-5, solver: SolverChoice::Direct };
    scene.dynamics = step.dynamics(iterated);
    scene.obstacles = vec![stage::obstacle(drum(), Pose::IDENTITY)];
    scene
}

/// Down by the pretension, then on at a speed (m/s).
fn pulled(speed: f64) -> Motion {
    let way = |time: f64| {
        let share = (time / PRETENSION_TIME).min(1.0);
        PRETENSION * share + speed * (time - PRETENSION_TIME).max(0.0)
    };
    let key = |k: u32| {
        let time = DURATION * f64::from(k) / 16.0;
        let translation = DVec3::NEG_Z * way(time);
        MotionKey { time, pose: Pose { translation, ..Pose::IDENTITY }, velocity: None }
    };
    Motion::from_keys((0..=16).map(key).collect()).expect("the keys are in order")
}

/// A prism around the y axis with corners at its far ends only.
fn drum() -> Surface {
    let rim = |y: f64| {
        (0..SIDES).map(move |k| {
            let turn = DQuat::from_rotation_y(TAU * f64::from(k) / f64::from(SIDES));
            turn * (RADIUS * DVec3::Z) + y * DVec3::Y
        })
    };
    let mut positions: Vec<DVec3> = rim(-0.1).chain(rim(0.1)).collect();
    let [near, far] = [positions.len() as u32, positions.len() as u32 + 1];
    positions.extend([DVec3::NEG_Y * 0.1, DVec3::Y * 0.1]);
    let mut triangles = Vec::new();
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        triangles.extend([[k, next, next + SIDES], [k, next + SIDES, k + SIDES]]);
        triangles.extend([[near, next, k], [far, k + SIDES, next + SIDES]]);
    }
    Surface { positions, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drum_is_closed_and_faces_outward() {
        let drum = drum();
        assert_eq!(drum.open_edge_count(), 0);
        for t in &drum.triangles {
            let [a, b, c] = t.map(|k| drum.positions[k as usize]);
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "{t:?}");
        }
    }
}
