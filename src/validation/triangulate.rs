//! Triangles between points of the plane.

use glam::DVec2;

/// How far away the corners of the triangle around everything are, in extents of the points.
const FAR: f64 = 1e5;

/// A Delaunay triangulation, counter-clockwise, by insertion of one point after the other
/// (Bowyer, Watson 1981). Meant for a few thousand points in general position: no four on a circle,
/// and none on the line between neighbours on the hull.
pub fn delaunay(points: &[DVec2]) -> Vec<[u32; 3]> {
    let count = points.len() as u32;
    let corners = with_far_corners(points);
    let mut triangles = vec![[count, count + 1, count + 2]];
    for new in 0..count {
        let (hit, mut kept): (Vec<_>, Vec<_>) = triangles.into_iter().partition(|t: &[u32; 3]| {
            in_circle(t.map(|k| corners[k as usize]), corners[new as usize])
        });
        kept.extend(outline(&hit).into_iter().map(|[a, b]| [a, b, new]));
        triangles = kept;
    }
    triangles.retain(|t| t.iter().all(|&k| k < count));
    triangles
}

fn with_far_corners(points: &[DVec2]) -> Vec<DVec2> {
    let low = points.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec2::max).unwrap_or_default();
    let (middle, reach) = (low.midpoint(high), FAR * low.distance(high).max(f64::MIN_POSITIVE));
    let far = [0.3, 2.4, 4.5].map(|angle| middle + DVec2::from_angle(angle) * reach);
    points.iter().copied().chain(far).collect()
}

/// The directed edges of the triangles which no neighbour among them runs back along.
fn outline(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let all: Vec<[u32; 2]> = edges.collect();
    all.iter().copied().filter(|&[a, b]| !all.contains(&[b, a])).collect()
}

/// Whether a point is inside the circle through the corners of a counter-clockwise triangle.
fn in_circle(corners: [DVec2; 3], point: DVec2) -> bool {
    let [a, b, c] = corners.map(|corner| corner - point);
    let lift = |p: DVec2| p.length_squared();
    let determinant = lift(a) * b.perp_dot(c) + lift(b) * c.perp_dot(a) + lift(c) * a.perp_dot(b);
    determinant > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::signed_area;

    fn scattered(count: u32) -> Vec<DVec2> {
        // Two irrational steps: dense, and never on one line or circle.
        let at = |k: u32| {
            DVec2::new(0.618_034 * f64::from(k), 0.754_878 * f64::from(k)).fract_gl() * 0.3
        };
        (1..=count).map(at).collect()
    }

    #[test]
    fn no_point_is_inside_the_circle_of_a_triangle() {
        let points = scattered(60);
        let triangles = delaunay(&points);
        for t in &triangles {
            let corners = t.map(|k| points[k as usize]);
            assert!(signed_area(corners) > 0.0, "{t:?}");
            let others = (0..60u32).filter(|k| !t.contains(k));
            assert!(others.into_iter().all(|k| !in_circle(corners, points[k as usize])), "{t:?}");
        }
    }

    #[test]
    fn triangles_fill_the_hull_once() {
        let mut points = scattered(40);
        points.iter_mut().for_each(|p| *p = *p * 0.5 + 0.05);
        let ring = (0..12).map(|k| DVec2::from_angle(f64::from(k) * 0.52 + 0.1) * 0.4);
        points.extend(ring.clone());
        let area = |t: &[u32; 3]| signed_area(t.map(|k| points[k as usize]));
        let filled: f64 = delaunay(&points).iter().map(area).sum();
        let ring: Vec<DVec2> = ring.collect();
        let hull: f64 = (0..12).map(|k| 0.5 * ring[k].perp_dot(ring[(k + 1) % 12])).sum();
        assert!((filled / hull - 1.0).abs() < 1e-12, "{filled} m^2, not {hull} m^2");
    }
}
