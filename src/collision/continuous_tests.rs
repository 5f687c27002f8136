use glam::DVec3;
use proptest::prelude::*;

use super::*;

const TOLERANCE: f64 = 1e-5;
const BOTH: [Features; 2] = [Features::VertexFace, Features::EdgeEdge];

fn vector() -> impl Strategy<Value = DVec3> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from)
}

fn points() -> impl Strategy<Value = [DVec3; 4]> {
    [vector(), vector(), vector(), vector()]
}

/// The smallest distance over a dense sampling, and when.
fn sampled(sweep: &Sweep, features: Features) -> (f64, f64) {
    let at = |i: u32| {
        let time = f64::from(i) / 2000.0;
        (nearest(features, sweep.at(time)).distance, time)
    };
    (0..=2000).map(at).fold((f64::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a })
}

/// Two features that touch at a time in the middle of their motion, by construction.
fn touching(features: Features, middle: [DVec3; 4], way: [DVec3; 4], time: f64) -> Sweep {
    let [a, b, c, d] = middle;
    let (inside, points) = match features {
        Features::VertexFace => ((b + c + d) / 3.0, [DVec3::ZERO, b, c, d]),
        Features::EdgeEdge => (a.midpoint(b), [a, b, c, d]),
    };
    let mut points = points;
    match features {
        Features::VertexFace => points[0] = inside,
        // The second edge's middle is put on that of the first.
        Features::EdgeEdge => {
            let shift = inside - c.midpoint(d);
            points[2] += shift;
            points[3] += shift;
        }
    }
    Sweep {
        start: [0, 1, 2, 3].map(|k| points[k] - way[k] * time),
        end: [0, 1, 2, 3].map(|k| points[k] + way[k] * (1.0 - time)),
    }
}

