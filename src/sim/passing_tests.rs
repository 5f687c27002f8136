//! Nothing passes: obstacles that move 20 contact thicknesses in a step against sheets.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use super::tests::{run, scene, square};
use super::*;
use crate::collision::Shape;
use crate::scene::{
    Deformation, Handle, Motion, MotionKey, Obstacle, PointKey, PoseVelocity, Surface,
};
use crate::validation::stage::{ball, block};

const STEP: f64 = 0.01;
/// Contact thickness is 5 mm.
const SPEED: f64 = 20.0 * 5e-3 / STEP;
const CELLS: u32 = 9;

/// A square sheet of 1 m around the origin, placed by a function of the material position.
fn sheet(place: impl Fn(DVec2) -> DVec3) -> Mesh {
    square(CELLS, |u| place(u - 0.5))
}

fn flat() -> Mesh {
    sheet(|u| u.extend(0.0))
}

fn key(time: f64, translation: DVec3, angle: f64, velocity: PoseVelocity) -> MotionKey {
    let rotation = DQuat::from_rotation_z(angle);
    MotionKey {
        time,
        pose: Pose { rotation, translation, ..Pose::IDENTITY },
        velocity: Some(velocity),
    }
}

/// One step a frame, no gravity, no remeshing; the obstacle on its motion.
fn against(mesh: Mesh, surface: Surface, keys: Vec<MotionKey>) -> Scene {
    let obstacle = Obstacle {
        name: "body".into(),
        surface: Arc::new(surface),
        deformation: None,
        placement: Pose::IDENTITY,
        motion: Some(0),
    };
    let mut scene = Scene {
        fps: 1.0 / STEP,
        steps_per_frame: 1,
        gravity: DVec3::ZERO,
        obstacles: vec![obstacle],
        motions: vec![Motion::from_keys(keys).unwrap()],
        ..scene(mesh)
    };
    scene.stages.remeshing = false;
    scene
}

/// Straight up through the sheet at z = 0, from 0.15 m below.
fn upwards(mesh: Mesh, surface: Surface) -> Scene {
    let velocity = PoseVelocity { translation: DVec3::Z * SPEED, ..PoseVelocity::default() };
    let at = |time: f64| {
        // A little aside, so that nothing is symmetric.
        key(time, DVec3::new(0.013, 0.021, SPEED * time - 0.15), 0.3, velocity)
    };
    against(mesh, surface, vec![at(0.0), at(1.0)])
}

fn pinned(mut scene: Scene) -> Scene {
    let rows = CELLS + 1;
    let nodes = vec![0, rows - 1, rows * (rows - 1), rows * rows - 1];
    scene.handles =
        vec![Handle { garment: 0, nodes, motion: None, start_time: 0.0, end_time: f64::INFINITY }];
    scene
}

/// The frames, each without a face that crosses the obstacle.
fn checked_run(scene: &Scene, frames: u32) -> Vec<Frame> {
    let all = run(scene.clone(), SizingMode::Uniform { edge_length: None }, frames);
    for frame in &all {
        let own = frame.obstacle_poses[0].inverse();
        let shape = Shape::new(&surface_at(scene, frame));
        let mesh = &frame.garments[0];
        for face in mesh.face_ids() {
            let corners = mesh.face_nodes(face).map(|n| own.transform_point(mesh.position[n]));
            assert!(corners.iter().all(|p| p.is_finite()));
            assert!(!shape.is_crossed_by(corners), "frame {}: a face is cut", frame.number);
        }
        assert_eq!(frame.report.trapped_nodes, 0, "frame {}", frame.number);
        assert!(frame.report.warnings.is_empty(), "{:?}", frame.report.warnings);
    }
    all
}

/// The obstacle in its own space at a frame.
fn surface_at(scene: &Scene, frame: &Frame) -> Surface {
    let surface = &scene.obstacles[0].surface;
    let positions = frame.points_of_obstacle(0, surface).to_vec();
    Surface { positions, triangles: surface.triangles.clone() }
}

/// How many faces a ray along z meets.
fn faces_along(mesh: &Mesh, from: DVec3, direction: DVec3) -> usize {
    let is_met = |face: FaceId| {
        let [a, b, c] = mesh.face_nodes(face).map(|n| mesh.position[n] - from);
        let side = |p: DVec3, q: DVec3| direction.dot(p.cross(q));
        let sides = [side(a, b), side(b, c), side(c, a)];
        let is_around = sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0);
        let sum: f64 = sides.iter().sum();
        let hit = (a * sides[1] + b * sides[2] + c * sides[0]) / sum;
        is_around && hit.dot(direction) > 0.0
    };
    mesh.face_ids().filter(|&f| is_met(f)).count()
}

fn assert_nothing_passes(scene: &Scene) -> Vec<Frame> {
    let frames = checked_run(scene, 8);
    for frame in &frames {
        let points = surface_at(scene, frame).positions;
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let centre = frame.obstacle_poses[0].transform_point(middle);
        let (above, below) = (
            faces_along(&frame.garments[0], centre, DVec3::Z),
            faces_along(&frame.garments[0], centre, DVec3::NEG_Z),
        );
        assert!(above % 2 == 1 && below % 2 == 0, "frame {}: {above} {below}", frame.number);
    }
    frames
}

fn mean_velocity(frame: &Frame) -> DVec3 {
    let mesh = &frame.garments[0];
    let areas = mesh.node_areas();
    let momentum: DVec3 = areas.enumerate().map(|(n, a)| mesh.velocity[n] * *a).sum();
    momentum / mesh.total_material_area()
}

