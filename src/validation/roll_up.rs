//! A strip rolled up to a closed circle is held so by M = 2 pi D / L per width at its ends, and
//! needs no other force.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, fabric};

const LENGTH: f64 = 0.2;
const RADIUS: f64 = LENGTH / TAU;
const WIDTH: f64 = LENGTH / 8.0;
const CELL: f64 = LENGTH / 64.0;
const RIGIDITY: f64 = 1e-3;
const THICKNESS: f64 = LENGTH / 100.0;

const TOLERANCE: f64 = 0.02;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let name = |figure: &str| format!("roll-up/{}/{figure}", layout.name());
        let claims = vec![
            Claim::relative(name("couple"), TAU * RIGIDITY * WIDTH / LENGTH, TOLERANCE),
            Claim::absolute(name("way-off-the-circle"), 0.0, TOLERANCE),
        ];
        Experiment::new(claims, move || measure(layout))
    };
    vec![of(Layout::Aligned), of(Layout::Irregular)]
}

/// The couple of the clamps of one end (N m), and how far the strip leaves the circle (in radii).
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let mut strip = rolled_up(layout);
    let load = TAU * RIGIDITY * WIDTH / (LENGTH * RADIUS);
    strip.settle(&Rest { residual: 1e-5, load, first_step: 0.02, steps_max: 1000 })?;
    let off = |x: &DVec3| (x.with_y(0.0).length() / RADIUS - 1.0).abs();
    let off_the_circle = strip.state.position.iter().map(off).fold(0.0, f64::max);
    Ok(vec![couple(&strip), off_the_circle])
}

/// About the line where the strip ends, of the clamps there (N m).
fn couple(strip: &Specimen) -> f64 {
    let end = on_circle(DVec2::new(LENGTH, 0.0));
    let is_end = |u: DVec2| (u.x - LENGTH).abs() < 0.75 * CELL;
    let nodes: Vec<usize> = strip.vertices(is_end).iter().map(|&v| strip.node_of(v)).collect();
    let of_clamp = |node: usize| {
        let at = strip.state.position[node];
        let clamps = strip.clamps.iter().filter(|clamp| clamp.node == node);
        clamps.map(|clamp| (at - end).cross(clamp.force(at)).y).sum::<f64>()
    };
    nodes.into_iter().map(of_clamp).sum()
}

/// Both ends are clamped half way between two rows, like the cantilever; they lie on each other.
fn rolled_up(layout: Layout) -> Specimen {
    let sheet = Sheet {
        origin: DVec2::new(-0.5 * CELL, 0.0),
        size: DVec2::new(LENGTH + CELL, WIDTH),
        cell: CELL,
        layout,
        columns: vec![0.5 * CELL, LENGTH - 0.5 * CELL],
    };
    let stretching = fabric::homogeneous_stretching(RIGIDITY, 0.0, THICKNESS);
    let fabric = fabric::plain(RIGIDITY, stretching, 0.2);
    let mut strip = Specimen::new(sheet.mesh(on_circle), &fabric);
    strip.clamp(|u| u.x < 0.75 * CELL || u.x > LENGTH - 0.75 * CELL);
    strip
}

/// The circle around the axis y.
fn on_circle(u: DVec2) -> DVec3 {
    let (sine, cosine) = (u.x / RADIUS).sin_cos();
    DVec3::new(RADIUS * sine, u.y, RADIUS * cosine)
}
