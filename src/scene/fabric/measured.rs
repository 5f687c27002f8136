//! Fabrics as measured.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_8};

use super::StretchStiffness;
use crate::math::SymTensor2;

/// A fabric from the tables of [`WOR11`](crate::papers::WOR11): orthotropic stretch which depends
/// on strain, bending which depends on curvature.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredFabric {
    /// (kg/m^2).
    pub density: f64,
    /// Rows of (k_uu, k_uv, k_vv, k_shear) (N/m): row 0 at rest, rows 1 to 5 for the larger
    /// principal stretch at 0, 22.5, 45, 67.5, 90 degrees from u and a stretch of 1 + 1/6.
    pub stretching: [[f64; 4]; 6],
    /// Rows: edge at 0, 45, 90 degrees in material space; columns: curvature 0, 5, 10, 15, 20 1/m
    /// (N m).
    pub bending: [[f64; 5]; 3],
    /// Damping proportional to stiffness (s).
    pub damping: f64,
    /// Least and largest principal stretch the garment may show.
    pub strain_limits: Option<[f64; 2]>,
}

/// The stretch at which rows 1 to 5 of the stretching table were measured.
const MEASURED_STRETCH: f64 = 1.0 / 6.0;

/// Distance of the bending table's columns (1/m).
const CURVATURE_STEP: f64 = 5.0;

impl MeasuredFabric {
    /// Linear in (stretch - 1) x 6 clamped to 0..1 and in the angle of the larger principal
    /// stretch, whose sign is of no consequence; negative results count as 0, then everything is
    /// doubled. k_uv is held to at most sqrt(k_uu k_vv): above it the energy has no lower bound.
    pub fn stretch_stiffness(&self, right_cauchy_green: SymTensor2) -> StretchStiffness {
        let eigen = right_cauchy_green.eigen();
        let stretch = eigen.values[0].max(0.0).sqrt();
        let weight = ((stretch - 1.0) / MEASURED_STRETCH).clamp(0.0, 1.0);
        let axis = eigen.major_axis;
        let angle = axis.y.abs().atan2(axis.x.abs());
        let (row, t) = table_position(angle / FRAC_PI_8, 5);
        let [rest, stretched @ ..] = &self.stretching;
        let [uu, uv, vv, shear] = std::array::from_fn(|k| {
            let at_angle = mix(stretched[row][k], stretched[row + 1][k], t);
            2.0 * mix(rest[k], at_angle, weight).max(0.0)
        });
        StretchStiffness { uu, uv: uv.min((uu * vv).sqrt()), vv, shear }
    }

    /// Linear in the edge's angle from u, folded to 0..90 degrees, and in the curvature's
    /// magnitude, constant above the largest measured.
    pub fn bending_stiffness(&self, edge_angle: f64, curvature: f64) -> f64 {
        let (sin, cos) = edge_angle.sin_cos();
        let (row, s) = table_position(sin.abs().atan2(cos.abs()) / FRAC_PI_4, 3);
        let (column, t) = table_position(curvature.abs() / CURVATURE_STEP, 5);
        let along = |r: &[f64; 5]| mix(r[column], r[column + 1], t);
        mix(along(&self.bending[row]), along(&self.bending[row + 1]), s).max(0.0)
    }
}

/// The lower of two neighbouring entries and the share of the upper one, for a position counted
/// in entries and held inside the table.
fn table_position(position: f64, count: usize) -> (usize, f64) {
    let position = position.clamp(0.0, (count - 1) as f64);
    let lower = (position as usize).min(count - 2);
    (lower, position - lower as f64)
}

