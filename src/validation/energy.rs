//! A step takes energy from cloth that is left to itself; it never adds any.

use super::momentum::crumpled;
use super::{Claim, Experiment, ExperimentError};
use crate::scene::{Dynamics, SolverChoice};

const STEPS: usize = 200;
const DT: f64 = 5e-3;

/// A step linearised once may add energy while a crumpled sheet springs open: this share of all
/// there is, at most.
const LINEARISED_GAIN_MAX: f64 = 1e-6;

/// What the tolerance of the iterations leaves open.
const CONVERGED_GAIN_MAX: f64 = 1e-9;

const CONVERGED: Dynamics =
    Dynamics { iterations: 100, tolerance: 1e-9, solver: SolverChoice::Direct };

pub fn experiments() -> Vec<Experiment> {
    let of = |name: &str, dynamics: Dynamics, limit: f64| {
        let claim = Claim::none(format!("energy/gain/{name}"), limit);
        Experiment::new(vec![claim], move || measure(dynamics))
    };
    vec![
        of("linearised-step", Dynamics { iterations: 1, ..CONVERGED }, LINEARISED_GAIN_MAX),
        of("converged-step", CONVERGED, CONVERGED_GAIN_MAX),
    ]
}

/// The largest gain of energy in a step of a crumpled sheet that nothing acts on, relative to the
/// energy at the start; negative if every step lost some.
fn measure(dynamics: Dynamics) -> Result<Vec<f64>, ExperimentError> {
    let mut sheet = crumpled(1.0);
    sheet.system.set_dynamics(dynamics);
    let start = sheet.energy();
    let mut before = start;
    let mut gain = f64::NEG_INFINITY;
    for _ in 0..STEPS {
        sheet.step(DT)?;
        let after = sheet.energy();
        gain = gain.max(after - before);
        before = after;
    }
    Ok(vec![gain / start])
}
