use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::collision::judge;
use crate::math::Random;

const TOLERANCE: f64 = 1e-5;
const BOTH: [Features; 2] = [Features::VertexFace, Features::EdgeEdge];

fn vector() -> impl Strategy<Value = DVec3> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from)
}

fn points() -> impl Strategy<Value = [DVec3; 4]> {
    [vector(), vector(), vector(), vector()]
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

/// Whether all points stay in one plane: then the advances may run out.
#[derive(Clone, Copy, PartialEq)]
enum Motion {
    Any,
    InPlane,
}

/// What the judge saw.
struct Verdict {
    has_passage: bool,
    is_claimed: bool,
}

/// Whatever certainly happens is reported, in time; and whatever is reported is shown to be near.
fn check(sweep: &Sweep, features: Features, motion: Motion) -> Result<Verdict, TestCaseError> {
    let ends = [sweep.start, sweep.end];
    let certain = match motion {
        Motion::Any => judge::passages(features, ends).first().map(|passage| passage.time),
        Motion::InPlane => judge::first_overlap(features, ends),
    };
    let touch = sweep.first_touch(features, TOLERANCE);
    match (certain, touch) {
        (Some(time), None) => prop_assert!(false, "the passage at {time} is missed"),
        (Some(time), Some(touch)) => {
            prop_assert!(touch.time <= time + 1e-12, "{touch:?} is later than {time}");
        }
        (None, _) => {}
    }
    if let Some(touch) = touch {
        check_touch(sweep, features, touch, motion)?;
    }
    Ok(Verdict { has_passage: certain.is_some(), is_claimed: touch.is_some() })
}

/// At the time of a touch its weights name a point of each feature, no farther apart than the
/// tolerance: proof enough that these are near, whoever found them.
fn check_touch(
    sweep: &Sweep,
    features: Features,
    FirstTouch { time, weights }: FirstTouch,
    motion: Motion,
) -> Result<(), TestCaseError> {
    prop_assert!((0.0..=1.0).contains(&time));
    let split = match features {
        Features::VertexFace => 1,
        Features::EdgeEdge => 2,
    };
    let (first, second) = weights.split_at(split);
    prop_assert!(first.iter().all(|&w| w >= 0.0) && second.iter().all(|&w| w <= 1e-15));
    prop_assert!((first.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    prop_assert!((second.iter().sum::<f64>() + 1.0).abs() < 1e-12);
    let points = judge::at([sweep.start, sweep.end], time);
    let apart = (0..4).map(|k| points[k] * weights[k]).sum::<DVec3>().length();
    let way = sweep.closing_way_max(features);
    let allowed = match motion {
        Motion::Any => TOLERANCE,
        Motion::InPlane => TOLERANCE.max(way / ADVANCES_MAX as f64 + 0.5 * TOLERANCE),
    };
    prop_assert!(apart <= allowed + 1e-12, "{apart} m apart at {time}, allowed are {allowed}");
    Ok(())
}

#[test]
fn dense_sampling_finds_no_passage_missed_and_no_touch_made_up() {
    let mut random = Random::new(4);
    for features in BOTH {
        let (mut passages, mut made_up) = (0, 0);
        for _ in 0..4000 {
            let [start, end] = [(); 2].map(|()| [(); 4].map(|()| random.vector()));
            let verdict = check(&Sweep { start, end }, features, Motion::Any).unwrap();
            passages += usize::from(verdict.has_passage);
            made_up += usize::from(verdict.is_claimed && !verdict.has_passage);
        }
        // Features that brush past one another within the tolerance, a hundred thousandth of their
        // size, are one in ten thousand.
        assert!(passages > 250, "{features:?}: only {passages} pass");
        assert!(made_up <= 3, "{features:?}: {made_up} touch without a passage");
    }
}

#[test]
fn what_passes_by_just_beyond_the_tolerance_does_not_touch() {
    // Down past the side of a triangle, and past the end of an edge.
    let touches = |features: Features, aside: f64| {
        let points = |z: f64| match features {
            Features::VertexFace => [DVec3::new(0.4, -aside, z), DVec3::ZERO, DVec3::X, DVec3::Y],
            Features::EdgeEdge => {
                [DVec3::new(aside, 0.0, z), DVec3::new(1.0, 0.3, z), DVec3::ZERO, DVec3::NEG_X]
            }
        };
        let sweep = Sweep { start: points(0.7), end: points(-0.6) };
        sweep.first_touch(features, TOLERANCE).is_some()
    };
    for features in BOTH {
        assert!(touches(features, -1e-3), "{features:?}");
        assert!(!touches(features, 1.01 * TOLERANCE), "{features:?}");
    }
}

#[test]
fn features_that_slide_along_one_another_are_not_taken_for_touching() {
    let middle = [
        DVec3::ZERO,
        DVec3::new(0.2171799658053799, -0.7638478700484326, 0.7016594964414304),
        DVec3::new(0.695108564896864, -0.8133905861495676, 0.6600130983812184),
        DVec3::new(-0.9618640743024385, -0.9840763212932306, -0.8291830551526282),
    ];
    let way = [
        DVec3::new(0.8240957129885854, -0.2757074314008993, 0.368776386307329),
        DVec3::new(0.6730454119293786, -0.46636974997419944, 0.12455919856364353),
        DVec3::new(0.0, -0.11493026297503348, 0.9741684676082751),
        DVec3::new(-0.9591929277679244, -0.16297317864119026, -0.7791825716875683),
    ];
    for features in BOTH {
        let sweep = touching(features, middle, way.map(|w| w * 4.885513), 0.15730587328618423);
        assert!(check(&sweep, features, Motion::Any).unwrap().is_claimed);
    }
}

proptest! {
    #[test]
    fn answers_agree_with_dense_sampling(start in points(), end in points()) {
        for features in BOTH {
            check(&Sweep { start, end }, features, Motion::Any)?;
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
            check(&sweep, features, Motion::Any)?;
        }
    }

    #[test]
    fn motion_within_one_plane_is_no_exception(
        start in points(), end in points(), normal in vector(), shift in -1.0..1.0f64,
    ) {
        let n = normal.try_normalize().unwrap_or(DVec3::Z);
        let flat = |p: DVec3| p - n * (n.dot(p) - shift);
        for features in BOTH {
            let sweep = Sweep { start: start.map(flat), end: end.map(flat) };
            check(&sweep, features, Motion::InPlane)?;
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
    fn a_tolerance_finer_than_rounding_misses_nothing(
        a in [vector(), vector()], tilt in vector(), angle in -16.0..-3.0f64, way in vector(),
        time in 0.01..0.99f64, size in -3.0..4.0f64, tolerance in -20.0..-9.0f64,
    ) {
        // Two nearly parallel edges whose middles meet at `time`.
        let (size, tolerance) = (10f64.powf(size), 10f64.powf(size + tolerance));
        let middle = a[0].midpoint(a[1]);
        let second = a.map(|p| p + (p - middle).dot(a[1] - a[0]) * tilt * 10f64.powf(angle));
        let points = [a[0], a[1], second[0], second[1]].map(|p| p * size);
        let ways = [DVec3::ZERO, DVec3::ZERO, way, way].map(|w| w * size);
        let sweep = Sweep {
            start: [0, 1, 2, 3].map(|k| points[k] - ways[k] * time),
            end: [0, 1, 2, 3].map(|k| points[k] + ways[k] * (1.0 - time)),
        };
        let touch = sweep.first_touch(Features::EdgeEdge, tolerance);
        prop_assert!(touch.is_some_and(|t| t.time <= time + 1e-12), "{touch:?}, not {time}");
        let FirstTouch { time, weights } = touch.unwrap();
        let at = sweep.at(time);
        let apart = (0..4).map(|k| at[k] * weights[k]).sum::<DVec3>().length();
        prop_assert!(apart <= 1e-6 * size, "{apart} m apart");
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
