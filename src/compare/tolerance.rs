//! How much two results may differ.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::metric::Metric;
use super::report::Kind;
use crate::scene::{self, LoadError};

/// Limits by metric; a metric without one may be anything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tolerance {
    /// A pixel differs if one of its channels is off by more than this many levels of 255.
    pub levels: u8,
    pub share: Option<f64>,
    pub flip: Option<f64>,
    pub rms_px: Option<f64>,
    pub p95_px: Option<f64>,
    pub over_1px: Option<f64>,
    pub silhouette_share: Option<f64>,
    pub silhouette_px: Option<f64>,
    pub popping_rms_px: Option<f64>,
    pub popping_p95_px: Option<f64>,
    pub unseen_rms_m: Option<f64>,
    pub unseen_p95_m: Option<f64>,
}

/// Why a tolerance cannot be used.
#[derive(Debug, Error)]
pub enum ToleranceError {
    #[error("{0}")]
    Json(#[from] LoadError),
    #[error("the limit of {name} is {value}: it must be at least 0")]
    Negative { name: &'static str, value: f64 },
    #[error("it limits only what {} do not have: {names}", kind.name())]
    OfOtherKind { kind: Kind, names: String },
}

impl Tolerance {
    /// # Errors
    /// If the text of the file is no JSON object of known limits, or a limit is below 0.
    pub fn from_json(file: &str, text: &str) -> Result<Self, ToleranceError> {
        let tolerance: Self = scene::from_json(file, text)?;
        for metric in Metric::ALL {
            if let Some(value) = tolerance.limit(metric).filter(|&limit| !(limit >= 0.0)) {
                return Err(ToleranceError::Negative { name: metric.name(), value });
            }
        }
        Ok(tolerance)
    }

    /// Metrics with a limit that things of a kind do not have, so that it never fires: a file may
    /// serve runs and pictures.
    ///
    /// # Errors
    /// If that is true of all limits.
    pub fn idle_limits(&self, kind: Kind) -> Result<Vec<Metric>, ToleranceError> {
        let limited = Metric::ALL.into_iter().filter(|&metric| self.limit(metric).is_some());
        let (of_kind, idle): (Vec<Metric>, Vec<Metric>) =
            limited.partition(|metric| metric.is_of(kind));
        if of_kind.is_empty() && !idle.is_empty() {
            let names: Vec<&str> = idle.iter().map(|metric| metric.name()).collect();
            return Err(ToleranceError::OfOtherKind { kind, names: names.join(", ") });
        }
        Ok(idle)
    }

    pub fn limit(&self, metric: Metric) -> Option<f64> {
        match metric {
            Metric::Share => self.share,
            Metric::Flip => self.flip,
            Metric::RmsPx => self.rms_px,
            Metric::P95Px => self.p95_px,
            Metric::Over1px => self.over_1px,
            Metric::SilhouetteShare => self.silhouette_share,
            Metric::SilhouettePx => self.silhouette_px,
            Metric::PoppingRmsPx => self.popping_rms_px,
            Metric::PoppingP95Px => self.popping_p95_px,
            Metric::UnseenRmsM => self.unseen_rms_m,
            Metric::UnseenP95M => self.unseen_p95_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_can_have_a_limit_under_its_own_name() {
        for metric in Metric::ALL {
            let text = format!("{{\"{}\": 0.25}}", metric.name());
            assert_eq!(Tolerance::from_json("x", &text).unwrap().limit(metric), Some(0.25));
        }
    }

    #[test]
    fn the_tolerance_of_a_golden_picture_is_one() {
        let tolerance = Tolerance::from_json("x", r#"{ "levels": 12, "share": 0.004 }"#).unwrap();
        assert_eq!((tolerance.levels, tolerance.share), (12, Some(0.004)));
    }

    #[test]
    fn limits_of_the_other_kind_are_known_and_refused_where_there_are_no_others() {
        let of = |text: &str| Tolerance::from_json("x", text).unwrap();
        let both = of(r#"{"levels": 4, "share": 0.1, "flip": 0.1, "rms_px": 1}"#);
        assert_eq!(both.idle_limits(Kind::Runs).unwrap(), [Metric::Share]);
        assert_eq!(both.idle_limits(Kind::Pictures).unwrap(), [Metric::RmsPx]);
        assert_eq!(of("{}").idle_limits(Kind::Runs).unwrap(), []);
        let error = of(r#"{"share": 0.1}"#).idle_limits(Kind::Runs).unwrap_err().to_string();
        assert_eq!(error, "it limits only what runs do not have: share");
    }

    #[test]
    fn unknown_and_negative_limits_are_refused() {
        for text in [r#"{"rms": 1}"#, r#"{"rms_px": -1}"#, r#"{"levels": 256}"#, "7", ""] {
            assert!(Tolerance::from_json("x", text).is_err(), "{text}");
        }
    }
}