/// What holds for every answer.
fn check(sweep: &Sweep, features: Features) -> Result<(), TestCaseError> {
    let (least, _) = sampled(sweep, features);
    match sweep.first_touch(features, TOLERANCE) {
        // Samples are at most 1/2000 of the way apart from a touch.
        None => prop_assert!(least > 0.0),
        Some(touch) => {
            prop_assert!((0.0..=1.0).contains(&touch.time));
            let points = sweep.at(touch.time);
            let offset: DVec3 = (0..4).map(|k| points[k] * touch.weights[k]).sum();
            // It is a near miss at least, and the weights are those of the nearest points.
            let near = TOLERANCE.max(sweep.closing_way_max(features) / ADVANCES_MAX as f64);
            prop_assert!(least <= near * 1.01, "{least} m apart");
            prop_assert!((nearest(features, points).distance - offset.length()).abs() < 1e-9);
            // Nothing touches earlier.
            for i in 0..500 {
                let time = touch.time * f64::from(i) / 500.0;
                let apart = nearest(features, sweep.at(time)).distance;
                prop_assert!(touch.time == 0.0 || apart > 0.0);
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn answers_agree_with_dense_sampling(start in points(), end in points()) {
        for features in BOTH {
            check(&Sweep { start, end }, features)?;
        }
    }

    #[test]
    fn a_touch_is_never_missed_and_never_late(
        middle in points(), way in points(), time in 0.0..1.0f64, speed in -6.0..1.0f64,
    ) {
        for features in BOTH {
            let sweep = touching(features, middle, way.map(|w| w * 10f64.powf(speed)), time);
            let touch = sweep.first_touch(features, TOLERANCE);
            prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
            check(&sweep, features)?;
        }
    }

    #[test]
    fn motion_within_one_plane_is_no_exception(
        start in points(), end in points(), normal in vector(), shift in -1.0..1.0f64,
    ) {
        let n = normal.try_normalize().unwrap_or(DVec3::Z);
        let flat = |p: DVec3| p - n * (n.dot(p) - shift);
        for features in BOTH {
            check(&Sweep { start: start.map(flat), end: end.map(flat) }, features)?;
        }
    }

    #[test]
    fn a_touch_within_one_plane_is_never_missed(
        middle in points(), way in points(), normal in vector(), time in 0.0..1.0f64,
    ) {
        let n = normal.try_normalize().unwrap_or(DVec3::Z);
        let flat = |p: DVec3| p - n * n.dot(p);
        for features in BOTH {
            let sweep = touching(features, middle.map(flat), way.map(flat), time);
            let touch = sweep.first_touch(features, TOLERANCE);
            prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
        }
    }

    #[test]
    fn parallel_edges_that_meet_are_seen(
        a in [vector(), vector()], way in vector(), along in -0.9..0.9f64, time in 0.0..1.0f64,
    ) {
        // The second edge lies on the first, shifted along it, at `time`.
        let shift = (a[1] - a[0]) * along;
        let sweep = Sweep {
            start: [a[0], a[1], a[0] + shift - way * time, a[1] + shift - way * time],
            end: [a[0], a[1], a[0] + shift + way * (1.0 - time), a[1] + shift + way * (1.0 - time)],
        };
        let touch = sweep.first_touch(Features::EdgeEdge, TOLERANCE);
        prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
    }

    #[test]
    fn features_without_extent_are_points(p in vector(), q in vector(), time in 0.0..1.0f64) {
        let way = q - p;
        // Three or two corners in one place, which the first feature runs into.
        let triangle = Sweep {
            start: [p - way * time, p, p, p],
            end: [p + way * (1.0 - time), p, p, p],
        };
        let touch = triangle.first_touch(Features::VertexFace, TOLERANCE);
        prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
        let edges = Sweep {
            start: [p - way * time, p - way * time, p, p],
            end: [p + way * (1.0 - time), p + way * (1.0 - time), p, p],
        };
        let touch = edges.first_touch(Features::EdgeEdge, TOLERANCE);
        prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
    }

    #[test]
    fn without_relative_motion_features_touch_at_once_or_never(
        start in points(), way in vector(),
    ) {
        for features in BOTH {
            let sweep = Sweep { start, end: start.map(|p| p + way) };
            let apart = nearest(features, start).distance;
            let touch = sweep.first_touch(features, TOLERANCE);
            prop_assert_eq!(touch.is_some(), apart <= TOLERANCE);
            let met = touching(features, start, [way; 4], 0.0);
            prop_assert_eq!(met.first_touch(features, TOLERANCE).map(|t| t.time), Some(0.0));
        }
    }
}

const FLOOR: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

fn onto_the_floor(from: DVec3, to: DVec3) -> Option<FirstTouch> {
    let [a, b, c] = FLOOR;
    let sweep = Sweep { start: [from, a, b, c], end: [to, a, b, c] };
    sweep.first_touch(Features::VertexFace, TOLERANCE)
}

#[test]
fn a_point_through_a_triangle_touches_when_it_is_there() {
    let p = DVec3::new(0.25, 0.25, 0.0);
    let touch = onto_the_floor(p + DVec3::Z, p - DVec3::Z * 3.0).unwrap();
    assert!(touch.time <= 0.25 && touch.time > 0.25 - TOLERANCE, "{}", touch.time);
    assert!(touch.weights.iter().sum::<f64>().abs() < 1e-12);
}

#[test]
fn a_point_that_starts_in_contact_touches_at_once_even_if_it_leaves() {
    let p = DVec3::new(0.25, 0.25, 0.0);
    assert_eq!(onto_the_floor(p, p + DVec3::Z).map(|t| t.time), Some(0.0));
}

#[test]
fn a_point_that_ends_just_above_does_not_touch() {
    let p = DVec3::new(0.25, 0.25, 0.0);
    assert_eq!(onto_the_floor(p + DVec3::Z, p + DVec3::Z * 2e-5), None);
}

#[test]
fn a_point_that_slides_above_a_triangle_is_let_pass() {
    let up = DVec3::Z * 1e-3;
    assert_eq!(onto_the_floor(DVec3::new(-1.0, 0.2, 0.0) + up, DVec3::X * 2.0 + up), None);
}

#[test]
fn motion_that_is_not_finite_is_no_endless_loop() {
    for features in BOTH {
        for value in [f64::NAN, f64::INFINITY, f64::MAX] {
            let sweep = Sweep { start: [DVec3::ZERO; 4], end: [DVec3::splat(value); 4] };
            let _ = sweep.first_touch(features, TOLERANCE);
            let other = Sweep { start: [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE], ..sweep };
            let _ = other.first_touch(features, TOLERANCE);
        }
    }
}
