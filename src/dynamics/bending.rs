//! Bending: the energy of an edge that is folded away from its rest angle.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Height of a face over its edge, in edge lengths, below which its normal is noise.
const HEIGHT_RATIO_MIN: f64 = 1e-6;

/// What an edge's bending depends on besides positions.
///
/// At a seam l is the mean of the edge's two lengths in material space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Global numbers: the edge from start to end as face 0 runs along it counter-clockwise, the
    /// node of face 0 opposite to it, and that of face 1.
    pub nodes: [u32; 4],
    /// theta_0 (rad).
    pub rest_angle: f64,
    /// Angle of the edge from u, as face 0 sees it (rad).
    pub edge_angle: f64,
    /// The same as face 1 sees it; `None` unless the edge is a seam.
    pub edge_angle_across: Option<f64>,
    /// alpha / theta = l / (2 (A_0 + A_1)) (1/m), areas in material space.
    pub curvature_per_angle: f64,
    /// 1/4 l^2 / (2 (A_0 + A_1)): times k, the energy at a fold of 1 rad.
    pub shape: f64,
}

impl Hinge {
    /// Lengths l_0, l_1 and areas A_0, A_1 of the two sides in material space (m, m^2).
    pub fn measures(lengths: [f64; 2], areas: [f64; 2]) -> (f64, f64) {
        let length = 0.5 * (lengths[0] + lengths[1]);
        let doubled_area = 2.0 * (areas[0] + areas[1]);
        (length / doubled_area, 0.25 * length * length / doubled_area)
    }

    pub fn corners(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.nodes.map(|n| positions[n as usize])
    }

    /// The fold angle theta - theta_0, by whole turns nearest to zero (rad), in (-pi, pi].
    ///
    /// An edge that rests at 170 degrees can thus be folded to 190 although dihedral angles end at
    /// 180.
    pub fn fold(&self, angle: f64) -> f64 {
        turn(self.rest_angle, angle)
    }

    /// theta - theta_0 at positions (rad); zero where the angle is not defined.
    pub fn fold_at(&self, positions: &[DVec3]) -> f64 {
        dihedral_angle(self.corners(positions)).map_or(0.0, |angle| self.fold(angle))
    }

    /// d2W/dtheta2 (N m) of W = k shape (theta - theta_0)^2, k in N m, frozen
    /// ([`WOR11`](crate::papers::WOR11), [`BMF03`](crate::papers::BMF03)).
    pub fn moment_per_fold(&self, stiffness: f64) -> f64 {
        2.0 * stiffness * self.shape
    }

    /// k, the mean over both sides of a seam, of a stiffness k(edge angle, curvature) (N m) at a
    /// dihedral angle (rad).
    pub fn stiffness(&self, angle: f64, mut law: impl FnMut(f64, f64) -> f64) -> f64 {
        let curvature = angle * self.curvature_per_angle;
        let own = law(self.edge_angle, curvature);
        match self.edge_angle_across {
            Some(across) => 0.5 * (own + law(across, curvature)),
            None => own,
        }
    }
}

/// The way from one angle to another, by whole turns the shortest (rad), in (-pi, pi].
pub fn turn(from: f64, to: f64) -> f64 {
    let way = to - from;
    if way > PI || way <= -PI { way - TAU * ((way - PI) / TAU).ceil() } else { way }
}

/// A dihedral angle and how it follows its four nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dihedral {
    /// theta (rad), in (-pi, pi]; positive where the edge is a ridge seen from the normals' side.
    pub angle: f64,
    /// dtheta/dx per node (1/m).
    pub gradients: [DVec3; 4],
}

/// The angle of [`Dihedral`] alone; `None` where a face or the edge has no extent.
pub fn dihedral_angle([start, end, top0, top1]: [DVec3; 4]) -> Option<f64> {
    let edge = end - start;
    let area0 = edge.cross(top0 - start);
    let area1 = (top1 - start).cross(edge);
    has_extent(edge, area0, area1).then(|| angle_between(edge, area0, area1))
}

/// With N_0, N_1 the area vectors (twice the areas) and l the edge length, the heights of the faces
/// over the edge are h_i = |N_i| / l, and the opposite nodes have gradients -N_i / (|N_i| h_i): a
/// node lifted along its normal flattens the ridge. The edge's nodes have what keeps the angle
/// unchanged under translation and rotation: shares of both by where the heights' feet stand
/// between them ([`BMF03`](crate::papers::BMF03) eq. 1). `None` where a face or the edge has no
/// extent.
pub fn dihedral([start, end, top0, top1]: [DVec3; 4]) -> Option<Dihedral> {
    let edge = end - start;
    let (arm0, arm1) = (top0 - start, top1 - start);
    let (area0, area1) = (edge.cross(arm0), arm1.cross(edge));
    if !has_extent(edge, area0, area1) {
        return None;
    }
    let length_squared = edge.length_squared();
    let length = length_squared.sqrt();
    let lift0 = area0 * (length / area0.length_squared());
    let lift1 = area1 * (length / area1.length_squared());
    let (foot0, foot1) = (arm0.dot(edge) / length_squared, arm1.dot(edge) / length_squared);
    Some(Dihedral {
        angle: angle_between(edge, area0, area1),
        gradients: [
            lift0 * (1.0 - foot0) + lift1 * (1.0 - foot1),
            lift0 * foot0 + lift1 * foot1,
            -lift0,
            -lift1,
        ],
    })
}

