//! Backward Euler is of first order: half the step, half the error.

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError, fabric};

/// How long the sheet swings (s).
const DURATION: f64 = 0.1;

/// Steps that the coarsest of the runs divides it into; each further run has twice as many.
const STEPS: u32 = 160;
const RUNS: usize = 3;

pub fn experiments() -> Vec<Experiment> {
    vec![Experiment::new(vec![Claim::absolute("order/in-the-step", 1.0, 0.05)], measure)]
}

/// log2 of how much smaller the difference between runs gets with each halving of the step:
/// |x_h - x_{h/2}| / |x_{h/2} - x_{h/4}| = 2^p.
fn measure() -> Result<Vec<f64>, ExperimentError> {
    let mut ends = Vec::new();
    for run in 0..RUNS {
        let mut sheet = swinging();
        let steps = STEPS << run;
        for _ in 0..steps {
            sheet.step(DURATION / f64::from(steps))?;
        }
        ends.push(sheet.state.position);
    }
    let apart = |a: &[DVec3], b: &[DVec3]| -> f64 {
        a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).sum::<f64>().sqrt()
    };
    Ok(vec![(apart(&ends[0], &ends[1]) / apart(&ends[1], &ends[2])).log2()])
}

/// A sheet held at one side, given a smooth push out of its plane.
fn swinging() -> Specimen {
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::new(0.3, 0.2),
        cell: 0.05,
        layout: Layout::Irregular,
        columns: Vec::new(),
    };
    let mesh = sheet.mesh(|u| u.extend(0.0));
    let mut specimen = Specimen::new(mesh, &fabric::plain(1e-4, 50.0, 0.2));
    specimen.clamp(|u| u.x == 0.0);
    for vertex in specimen.vertices(|_| true) {
        let u = specimen.mesh.material(vertex);
        let node = specimen.node_of(vertex);
        specimen.state.velocity[node] = DVec3::Z * (20.0 * u.x * u.x);
    }
    specimen
}
