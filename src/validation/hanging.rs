//! A strip that hangs from its upper edge stretches under its own weight.

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, GRAVITY, fabric};

const LENGTH: f64 = 0.5;
const DENSITY: f64 = 0.2;

/// Membrane stiffness (N/m): the strip stretches by 5e-4, little enough for Hooke's law.
const STIFFNESS: f64 = 1000.0;

/// Saint Venant and Kirchhoff's law is softer than Hooke's by 3/2 of the strain, 7e-4.
const TOLERANCE: f64 = 2e-3;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let name = format!("hanging-strip/{}", layout.name());
        let claim = Claim::relative(name, expected(), TOLERANCE);
        Experiment::new(vec![claim], move || measure(layout))
    };
    [Layout::Aligned, Layout::Rotated(0.3), Layout::Irregular].map(of).into()
}

/// rho g L^2 / (2 E) (m), rho per area, E per width.
fn expected() -> f64 {
    DENSITY * GRAVITY * LENGTH * LENGTH / (2.0 * STIFFNESS)
}

/// How far the lower edge sinks (m).
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let size = DVec2::new(LENGTH, 0.1);
    let sheet = Sheet { origin: DVec2::ZERO, size, cell: 0.02, layout, columns: Vec::new() };
    let fabric = fabric::plain(1e-5, STIFFNESS, DENSITY);
    let mut strip = Specimen::new(sheet.mesh(|u| DVec3::new(u.y, 0.0, -u.x)), &fabric);
    strip.clamp(|u| u.x == 0.0);
    strip.gravity = DVec3::NEG_Z * GRAVITY;
    let load = strip.mass() * GRAVITY;
    strip.settle(&Rest { residual: 1e-7, load, first_step: 0.05, steps_max: 200 })?;
    Ok(vec![-LENGTH - strip.mean_position(|u| u.x == LENGTH).z])
}
