//! Symmetric 2x2 tensors: strains, and the sizing metrics that say how fine a mesh should be.

use std::ops::{Add, AddAssign, Mul, Sub};

use glam::{DMat2, DVec2};
use serde::{Deserialize, Serialize};

/// A symmetric 2x2 tensor in material coordinates.
///
/// As a sizing metric (1/m^2) it is positive definite, and an edge du is valid if
/// du^T M du <= 1 ([`VD15`](crate::papers::VD15) eq. 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SymTensor2 {
    pub xx: f64,
    pub xy: f64,
    pub yy: f64,
}

/// Eigenvalues, the larger first, and the unit eigenvector of the larger; that of the smaller is
/// its left perpendicular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigen2 {
    pub values: [f64; 2],
    pub major_axis: DVec2,
}

impl SymTensor2 {
    pub const ZERO: Self = Self { xx: 0.0, xy: 0.0, yy: 0.0 };
    pub const IDENTITY: Self = Self { xx: 1.0, xy: 0.0, yy: 1.0 };

    pub const fn new(xx: f64, xy: f64, yy: f64) -> Self {
        Self { xx, xy, yy }
    }

    /// s I.
    pub const fn isotropic(s: f64) -> Self {
        Self { xx: s, xy: 0.0, yy: s }
    }

    /// a a^T.
    pub fn outer(a: DVec2) -> Self {
        Self { xx: a.x * a.x, xy: a.x * a.y, yy: a.y * a.y }
    }

    /// The symmetric part of a matrix.
    pub fn symmetric_part(m: DMat2) -> Self {
        Self { xx: m.x_axis.x, xy: 0.5 * (m.x_axis.y + m.y_axis.x), yy: m.y_axis.y }
    }

    /// Q diag(values) Q^T with Q's first column `major_axis` (unit length).
    pub fn from_eigen(eigen: Eigen2) -> Self {
        let minor_axis = eigen.major_axis.perp();
        Self::outer(eigen.major_axis) * eigen.values[0] + Self::outer(minor_axis) * eigen.values[1]
    }

    pub fn matrix(self) -> DMat2 {
        DMat2::from_cols(DVec2::new(self.xx, self.xy), DVec2::new(self.xy, self.yy))
    }

    /// u^T M u.
    pub fn quadratic_form(self, u: DVec2) -> f64 {
        self.xx * u.x * u.x + 2.0 * self.xy * u.x * u.y + self.yy * u.y * u.y
    }

    /// u^T M v.
    pub fn bilinear_form(self, u: DVec2, v: DVec2) -> f64 {
        self.xx * u.x * v.x + self.xy * (u.x * v.y + u.y * v.x) + self.yy * u.y * v.y
    }

    pub fn trace(self) -> f64 {
        self.xx + self.yy
    }

    pub fn determinant(self) -> f64 {
        self.xx * self.yy - self.xy * self.xy
    }

    pub fn is_finite(self) -> bool {
        self.xx.is_finite() && self.xy.is_finite() && self.yy.is_finite()
    }

    /// The tensor with its two eigenvalues exchanged: the adjugate.
    pub fn adjugate(self) -> Self {
        Self { xx: self.yy, xy: -self.xy, yy: self.xx }
    }

    /// A^T M A, the metric seen through a linear map A (pull-back).
    pub fn congruence(self, a: DMat2) -> Self {
        let (p, q) = (a.x_axis, a.y_axis);
        Self {
            xx: self.quadratic_form(p),
            xy: self.bilinear_form(p, q),
            yy: self.quadratic_form(q),
        }
    }

    /// Closed form; an isotropic tensor reports the x axis.
    pub fn eigen(self) -> Eigen2 {
        let mean = 0.5 * (self.xx + self.yy);
        let half_gap = 0.5 * (self.xx - self.yy);
        let radius = half_gap.hypot(self.xy);
        // Of the two equivalent eigenvector formulas the one without cancellation.
        let axis = if half_gap >= 0.0 {
            DVec2::new(half_gap + radius, self.xy)
        } else {
            DVec2::new(self.xy, radius - half_gap)
        };
        Eigen2 {
            values: [mean + radius, mean - radius],
            major_axis: axis.try_normalize().unwrap_or(DVec2::X),
        }
    }

