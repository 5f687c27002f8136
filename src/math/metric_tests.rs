use super::*;
use proptest::prelude::*;

/// Semi-definite tensors from the largest aspect worth having down to rank one and zero.
fn metric() -> impl Strategy<Value = SymTensor2> {
    let value = prop_oneof![Just(0.0), (-4.0..5.0).prop_map(|e: f64| 10f64.powf(e))];
    (value.clone(), value, 0.0..std::f64::consts::TAU).prop_map(|(p, q, angle)| {
        let axis = DVec2::from_angle(angle);
        SymTensor2::outer(axis) * p + SymTensor2::outer(axis.perp()) * q
    })
}

fn size(m: SymTensor2) -> f64 {
    m.xx.abs() + m.xy.abs() + m.yy.abs()
}

/// The worst relative violation of a >= b.
fn shortfall(a: SymTensor2, b: SymTensor2) -> f64 {
    -(a - b).eigen().values[1] / (size(a) + size(b)).max(f64::MIN_POSITIVE)
}

proptest! {
    #[test]
    fn the_maximum_is_at_least_as_fine_as_both(a in metric(), b in metric()) {
        let max = tensor_max(a, b);
        prop_assert!(shortfall(max, a) < 1e-10 && shortfall(max, b) < 1e-10, "{max:?}");
    }

    #[test]
    fn the_maximum_does_not_depend_on_the_order(a in metric(), b in metric()) {
        let (p, q) = (tensor_max(a, b), tensor_max(b, a));
        prop_assert!(size(p - q) <= 1e-14 * size(p), "{p:?} and {q:?}");
    }

    #[test]
    fn the_maximum_touches_both(a in metric(), b in metric()) {
        // Minimal: it is one of the two, or singular less either, so nothing can be taken away.
        let max = tensor_max(a, b);
        if max == a || max == b {
            return Ok(());
        }
        for other in [a, b] {
            let rest = (max - other).determinant();
            prop_assert!(rest.abs() <= 1e-10 * size(max).powi(2), "{rest}");
        }
    }

    #[test]
    fn commuting_metrics_keep_the_larger_eigenvalues(
        p in [0.0..10.0, 0.0..10.0], q in [0.0..10.0, 0.0..10.0], angle in 0.0..3.0,
    ) {
        let axis = DVec2::from_angle(angle);
        let build = |values: [f64; 2]| {
            SymTensor2::outer(axis) * values[0] + SymTensor2::outer(axis.perp()) * values[1]
        };
        let (p, q): ([f64; 2], [f64; 2]) = (p, q);
        let max = tensor_max(build(p), build(q));
        let min = tensor_min(build(p), build(q));
        let larger = build([p[0].max(q[0]), p[1].max(q[1])]);
        let smaller = build([p[0].min(q[0]), p[1].min(q[1])]);
        prop_assert!(size(max - larger) < 1e-12 * (1.0 + size(max)));
        prop_assert!(size(min - smaller) < 1e-9 * (1.0 + size(max)));
    }

    #[test]
    fn the_maximum_is_continuous(a in metric(), b in metric(), nudge in metric()) {
        let step = nudge * (1e-9 * size(a + b) / size(nudge).max(f64::MIN_POSITIVE));
        let change = size(tensor_max(a + step, b) - tensor_max(a, b));
        // Near rank one it is no better than Hoelder continuous with exponent 1/2.
        prop_assert!(change <= 1e-3 * size(a + b), "{change}");
    }

    #[test]
    fn the_minimum_is_no_finer_than_either_and_never_negative(a in metric(), b in metric()) {
        let min = tensor_min(a, b);
        // As exact as a nearly singular metric lets it be.
        prop_assert!(shortfall(a, min) < 1e-7 && shortfall(b, min) < 1e-7, "{min:?}");
        prop_assert!(min.eigen().values[1] >= -1e-12 * size(a + b), "{min:?}");
    }

    #[test]
    fn maximum_and_minimum_add_up_to_the_sum(a in metric(), b in metric()) {
        let rest = tensor_max(a, b) + tensor_min(a, b) - (a + b);
        prop_assert!(size(rest) <= 1e-7 * size(a + b), "{rest:?}");
    }
}

#[test]
fn two_metrics_of_rank_one_are_resolved_together() {
    let (a, b) = (SymTensor2::outer(DVec2::X), SymTensor2::outer(DVec2::Y));
    assert_eq!(tensor_max(a, b), SymTensor2::IDENTITY);
    assert_eq!(tensor_max(a, a * 2.0), a * 2.0);
    assert_eq!(tensor_max(SymTensor2::ZERO, a), a);
    assert_eq!(tensor_max_of([a, b, a * 3.0]), Some(SymTensor2::new(3.0, 0.0, 1.0)));
    assert_eq!(tensor_max_of([]), None);
}

#[test]
fn eigenvalues_are_clamped_from_both_sides() {
    let m = SymTensor2::new(100.0, 0.0, 1e-3);
    let clamped = m.clamp_eigenvalues(1.0, 50.0);
    assert!(size(clamped - SymTensor2::new(50.0, 0.0, 1.0)) < 1e-12);
    assert!(size(m.clamp_eigenvalues(0.0, f64::INFINITY) - m) < 1e-12);
}

#[test]
fn the_aspect_is_raised_and_never_lowered() {
    let raised = SymTensor2::new(100.0, 0.0, 1.0).with_aspect_at_least(0.2);
    assert!(size(raised - SymTensor2::new(100.0, 0.0, 4.0)) < 1e-12);
    let fine = SymTensor2::new(1.0, 0.0, 1.0);
    assert_eq!(fine.with_aspect_at_least(0.2), fine);
}

#[test]
fn the_signed_root_squares_back_to_magnitudes() {
    let m = SymTensor2::new(4.0, 0.0, -9.0);
    assert_eq!(m.signed_sqrt(), SymTensor2::new(2.0, 0.0, -3.0));
    assert_eq!(m.squared(), SymTensor2::new(16.0, 0.0, 81.0));
    assert_eq!(m.positive_part(), SymTensor2::new(4.0, 0.0, 0.0));
}
