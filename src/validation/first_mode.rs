//! A clamped strip left to itself swings with f = 3.5160 / (2 pi) sqrt(D / (rho L^4)).

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, fabric};

const LENGTH: f64 = 0.2;
const CELL: f64 = LENGTH / 30.0;
const WIDTH: f64 = 4.0 * CELL;
const RIGIDITY: f64 = 1e-3;
const DENSITY: f64 = 0.2;
const STRETCHING: f64 = 1e3;

/// Steps a period; what they do to the frequency is (2 pi / 200)^2 / 3, 3e-4.
const STEPS: f64 = 200.0;

/// Of the tip when let go, in lengths.
const AMPLITUDE: f64 = 1e-3;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let name = format!("first-mode/{}", layout.name());
        let claim = Claim::relative(name, expected(), 0.02);
        Experiment::new(vec![claim], move || measure(layout))
    };
    vec![of(Layout::Aligned), of(Layout::Irregular)]
}

/// (1/s).
fn expected() -> f64 {
    3.5160 / TAU * (RIGIDITY / (DENSITY * LENGTH.powi(4))).sqrt()
}

/// One over twice the time between the first two passages of the tip through rest.
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let sheet = Sheet {
        origin: DVec2::new(-0.5 * CELL, 0.0),
        size: DVec2::new(LENGTH + 0.5 * CELL, WIDTH),
        cell: CELL,
        layout,
        columns: vec![0.5 * CELL],
    };
    let fabric = fabric::plain(RIGIDITY, STRETCHING, DENSITY);
    let mut strip = Specimen::new(sheet.mesh(|u| u.extend(0.0)), &fabric);
    strip.clamp(|u| u.x < 0.75 * CELL);
    // The shape under a weight that is taken away is nearly that of the first mode: H / L = Gamma / 8.
    let gravity = 8.0 * AMPLITUDE * RIGIDITY / (DENSITY * LENGTH.powi(3));
    strip.gravity = DVec3::NEG_Z * gravity;
    let load = strip.mass() * gravity;
    strip.settle(&Rest { residual: 1e-5, load, first_step: 0.1, steps_max: 200 })?;
    strip.gravity = DVec3::ZERO;
    let dt = 1.0 / (expected() * STEPS);
    let height = |strip: &Specimen| strip.mean_position(|u| u.x == LENGTH).z;
    let mut passages = Vec::new();
    let mut before = height(&strip);
    for step in 0..STEPS as u32 {
        strip.step(dt)?;
        let after = height(&strip);
        if before.signum() != after.signum() {
            passages.push(dt * (f64::from(step) + before / (before - after)));
        }
        before = after;
    }
    match passages[..] {
        [first, second, ..] => Ok(vec![0.5 / (second - first)]),
        _ => Err(ExperimentError::Nothing("the strip does not swing")),
    }
}