    /// The tensor with the same axes and f applied to each eigenvalue.
    pub fn map_eigenvalues(self, f: impl Fn(f64) -> f64) -> Self {
        let eigen = self.eigen();
        Self::from_eigen(Eigen2 { values: eigen.values.map(f), ..eigen })
    }

    /// Lower-triangular L with M = L L^T; `None` unless positive definite.
    pub fn cholesky(self) -> Option<DMat2> {
        if !(self.xx > 0.0) {
            return None;
        }
        let l00 = self.xx.sqrt();
        let l10 = self.xy / l00;
        let rest = self.yy - l10 * l10;
        (rest > 0.0).then(|| DMat2::from_cols(DVec2::new(l00, l10), DVec2::new(0.0, rest.sqrt())))
    }
}

impl Add for SymTensor2 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { xx: self.xx + o.xx, xy: self.xy + o.xy, yy: self.yy + o.yy }
    }
}

impl AddAssign for SymTensor2 {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl Sub for SymTensor2 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { xx: self.xx - o.xx, xy: self.xy - o.xy, yy: self.yy - o.yy }
    }
}

impl Mul<f64> for SymTensor2 {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self { xx: self.xx * s, xy: self.xy * s, yy: self.yy * s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(a: SymTensor2, b: SymTensor2) {
        let scale = 1.0 + a.trace().abs();
        for (p, q) in [(a.xx, b.xx), (a.xy, b.xy), (a.yy, b.yy)] {
            assert!((p - q).abs() <= 1e-12 * scale, "{a:?} and {b:?} differ");
        }
    }

    #[test]
    fn eigen_decomposition_rebuilds_the_tensor() {
        let samples = [
            SymTensor2::new(3.0, 1.0, -2.0),
            SymTensor2::new(-2.0, 1.0, 3.0),
            SymTensor2::new(1.0, -1e-9, 1.0),
            SymTensor2::new(1e8, 1.0, 1e-4),
            SymTensor2::ZERO,
        ];
        for m in samples {
            let eigen = m.eigen();
            assert!(eigen.values[0] >= eigen.values[1]);
            assert!((eigen.major_axis.length() - 1.0).abs() < 1e-12);
            assert_close(SymTensor2::from_eigen(eigen), m);
        }
    }

    #[test]
    fn adjugate_exchanges_the_eigenvalues() {
        let m = SymTensor2::new(3.0, 1.0, 2.0);
        let (a, b) = (m.eigen(), m.adjugate().eigen());
        assert!((a.values[0] - b.values[0]).abs() < 1e-12);
        assert!(a.major_axis.dot(b.major_axis).abs() < 1e-12);
    }

    #[test]
    fn cholesky_multiplies_back_and_refuses_indefinite_tensors() {
        let m = SymTensor2::new(4.0, 1.0, 2.0);
        let l = m.cholesky().unwrap();
        assert_close(SymTensor2::symmetric_part(l * l.transpose()), m);
        assert!(SymTensor2::new(1.0, 2.0, 1.0).cholesky().is_none());
        assert!(SymTensor2::new(f64::NAN, 0.0, 1.0).cholesky().is_none());
    }

    #[test]
    fn congruence_is_the_form_of_the_mapped_vector() {
        let m = SymTensor2::new(4.0, 1.0, 2.0);
        let a = DMat2::from_cols(DVec2::new(1.0, 2.0), DVec2::new(-0.5, 3.0));
        let u = DVec2::new(0.3, -0.7);
        assert!((m.congruence(a).quadratic_form(u) - m.quadratic_form(a * u)).abs() < 1e-12);
    }
}