/// Written so that a NaN has no extent.
fn has_extent(edge: DVec3, area0: DVec3, area1: DVec3) -> bool {
    let least = (HEIGHT_RATIO_MIN * edge.length_squared()).powi(2);
    least > 0.0 && area0.length_squared() > least && area1.length_squared() > least
}

/// theta = atan2((N_0 x N_1).e / |e|, N_0.N_1).
fn angle_between(edge: DVec3, area0: DVec3, area1: DVec3) -> f64 {
    let sine = area0.cross(area1).dot(edge) / edge.length();
    sine.atan2(area0.dot(area1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::testing::Random;

    fn hinge(rest_angle: f64) -> Hinge {
        let (curvature_per_angle, shape) = Hinge::measures([0.1, 0.12], [0.004, 0.006]);
        Hinge {
            nodes: [0, 1, 2, 3],
            rest_angle,
            edge_angle: 0.3,
            edge_angle_across: None,
            curvature_per_angle,
            shape,
        }
    }

    /// A hinge along x with its two faces folded down by half of `angle` each.
    fn folded(angle: f64) -> [DVec3; 4] {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        let arm = |side: f64| DVec3::new(0.04, side * 0.08 * cosine, -0.08 * sine);
        [DVec3::ZERO, 0.1 * DVec3::X, arm(1.0), arm(-1.0)]
    }

    #[test]
    fn a_ridge_has_the_angle_it_was_folded_to() {
        for angle in [-3.1, -1.0, 0.0, 0.4, 2.0, 3.1] {
            let found = dihedral_angle(folded(angle)).unwrap();
            assert!((found - angle).abs() < 1e-12, "{found} for {angle}");
        }
    }

    #[test]
    fn gradients_agree_with_finite_differences() {
        let mut random = Random::new(4);
        for _ in 0..50 {
            let x = [0; 4].map(|_| random.vector());
            let Dihedral { angle, gradients } = dihedral(x).unwrap();
            for (k, gradient) in gradients.into_iter().enumerate() {
                for axis in DVec3::AXES {
                    let at = |step: f64| {
                        let mut moved = x;
                        moved[k] += axis * step;
                        Hinge { rest_angle: angle, ..hinge(0.0) }
                            .fold(dihedral_angle(moved).unwrap())
                    };
                    let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
                    let scale = 1.0 + gradient.length();
                    assert!((difference - gradient.dot(axis)).abs() < 1e-5 * scale * scale);
                }
            }
        }
    }

    #[test]
    fn rigid_motions_do_not_change_the_angle() {
        let mut random = Random::new(5);
        for _ in 0..50 {
            let x = [0; 4].map(|_| random.vector());
            let gradients = dihedral(x).unwrap().gradients;
            let scale: f64 = gradients.iter().map(|g| g.length()).sum();
            let push: DVec3 = gradients.iter().sum();
            let turn: DVec3 = (0..4).map(|k| x[k].cross(gradients[k])).sum();
            assert!(push.length() < 1e-12 * scale && turn.length() < 1e-12 * scale);
        }
    }

    #[test]
    fn a_relaxed_hinge_stores_no_energy() {
        let angle = dihedral_angle(folded(0.7)).unwrap();
        assert_eq!(hinge(angle).fold_at(&folded(0.7)), 0.0);
    }

    #[test]
    fn energy_is_a_quarter_k_l_squared_over_twice_the_areas() {
        let hinge = hinge(0.2);
        let energy = 0.5 * hinge.moment_per_fold(1e-5) * hinge.fold_at(&folded(0.7)).powi(2);
        let expected = 0.25 * 1e-5 * 0.11f64.powi(2) / (2.0 * 0.010) * 0.5f64.powi(2);
        assert!((energy - expected).abs() < 1e-12 * expected.abs() + 1e-20);
    }

    #[test]
    fn a_fold_past_the_flat_angle_is_unwrapped_towards_the_rest_angle() {
        let sharp = hinge(2.9);
        let past = dihedral_angle(folded(3.3)).unwrap();
        assert!(past < 0.0, "the bare angle jumps");
        assert!((sharp.fold(past) - 0.4).abs() < 1e-12);
        assert!((hinge(-2.9).fold(-past) + 0.4).abs() < 1e-12);
        assert_eq!(hinge(0.0).fold(PI), PI);
    }

    #[test]
    fn faces_and_edges_without_extent_have_no_angle() {
        let [a, b, c, d] = folded(0.3);
        assert!(dihedral([a, a, c, d]).is_none());
        assert!(dihedral([a, b, 0.5 * (a + b), d]).is_none());
        assert!(dihedral([a, b, c, DVec3::NAN]).is_none());
        assert!(dihedral_angle([a, b, c, a]).is_none());
    }

    #[test]
    fn a_seam_is_as_stiff_as_its_sides_on_average() {
        let law = |edge_angle: f64, curvature: f64| edge_angle + 100.0 * curvature;
        let seam = Hinge { edge_angle_across: Some(0.5), ..hinge(0.0) };
        let curvature = 2.0 * seam.curvature_per_angle;
        assert!((seam.stiffness(2.0, law) - (0.4 + 100.0 * curvature)).abs() < 1e-12);
    }
}
