use proptest::prelude::*;

use super::*;
use crate::shot::tests::sample_view;

fn frustum() -> Frustum {
    Frustum::of(&sample_view())
}

/// Nearest point of the frustum by trying every set of up to three sides as the active ones: shares
/// nothing with the distance under test but the sides.
fn point_distance(frustum: &Frustum, x: DVec3) -> f64 {
    let is_inside = |p: DVec3| frustum.sides.iter().all(|s| s.distance(p) < 1e-9);
    let mut least = if is_inside(x) { 0.0 } else { f64::INFINITY };
    let mut consider = |p: DVec3| {
        if is_inside(p) {
            least = f64::min(least, p.distance(x));
        }
    };
    for (i, a) in frustum.sides.iter().enumerate() {
        consider(x - a.normal * a.distance(x));
        for (j, b) in frustum.sides.iter().enumerate().skip(i + 1) {
            let along = a.normal.cross(b.normal);
            if along.length_squared() < 1e-12 {
                continue;
            }
            let meet = |third: DVec3, offset: f64| {
                glam::DMat3::from_cols(a.normal, b.normal, third).transpose().inverse()
                    * DVec3::new(a.offset, b.offset, offset)
            };
            consider(meet(along, along.dot(x)));
            for c in frustum.sides.iter().skip(j + 1) {
                if along.dot(c.normal).abs() > 1e-9 {
                    consider(meet(c.normal, c.offset));
                }
            }
        }
    }
    least
}

/// Least over 0..1 of a convex function.
fn least_of(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let (p, q) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if f(p) < f(q) { high = q } else { low = p }
    }
    f(0.5 * (low + high))
}

/// The distance to a convex solid is convex on the triangle, so nested searches find its minimum.
fn brute_force(frustum: &Frustum, [a, b, c]: [DVec3; 3]) -> f64 {
    least_of(|s| least_of(|t| point_distance(frustum, a.lerp(b.lerp(c, t), s))))
}

fn offset(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from_array)
}

/// Triangles near the frustum's corners and edges, small and large.
fn triangle() -> impl Strategy<Value = [DVec3; 3]> {
    (0..8usize, 0..8usize, 0.0..1.0, offset(0.6), -2.0..0.5, [offset(1.0), offset(1.0)]).prop_map(
        |(i, j, s, away, log_size, [p, q])| {
            let corners = frustum().corners();
            let a = corners[i].lerp(corners[j], s) + away;
            let size = 10f64.powf(log_size);
            [a, a + p * size, a + q * size]
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_distance_is_that_of_brute_force(t in triangle()) {
        let frustum = frustum();
        let (exact, brute) = (frustum.distance_to_triangle(t), brute_force(&frustum, t));
        prop_assert!((exact - brute).abs() < 1e-6, "{exact} instead of {brute}");
    }

    #[test]
    fn a_limit_changes_nothing_below_it(t in triangle(), limit in 0.0..0.8) {
        let frustum = frustum();
        let (exact, limited) =
            (frustum.distance_to_triangle(t), frustum.distance_to_triangle_up_to(limit, t));
        if exact < limit {
            prop_assert_eq!(exact, limited);
        } else {
            prop_assert!(limited >= limit && limited <= exact + 1e-12);
            prop_assert_eq!(limited == 0.0, exact == 0.0);
        }
    }
}

/// A frustum of unit half width at depth 1 along -z, near 1, far 3, the eye at the origin.
fn simple() -> Frustum {
    let mut view = sample_view();
    view.eye = DVec3::ZERO;
    [view.right, view.up, view.back] = [DVec3::X, DVec3::Y, DVec3::Z];
    [view.gate_min, view.gate_max] = [glam::DVec2::NEG_ONE, glam::DVec2::ONE];
    [view.near, view.far] = [1.0, 3.0];
    Frustum::of(&view)
}

#[test]
fn a_triangle_through_or_around_the_frustum_is_at_distance_zero() {
    let frustum = simple();
    let d = |t: [[f64; 3]; 3]| frustum.distance_to_triangle(t.map(DVec3::from_array));
    assert_eq!(d([[-50.0, -50.0, -2.0], [50.0, -50.0, -2.0], [0.0, 90.0, -2.0]]), 0.0);
    assert_eq!(d([[-50.0, 0.0, -2.0], [50.0, 0.0, -2.0], [50.0, 0.1, -2.0]]), 0.0);
    assert_eq!(d([[0.0, 0.0, -2.0], [0.1, 0.0, -2.0], [0.0, 0.1, -2.0]]), 0.0);
    assert_eq!(d([[0.0, 0.0, -1.0], [0.1, 0.0, 5.0], [0.0, 0.1, 5.0]]), 0.0);
}

#[test]
fn a_triangle_between_eye_and_near_plane_or_behind_is_outside() {
    let frustum = simple();
    let at = |z: f64| [[-0.1, -0.1, z], [0.1, -0.1, z], [0.0, 0.1, z]].map(DVec3::from_array);
    assert!((frustum.distance_to_triangle(at(-0.75)) - 0.25).abs() < 1e-12);
    assert!((frustum.distance_to_triangle(at(2.0)) - 3.0).abs() < 1e-12);
    assert!((frustum.distance_to_triangle(at(-3.5)) - 0.5).abs() < 1e-12);
}

#[test]
fn the_face_counts_and_not_its_corners() {
    // A large triangle beyond the far plane's corner: that corner stands over its middle.
    let frustum = simple();
    let corner = DVec3::new(3.0, 3.0, -3.0);
    let away = DVec3::new(1.0, 1.0, -1.0).normalize();
    let side = away.any_orthonormal_vector();
    let other = away.cross(side);
    let middle = corner + away * 0.3;
    let t = [side * 9.0, other * 9.0 - side * 9.0, -other * 9.0 - side * 9.0].map(|o| middle + o);
    assert!((frustum.distance_to_triangle(t) - 0.3).abs() < 1e-12);
}

#[test]
fn a_triangle_without_area_is_a_segment_or_a_point() {
    let frustum = simple();
    let p = DVec3::new(0.0, 0.0, 1.0);
    assert!((frustum.distance_to_triangle([p, p, p]) - 2.0).abs() < 1e-12);
    let q = DVec3::new(0.0, 0.0, -0.5);
    assert!((frustum.distance_to_triangle([p, q, q.lerp(p, 0.5)]) - 0.5).abs() < 1e-12);
}
