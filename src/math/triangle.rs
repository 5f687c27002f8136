//! Points, segments and triangles in space.

use glam::DVec3;

/// The point of a triangle closest to another point, and its barycentric coordinates: exactly zero
/// where the closest point lies on an edge or a corner, which tells the feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    pub point: DVec3,
    pub barycentric: [f64; 3],
}

/// By the Voronoi regions of the corners and edges; a degenerate triangle gives a closest point of
/// its edges.
pub fn closest_point_on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> ClosestPoint {
    let at = |barycentric: [f64; 3]| ClosestPoint {
        point: a * barycentric[0] + b * barycentric[1] + c * barycentric[2],
        barycentric,
    };
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return at([1.0, 0.0, 0.0]);
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return at([0.0, 1.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3 {
        let t = d1 / (d1 - d3);
        return at([1.0 - t, t, 0.0]);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return at([0.0, 0.0, 1.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6 {
        let t = d2 / (d2 - d6);
        return at([1.0 - t, 0.0, t]);
    }
    let va = d3 * d6 - d5 * d4;
    let (along, back) = (d4 - d3, d5 - d6);
    if va <= 0.0 && along >= 0.0 && back >= 0.0 && along + back > 0.0 {
        let t = along / (along + back);
        return at([0.0, 1.0 - t, t]);
    }
    let sum = va + vb + vc;
    if !(sum > 0.0) {
        return at([1.0, 0.0, 0.0]);
    }
    let (v, w) = (vb / sum, vc / sum);
    at([1.0 - v - w, v, w])
}

/// Whether two triangles cross: an edge of one passes through the inside of the other. Triangles in
/// one plane do not cross.
pub fn triangles_cross(first: [DVec3; 3], second: [DVec3; 3]) -> bool {
    edge_passes_through(first, second) || edge_passes_through(second, first)
}

/// Where edges of one triangle pass through the inside of the other.
pub fn crossing_places(first: [DVec3; 3], second: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
    let of = |edges_of: [DVec3; 3], face: [DVec3; 3]| {
        [(0, 1), (1, 2), (2, 0)]
            .into_iter()
            .filter_map(move |(i, j)| place_in_segment([edges_of[i], edges_of[j]], face))
    };
    of(first, second).chain(of(second, first))
}

fn edge_passes_through(edges_of: [DVec3; 3], face: [DVec3; 3]) -> bool {
    [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .any(|(i, j)| segment_passes_through([edges_of[i], edges_of[j]], face))
}

/// Whether a segment passes through the inside of a triangle. One that lies in the triangle's plane
/// to rounding does so only where it is over the inside.
pub fn segment_passes_through(ends: [DVec3; 2], face: [DVec3; 3]) -> bool {
    place_in_segment(ends, face).is_some()
}

fn place_in_segment(ends: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let [low, high] = ends.map(|p| normal.dot(p - a));
    if (low > 0.0) == (high > 0.0) {
        return None;
    }
    let p = ends[0].lerp(ends[1], low / (low - high));
    let inside = |from: DVec3, to: DVec3| normal.dot((to - from).cross(p - from)) > 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then_some(p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from)
    }

    proptest! {
        #[test]
        fn no_sample_of_the_triangle_is_closer(p in point(), t in [point(), point(), point()]) {
            let closest = closest_point_on_triangle(p, t);
            let distance = closest.point.distance(p);
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                    let sample = t[0] * (1.0 - u - v) + t[1] * u + t[2] * v;
                    prop_assert!(distance <= sample.distance(p) + 1e-12);
                }
            }
            let sum: f64 = closest.barycentric.iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-12);
            prop_assert!(closest.barycentric.iter().all(|&b| b >= -1e-12));
        }
    }

    #[test]
    fn features_are_told_by_zero_coordinates() {
        let t = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let zeros = |p: DVec3| {
            closest_point_on_triangle(p, t).barycentric.iter().filter(|&&b| b == 0.0).count()
        };
        assert_eq!(zeros(DVec3::new(0.2, 0.2, 1.0)), 0);
        assert_eq!(zeros(DVec3::new(0.5, -1.0, 1.0)), 1);
        assert_eq!(zeros(DVec3::new(-1.0, -1.0, 1.0)), 2);
    }

    #[test]
    fn a_degenerate_triangle_has_a_closest_point() {
        let p = DVec3::new(0.3, 1.0, 0.0);
        for t in [[DVec3::ZERO; 3], [DVec3::ZERO, DVec3::X, DVec3::X * 0.5]] {
            assert!(closest_point_on_triangle(p, t).point.is_finite());
        }
    }

    #[test]
    fn crossing_is_seen_from_both_sides_and_apart_is_apart() {
        let floor = [DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0];
        let blade =
            [DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.2, 1.0, 1.0), DVec3::new(1.0, 1.2, 1.0)];
        assert!(triangles_cross(floor, blade) && triangles_cross(blade, floor));
        let lifted = blade.map(|p| p + DVec3::Z * 2.0);
        assert!(!triangles_cross(floor, lifted));
        let beside = blade.map(|p| p + DVec3::X * 9.0);
        assert!(!triangles_cross(floor, beside));
        assert!(!triangles_cross(floor, floor));
    }

    #[test]
    fn neighbours_in_a_tilted_plane_do_not_cross_whatever_rounding_says() {
        // Two rotations make every coordinate round.
        let turn = DQuat::from_rotation_x(0.3) * DQuat::from_rotation_y(0.7);
        let at = |i: u32, j: u32| turn * (DVec3::new(f64::from(i), f64::from(j), 0.0) * 0.0131);
        for i in 0..40 {
            for j in 0..40 {
                let face = [at(i, j), at(i + 1, j), at(i, j + 1)];
                for end in [at(i + 2, j), at(i, j + 2), at(i + 2, j + 1)] {
                    assert!(!segment_passes_through([at(i + 1, j + 1), end], face));
                }
            }
        }
    }
}
