//! A strip bent by a moment at its end is an arc; M = 2 pi D / L per width closes the circle.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, fabric};
use crate::dynamics::HandleSpring;

const LENGTH: f64 = 0.2;
const WIDTH: f64 = LENGTH / 8.0;
const CELL: f64 = LENGTH / 40.0;
const RIGIDITY: f64 = 1e-3;
const THICKNESS: f64 = LENGTH / 100.0;

/// Parts in which the moment is laid on.
const PARTS: u32 = 16;

/// How often a couple is turned to where the end has turned under it.
const TURNS: usize = 4;

/// How far away the points are that pull (m): their springs are as weak as the force over this.
const PULL_LENGTH: f64 = 10.0;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let claims = vec![
            Claim::relative(format!("roll-up/{}/turn", layout.name()), TAU, 0.01),
            Claim::absolute(format!("roll-up/{}/gap-over-length", layout.name()), 0.0, 0.02),
        ];
        Experiment::new(claims, move || measure(layout))
    };
    vec![of(Layout::Aligned), of(Layout::Irregular)]
}

/// The angle by which the end turns (rad), and how far it stays from the beginning (in lengths).
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let half = 0.5 * CELL;
    let sheet = Sheet {
        origin: DVec2::new(-half, 0.0),
        size: DVec2::new(LENGTH + 2.0 * half, WIDTH),
        cell: CELL,
        layout,
        columns: vec![half, LENGTH - half],
    };
    let stretching = fabric::homogeneous_stretching(RIGIDITY, 0.0, THICKNESS);
    let fabric = fabric::plain(RIGIDITY, stretching, 0.2);
    let mut strip = Specimen::new(sheet.mesh(|u| u.extend(0.0)), &fabric);
    strip.clamp(|u| u.x < 1.5 * half);
    let clamps = strip.clamps.clone();
    let (inner, outer) = (columns_at(LENGTH - half), columns_at(LENGTH + half));
    let mut turned = 0.0;
    for part in 1..=PARTS {
        let moment = TAU * RIGIDITY / LENGTH * WIDTH * f64::from(part) / f64::from(PARTS);
        for _ in 0..TURNS {
            let force = DVec3::new(-f64::sin(turned), 0.0, f64::cos(turned)) * (moment / CELL);
            strip.clamps.clone_from(&clamps);
            pull(&mut strip, &outer, force);
            pull(&mut strip, &inner, -force);
            let load = force.length();
            strip.settle(&Rest { residual: 1e-5, load, first_step: 0.02, steps_max: 500 })?;
            let along = strip.mean_position(&outer) - strip.mean_position(&inner);
            let change = along.z.atan2(along.x) - turned;
            turned += change - TAU * (change / TAU).round();
        }
    }
    let end = strip.mean_position(&outer).midpoint(strip.mean_position(&inner));
    let start = DVec3::new(0.0, end.y, 0.0);
    Ok(vec![turned, end.distance(start) / LENGTH])
}

fn columns_at(line: f64) -> impl Fn(DVec2) -> bool {
    move |u| (u.x - line).abs() < 1e-9
}

/// Shares a force out among nodes.
fn pull(strip: &mut Specimen, is_chosen: &impl Fn(DVec2) -> bool, force: DVec3) {
    let chosen = strip.vertices(is_chosen);
    let share = force / chosen.len() as f64;
    let stiffness = share.length() / PULL_LENGTH;
    for vertex in chosen {
        let node = strip.node_of(vertex);
        let target = strip.state.position[node] + share / stiffness;
        strip.clamps.push(HandleSpring { node, target, stiffness });
    }
}
