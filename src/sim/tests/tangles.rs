//! Garments that start inside one another or inside obstacles, and ones that come to be tangled.

use super::frame_to_frame::bits;
use super::*;
use crate::collision::crossings;
use crate::math::{segment_passes_through, triangles_cross};
use crate::validation::stage::ball;

/// Cells along a side of a sheet.
const CELLS: u32 = 14;

/// A square sheet of 1 m, placed in the world.
fn placed(place: impl Fn(DVec2) -> DVec3) -> Mesh {
    square(CELLS, place)
}

/// Sheets in mid-air, without gravity.
fn floating(sheets: Vec<Mesh>) -> Scene {
    let mut shot = scene(sheet());
    shot.gravity = DVec3::ZERO;
    let garment = shot.garments.remove(0);
    shot.garments = sheets.into_iter().map(|mesh| Garment { mesh, ..garment.clone() }).collect();
    shot.stages.remeshing = false;
    shot
}

/// Nodes of no two sheets are over one another.
fn level(u: DVec2, z: f64) -> DVec3 {
    DVec3::new(u.x, u.y, z)
}

fn bump(height: f64) -> impl Fn(DVec2) -> DVec3 {
    move |u| {
        let r = u.distance(DVec2::splat(0.5)) / 0.25;
        (u + DVec2::new(0.013, 0.007)).extend(height * (-r * r).exp() - 0.01 * height.signum())
    }
}

fn corner(u: DVec2) -> DVec3 {
    let beyond = (0.35 - u.x - u.y).max(0.0) / 0.35;
    (u + DVec2::new(0.013, 0.007)).extend(0.01 - 0.08 * beyond)
}

fn crossing_count(frame: &Frame) -> usize {
    let garments: Vec<Mesh> = frame.garments.iter().map(|g| (**g).clone()).collect();
    let positions = StepState::gathered(&garments.iter().collect::<Vec<_>>()).position;
    crossings(&FaceTree::new(&positions, &global_faces(&garments)), &positions).len()
}

/// Of all pairs of faces, those of which an edge of one passes through the other.
fn pair_count(frame: &Frame) -> usize {
    let garments: Vec<Mesh> = frame.garments.iter().map(|g| (**g).clone()).collect();
    let positions = StepState::gathered(&garments.iter().collect::<Vec<_>>()).position;
    let faces = global_faces(&garments);
    let passes = |edges_of: [u32; 3], face: [u32; 3]| {
        (0..3).any(|k| {
            let ends = [edges_of[k], edges_of[(k + 1) % 3]];
            let at = |n: u32| positions[n as usize];
            !ends.iter().any(|n| face.contains(n))
                && segment_passes_through(ends.map(at), face.map(at))
        })
    };
    let later = |(k, a): (usize, &[u32; 3])| {
        faces[k + 1..].iter().filter(|b| passes(*a, **b) || passes(**b, *a)).count()
    };
    faces.iter().enumerate().map(later).sum()
}

#[test]
fn garments_that_start_through_one_another_are_apart_at_frame_0_and_stay_so() {
    let flat = || placed(|u| level(u, 0.0));
    let shots = [
        vec![flat(), placed(corner)],
        vec![flat(), placed(bump(0.05))],
        vec![flat(), placed(bump(0.05)), placed(bump(-0.06))],
    ];
    for sheets in shots {
        let count = sheets.len();
        let frames = run(floating(sheets), SizingMode::Adaptive, 4);
        for frame in &frames {
            assert_eq!(frame.report.intersections, Some(0), "{count} sheets, {}", frame.number);
            assert_eq!(crossing_count(frame), 0);
        }
    }
}

/// A frame of two sheets that came to pass through one another, and its scene.
fn tangled_in_between(height: f64) -> (Arc<Scene>, Frame) {
    let shot = floating(vec![placed(|u| level(u, 0.0)), placed(|u| level(u, -0.02))]);
    let mut frame = run(shot.clone(), SizingMode::Adaptive, 0).remove(0);
    let mut upper = (*frame.garments[1]).clone();
    let bump = bump(height);
    for (x, at) in upper.position.iter_mut().zip(&frame.garments[1].position) {
        *x = bump(at.truncate());
    }
    frame.garments[1] = Arc::new(upper);
    frame.report.intersections = Some(crossing_count(&frame));
    assert!(crossing_count(&frame) > 20);
    (Arc::new(shot), frame)
}

fn goes_on(shot: &Arc<Scene>, frame: &Frame, count: u32) -> Vec<Frame> {
    let settings = SimSettings { sizing: SizingMode::Adaptive };
    let mut simulation = Simulation::from_frame(shot.clone(), settings, frame).unwrap();
    (0..count).map(|_| simulation.advance().unwrap()).collect()
}

#[test]
fn a_tangle_in_a_shot_pulls_apart_over_some_frames_and_what_is_left_is_said() {
    let (shot, frame) = tangled_in_between(0.08);
    let frames = goes_on(&shot, &frame, 12);
    let left: Vec<usize> = frames.iter().map(crossing_count).collect();
    for (frame, &left) in frames.iter().zip(&left) {
        assert_eq!(frame.report.intersections, Some(pair_count(frame)));
        let is_said = frame.report.warnings.iter().any(|w| w.contains("crossings are left"));
        assert_eq!(is_said, left > 0, "{:?}", frame.report.warnings);
    }
    assert!(left[0] > 0 && left[0] < crossing_count(&frame), "{left:?}: it takes some frames");
    assert_eq!(*left.last().unwrap(), 0, "{left:?}");
}

