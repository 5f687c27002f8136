//! Inner forces do not push the cloth as a whole.

use glam::DVec2;

use super::sheet::{Layout, Sheet};
use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError, fabric};
use crate::math::Random;

const STEPS: usize = 50;
const DT: f64 = 5e-3;

pub fn experiments() -> Vec<Experiment> {
    vec![Experiment::new(vec![Claim::absolute("momentum/linear", 0.0, 1e-10)], measure)]
}

/// How far the linear momentum of a crumpled sheet drifts without forces from outside, relative to
/// the sum of |m v| over its nodes at the start.
fn measure() -> Result<Vec<f64>, ExperimentError> {
    let mut sheet = crumpled(1.0);
    let scale: f64 =
        sheet.system.masses().iter().zip(&sheet.state.velocity).map(|(m, v)| m * v.length()).sum();
    let before = sheet.momentum();
    let mut drift: f64 = 0.0;
    for _ in 0..STEPS {
        sheet.step(DT)?;
        drift = drift.max(sheet.momentum().distance(before));
    }
    Ok(vec![drift / scale])
}

/// A sheet with every node moved by up to 1 cm, at velocities of up to `speed` (m/s) along each axis.
pub(super) fn crumpled(speed: f64) -> Specimen {
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::new(0.4, 0.3),
        cell: 0.05,
        layout: Layout::Irregular,
        columns: Vec::new(),
    };
    let mesh = sheet.mesh(|u| u.extend(0.0));
    let mut specimen = Specimen::new(mesh, &fabric::plain(2e-5, 500.0, 0.15));
    let mut random = Random::new(3);
    specimen.state.position.iter_mut().for_each(|x| *x += random.vector() * 0.01);
    specimen.state.velocity.iter_mut().for_each(|v| *v = random.vector() * speed);
    specimen
}
