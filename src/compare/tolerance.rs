//! How much two results may differ.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::metric::Metric;

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
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    #[error("the limit of {name} is {value}: it must be at least 0")]
    Negative { name: &'static str, value: f64 },
}

impl Tolerance {
    /// # Errors
    /// If the text is no JSON object of known limits, or a limit is below 0.
    pub fn from_json(text: &str) -> Result<Self, ToleranceError> {
        let tolerance: Self = serde_json::from_str(text)?;
        for metric in Metric::ALL {
            if let Some(value) = tolerance.limit(metric).filter(|&limit| !(limit >= 0.0)) {
                return Err(ToleranceError::Negative { name: metric.name(), value });
            }
        }
        Ok(tolerance)
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
            assert_eq!(Tolerance::from_json(&text).unwrap().limit(metric), Some(0.25));
        }
    }

    #[test]
    fn the_tolerance_of_a_golden_picture_is_one() {
        let tolerance = Tolerance::from_json(r#"{ "levels": 12, "share": 0.004 }"#).unwrap();
        assert_eq!((tolerance.levels, tolerance.share), (12, Some(0.004)));
    }

    #[test]
    fn unknown_and_negative_limits_are_refused() {
        for text in [r#"{"rms": 1}"#, r#"{"rms_px": -1}"#, r#"{"levels": 256}"#, "7", ""] {
            assert!(Tolerance::from_json(text).is_err(), "{text}");
        }
    }
}
