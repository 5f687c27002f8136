//! What is done to sizing metrics: combine, bound, keep from becoming slivers.

use glam::{DMat2, DVec2};

use super::{Eigen2, SymTensor2};

/// The smallest metric at least as fine as both ([`NPO13`](crate::papers::NPO13)): in the basis
/// which makes both diagonal, the larger of each pair of eigenvalues. For semi-definite ones.
///
/// That is (c + |d|) / 2 with c = a + b, d = a - b, where |d| is the pencil (d, c) with the signs
/// of its negative eigenvalues turned. With x = tr(adj(a) b): where x <= det a + det b one
/// dominates and |d| is d or -d; else |d| = (d (det a - det b) + c (x - det a - det b)) / r,
/// r^2 = x^2 - 4 det a det b. No inverse, no eigenvectors; rank one is no exception.
pub fn tensor_max(a: SymTensor2, b: SymTensor2) -> SymTensor2 {
    let [det_a, det_b] = [a, b].map(|m| m.determinant().max(0.0));
    let x = a.yy * b.xx + a.xx * b.yy - 2.0 * a.xy * b.xy;
    let excess = x - det_a - det_b;
    if excess <= DOMINANCE_SLACK * a.trace() * b.trace() {
        return if a.trace() >= b.trace() { a } else { b };
    }
    let r = (x * x - 4.0 * det_a * det_b).sqrt();
    let (c, d) = (a + b, a - b);
    (c + d * ((det_a - det_b) / r) + c * (excess / r)) * 0.5
}

/// A metric counts as dominating another when it falls short of it by no more than this part: what
/// rounding makes of two metrics of rank one in the same direction.
const DOMINANCE_SLACK: f64 = 1e-14;

/// [`tensor_max`] of more than two, folded in the order given: at least as fine as all, and nearly
/// the smallest such. `None` of nothing.
pub fn tensor_max_of(metrics: impl IntoIterator<Item = SymTensor2>) -> Option<SymTensor2> {
    metrics.into_iter().reduce(tensor_max)
}

/// Least part of a metric's diagonal which elimination may leave: below it the rest is rounding.
const CONDITION_MIN: f64 = 1e-10;

/// The largest metric no finer than either: in the basis which makes both diagonal, the smaller of
/// each pair of eigenvalues.
///
/// With a = L L^T and L^-1 b L^-T = Q g Q^T it is L Q min(1, g) Q^T L^T: b may be of any rank.
/// Where a is all but singular, a + b - max(a, b).
pub fn tensor_min(a: SymTensor2, b: SymTensor2) -> SymTensor2 {
    let well_conditioned = |l: &DMat2| l.y_axis.y * l.y_axis.y > CONDITION_MIN * a.yy;
    let Some(l) = a.cholesky().filter(well_conditioned) else {
        return a + b - tensor_max(a, b);
    };
    let (l00, l10, l11) = (l.x_axis.x, l.x_axis.y, l.y_axis.y);
    // L^-1 b L^-T.
    let xx = b.xx / (l00 * l00);
    let xy = (b.xy / l00 - xx * l10) / l11;
    let yy = (b.yy / l11 - l10 * (2.0 * xy + xx * l10 / l11)) / l11;
    let relative = SymTensor2::new(xx, xy, yy).eigen();
    if relative.values[1] >= 1.0 {
        return a;
    }
    let g = relative.values.map(|g| g.clamp(0.0, 1.0));
    let minor_axis = relative.major_axis.perp();
    let column = |q: DVec2| SymTensor2::outer(l * q);
    column(relative.major_axis) * g[0] + column(minor_axis) * g[1]
}

impl SymTensor2 {
    /// Every eigenvalue raised to at least `least`, then cut to at most `greatest`.
    pub fn clamp_eigenvalues(self, least: f64, greatest: f64) -> Self {
        self.map_eigenvalues(|value| value.max(least).min(greatest))
    }

    /// The smaller eigenvalue raised to at least aspect^2 times the larger, so that the edge
    /// lengths the metric asks for differ at most by the factor 1 / aspect. For semi-definite ones.
    pub fn with_aspect_at_least(self, aspect: f64) -> Self {
        let eigen = self.eigen();
        let least = aspect * aspect * eigen.values[0];
        if eigen.values[1] >= least {
            return self;
        }
        Self::from_eigen(Eigen2 { values: [eigen.values[0], least], ..eigen })
    }

    /// The positive part: negative eigenvalues become 0.
    pub fn positive_part(self) -> Self {
        self.map_eigenvalues(|value| value.max(0.0))
    }

    /// The root of each eigenvalue's magnitude, with the eigenvalue's sign.
    pub fn signed_sqrt(self) -> Self {
        self.map_eigenvalues(|value| value.abs().sqrt().copysign(value))
    }

    /// M M.
    pub fn squared(self) -> Self {
        let (xx, xy, yy) = (self.xx, self.xy, self.yy);
        Self { xx: xx * xx + xy * xy, xy: xy * (xx + yy), yy: xy * xy + yy * yy }
    }
}

#[cfg(test)]
#[path = "metric_tests.rs"]
mod tests;
