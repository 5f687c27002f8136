//! At which load a strip buckles sideways, by each model of bending.

use anyhow::Result;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::super::super::failure::Failure;
use super::super::super::interrupt::Interrupt;
use super::name;
use crate::scene::BendingModel;
use crate::validation::bending::MODELS;
use crate::validation::buckling::{ONSETS, onset_of};
use crate::validation::sheet::Layout;

/// The least and the greatest nu of those whose onset is known: a model that treats twist unlike
/// bending is off by different amounts.
const ENDS: [(f64, f64); 2] = [ONSETS[0], ONSETS[ONSETS.len() - 1]];

/// What became of strips of one model and layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnsetRow {
    pub model: BendingModel,
    pub layout: Layout,
    /// Gamma_c over that of theory - 1 for each of [`ENDS`]; `None` where nothing was measured.
    pub errors: [Option<f64>; 2],
}

impl OnsetRow {
    /// The largest error as a magnitude; `None` if nothing was measured.
    pub fn worst(&self) -> Option<f64> {
        self.errors.iter().flatten().map(|e| e.abs()).reduce(f64::max)
    }

    pub fn json(&self) -> Value {
        json!({
            "model": self.model, "layout": self.layout.name(),
            "poisson_ratios": ENDS.map(|(nu, _)| nu), "errors": self.errors,
        })
    }
}

/// # Errors
/// If the user asks to stop.
pub fn rows(interrupt: &Interrupt) -> Result<Vec<OnsetRow>> {
    let trials: Vec<(BendingModel, Layout)> =
        MODELS.iter().flat_map(|&model| Layout::ALL.map(|layout| (model, layout))).collect();
    trials
        .par_iter()
        .map(|&(model, layout)| {
            if let Some(signal) = interrupt.requested() {
                return Err(Failure::Interrupted(signal).into());
            }
            let errors = ENDS.map(|(nu, expected)| match onset_of(model, layout, nu) {
                Ok(onset) => Some(onset / expected - 1.0),
                Err(error) => {
                    tracing::warn!("{}, {} mesh, nu {nu}: {error}", name(model), layout.name());
                    None
                }
            });
            Ok(OnsetRow { model, layout, errors })
        })
        .collect()
}

/// A line per model and layout.
pub fn table(rows: &[OnsetRow]) -> String {
    let [low, high] = ENDS.map(|(nu, _)| format!("nu {nu}"));
    let title = "onset of lateral buckling, Gamma against theory's".to_owned();
    let head = format!("{:10} {:12} {low:>9} {high:>9}", "model", "layout");
    let line = |row: &OnsetRow| {
        let [low, high] = row.errors.map(|error| match error {
            Some(error) => format!("{:+.2} %", 100.0 * error),
            None => "none".to_owned(),
        });
        format!("{:10} {:12} {low:>9} {high:>9}", name(row.model), row.layout.name())
    };
    [title, head].into_iter().chain(rows.iter().map(line)).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_measured_is_said_and_is_not_an_error_of_zero() {
        let of = |errors| OnsetRow { model: MODELS[0], layout: Layout::Aligned, errors };
        assert_eq!(of([Some(-0.2), Some(0.1)]).worst(), Some(0.2));
        assert_eq!(of([None, Some(0.1)]).worst(), Some(0.1));
        assert_eq!(of([None, None]).worst(), None);
        let table = table(&[of([Some(-0.2), None])]);
        let words: Vec<&str> = table.lines().last().unwrap().split_whitespace().collect();
        assert_eq!(words, ["hinges", "aligned", "-20.00", "%", "none"]);
    }
}
