//! Cubics over the unit interval: where can they vanish?

use glam::DVec3;

/// p(t) = sum_i b_i B_i(t) for t in 0..1, with Bernstein's polynomials B_i of degree 3. The curve
/// (t, p(t)) lies in the convex hull of the points (i/3, b_i), so what the hull does not reach, the
/// cubic does not reach either, whatever its roots are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// b_0 = p(0) to b_3 = p(1).
    pub coefficients: [f64; 4],
    /// How far rounding may have moved any of the coefficients.
    pub error: f64,
}

/// Products and sums behind a coefficient: each rounds by half an epsilon of at most the product of
/// the vectors' lengths. Some 30 operations, with room to spare for the splits that follow.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Cubic {
    /// a(t) . (b(t) x c(t)) of three vectors that move linearly from their first to their second
    /// value.
    pub fn triple_product(
        [a0, a1]: [DVec3; 2],
        [b0, b1]: [DVec3; 2],
        [c0, c1]: [DVec3; 2],
    ) -> Self {
        let (start, end) = (b0.cross(c0), b1.cross(c1));
        let mixed = b1.cross(c0) + b0.cross(c1);
        let longest = |v: DVec3, w: DVec3| v.length_squared().max(w.length_squared());
        let size = (longest(a0, a1) * longest(b0, b1) * longest(c0, c1)).sqrt();
        Self {
            coefficients: [
                a0.dot(start),
                (a1.dot(start) + a0.dot(mixed)) / 3.0,
                (a0.dot(end) + a1.dot(mixed)) / 3.0,
                a1.dot(end),
            ],
            error: ROUNDING * size,
        }
    }

    /// The same cubic from t to 1, stretched over 0..1 again (de Casteljau).
    #[must_use]
    pub fn after(self, t: f64) -> Self {
        let [mut a, mut b, mut c, d] = self.coefficients;
        let towards = |p: f64, q: f64| p + (q - p) * t;
        (a, b, c) = (towards(a, b), towards(b, c), towards(c, d));
        (a, b) = (towards(a, b), towards(b, c));
        a = towards(a, b);
        Self { coefficients: [a, b, c, d], error: self.error }
    }

    /// A time in 0..1 before which the cubic cannot vanish, by its convex hull; `None` if it
    /// cannot vanish at all. What is zero within the error may vanish.
    pub fn earliest_zero(&self) -> Option<f64> {
        let b = self.coefficients;
        if b.iter().all(|&b| b > self.error) || b.iter().all(|&b| b < -self.error) {
            return None;
        }
        // On the positive side of zero; what is not positive there may vanish at once.
        let side = b[0].signum();
        let above = b.map(|b| b * side - self.error);
        if !(above[0] > 0.0) {
            return Some(0.0);
        }
        let mut earliest = f64::INFINITY;
        for i in 0..4 {
            for j in i + 1..4 {
                if above[i] > 0.0 && above[j] <= 0.0 {
                    let part = above[i] / (above[i] - above[j]);
                    earliest = earliest.min((i as f64 + (j - i) as f64 * part) / 3.0);
                }
            }
        }
        Some(earliest.min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(cubic: Cubic, t: f64) -> f64 {
        cubic.after(t).coefficients[0]
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from)
    }

    proptest! {
        #[test]
        fn it_is_the_triple_product_of_the_moved_vectors(
            a in [vector(), vector()], b in [vector(), vector()], c in [vector(), vector()],
            t in 0.0..1.0,
        ) {
            let cubic = Cubic::triple_product(a, b, c);
            let at = |v: [DVec3; 2]| v[0].lerp(v[1], t);
            let exact = at(a).dot(at(b).cross(at(c)));
            prop_assert!((value(cubic, t) - exact).abs() <= 1e-14);
        }

        #[test]
        fn no_sample_vanishes_before_the_earliest_zero(
            coefficients in [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64],
        ) {
            let cubic = Cubic { coefficients, error: 0.0 };
            let earliest = cubic.earliest_zero().unwrap_or(1.0);
            for i in 0..=1000 {
                let t = earliest * f64::from(i) / 1000.0 * (1.0 - 1e-9);
                prop_assert!(value(cubic, t) * coefficients[0] > 0.0);
            }
        }

        #[test]
        fn clipping_again_and_again_finds_a_root(root in 0.05..0.95f64, slope in 0.1..2.0f64) {
            // slope (t - root) (1 + t^2) changes sign at the root only.
            let p = |t: f64| slope * (t - root) * (1.0 + t * t);
            // By values at 0, 1/3, 2/3 and 1.
            let [p0, p1, p2, p3] = [p(0.0), p(1.0 / 3.0), p(2.0 / 3.0), p(1.0)];
            let b1 = (-5.0 * p0 + 18.0 * p1 - 9.0 * p2 + 2.0 * p3) / 6.0;
            let b2 = (2.0 * p0 - 9.0 * p1 + 18.0 * p2 - 5.0 * p3) / 6.0;
            let cubic = Cubic { coefficients: [p0, b1, b2, p3], error: 1e-15 };
            let mut t = 0.0;
            for _ in 0..80 {
                let ahead = cubic.after(t).earliest_zero().expect("the root is ahead");
                t += ahead * (1.0 - t);
            }
            prop_assert!((t - root).abs() < 1e-9, "{t} and {root}");
        }
    }

    #[test]
    fn what_is_zero_within_rounding_may_vanish_at_once() {
        let flat = Cubic { coefficients: [0.0; 4], error: 0.0 };
        assert_eq!(flat.earliest_zero(), Some(0.0));
        let nearly = Cubic { coefficients: [1e-20, 1.0, 1.0, 1.0], error: 1e-18 };
        assert_eq!(nearly.earliest_zero(), Some(0.0));
        let away = Cubic { coefficients: [-1e-9, -1.0, -1.0, -2e-18], error: 1e-18 };
        assert_eq!(away.earliest_zero(), None);
    }
}
