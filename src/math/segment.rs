//! Straight segments in space.

use glam::DVec3;

/// The nearest points of two segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentPair {
    /// Where along the first, 0..1.
    pub first: f64,
    /// Where along the second, 0..1.
    pub second: f64,
    /// From the point of the second to that of the first (m).
    pub offset: DVec3,
}

/// Squared distance between two segments (m^2); either may be a point, and they may be parallel.
pub fn segment_distance_squared(a: [DVec3; 2], b: [DVec3; 2]) -> f64 {
    closest_points_of_segments(a, b).offset.length_squared()
}

/// The nearest points of two segments; either may be a point. Of parallel segments, where many pairs
/// are as near, one of them.
pub fn closest_points_of_segments([a0, a1]: [DVec3; 2], [b0, b1]: [DVec3; 2]) -> SegmentPair {
    let (a, b, offset) = (a1 - a0, b1 - b0, a0 - b0);
    let (aa, bb, ab) = (a.length_squared(), b.length_squared(), a.dot(b));
    let (ao, bo) = (a.dot(offset), b.dot(offset));
    // Where the parameters s along a and t along b give the nearest points of the two lines; for
    // parallel ones any s is as good as another.
    let gap = aa * bb - ab * ab;
    let s_line = if gap > 0.0 { ((ab * bo - bb * ao) / gap).clamp(0.0, 1.0) } else { 0.0 };
    let t = clamped_ratio(ab * s_line + bo, bb);
    // Clamping t moves the nearest point of the first segment, which clamps again.
    let s = clamped_ratio(ab * t - ao, aa);
    let t = clamped_ratio(ab * s + bo, bb);
    SegmentPair { first: s, second: t, offset: offset + a * s - b * t }
}

/// n / d within 0..1; 0 where d is 0.
fn clamped_ratio(n: f64, d: f64) -> f64 {
    if d > 0.0 { (n / d).clamp(0.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(DVec3::from_array)
    }

    /// Smallest over a fine grid of parameters of the first segment; exact in the second.
    fn sampled(a: [DVec3; 2], b: [DVec3; 2]) -> f64 {
        let to_second = |p: DVec3| {
            let d = b[1] - b[0];
            p.distance_squared(b[0] + d * clamped_ratio((p - b[0]).dot(d), d.length_squared()))
        };
        (0..=2000)
            .map(|i| to_second(a[0].lerp(a[1], f64::from(i) / 2000.0)))
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn distance_agrees_with_dense_sampling(a in [point(), point()], b in [point(), point()]) {
            let (exact, brute) = (segment_distance_squared(a, b), sampled(a, b));
            prop_assert!(exact <= brute + 1e-12);
            prop_assert!(brute.sqrt() - exact.sqrt() <= 0.005);
        }

        #[test]
        fn parallel_segments_are_no_exception(
            a in [point(), point()], p in point(), s in -2.0..2.0,
        ) {
            let b = [p, p + (a[1] - a[0]) * s];
            let (exact, brute) = (segment_distance_squared(a, b), sampled(a, b));
            prop_assert!(exact <= brute + 1e-9 && brute.sqrt() - exact.sqrt() <= 0.005);
        }
    }

    #[test]
    fn a_segment_without_length_is_a_point() {
        let p = [DVec3::new(0.5, 2.0, 0.0); 2];
        let line = [DVec3::ZERO, DVec3::X];
        assert_eq!(segment_distance_squared(p, line), 4.0);
        assert_eq!(segment_distance_squared(line, p), 4.0);
        assert_eq!(segment_distance_squared(p, p), 0.0);
    }
}
