//! An independent judge of what touches and passes: dense samples of the motion and signs of
//! volumes, nothing of what it judges.
//!
//! What it says has happened has happened; grazing touches it does not see.

use glam::DVec3;

use super::continuous::Features;

/// Moments of the motion that are looked at.
const SAMPLES: u32 = 300;

/// As shares of the features: so far within both a touch must be to count.
const ROOM: f64 = 1e-6;

/// Four points at the start and at the end of a linear motion, see [`Features`].
pub type Ends = [[DVec3; 4]; 2];

/// Where points are at a share of the motion.
pub fn at([start, end]: Ends, time: f64) -> [DVec3; 4] {
    [0, 1, 2, 3].map(|k| start[k] * (1.0 - time) + end[k] * time)
}

/// A moment at which features pass through one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    pub time: f64,
    /// Whether the volume goes from negative to positive.
    pub is_upwards: bool,
}

/// When the features pass through one another: the volume of the four points changes its sign, and
/// at that moment one feature crosses the inside of the other.
pub fn passages(features: Features, ends: Ends) -> Vec<Passage> {
    let is_above = |time: f64| volume(at(ends, time)) > 0.0;
    let time = |sample: u32| f64::from(sample) / f64::from(SAMPLES);
    let mut found = Vec::new();
    let mut above_before = is_above(0.0);
    for sample in 1..=SAMPLES {
        let above = is_above(time(sample));
        if above != above_before {
            let (mut before, mut after) = (time(sample - 1), time(sample));
            for _ in 0..60 {
                let middle = 0.5 * (before + after);
                *if is_above(middle) == above { &mut after } else { &mut before } = middle;
            }
            if is_across(features, at(ends, after)) {
                found.push(Passage { time: after, is_upwards: above });
            }
        }
        above_before = above;
    }
    found
}

/// Whether the features have changed sides at the end, whatever they did on their way.
pub fn have_passed(features: Features, ends: Ends) -> bool {
    let ways = passages(features, ends).into_iter().map(|p| if p.is_upwards { 1 } else { -1 });
    ways.sum::<i32>() != 0
}

/// The first sample at which features that move within one plane overlap.
pub fn first_overlap(features: Features, ends: Ends) -> Option<f64> {
    let times = (0..=SAMPLES).map(|sample| f64::from(sample) / f64::from(SAMPLES));
    times.into_iter().find(|&time| is_across(features, at(ends, time)))
}

/// Six times the volume of the tetrahedron of four points.
fn volume([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).dot((c - a).cross(d - a))
}

/// Whether four points in one plane overlap: the point lies in the triangle, or the edges cross.
fn is_across(features: Features, [a, b, c, d]: [DVec3; 4]) -> bool {
    let shares = match features {
        Features::VertexFace => {
            let normal = (c - b).cross(d - b);
            let share =
                |p: DVec3, q: DVec3| normal.dot((p - a).cross(q - a)) / normal.length_squared();
            [share(b, c), share(c, d), share(d, b)]
        }
        Features::EdgeEdge => {
            let (first, second) = (b - a, d - c);
            let normal = first.cross(second);
            let share = |way: DVec3| (c - a).cross(way).dot(normal) / normal.length_squared();
            [share(first), share(second), 0.5]
        }
    };
    // False where there is no normal.
    shares.into_iter().all(|share| share > ROOM && share < 1.0 - ROOM)
}

#[test]
fn it_sees_a_point_go_through_a_triangle_and_back_and_not_beside_it() {
    let passed = |from: DVec3, to: DVec3| {
        let still = |p| [p, DVec3::ZERO, DVec3::X, DVec3::Y];
        passages(Features::VertexFace, [still(from), still(to)])
    };
    let (above, below) = (DVec3::new(0.2, 0.3, 1.0), DVec3::new(0.2, 0.3, -3.0));
    let [down] = passed(above, below)[..] else { panic!("it passes once") };
    let [up] = passed(below, above)[..] else { panic!("it passes once") };
    assert!((down.time - 0.25).abs() < 1e-12 && (up.time - 0.75).abs() < 1e-12);
    assert_ne!(down.is_upwards, up.is_upwards);
    let aside = DVec3::X * 0.6;
    assert_eq!(passed(above + aside, below + aside), []);
    assert_eq!(passed(above, above + DVec3::Z), []);
}

#[test]
fn it_sees_edges_cross_and_not_the_lines_beyond_their_ends() {
    let passed = |shift: DVec3| {
        let [a, b, c, d] = [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y];
        let ends = [DVec3::Z, DVec3::NEG_Z].map(|z| [a + z + shift, b + z + shift, c, d]);
        passages(Features::EdgeEdge, ends).len()
    };
    assert_eq!(passed(DVec3::ZERO), 1);
    assert_eq!(passed(DVec3::new(0.9, -0.9, 0.0)), 1);
    assert_eq!(passed(DVec3::X * 1.1), 0);
    assert_eq!(passed(DVec3::Y * 1.1), 0);
}
