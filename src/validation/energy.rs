//! A step takes energy from cloth that is left to itself; it never adds any.

use super::momentum::crumpled;
use super::{Claim, Experiment, ExperimentError};

const STEPS: usize = 200;
const DT: f64 = 5e-3;

/// A step linearised once may add energy while a crumpled sheet springs open: this share of all
/// there is, at most.
const LINEARISED_GAIN_MAX: f64 = 0.01;

pub fn experiments() -> Vec<Experiment> {
    vec![Experiment::new(
        vec![Claim::none("energy/gain/linearised-step", LINEARISED_GAIN_MAX)],
        measure,
    )]
}

/// The largest gain of energy in a step of a crumpled sheet that nothing acts on, relative to the
/// energy at the start; negative if every step lost some.
fn measure() -> Result<Vec<f64>, ExperimentError> {
    let mut sheet = crumpled(1.0);
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
