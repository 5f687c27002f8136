//! Obstacles that bulge, bend and grow through pieces of cloth, which nothing but carrying helps.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::collision::continuous::Features;
use crate::collision::face_tree::FaceTree;
use crate::collision::judge::have_passed;
use crate::collision::motion::ObstacleMotion;
use crate::collision::near::NearMemory;
use crate::collision::resolve::MovedCloth;
use crate::collision::shape::Shape;
use crate::collision::stop::{Stops, Surroundings, stop_in_rounds};
use crate::math::Random;
use crate::scene::{Contact, Pose, Surface};

const SETTINGS: Contact =
    Contact { thickness: 5e-3, stiffness: 1e6, friction_cloth: 0.6, friction_obstacle: 0.3 };

/// (s).
const STEP: f64 = 0.01;

/// A ball of 10 cm with 128 triangles.
fn ball() -> Surface {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let [a, b, c] = axes;
    let mut triangles = vec![[a, b, c], [b, -a, c], [-a, -b, c], [-b, a, c]];
    let mirrored: Vec<_> = triangles
        .iter()
        .map(|&[p, q, r]| [q, p, r].map(|v: DVec3| v * DVec3::new(1.0, 1.0, -1.0)))
        .collect();
    triangles.extend(mirrored);
    for _ in 0..2 {
        let split = |[p, q, r]: [DVec3; 3]| {
            let [u, v, w] = [p.midpoint(q), q.midpoint(r), r.midpoint(p)].map(DVec3::normalize);
            [[p, u, w], [u, q, v], [w, v, r], [u, v, w]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let positions = triangles.iter().flatten().map(|p| *p * 0.1).collect();
    let numbers = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
    Surface { positions, triangles: numbers.collect() }.welded()
}

/// How wildly an obstacle moves.
#[derive(Clone, Copy)]
struct Wildness {
    /// Turns of up to 23 degrees about each axis, shifts of up to 8 cm along each.
    rigid: f64,
    /// By up to 30 % along each axis.
    stretch: f64,
    /// Waves of up to 12 mm along each axis.
    bulges: f64,
    /// Of every point by itself, up to 4 mm along each axis.
    noise: f64,
}

/// The ball, a little dented, on its way to somewhere else in another form.
fn obstacle(random: &mut Random, wildness: Wildness) -> ObstacleMotion {
    let surface = ball();
    let dented = |p: &DVec3| *p * (1.0 + 0.1 * random.number());
    let positions: Vec<DVec3> = surface.positions.iter().map(dented).collect();
    let start = Shape::new(&Surface { positions, ..surface });
    let turn = DQuat::from_scaled_axis(random.vector() * 0.4 * wildness.rigid);
    let shift = random.vector() * 0.08 * wildness.rigid;
    let stretch = DVec3::ONE + random.vector() * 0.3 * wildness.stretch;
    let waves: Vec<[DVec3; 2]> = (0..3)
        .map(|_| [random.vector() * 40.0, random.vector() * 0.012 * wildness.bulges])
        .collect();
    let mut end = |p: &DVec3| {
        let bulge = waves.iter().map(|[k, way]| *way * (k.dot(*p) + k.x).sin()).sum::<DVec3>();
        turn * (*p * stretch) + bulge + shift + random.vector() * 0.004 * wildness.noise
    };
    let positions = start.positions().iter().map(&mut end).collect();
    let end = start.moved(positions);
    let shapes = [Arc::new(start), Arc::new(end)];
    ObstacleMotion::deforming(shapes, [Pose::IDENTITY; 2], STEP)
}

/// A piece of cloth and where it would be at the end of the step without obstacles.
struct Patch {
    faces: Vec<[u32; 3]>,
    start: Vec<DVec3>,
    end: Vec<DVec3>,
}

/// One face, or two times `cells` squared, beside the obstacle and not through it.
fn patch(random: &mut Random, shape: &Shape, cells: u32) -> Patch {
    let rows = cells + 1;
    let mut faces = vec![[0, 1, rows]];
    if cells > 1 {
        let cell = |c: u32| {
            let a = c / cells * rows + c % cells;
            [[a, a + 1, a + 1 + rows], [a, a + 1 + rows, a + rows]]
        };
        faces = (0..cells * cells).flat_map(cell).collect();
    }
    loop {
        let away = random.vector().normalize();
        let turn = DQuat::from_rotation_arc(DVec3::Z, away)
            * DQuat::from_scaled_axis(random.vector() * 0.5);
        let (size, height) = (0.15 + 0.13 * random.number(), 0.11 + 0.015 * random.number());
        let place = |n: u32| {
            let (u, v) = (f64::from(n % rows), f64::from(n / rows));
            let flat = DVec3::new(u, v, 0.0) / f64::from(cells) - DVec3::new(0.5, 0.5, 0.0);
            away * height + turn * (flat * size)
        };
        let start: Vec<DVec3> = (0..rows * rows).map(place).collect();
        let corners = |f: &[u32; 3]| f.map(|n| start[n as usize]);
        let is_outside = |p: &DVec3| shape.nearest(*p, 1.0).unwrap().signed_distance > 5e-4;
        if start.iter().all(is_outside) && !faces.iter().any(|f| shape.is_crossed_by(corners(f))) {
            let way = random.vector() * 0.01;
            let end = start.iter().map(|p| *p + way + random.vector() * 0.003).collect();
            return Patch { faces, start, end };
        }
    }
}

/// Whether a piece of cloth that goes from `start` to `end` is cut by the obstacle.
fn is_cut(faces: &[[u32; 3]], start: &[DVec3], end: &[DVec3], obstacle: &ObstacleMotion) -> bool {
    let path = |n: u32| [start[n as usize], end[n as usize]];
    let [from, to] = [obstacle.shape_at_start(), obstacle.shape_at_end()].map(Shape::positions);
    let way = |c: u32| [from[c as usize], to[c as usize]];
    let passed = |features: Features, paths: [[DVec3; 2]; 4], split: usize| {
        let reach = |part: &[[DVec3; 2]]| {
            let all = || part.iter().flatten().copied();
            (all().reduce(DVec3::min).unwrap(), all().reduce(DVec3::max).unwrap())
        };
        let (a, b) = (reach(&paths[..split]), reach(&paths[split..]));
        a.0.cmple(b.1).all()
            && b.0.cmple(a.1).all()
            && have_passed(features, [0, 1].map(|k| paths.map(|p| p[k])))
    };
    let triangles = obstacle.shape_at_start().topology().triangles();
    let edges_of = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    faces.iter().any(|&face| {
        triangles.iter().any(|&triangle| {
            let ([i, j, k], [a, b, c]) = (face.map(path), triangle.map(way));
            face.iter().any(|&n| passed(Features::VertexFace, [path(n), a, b, c], 1))
                || triangle.iter().any(|&v| passed(Features::VertexFace, [way(v), i, j, k], 1))
                || edges_of(face).into_iter().any(|e| {
                    edges_of(triangle).into_iter().any(|f| {
                        let ([p, q], [r, s]) = (e.map(path), f.map(way));
                        passed(Features::EdgeEdge, [p, q, r, s], 2)
                    })
                })
        })
    })
}

/// Stops the piece in rounds of impacts and of carrying; where its nodes end.
fn stopped(patch: &Patch, obstacle: &ObstacleMotion, rounds: [usize; 2]) -> (Vec<DVec3>, Stops) {
    let tree = FaceTree::new(&patch.start, &patch.faces);
    let nodes = patch.start.len();
    let mut position = patch.end.clone();
    let mut velocity: Vec<DVec3> =
        position.iter().zip(&patch.start).map(|(b, a)| (*b - *a) / STEP).collect();
    let mut cloth = MovedCloth {
        position: &mut position,
        velocity: &mut velocity,
        position_at_start: &patch.start,
        area: &vec![1e-4; nodes],
        thickness: &vec![SETTINGS.thickness; nodes],
        mass: &vec![1e-5; nodes],
        faces: &patch.faces,
    };
    let memory = NearMemory::new(nodes, 1);
    let obstacles = std::slice::from_ref(obstacle);
    let around = Surroundings { tree: &tree, obstacles, memory: &memory, settings: &SETTINGS };
    let stops = stop_in_rounds(&mut cloth, &around, None, rounds);
    assert!(position.iter().chain(&velocity).all(|v| v.is_finite()));
    (position, stops)
}

/// What became of random pieces of cloth and obstacles.
#[derive(Default)]
struct Counts {
    /// Would be cut if nothing stopped them.
    endangered: usize,
    cut: usize,
    /// Cut, and not said to be.
    kept_quiet: usize,
}

fn counts(seed: u64, wildness: Wildness, rounds: [usize; 2]) -> Counts {
    let mut random = Random::new(seed);
    let mut counts = Counts::default();
    for number in 0..60 {
        let obstacle = obstacle(&mut random, wildness);
        let patch = patch(&mut random, obstacle.shape_at_start(), 1 + number % 5);
        let (end, stops) = stopped(&patch, &obstacle, rounds);
        let is_cut = |end: &[DVec3]| is_cut(&patch.faces, &patch.start, end, &obstacle);
        counts.endangered += usize::from(is_cut(&patch.end));
        let is_cut = is_cut(&end);
        counts.cut += usize::from(is_cut);
        counts.kept_quiet += usize::from(is_cut && stops.unresolved == 0);
    }
    counts
}

/// Nothing is cut, whether carrying comes last or is all there is.
#[track_caller]
fn assert_uncut(wildness: Wildness) {
    for rounds in [[0, 24], [8, 24]] {
        let Counts { endangered, cut, .. } = counts(1, wildness, rounds);
        assert!(endangered > 15, "only {endangered} are in danger");
        assert_eq!(cut, 0, "of {endangered} in danger, in rounds {rounds:?}");
    }
}

#[test]
fn a_body_that_moves_and_grows_carries_cloth_in_front_of_it() {
    assert_uncut(Wildness { rigid: 1.0, stretch: 1.0, bulges: 0.0, noise: 0.0 });
}

#[test]
fn a_body_that_bulges_carries_cloth_in_front_of_it() {
    assert_uncut(Wildness { rigid: 1.0, stretch: 1.0, bulges: 1.0, noise: 1.0 });
}

#[test]
fn a_body_whose_points_each_go_their_way_carries_cloth_in_front_of_it() {
    assert_uncut(Wildness { rigid: 0.3, stretch: 0.3, bulges: 1.0, noise: 4.0 });
}

#[test]
fn a_body_that_turns_by_sixty_degrees_carries_cloth_in_front_of_it() {
    assert_uncut(Wildness { rigid: 3.0, stretch: 2.0, bulges: 1.0, noise: 1.0 });
}

#[test]
fn what_a_body_cuts_that_folds_into_itself_is_reported() {
    let folding = Wildness { rigid: 2.0, stretch: 2.0, bulges: 3.0, noise: 2.0 };
    for rounds in [[0, 1], [1, 0], [8, 24]] {
        let Counts { cut, kept_quiet, .. } = counts(1, folding, rounds);
        assert!(cut > 0, "there is nothing to report");
        assert_eq!(kept_quiet, 0, "of {cut} that are cut in rounds {rounds:?}");
    }
}
