//! What one view makes of one face: how far out of the frame it is, and which side it shows.

use glam::DVec3;

use super::ViewSample;
use crate::scene::ViewSettings;
use crate::shot::View;

/// Which side of a face is turned to the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    Front,
    Back,
}

/// Whether a view shows a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// Out of frame, or showing its back and not two-sided.
    Hidden,
    Visible,
    /// In frame and partly behind the near plane: visible, of unbounded size on the image.
    AcrossNearPlane,
}

/// A face in one view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// d, from the frustum (m): exact below the margin, elsewhere a lower bound not below it; 0
    /// only if the face is in frame.
    pub distance: f64,
    /// nu~ of [`spatial_view_factor`].
    pub factor: f64,
    pub visibility: Visibility,
}

impl Sight {
    /// `triangle` in the world (m). The back of a `two_sided` garment counts as its front.
    pub fn of(
        triangle: [DVec3; 3],
        sample: &ViewSample,
        settings: &ViewSettings,
        two_sided: bool,
    ) -> Self {
        let distance = sample.frustum.distance_to_triangle_up_to(settings.margin_m, triangle);
        if distance > 0.0 && distance >= settings.margin_m {
            return Self { distance, factor: settings.nu_out, visibility: Visibility::Hidden };
        }
        let across =
            distance == 0.0 && triangle.iter().any(|&x| depth(&sample.view, x) < sample.view.near);
        let shows_front = across || two_sided || facing(sample.view.eye, triangle) == Facing::Front;
        let nu_facing = if shows_front { settings.nu_front } else { settings.nu_back };
        let visibility = match (distance == 0.0 && shows_front, across) {
            (false, _) => Visibility::Hidden,
            (true, false) => Visibility::Visible,
            (true, true) => Visibility::AcrossNearPlane,
        };
        let factor = spatial_view_factor(nu_facing, settings.nu_out, settings.margin_m, distance);
        Self { distance, factor, visibility }
    }
}

/// Distance in front of the eye along the line of sight (m).
fn depth(view: &View, point: DVec3) -> f64 {
    view.back.dot(view.eye - point)
}

/// The sign of n . (eye - x): by where the eye is, not by where it looks. Edge-on faces and those
/// without area count as front-facing.
pub fn facing(eye: DVec3, [a, b, c]: [DVec3; 3]) -> Facing {
    let normal = (b - a).cross(c - a);
    if normal.dot(eye - a) >= 0.0 { Facing::Front } else { Facing::Back }
}

/// nu~ = nu_fb where d = 0, nu_fb - d/m (nu_fb - nu_out) where 0 < d < m, nu_out where d >= m
/// ([`VD15`](crate::papers::VD15) eq. 3). m = 0 is a hard edge.
pub fn spatial_view_factor(nu_facing: f64, nu_out: f64, margin: f64, distance: f64) -> f64 {
    let nearness = nearness(distance, margin);
    // Written so that both ends are exact.
    nu_facing * nearness + nu_out * (1.0 - nearness)
}

/// max(0, 1 - d/m): 1 in frame, 0 beyond the margin. m = 0 is a hard edge.
pub fn nearness(distance: f64, margin: f64) -> f64 {
    if distance == 0.0 {
        1.0
    } else if distance < margin {
        1.0 - distance / margin
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::tests::{key, path};
    use crate::view::ViewerWindow;

    /// From the origin along y; 90 degrees high, wider than high; near plane at 0.05 m.
    fn sample() -> ViewSample {
        let mut only = key(0.0, DVec3::ZERO, DVec3::Y);
        only.lens = crate::shot::Lens::FieldOfView { fov_y: std::f64::consts::FRAC_PI_2 };
        ViewerWindow::new(&path(vec![only]), 0.0, 0.0).present().clone()
    }

    /// A small triangle around a point whose normal points to the origin or away from it.
    fn triangle(centre: DVec3, shown: Facing) -> [DVec3; 3] {
        let normal = if shown == Facing::Front { -centre } else { centre };
        let u = normal.normalize().any_orthonormal_vector() * 0.01;
        let v = normal.normalize().cross(u);
        [centre + u, centre + v, centre - u - v]
    }

    fn sight(t: [DVec3; 3], two_sided: bool) -> Sight {
        Sight::of(t, &sample(), &ViewSettings::default(), two_sided)
    }

    #[test]
    fn equation_3_runs_from_the_frame_to_the_margin() {
        let nu = |d: f64| spatial_view_factor(1.0, 0.01, 0.4, d);
        assert_eq!(nu(0.0), 1.0);
        assert!((nu(0.2) - 0.505).abs() < 1e-15);
        assert!((nu(1e-12) - 1.0).abs() < 1e-9);
        assert_eq!(nu(0.4), 0.01);
        assert_eq!(nu(9.0), 0.01);
    }

    #[test]
    fn without_a_margin_the_frame_has_a_hard_edge() {
        assert_eq!(spatial_view_factor(1.0, 0.01, 0.0, 0.0), 1.0);
        assert_eq!(spatial_view_factor(1.0, 0.01, 0.0, 1e-300), 0.01);
    }

    #[test]
    fn a_face_in_frame_has_the_factor_of_the_side_it_shows() {
        let at = DVec3::new(0.0, 2.0, 0.5);
        let front = sight(triangle(at, Facing::Front), false);
        assert_eq!((front.factor, front.visibility), (1.0, Visibility::Visible));
        let back = sight(triangle(at, Facing::Back), false);
        assert_eq!((back.factor, back.visibility), (0.2, Visibility::Hidden));
    }

    #[test]
    fn a_two_sided_garment_has_no_back() {
        let back = sight(triangle(DVec3::Y * 2.0, Facing::Back), true);
        assert_eq!((back.factor, back.visibility), (1.0, Visibility::Visible));
    }

    #[test]
    fn facing_goes_by_the_eye_and_not_by_the_line_of_sight() {
        // Far to the side, turned slightly away from the line of sight and still to the eye.
        let t = [DVec3::new(3.0, 3.0, 0.0), DVec3::new(3.0, 3.0, 0.1), DVec3::new(3.01, 3.09, 0.0)];
        let normal = (t[1] - t[0]).cross(t[2] - t[0]);
        assert!(normal.dot(DVec3::Y) > 0.0, "a view direction alone would call it a back");
        assert_eq!(facing(DVec3::ZERO, t), Facing::Front);
    }

    #[test]
    fn behind_the_camera_is_out_of_frame() {
        let seen = sight(triangle(DVec3::Y * -3.0, Facing::Front), false);
        assert_eq!((seen.factor, seen.visibility), (0.01, Visibility::Hidden));
        assert!(seen.distance >= 0.4);
    }

    #[test]
    fn a_face_across_the_near_plane_is_visible_from_both_sides() {
        let t =
            [DVec3::new(-0.3, -1.0, -0.1), DVec3::new(0.3, 1.0, -0.1), DVec3::new(-0.3, 1.0, -0.1)];
        for t in [t, [t[1], t[0], t[2]]] {
            let seen = sight(t, false);
            assert_eq!((seen.factor, seen.visibility), (1.0, Visibility::AcrossNearPlane));
        }
    }

    #[test]
    fn an_edge_on_face_and_one_without_area_are_finite() {
        let edge_on = [DVec3::Y, DVec3::Y * 2.0, DVec3::new(0.0, 1.5, 0.2)];
        for t in [edge_on, [DVec3::Y; 3]] {
            assert_eq!(sight(t, false).factor, 1.0);
        }
    }
}
