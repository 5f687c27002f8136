//! No finer than the image can show.

use glam::{DMat2, DVec2, DVec3};

use crate::math::{SymTensor2, tensor_min};
use crate::shot::View;

/// S, the Jacobian from material to image coordinates over a face (px/m): the sum over its corners
/// of p_i (grad phi_i)^T, with p_i the projected corner and phi_i its shape function. `None` if a
/// corner is not in front of the near plane.
pub fn screen_jacobian(
    view: &View,
    corners: [DVec3; 3],
    shape_gradients: [DVec2; 3],
) -> Option<DMat2> {
    corners.into_iter().zip(shape_gradients).try_fold(DMat2::ZERO, |sum, (corner, gradient)| {
        let p = view.point_in_image(corner)?;
        Some(sum + DMat2::from_cols(p * gradient.x, p * gradient.y))
    })
}

/// M_vd = L Q min(1, g) Q^T L^T, where M~ = L L^T, L^-1 G L^-T = Q g Q^T and G = S^T S / l_min^2:
/// the metric with which no edge shorter than `min_edge_px` on the image is refined
/// ([`VD15`](crate::papers::VD15) eqs. 5 to 8, without the inverse of S: finite for edge-on faces,
/// and never finer than `metric`). 0 px asks for nothing.
pub fn screen_clamped(metric: SymTensor2, jacobian: DMat2, min_edge_px: f64) -> SymTensor2 {
    if !(min_edge_px > 0.0) {
        return metric;
    }
    tensor_min(metric, SymTensor2::IDENTITY.congruence(jacobian * min_edge_px.recip()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Mat3x2;
    use crate::shot::tests::{sample_view, still};
    use proptest::prelude::*;

    /// Eqs. 5 to 8 as they stand: through the inverse of S.
    fn as_in_the_paper(metric: SymTensor2, s: DMat2, min_edge: f64) -> SymTensor2 {
        let on_screen = metric.congruence(s.inverse());
        on_screen.map_eigenvalues(|l| l.min(min_edge.powi(-2))).congruence(s)
    }

    proptest! {
        #[test]
        fn where_s_is_regular_the_result_is_that_of_the_paper(
            [a, b, c] in [0.0..2.0, -3.0..3.0, 0.0..2.0],
            s in [-800.0..800.0, -800.0..800.0, -800.0..800.0, -800.0..800.0],
            px in 1.0..10.0,
        ) {
            let s = DMat2::from_cols_array(&s);
            prop_assume!(s.determinant().abs() > 1e3);
            let diagonal = [a, c].map(|e| 10f64.powf(e));
            let stretch = DMat2::from_cols_array(&[diagonal[0], b, 0.0, diagonal[1]]);
            let m = SymTensor2::IDENTITY.congruence(stretch);
            let (ours, paper) = (screen_clamped(m, s, px), as_in_the_paper(m, s, px));
            // Eqs. 5 to 8 clamp in an orthonormal basis of the screen: the same pencil.
            let gap = (ours.trace() - paper.trace()).abs();
            prop_assert!(gap <= 1e-5 * (ours.trace() + 1e-9), "{ours:?} {paper:?}");
            prop_assert!((m - ours).eigen().values[1] >= -1e-9 * m.trace());
        }
    }

    #[test]
    fn an_edge_on_face_stays_finite() {
        let m = SymTensor2::isotropic(1e4);
        let flat = screen_clamped(m, DMat2::from_cols(DVec2::new(1000.0, 0.0), DVec2::ZERO), 4.0);
        assert!((flat.xx - 1e4).abs() < 1e-6 && flat.yy.abs() < 1e-6, "{flat:?}");
        assert_eq!(screen_clamped(m, DMat2::ZERO, 4.0).trace(), 0.0);
        assert_eq!(screen_clamped(m, DMat2::ZERO, 0.0), m);
    }

    #[test]
    fn a_face_head_on_is_cut_to_the_pixels_it_covers() {
        let view = still(DVec3::Y * -10.0, DVec3::ZERO).view(0.0);
        let corners = [DVec3::ZERO, DVec3::X * 0.01, DVec3::Z * 0.01];
        let shapes = [DVec2::new(-100.0, -100.0), DVec2::new(100.0, 0.0), DVec2::new(0.0, 100.0)];
        let s = screen_jacobian(&view, corners, shapes).unwrap();
        let px_per_metre = 270.0 / 20f64.to_radians().tan() / 10.0;
        assert!((s.x_axis.length() - px_per_metre).abs() < 1e-6);
        assert!((s.y_axis.length() - px_per_metre).abs() < 1e-6);
        let clamped = screen_clamped(SymTensor2::isotropic(1e4), s, 4.0);
        assert!((clamped.xx.powf(-0.5) * px_per_metre - 4.0).abs() < 1e-9, "{clamped:?}");
    }

    #[test]
    fn the_jacobian_of_a_small_face_is_the_derivative_of_the_projection() {
        let view = sample_view();
        let centre = view.eye - view.back * 2.0 + view.right * 0.3;
        let f = Mat3x2 { x_axis: DVec3::new(1.0, 0.2, 0.1), y_axis: DVec3::new(-0.1, 0.7, 0.9) };
        let shapes = [DVec2::NEG_ONE, DVec2::X, DVec2::Y].map(|g| g * 1e6);
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y].map(|u| centre + f.mul_vec2(u * 1e-6));
        let s = screen_jacobian(&view, corners, shapes).unwrap();
        for (u, column) in [(DVec2::X, s.x_axis), (DVec2::Y, s.y_axis)] {
            let at = |h: f64| view.point_in_image(centre + f.mul_vec2(u * h)).unwrap();
            assert!(((at(1e-4) - at(-1e-4)) / 2e-4 - column).length() < 0.05);
        }
    }

    #[test]
    fn a_corner_behind_the_near_plane_has_no_jacobian() {
        let view = sample_view();
        let corners = [1.0, 2.0, 0.1].map(|depth| view.eye - view.back * depth);
        assert_eq!(screen_jacobian(&view, corners, [DVec2::ZERO; 3]), None);
    }
}
