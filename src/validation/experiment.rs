//! What is claimed, what is measured, and how far apart the two are.

use serde::Serialize;
use thiserror::Error;

use crate::dynamics::StepError;
use crate::sim::SimError;

/// A figure that is known, and how far off a measured one may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Parts separated by slashes, from general to special.
    pub name: String,
    pub expected: f64,
    pub tolerance: Tolerance,
}

/// How the error of a figure is taken, and how large it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// |measured - expected| / |expected|.
    Relative(f64),
    /// |measured - expected|.
    Absolute(f64),
    /// max(0, measured - expected): less is as good.
    Above(f64),
}

/// A claim and what was measured of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    pub name: String,
    pub expected: f64,
    /// NaN, which JSON writes as null, if the experiment came to nothing.
    pub measured: f64,
    /// As the claim's [`Tolerance`] takes it.
    pub error: f64,
    pub tolerance: f64,
}

/// Why an experiment came to nothing.
#[derive(Debug, Error)]
pub enum ExperimentError {
    #[error(transparent)]
    Step(#[from] StepError),
    #[error(transparent)]
    Simulation(#[from] SimError),
    #[error("not at rest after {steps} steps: forces are off by {residual:.1e}, not {limit:.1e}")]
    NotAtRest { steps: usize, residual: f64, limit: f64 },
    #[error("{0}")]
    Nothing(&'static str),
}

/// Claims, and what measures them.
pub struct Experiment {
    claims: Vec<Claim>,
    measure: Box<Measure>,
}

type Measure = dyn Fn() -> Result<Vec<f64>, ExperimentError> + Send + Sync;

/// What came of an experiment.
#[derive(Debug)]
pub struct Outcome {
    /// One per claim.
    pub rows: Vec<Row>,
    /// Why nothing was measured, if nothing was.
    pub error: Option<ExperimentError>,
}

impl Claim {
    /// Within a share of what is expected.
    pub fn relative(name: impl Into<String>, expected: f64, tolerance: f64) -> Self {
        Self { name: name.into(), expected, tolerance: Tolerance::Relative(tolerance) }
    }

    /// Within a difference.
    pub fn absolute(name: impl Into<String>, expected: f64, tolerance: f64) -> Self {
        Self { name: name.into(), expected, tolerance: Tolerance::Absolute(tolerance) }
    }

    /// No more than zero.
    pub fn none(name: impl Into<String>, tolerance: f64) -> Self {
        Self { name: name.into(), expected: 0.0, tolerance: Tolerance::Above(tolerance) }
    }

    /// What a measured figure makes of the claim.
    pub fn row(&self, measured: f64) -> Row {
        let off = measured - self.expected;
        let (error, tolerance) = match self.tolerance {
            Tolerance::Relative(tolerance) => ((off / self.expected).abs(), tolerance),
            Tolerance::Absolute(tolerance) => (off.abs(), tolerance),
            // Unlike `max`, this hands a NaN on.
            Tolerance::Above(tolerance) => (if off < 0.0 { 0.0 } else { off }, tolerance),
        };
        Row { name: self.name.clone(), expected: self.expected, measured, error, tolerance }
    }
}

impl Row {
    /// Whether the claim holds; a NaN never does.
    pub fn holds(&self) -> bool {
        self.error <= self.tolerance
    }
}

impl Experiment {
    /// The measurement gives one figure per claim, in their order.
    pub fn new(
        claims: Vec<Claim>,
        measure: impl Fn() -> Result<Vec<f64>, ExperimentError> + Send + Sync + 'static,
    ) -> Self {
        Self { claims, measure: Box::new(measure) }
    }

    pub fn claims(&self) -> &[Claim] {
        &self.claims
    }

    /// # Panics
    /// If the measurement does not give one figure per claim.
    pub fn run(&self) -> Outcome {
        let (measured, error) = match (self.measure)() {
            Ok(measured) => (measured, None),
            Err(error) => (vec![f64::NAN; self.claims.len()], Some(error)),
        };
        assert_eq!(measured.len(), self.claims.len(), "every claim is measured");
        let rows = self.claims.iter().zip(measured).map(|(claim, figure)| claim.row(figure));
        Outcome { rows: rows.collect(), error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_taken_as_the_tolerance_says() {
        assert_eq!(Claim::relative("a", -2.0, 0.1).row(-2.5).error, 0.25);
        assert_eq!(Claim::absolute("a", 2.0, 0.1).row(1.5).error, 0.5);
        assert_eq!(Claim::none("a", 0.1).row(-3.0).error, 0.0);
        assert_eq!(Claim::none("a", 0.1).row(0.5).error, 0.5);
    }

    #[test]
    fn what_is_not_a_number_never_holds() {
        for claim in
            [Claim::relative("a", 1.0, 9.0), Claim::absolute("a", 1.0, 9.0), Claim::none("a", 9.0)]
        {
            assert!(!claim.row(f64::NAN).holds(), "{claim:?}");
            assert!(claim.row(1.0).holds(), "{claim:?}");
        }
    }

    #[test]
    fn an_experiment_that_comes_to_nothing_has_rows_that_do_not_hold() {
        let claims = vec![Claim::none("a", 1.0), Claim::none("b", 1.0)];
        let outcome = Experiment::new(claims, || Err(ExperimentError::Nothing("broken"))).run();
        assert!(outcome.rows.len() == 2 && outcome.rows.iter().all(|row| !row.holds()));
        assert_eq!(outcome.error.unwrap().to_string(), "broken");
        let json = serde_json::to_value(&outcome.rows[0]).unwrap();
        assert_eq!(json["measured"], serde_json::Value::Null);
    }
}
