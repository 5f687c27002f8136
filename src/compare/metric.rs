//! What is compared, by the names that tables, files and tolerances share.

use super::report::Kind;
use crate::resample::VisibleError;

/// A number that says how much two results differ; 0 where they do not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Metric {
    /// Share of the picture's pixels of which a channel is off by more than the tolerance's levels.
    Share,
    /// Mean FLIP of the pictures, 0..1.
    Flip,
    /// Displacement of the cloth that is seen (px): root mean square.
    RmsPx,
    /// The same, 95th percentile (px).
    P95Px,
    /// Share of the cloth's pixels displaced by more than 1 px.
    Over1px,
    /// Pixels that are cloth in one picture only, as a share of those that are in either.
    SilhouetteShare,
    /// Mean distance between the outlines (px).
    SilhouettePx,
    /// Change since the frame before beyond the reference's own (px): root mean square.
    PoppingRmsPx,
    /// The same, 95th percentile (px).
    PoppingP95Px,
    /// Displacement in the world of cloth that is not seen (m): root mean square by area.
    UnseenRmsM,
    /// The same, 95th percentile (m).
    UnseenP95M,
}

impl Metric {
    pub const ALL: [Self; 11] = [
        Self::Share,
        Self::Flip,
        Self::RmsPx,
        Self::P95Px,
        Self::Over1px,
        Self::SilhouetteShare,
        Self::SilhouettePx,
        Self::PoppingRmsPx,
        Self::PoppingP95Px,
        Self::UnseenRmsM,
        Self::UnseenP95M,
    ];

    /// Whether things of a kind can have a value of it.
    pub fn is_of(self, kind: Kind) -> bool {
        match self {
            Self::Share => kind == Kind::Pictures,
            Self::Flip => true,
            _ => kind == Kind::Runs,
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Share => "share",
            Self::Flip => "flip",
            Self::RmsPx => "rms_px",
            Self::P95Px => "p95_px",
            Self::Over1px => "over_1px",
            Self::SilhouetteShare => "silhouette_share",
            Self::SilhouettePx => "silhouette_px",
            Self::PoppingRmsPx => "popping_rms_px",
            Self::PoppingP95Px => "popping_p95_px",
            Self::UnseenRmsM => "unseen_rms_m",
            Self::UnseenP95M => "unseen_p95_m",
        }
    }
}

/// A metric's value; `None` if it is without bound, as the distance to an outline that is not there.
pub type Value = (Metric, Option<f64>);

/// A frame's visible error by metric; popping only where there is a frame before.
pub fn visible_error_values(error: &VisibleError) -> Vec<Value> {
    let mut values = vec![
        (Metric::RmsPx, Some(error.displacement.rms)),
        (Metric::P95Px, Some(error.displacement.p95)),
        (Metric::Over1px, Some(error.share_over_1px)),
        (Metric::SilhouetteShare, Some(error.silhouette.share)),
        (Metric::SilhouettePx, error.silhouette.distance),
    ];
    if let Some(popping) = error.popping {
        values.push((Metric::PoppingRmsPx, Some(popping.rms)));
        values.push((Metric::PoppingP95Px, Some(popping.p95)));
    }
    values.push((Metric::UnseenRmsM, Some(error.unseen.displacement.rms)));
    values.push((Metric::UnseenP95M, Some(error.unseen.displacement.p95)));
    values
}
