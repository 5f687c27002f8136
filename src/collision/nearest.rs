//! The triangle of a tree nearest to a point.

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhLeafCost, BvhNode};

use crate::math::{ClosestPoint, closest_point_on_triangle};

/// A triangle near a point.
#[derive(Clone, Copy, Debug)]
pub struct NearTriangle {
    pub index: u32,
    pub distance: f64,
    pub closest: ClosestPoint,
}

/// The triangle of a tree nearest to a point, if one is closer than `reach`. `corners` tells the
/// corners of a triangle by its number.
pub fn nearest_triangle(
    tree: &Bvh,
    point: DVec3,
    reach: f64,
    corners: impl Fn(u32) -> [DVec3; 3],
) -> Option<NearTriangle> {
    let box_distance =
        |node: &BvhNode, _best: f64| point.distance(point.clamp(node.mins(), node.maxs()));
    let leaf = |index: u32, _best: f64| {
        let closest = closest_point_on_triangle(point, corners(index));
        Some(NearTriangle { index, distance: closest.point.distance(point), closest })
    };
    tree.find_best(reach, box_distance, leaf).map(|(_, triangle)| triangle)
}

impl BvhLeafCost for NearTriangle {
    fn cost(&self) -> f64 {
        self.distance
    }
}

/// The box around points; at least one.
pub fn bounds(points: &[DVec3]) -> Aabb {
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    Aabb::new(low, high)
}
