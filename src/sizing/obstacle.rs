//! Finer where an obstacle is near.

use glam::{DVec2, DVec3};

use crate::math::{Mat3x2, SymTensor2};

/// Distances below this (m) are all as good as contact: it keeps the metric finite there, and is a
/// tenth of the shortest edge that garments are cut to.
const DISTANCE_MIN: f64 = 1e-3;

/// A plane that stands for the part of an obstacle nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// (m), world.
    pub point: DVec3,
    /// Unit, outward.
    pub normal: DVec3,
}

impl Plane {
    /// h, the distance of a point in front of the plane (m); negative behind it.
    pub fn distance(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal)
    }
}

/// M = 1/3 sum over the corners of (grad h)(grad h)^T / h^2 (1/m^2), with grad h = F^T n the
/// material gradient of the distance to the corner's plane: along a valid edge the distance
/// changes by at most itself ([`NSO12`](crate::papers::NSO12)). A corner without a
/// plane asks for nothing.
pub fn obstacle_metric(
    deformation_gradient: Mat3x2,
    corners: [DVec3; 3],
    planes: [Option<Plane>; 3],
) -> SymTensor2 {
    corners.into_iter().zip(planes).fold(SymTensor2::ZERO, |sum, (corner, plane)| {
        let Some(plane) = plane else { return sum };
        let h = plane.distance(corner).abs().max(DISTANCE_MIN);
        let gradient: DVec2 = deformation_gradient.transpose_mul_vec3(plane.normal);
        sum + SymTensor2::outer(gradient) * (1.0 / (3.0 * h * h))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: Mat3x2 = Mat3x2 { x_axis: DVec3::X, y_axis: DVec3::Y };
    const CORNERS: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    #[test]
    fn cloth_parallel_to_an_obstacle_needs_no_refinement() {
        let floor = Plane { point: DVec3::NEG_Z * 0.01, normal: DVec3::Z };
        assert_eq!(obstacle_metric(FLAT, CORNERS, [Some(floor); 3]), SymTensor2::ZERO);
    }

    #[test]
    fn cloth_running_into_a_wall_is_refined_towards_it() {
        let wall = |distance: f64| Plane { point: DVec3::NEG_X * distance, normal: DVec3::X };
        let m = obstacle_metric(FLAT, [DVec3::ZERO; 3], [Some(wall(0.02)); 3]);
        assert!((m.xx - 2500.0).abs() < 1e-9 && m.yy == 0.0, "{m:?}");
        let one = obstacle_metric(FLAT, [DVec3::ZERO; 3], [Some(wall(0.02)), None, None]);
        assert!((one.xx - 2500.0 / 3.0).abs() < 1e-9);
        assert!(obstacle_metric(FLAT, [DVec3::ZERO; 3], [Some(wall(0.0)); 3]).is_finite());
    }
}