/// The sheet goes where the body went that met it, and not much faster than the body's fastest point
/// (m/s): the contact layer pushes it out by a thickness within a step.
fn assert_carried_at(fastest: f64, frames: &[Frame]) {
    let velocity = mean_velocity(frames.last().unwrap());
    assert!(velocity.z > 0.1 * fastest && velocity.z < 1.2 * fastest, "{velocity}");
    assert!(velocity.truncate().length() < 0.2 * fastest, "{velocity}");
}

fn assert_carried(frames: &[Frame]) {
    assert_carried_at(SPEED, frames);
}

#[test]
fn a_thin_plate_does_not_pass_through_a_sheet() {
    let plate = || block(DVec3::new(0.3, 0.2, 1e-4));
    assert_carried(&assert_nothing_passes(&upwards(flat(), plate())));
    assert_nothing_passes(&pinned(upwards(flat(), plate())));
}

#[test]
fn a_rod_as_thin_as_a_needle_does_not_pass_through_a_sheet() {
    let rod = || block(DVec3::new(0.9, 5e-4, 5e-4));
    assert_carried(&assert_nothing_passes(&upwards(flat(), rod())));
    assert_nothing_passes(&pinned(upwards(flat(), rod())));
}

#[test]
fn a_needle_does_not_pierce_a_sheet() {
    let needle = || block(DVec3::new(5e-4, 5e-4, 0.1));
    assert_nothing_passes(&upwards(flat(), needle()));
    assert_nothing_passes(&pinned(upwards(flat(), needle())));
}

#[test]
fn a_ball_does_not_pass_through_a_sheet() {
    assert_carried(&assert_nothing_passes(&upwards(flat(), ball(0.12))));
    assert_nothing_passes(&pinned(upwards(flat(), ball(0.12))));
}

#[test]
fn a_box_does_not_pass_through_a_sheet() {
    let cube = || block(DVec3::splat(0.1));
    assert_carried(&assert_nothing_passes(&upwards(flat(), cube())));
    assert_nothing_passes(&pinned(upwards(flat(), cube())));
}

#[test]
fn a_sheet_that_falls_edge_on_onto_a_ridge_is_not_cut() {
    // A prism along y with its ridge at z = 0; the sheet stands above it in the plane of x and z.
    let prism = Surface {
        positions: [(-0.2, -0.3), (0.2, -0.3), (0.0, 0.0)]
            .into_iter()
            .flat_map(|(x, z)| [DVec3::new(x, -0.5, z), DVec3::new(x, 0.5, z)])
            .collect(),
        triangles: vec![
            [0, 2, 4],
            [1, 5, 3],
            [0, 1, 3],
            [0, 3, 2],
            [2, 3, 5],
            [2, 5, 4],
            [4, 5, 1],
            [4, 1, 0],
        ],
    };
    assert_eq!(prism.open_edge_count(), 0);
    let mut mesh = sheet(|u| DVec3::new(u.x + 0.02, 0.01 * u.x, u.y + 0.55));
    mesh.velocity.iter_mut().for_each(|v| *v = DVec3::NEG_Z * SPEED);
    let still = vec![key(0.0, DVec3::ZERO, 0.0, PoseVelocity::default())];
    checked_run(&against(mesh, prism, still), 12);
}

#[test]
fn a_spinning_blade_does_not_cut_a_sheet() {
    // Six degrees a step: 6 cm at the tip. The sheet stands beside it.
    let spin = FRAC_PI_2 / 15.0 / STEP;
    let velocity = PoseVelocity { angular: DVec3::Z * spin, ..PoseVelocity::default() };
    let keys = (0..40).map(|k| {
        let time = f64::from(k) * STEP;
        key(time, DVec3::ZERO, spin * time, velocity)
    });
    let mesh = sheet(|u| DVec3::new(u.x, 0.2 + 0.1 * u.x, u.y));
    let blade = block(DVec3::new(0.6, 1e-3, 0.2));
    checked_run(&against(mesh, blade, keys.collect()), 25);
}

/// A ball below the sheet which becomes a long egg high above it, all by its own points: they move
/// by 20 thicknesses in a step and more.
/// How much taller the deforming ball becomes (1/s).
const GROWTH: f64 = 5.0;

fn deforming() -> Scene {
    let still = vec![key(0.0, DVec3::ZERO, 0.0, PoseVelocity::default())];
    let mut scene = against(flat(), ball(0.1), still);
    let at = |time: f64| {
        let stretch = DVec3::new(1.0 + 15.0 * time, 1.0, 1.0 + GROWTH * time);
        let shift = DVec3::new(0.013, 0.021, SPEED * time - 0.15);
        let positions = ball(0.1).positions.iter().map(|&p| p * stretch + shift).collect();
        PointKey { time, positions }
    };
    let deformation = Deformation::from_keys(vec![at(0.0), at(0.035), at(0.1)]).unwrap();
    scene.obstacles[0].surface = Arc::new(Surface { positions: at(0.0).positions, ..ball(0.1) });
    scene.obstacles[0].deformation = Some(Arc::new(deformation));
    scene
}

#[test]
fn a_body_that_deforms_fast_does_not_pass_through_a_sheet() {
    let fastest = SPEED + 0.1 * GROWTH;
    assert_carried_at(fastest, &assert_nothing_passes(&deforming()));
    assert_nothing_passes(&pinned(deforming()));
}

#[test]
fn stopping_gives_the_same_bits_on_any_number_of_threads() {
    for scene in [pinned(upwards(flat(), ball(0.12))), deforming()] {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(scene.clone(), SizingMode::Uniform { edge_length: None }, 5))
        };
        let [one, two, seven] = [1, 2, 7].map(on);
        for ((a, b), c) in one.iter().zip(&two).zip(&seven) {
            assert_eq!(a.garments, b.garments);
            assert_eq!(a.garments, c.garments);
        }
    }
}
