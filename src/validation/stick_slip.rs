//! A strip clamped upright, pressed down on a rough plane: it sticks until the sideways share of
//! its push exceeds mu.
//!
//! With eps = 1 - height / L the strip needs mu >= mu*(eps), |Q| / P of the elastica clamped at one
//! end and held by a point at the other ([`RLBD21`](crate::papers::RLBD21)). A strip that is pressed
//! down slowly therefore slips at the eps where mu*(eps) is its mu.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::stage::Step;
use super::{Claim, Experiment, ExperimentError, fabric, stage};
use crate::mesh::{Id, Mesh};
use crate::scene::{
    Dynamics, ElasticFabric, Fabric, Handle, Motion, MotionKey, Pose, Scene, SolverChoice,
};
use crate::sim::{SimSettings, Simulation, SizingMode};

/// eps and mu*(eps), until the strip lies down on the plane.
const THRESHOLDS: [(f64, f64); 17] = [
    (0.0005, 0.00996),
    (0.0061, 0.03494),
    (0.0089, 0.04229),
    (0.0201, 0.06412),
    (0.0313, 0.08073),
    (0.0509, 0.10459),
    (0.0762, 0.13061),
    (0.1014, 0.15403),
    (0.1263, 0.17579),
    (0.1510, 0.19674),
    (0.1757, 0.21741),
    (0.2004, 0.23812),
    (0.2251, 0.25910),
    (0.2498, 0.28057),
    (0.2746, 0.30273),
    (0.2993, 0.32580),
    (0.3281, 0.35416),
];

const LENGTH: f64 = 0.2;
const CELL: f64 = LENGTH / 30.0;
const WIDTH: f64 = 2.0 * CELL;
const RIGIDITY: f64 = 1e-2;
const DENSITY: f64 = 0.2;
const THICKNESS: f64 = LENGTH / 100.0;

/// The strip is bent a little from the beginning, so that it knows which way to go.
const IMPERFECTION: f64 = 1e-3;

/// The deepest that it is pressed, and how long that takes (s).
const DEEPEST: f64 = 0.33;
const DURATION: f64 = 4.0;

/// The foot has slipped when it is so far from where it was, in lengths.
const SLIP: f64 = 0.01;

pub fn experiments() -> Vec<Experiment> {
    let of = |(mu, step): (f64, Step)| {
        let claim = Claim::absolute(format!("stick-slip/{}mu-{mu}", step.prefix()), mu, 0.02);
        Experiment::new(vec![claim], move || Ok(vec![threshold(slipping(mu, step)?)]))
    };
    Step::ALL.into_iter().flat_map(|step| [0.1, 0.2, 0.3].map(|mu| of((mu, step)))).collect()
}

/// mu*(eps), between the table's entries.
fn threshold(eps: f64) -> f64 {
    let upper = THRESHOLDS.iter().position(|(e, _)| *e > eps).unwrap_or(THRESHOLDS.len() - 1);
    let [(e0, mu0), (e1, mu1)] = [THRESHOLDS[upper.max(1) - 1], THRESHOLDS[upper.max(1)]];
    mu0 + (mu1 - mu0) * (eps - e0) / (e1 - e0)
}

/// The eps at which the foot slips.
fn slipping(mu: f64, step: Step) -> Result<f64, ExperimentError> {
    let settings = SimSettings { sizing: SizingMode::Uniform { edge_length: None } };
    let scene = Arc::new(scene(mu, step));
    let (mut simulation, first) = Simulation::start(scene.clone(), settings)?;
    let start = foot(&first.garments[0]);
    let frames = (DURATION / scene.frame_time()) as u32;
    let mut before = (0.0, 0.0);
    for _ in 0..frames {
        let frame = simulation.advance()?;
        let top = top(&frame.garments[0]);
        let foot = foot(&frame.garments[0]);
        let eps = 1.0 - (top.z - foot.z) / LENGTH;
        let slip = (foot.x - start.x).abs() / LENGTH;
        if slip > SLIP {
            let share = (SLIP - before.1) / (slip - before.1);
            return Ok(before.0 + share * (eps - before.0));
        }
        before = (eps, slip);
    }
    Err(ExperimentError::Nothing("the strip does not slip"))
}

/// The mean place of the lowest row of nodes (m).
fn foot(mesh: &Mesh) -> DVec3 {
    mean(mesh, |u| u.x == LENGTH)
}

fn top(mesh: &Mesh) -> DVec3 {
    mean(mesh, |u| u.x < CELL)
}

fn mean(mesh: &Mesh, is_chosen: impl Fn(DVec2) -> bool) -> DVec3 {
    let chosen: Vec<DVec3> = mesh
        .vertex_ids()
        .filter(|&v| is_chosen(mesh.material(v)))
        .map(|v| mesh.vertex_position(v))
        .collect();
    chosen.iter().sum::<DVec3>() / chosen.len() as f64
}

/// The clamp, half way between two rows of nodes, comes down; there is no gravity.
fn scene(mu: f64, step: Step) -> Scene {
    let sheet = Sheet {
        origin: DVec2::new(-0.5 * CELL, -0.5 * WIDTH),
        size: DVec2::new(LENGTH + 0.5 * CELL, WIDTH),
        cell: CELL,
        layout: Layout::Aligned,
        columns: vec![0.5 * CELL],
    };
    let mut scene = stage::scene(Vec::new());
    let top = LENGTH + scene.contact.thickness;
    let mesh = sheet.mesh(|u| {
        let share = (u.x / LENGTH).max(0.0);
        let aside = IMPERFECTION * LENGTH * share * share * (1.0 - share);
        DVec3::new(aside, u.y, top - u.x)
    });
    let held = mesh.vertex_ids().filter(|&v| mesh.material(v).x < 0.75 * CELL);
    let nodes = held.map(|v| mesh.node_of(v).index() as u32).collect();
    scene.garments = vec![stage::garment(mesh, fabric())];
    let hold =
        Handle { garment: 0, nodes, motion: Some(0), start_time: 0.0, end_time: f64::INFINITY };
    scene.handles = vec![hold];
    scene.motions = vec![coming_down()];
    scene.gravity = DVec3::ZERO;
    scene.contact.friction_obstacle = mu;
    // The foot carries the push of the whole strip.
    scene.contact.stiffness = 1e8;
    let iterated = Dynamics { iterations: 30, tolerance: 1e-6, solver: SolverChoice::Direct };
    scene.dynamics = step.dynamics(iterated);
    let half = DVec3::new(2.0, 2.0, 0.5);
    let below = Pose { translation: DVec3::NEG_Z * half.z, ..Pose::IDENTITY };
    scene.obstacles = vec![stage::obstacle(stage::block(half), below)];
    scene
}

fn coming_down() -> Motion {
    let at = |time: f64, way: f64| MotionKey {
        time,
        pose: Pose { translation: DVec3::NEG_Z * way, ..Pose::IDENTITY },
        velocity: None,
    };
    // Keys all along the way make the speed even.
    let keys = (0..=20).map(|k| f64::from(k) / 20.0);
    Motion::from_keys(keys.map(|share| at(share * DURATION, share * DEEPEST * LENGTH)).collect())
        .expect("the keys are in order")
}

/// Damped, so that it does not swing.
fn fabric() -> Fabric {
    let stretching = fabric::homogeneous_stretching(RIGIDITY, 0.0, THICKNESS);
    match fabric::plain(RIGIDITY, stretching, DENSITY) {
        Fabric::Elastic(plain) => Fabric::Elastic(ElasticFabric { damping: 0.005, ..plain }),
        other => other,
    }
}
