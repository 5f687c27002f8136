//! Continuous tests: when do four points that move linearly first touch, as a point and a triangle
//! or as two edges?
//!
//! Time advances by what is known to be free: nothing can touch before the distance is used up
//! ([`LKJ21`](crate::papers::LKJ21)), nor before the four points can be in one plane, which the
//! Bernstein coefficients of a cubic tell. The first alone crawls where features pass close by or
//! rest near one another, the second alone fails where they stay in one plane or an edge has no
//! length; together each covers for the other, and most pairs are dismissed by the cubic before any
//! distance is measured. Roots are never computed, so no tolerance decides which of them are real.

use glam::DVec3;

use crate::math::{Cubic, closest_point_on_triangle, closest_points_of_segments};

/// Four points and where they go, on straight lines in the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// (m).
    pub start: [DVec3; 4],
    /// (m).
    pub end: [DVec3; 4],
}

/// Which features the four points are the corners of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Features {
    /// A point, and the three corners of a triangle.
    VertexFace,
    /// The ends of one edge, then those of another.
    EdgeEdge,
}

/// The first touch of two features.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstTouch {
    /// Share of the motion, 0..1; never later than the true first touch, and at most as much
    /// earlier as it takes to close the tolerance.
    pub time: f64,
    /// The offset between the nearest points at that time is the weighted sum of the four points:
    /// the first feature's weights add up to 1, the second's to -1.
    pub weights: [f64; 4],
}

/// Advances after which the touch is taken for granted. A clear hit or miss takes fewer than ten; only
/// features which turn while they slide along one another need more, and only those nearer than a
/// thousandth of their way run out of them.
const ADVANCES_MAX: usize = 1000;

/// No tolerance is finer than this share of the size of the features. How far apart two edges are is
/// told to about the root of an epsilon of their length, 1.5e-8, where they are nearly parallel: so
/// small is the sine of the angle below which the difference of products that holds its square is all
/// rounding, and so far off may the nearest points then be. Seven times that leaves room.
pub(super) const TOLERANCE_OF_SIZE_MIN: f64 = 1e-7;

impl Sweep {
    /// When the features first come as close as the tolerance (m), if they touch; `None` is
    /// certain. Features which pass one another closer than the tolerance, or come to lie so, may
    /// be reported as touching.
    ///
    /// Features that touch at the start touch at time 0, wherever they go. Without relative motion
    /// they touch at time 0 or never. Edges may be parallel, edges and triangles without extent,
    /// all points in one plane throughout. The tolerance is never less than 1e-7 of the size the
    /// features have at the time, for so much may rounding hide where edges are parallel.
    pub fn first_touch(&self, features: Features, tolerance: f64) -> Option<FirstTouch> {
        let plane = self.plane();
        let way = self.closing_way_max(features);
        let mut time = 0.0;
        let mut nearest_yet = (f64::INFINITY, FirstTouch { time, weights: [0.0; 4] });
        for _ in 0..ADVANCES_MAX {
            time += plane.after(time).earliest_zero()? * (1.0 - time);
            let points = self.at(time);
            let near = nearest(features, points);
            let tolerance = tolerance.max(TOLERANCE_OF_SIZE_MIN * size(features, points));
            let here = FirstTouch { time, weights: near.weights };
            if near.distance <= tolerance {
                return Some(here);
            }
            // What is no number is kept, and shows.
            if !(near.distance >= nearest_yet.0) {
                nearest_yet = (near.distance, here);
            }
            // Half the tolerance is kept back for rounding.
            let free = (near.distance - 0.5 * tolerance) / way;
            time += free.max(self.parted_for(features, time, near, 0.5 * tolerance));
            if time > 1.0 {
                return None;
            }
        }
        // The advances add up to less than the whole, so the least of them was under a thousandth.
        Some(nearest_yet.1)
    }

    /// Where the points are at a share of the motion.
    pub fn at(&self, time: f64) -> [DVec3; 4] {
        [0, 1, 2, 3].map(|k| self.start[k].lerp(self.end[k], time))
    }

    /// How long a plane across the offset between the nearest points keeps the features apart (share
    /// of the motion): until the first two corners, one of either, are no farther apart across it than
    /// a distance (m). Features that slide along one another are apart for long, however fast.
    fn parted_for(&self, features: Features, time: f64, near: Near, least: f64) -> f64 {
        let points = self.at(time);
        let offset: DVec3 = (0..4).map(|k| points[k] * near.weights[k]).sum();
        let normal = offset / near.distance;
        let heights = points.map(|p| normal.dot(p));
        let rises = [0, 1, 2, 3].map(|k| normal.dot(self.end[k] - self.start[k]));
        let until = |(i, j): (usize, usize)| {
            let closing = rises[j] - rises[i];
            if closing <= 0.0 { f64::INFINITY } else { (heights[i] - heights[j] - least) / closing }
        };
        // What is no number parts nothing.
        let earlier = |a: f64, b: f64| if b >= a { a } else { b };
        corner_pairs(features).iter().copied().map(until).fold(f64::INFINITY, earlier)
    }

    /// The volume of the parallelepiped at the first point: zero where the four are in one plane.
    fn plane(&self) -> Cubic {
        let from_first = |k: usize| [self.start[k] - self.start[0], self.end[k] - self.end[0]];
        Cubic::triple_product(from_first(1), from_first(2), from_first(3))
    }

    /// No two points of the features come closer by more (m): the longest relative way of their
    /// corners.
    fn closing_way_max(&self, features: Features) -> f64 {
        let way = |i: usize, j: usize| {
            ((self.end[i] - self.start[i]) - (self.end[j] - self.start[j])).length_squared()
        };
        corner_pairs(features).iter().map(|&(i, j)| way(i, j)).fold(0.0, f64::max).sqrt()
    }
}

/// A corner of the first feature and one of the second.
pub(super) fn corner_pairs(features: Features) -> &'static [(usize, usize)] {
    match features {
        Features::VertexFace => &[(0, 1), (0, 2), (0, 3)],
        Features::EdgeEdge => &[(0, 2), (0, 3), (1, 2), (1, 3)],
    }
}

/// The longest edge of the features (m).
pub(super) fn size(features: Features, [a, b, c, d]: [DVec3; 4]) -> f64 {
    let squared = match features {
        Features::VertexFace => {
            b.distance_squared(c).max(c.distance_squared(d)).max(d.distance_squared(b))
        }
        Features::EdgeEdge => a.distance_squared(b).max(c.distance_squared(d)),
    };
    squared.sqrt()
}

/// How far apart two features are, and between which of their points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub distance: f64,
    /// Of the offset between the nearest points, as those of [`FirstTouch`].
    pub weights: [f64; 4],
}

pub(super) fn nearest(features: Features, [a, b, c, d]: [DVec3; 4]) -> Near {
    match features {
        Features::VertexFace => {
            let closest = closest_point_on_triangle(a, [b, c, d]);
            let [u, v, w] = closest.barycentric;
            Near { distance: closest.point.distance(a), weights: [1.0, -u, -v, -w] }
        }
        Features::EdgeEdge => {
            let pair = closest_points_of_segments([a, b], [c, d]);
            let (s, t) = (pair.first, pair.second);
            Near { distance: pair.offset.length(), weights: [1.0 - s, s, t - 1.0, -t] }
        }
    }
}

#[cfg(test)]
#[path = "continuous_tests.rs"]
mod tests;
