//! Finer where cloth is about to buckle.

use crate::math::{Mat3x2, SymTensor2};

/// M = [ -E + sqrt(E^2 - 4 c^2 adj(S^T S)) ]_+ / (2 c^2) (1/m^2), with E = F^T F - I, S = grad n
/// (1/m) and c = `refine_compression` (m, above 0) ([`NSO12`](crate::papers::NSO12)).
///
/// The root keeps the signs of its eigenvalues, and [.]_+ drops negative ones: cloth already bent
/// across a direction is less able to buckle along it.
pub fn compression_metric(
    deformation_gradient: Mat3x2,
    normal_gradient: Mat3x2,
    refine_compression: f64,
) -> SymTensor2 {
    let strain = deformation_gradient.gram() - SymTensor2::IDENTITY;
    let c_squared = refine_compression * refine_compression;
    let bent = normal_gradient.gram().adjugate() * (4.0 * c_squared);
    let root = (strain.squared() - bent).signed_sqrt();
    (root - strain).positive_part() * (0.5 / c_squared)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    const C: f64 = 0.01;

    fn stretched(along_x: f64, along_y: f64) -> Mat3x2 {
        Mat3x2 { x_axis: DVec3::X * along_x, y_axis: DVec3::Y * along_y }
    }

    #[test]
    fn a_flat_sheet_is_refined_along_its_compression_alone() {
        let m = compression_metric(stretched(0.9, 1.1), Mat3x2::ZERO, C);
        // -E = 1 - 0.81.
        assert!((m.xx - 0.19 / (C * C)).abs() < 1e-9, "{m:?}");
        assert!(m.xy.abs() < 1e-9 && m.yy.abs() < 1e-9, "{m:?}");
    }

    #[test]
    fn a_sheet_at_rest_asks_for_nothing_however_bent() {
        for curvature in [0.0, 3.0] {
            let bent = Mat3x2 { x_axis: DVec3::X * curvature, y_axis: DVec3::ZERO };
            assert_eq!(compression_metric(stretched(1.0, 1.0), bent, C).trace(), 0.0);
        }
    }

    #[test]
    fn a_bend_across_the_compression_stiffens_it() {
        let across = |curvature: f64| Mat3x2 { x_axis: DVec3::ZERO, y_axis: DVec3::Y * curvature };
        let m = |curvature: f64| compression_metric(stretched(0.95, 1.0), across(curvature), C).xx;
        let e = 1.0 - 0.95f64.powi(2);
        let expected = (e + (e * e - 4.0 * C * C * 4.0).sqrt()) / (2.0 * C * C);
        assert!((m(2.0) - expected).abs() < 1e-9);
        assert!(m(0.0) > m(2.0) && m(2.0) > m(4.0));
        assert_eq!(m(20.0), 0.0);
    }

    #[test]
    fn a_bend_along_the_compression_does_not() {
        let along = Mat3x2 { x_axis: DVec3::X * 4.0, y_axis: DVec3::ZERO };
        let bent = compression_metric(stretched(0.95, 1.0), along, C);
        let flat = compression_metric(stretched(0.95, 1.0), Mat3x2::ZERO, C);
        assert!((bent.xx - flat.xx).abs() < 1e-9);
    }
}
