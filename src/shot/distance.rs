//! How far a triangle is from what a camera sees.

use glam::DVec3;

use super::Frustum;
use super::frustum::{EDGES, SIDE_COUNT};
use crate::math::segment_distance_squared;

/// Signed distances of a triangle's corners from each side of the frustum (m).
type SideDistances = [[f64; 3]; SIDE_COUNT];

impl Frustum {
    /// Distance from a triangle to the frustum (m); 0 where they touch or one contains the other.
    pub fn distance_to_triangle(&self, triangle: [DVec3; 3]) -> f64 {
        self.distance_to_triangle_up_to(f64::INFINITY, triangle)
    }

    /// The distance (m) if it is less than `limit`; otherwise a lower bound on it, not less than
    /// `limit`, which is 0 only if the distance is 0. Much cheaper far away.
    pub fn distance_to_triangle_up_to(&self, limit: f64, triangle: [DVec3; 3]) -> f64 {
        let distances: SideDistances =
            self.sides.each_ref().map(|side| triangle.map(|x| side.distance(x)));
        let is_inside = |corner: usize| distances.iter().all(|d| d[corner] <= 0.0);
        if (0..3).any(is_inside) {
            return 0.0;
        }
        // No point of the triangle is nearer than its nearest corner to a side.
        let bound = distances.iter().map(|d| d[0].min(d[1]).min(d[2])).fold(0.0, f64::max);
        if bound > 0.0 && bound >= limit {
            return bound;
        }
        if bound == 0.0 && self.meets(&distances, triangle) {
            return 0.0;
        }
        let to_sides = self.corners_to_sides(&distances, triangle);
        if to_sides <= bound {
            return to_sides;
        }
        // Between a corner and a side, a corner of the frustum and the triangle, or two edges.
        to_sides
            .min(self.corners_to_inner_triangle(triangle))
            .min(self.edges_to_edges(&distances, triangle))
    }

    /// True if some point of the triangle is inside all sides: the triangle is cut down to what is
    /// inside one side after the other.
    fn meets(&self, distances: &SideDistances, triangle: [DVec3; 3]) -> bool {
        let mut polygon = Polygon::new(triangle);
        for (side, d) in self.sides.iter().zip(distances) {
            if d.iter().all(|&d| d <= 0.0) {
                continue;
            }
            polygon = polygon.inside(|x| side.distance(x));
            if polygon.count == 0 {
                return false;
            }
        }
        true
    }

    /// From those corners of the triangle which stand straight above a side.
    fn corners_to_sides(&self, distances: &SideDistances, triangle: [DVec3; 3]) -> f64 {
        let mut least = f64::INFINITY;
        for (index, side) in self.sides.iter().enumerate() {
            for (&d, corner) in distances[index].iter().zip(triangle) {
                let foot = corner - side.normal * d;
                let others = self.sides.iter().enumerate().filter(|(i, _)| *i != index);
                if d > 0.0 && d < least && others.map(|(_, s)| s.distance(foot)).all(|o| o <= 0.0) {
                    least = d;
                }
            }
        }
        least
    }

    /// From those corners of the frustum which stand straight above the triangle.
    fn corners_to_inner_triangle(&self, [a, b, c]: [DVec3; 3]) -> f64 {
        let Some(normal) = (b - a).cross(c - a).try_normalize() else {
            return f64::INFINITY;
        };
        let inward = [(a, b), (b, c), (c, a)].map(|(p, q)| (p, normal.cross(q - p)));
        self.corners
            .iter()
            .filter(|&&x| inward.iter().all(|(p, n)| n.dot(x - p) >= 0.0))
            .map(|&x| normal.dot(x - a).abs())
            .fold(f64::INFINITY, f64::min)
    }

    fn edges_to_edges(&self, distances: &SideDistances, [a, b, c]: [DVec3; 3]) -> f64 {
        // The way from the nearest point of an edge leads out of one of its sides at least.
        let is_faced = distances.map(|d| d.iter().any(|&d| d > 0.0));
        let faced = EDGES.iter().filter(|e| e.sides.iter().any(|&s| is_faced[s]));
        faced
            .map(|e| e.corners.map(|corner| self.corners[corner]))
            .flat_map(|e| [[a, b], [b, c], [c, a]].map(|t| segment_distance_squared(t, e)))
            .fold(f64::INFINITY, f64::min)
            .sqrt()
    }
}

/// What is left of a triangle: each cut adds one corner at most.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec3; 3 + SIDE_COUNT],
    count: usize,
}

impl Polygon {
    fn new(triangle: [DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; 3 + SIDE_COUNT];
        corners[..3].copy_from_slice(&triangle);
        Self { corners, count: 3 }
    }

    fn push(&mut self, corner: DVec3) {
        // Rounding can make a cut that is not convex; what does not fit is not missed then.
        if self.count < self.corners.len() {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// The part where the distance is not positive.
    fn inside(&self, distance: impl Fn(DVec3) -> f64) -> Self {
        let mut kept = Self { corners: self.corners, count: 0 };
        for i in 0..self.count {
            let [p, q] = [self.corners[i], self.corners[(i + 1) % self.count]];
            let [dp, dq] = [p, q].map(&distance);
            if dp <= 0.0 {
                kept.push(p);
            }
            if (dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0) {
                kept.push(p.lerp(q, dp / (dp - dq)));
            }
        }
        kept
    }
}

#[cfg(test)]
#[path = "distance_tests.rs"]
mod tests;