fn mix(a: f64, b: f64, t: f64) -> f64 {
    a * (1.0 - t) + b * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    use crate::math::Eigen2;

    fn fabric() -> MeasuredFabric {
        let row = |k: usize| [100.0 + k as f64, 5.0 * k as f64, 60.0 - k as f64, 7.0 * k as f64];
        MeasuredFabric {
            density: 0.2,
            stretching: std::array::from_fn(row),
            bending: std::array::from_fn(|i| std::array::from_fn(|j| (10 * i + j + 1) as f64)),
            damping: 0.0,
            strain_limits: None,
        }
    }

    /// F^T F with the larger stretch at an angle (rad) from u.
    fn stretched(stretch: f64, angle: f64) -> SymTensor2 {
        let major_axis = DVec2::from_angle(angle);
        SymTensor2::from_eigen(Eigen2 { values: [stretch * stretch, 0.9], major_axis })
    }

    #[test]
    fn stretch_stiffness_is_twice_the_table_at_its_nodes() {
        let fabric = fabric();
        let full = 1.0 + MEASURED_STRETCH;
        for row in 1..6 {
            let angle = (row - 1) as f64 * FRAC_PI_8;
            for angle in [angle, -angle, angle + 2.0 * FRAC_PI_4 * 2.0] {
                let k = fabric.stretch_stiffness(stretched(full, angle));
                let expected = fabric.stretching[row].map(|x| 2.0 * x);
                for (a, b) in [k.uu, k.uv, k.vv, k.shear].into_iter().zip(expected) {
                    assert!((a - b).abs() < 1e-9, "{k:?} at row {row}");
                }
            }
        }
        let rest = fabric.stretch_stiffness(SymTensor2::IDENTITY);
        assert_eq!([rest.uu, rest.uv, rest.vv, rest.shear], [200.0, 0.0, 120.0, 0.0]);
        let beyond = fabric.stretch_stiffness(stretched(3.0, 0.0));
        assert!((beyond.uu - 202.0).abs() < 1e-9);
    }

    #[test]
    fn stretch_stiffness_is_continuous_in_stretch_and_angle() {
        let fabric = fabric();
        for i in 0..400 {
            let (stretch, angle) = (1.0 + i as f64 * 1e-3, i as f64 * 0.017);
            let a = fabric.stretch_stiffness(stretched(stretch, angle));
            let b = fabric.stretch_stiffness(stretched(stretch + 1e-9, angle + 1e-9));
            for (p, q) in [(a.uu, b.uu), (a.uv, b.uv), (a.vv, b.vv), (a.shear, b.shear)] {
                assert!((p - q).abs() < 1e-5, "{a:?} jumps to {b:?}");
            }
        }
    }

    #[test]
    fn negative_entries_count_as_zero_and_coupling_stays_convex() {
        let mut fabric = fabric();
        fabric.stretching[0] = [4.0, 50.0, 9.0, -3.0];
        let k = fabric.stretch_stiffness(SymTensor2::IDENTITY);
        assert_eq!([k.uu, k.uv, k.vv, k.shear], [8.0, 12.0, 18.0, 0.0]);
    }

    #[test]
    fn bending_stiffness_is_the_table_at_its_nodes_and_even_in_both_arguments() {
        let fabric = fabric();
        for i in 0..3 {
            for j in 0..5 {
                let (angle, curvature) = (i as f64 * FRAC_PI_4, j as f64 * 5.0);
                for (angle, curvature) in [
                    (angle, curvature),
                    (-angle, -curvature),
                    (4.0 * FRAC_PI_4 - angle, curvature),
                    (4.0 * FRAC_PI_4 + angle, curvature),
                ] {
                    let k = fabric.bending_stiffness(angle, curvature);
                    assert!((k - fabric.bending[i][j]).abs() < 1e-9, "{k} at {i}, {j}");
                }
            }
        }
        assert_eq!(fabric.bending_stiffness(0.0, 1e6), fabric.bending[0][4]);
    }

    #[test]
    fn bending_stiffness_is_continuous() {
        let fabric = fabric();
        for i in 0..1000 {
            let (angle, curvature) = (i as f64 * 0.01, i as f64 * 0.025);
            let a = fabric.bending_stiffness(angle, curvature);
            let b = fabric.bending_stiffness(angle + 1e-9, curvature + 1e-9);
            assert!((a - b).abs() < 1e-6);
        }
    }
}