#[test]
fn taking_apart_kicks_nothing() {
    let (shot, frame) = tangled_in_between(0.05);
    let frames = goes_on(&shot, &frame, 10);
    let stored = frames.iter().map(|f| f.report.elastic_energy).fold(0.0, f64::max);
    let fastest = frames.iter().flat_map(|f| f.garments.iter()).flat_map(|g| g.velocity.iter());
    let fastest = fastest.map(|v| v.length()).fold(0.0, f64::max);
    // What speed the strain of the bump itself could give, and no more.
    assert!(fastest < 3.0, "{fastest} m/s");
    let last = frames.last().unwrap();
    assert!(last.report.kinetic_energy < stored, "{}", last.report.kinetic_energy);
}

#[test]
fn tangles_follow_from_each_frame_and_have_the_same_bits_for_any_number_of_threads() {
    let (shot, frame) = tangled_in_between(0.08);
    let straight = goes_on(&shot, &frame, 4);
    assert!(crossing_count(&straight[0]) > 0);
    for pair in straight.windows(2) {
        let next = goes_on(&shot, &pair[0], 1).remove(0);
        assert!(bits(&next) == bits(&pair[1]), "frame {} is another one", pair[1].number);
    }
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let again = pool.install(|| goes_on(&shot, &frame, 2));
        assert!(again.iter().zip(&straight).all(|(a, b)| bits(a) == bits(b)), "{threads} threads");
    }
}

/// A sheet at a height above the middle of a ball (m).
fn around_a_ball(radius: f64, height: f64) -> Scene {
    let mut shot = floating(vec![placed(|u| level(u - 0.5, height))]);
    shot.obstacles = vec![Obstacle {
        name: "ball".into(),
        surface: Arc::new(ball(radius)),
        deformation: None,
        placement: Pose::IDENTITY,
        motion: None,
    }];
    shot
}

#[test]
fn a_garment_that_starts_inside_a_body_is_outside_at_frame_0() {
    // Partly, and all of it.
    for (radius, height) in [(0.2, 0.1), (0.2, 0.0), (0.8, 0.2)] {
        let frames = run(around_a_ball(radius, height), SizingMode::Adaptive, 3);
        for frame in &frames {
            let report = &frame.report;
            assert_eq!(report.trapped_nodes, 0, "{radius} {height}: {}", frame.number);
            let cut = report.warnings.iter().any(|w| w.contains("cut obstacles"));
            assert!(!cut, "{radius} {height}, {}: {:?}", frame.number, report.warnings);
            assert!(report.largest_stretch.is_finite());
        }
    }
}

/// Of all faces and triangles of the first obstacle, the pairs that cross; and of all nodes those
/// within a radius (m) of the origin.
fn pairs_and_nodes_within(shot: &Scene, frame: &Frame, radius: f64) -> (usize, usize) {
    let (mesh, surface) = (&frame.garments[0], &shot.obstacles[0].surface);
    let solid = surface.triangles.iter().map(|t| t.map(|v| surface.positions[v as usize]));
    let solid: Vec<[DVec3; 3]> = solid.collect();
    let crossed =
        |face| solid.iter().filter(move |t| triangles_cross(mesh.face_positions(face), **t));
    let pairs = mesh.face_ids().map(|face| crossed(face).count()).sum();
    (pairs, mesh.position.iter().filter(|x| x.length() < radius).count())
}

#[test]
fn what_passes_through_obstacles_is_counted_whatever_is_done_about_it() {
    let without = |change: fn(&mut StageSwitches)| {
        let mut shot = around_a_ball(0.3, 0.1);
        change(&mut shot.stages);
        shot.stages.dynamics = false;
        let frame = run(shot.clone(), SizingMode::Adaptive, 1).remove(1);
        let (pairs, nodes) = pairs_and_nodes_within(&shot, &frame, 0.28);
        let report = frame.report;
        assert_eq!(report.intersections, shot.stages.self_contact.then_some(pairs));
        assert!(report.trapped_nodes >= nodes, "{} of {nodes}", report.trapped_nodes);
        (pairs, report)
    };
    let (pairs, report) = without(|stages| stages.collision = false);
    assert!(pairs > 20 && report.trapped_nodes > 20, "{pairs} {}", report.trapped_nodes);
    let (pairs, report) = without(|stages| {
        stages.collision = false;
        stages.self_contact = false;
    });
    assert!(pairs > 20 && report.trapped_nodes > 20, "{pairs} {}", report.trapped_nodes);
    assert_eq!(without(|_| ()).0, 0);
}

#[test]
fn faces_across_an_obstacle_are_counted_and_named_where_nothing_lifts_them_off() {
    // Coarse, so that faces are cut and no node is inside.
    let height = 0.04;
    let mut shot = around_a_ball(0.1, height);
    shot.garments[0].mesh = square(3, |u| level(u - 0.5, height));
    shot.stages.dynamics = false;
    shot.stages.untangling = false;
    let frame = run(shot.clone(), SizingMode::Adaptive, 1).remove(1);
    let (pairs, _) = pairs_and_nodes_within(&shot, &frame, 0.1);
    assert!(pairs > 0);
    assert_eq!((frame.report.intersections, frame.report.trapped_nodes), (Some(pairs), 0));
    let warnings = &frame.report.warnings;
    assert!(warnings.iter().any(|w| w.contains("faces of cloth cut obstacles")), "{warnings:?}");
    shot.stages.untangling = true;
    let frame = run(shot.clone(), SizingMode::Adaptive, 1).remove(1);
    assert_eq!(pairs_and_nodes_within(&shot, &frame, 0.1).0, 0);
    assert_eq!(frame.report.intersections, Some(0), "{:?}", frame.report.warnings);
}
