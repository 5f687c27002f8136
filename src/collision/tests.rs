use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::*;
use crate::math::Random;
use crate::remesh::{Change, EditGuard};
use crate::scene::{Contact, Pose, Surface};

/// The cube from -1 to 1.
pub(super) fn cube() -> Surface {
    let corner = |i: u32| {
        let axis = |bit: u32| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
        DVec3::new(axis(0), axis(1), axis(2))
    };
    let quads: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Surface {
        positions: (0..8).map(corner).collect(),
        triangles: quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect(),
    }
}

fn at(translation: DVec3) -> Pose {
    Pose { translation, ..Pose::IDENTITY }
}

fn moving(start: Pose, end: Pose) -> Vec<ObstacleMotion> {
    vec![ObstacleMotion::new(Arc::new(Shape::new(&cube())), start, end, 0.005)]
}

fn still() -> Vec<ObstacleMotion> {
    moving(Pose::IDENTITY, Pose::IDENTITY)
}

const SETTINGS: Contact =
    Contact { thickness: 0.01, stiffness: 1e6, friction_cloth: 0.6, friction_obstacle: 0.3 };

#[test]
fn signed_distance_of_a_cube_is_exact_inside_and_out() {
    let shape = Shape::new(&cube());
    let exact = |p: DVec3| {
        let q = p.abs() - 1.0;
        q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
    };
    for i in 0..1000u32 {
        let h = |k: u32| f64::from((i * 7919 + 31) * k % 1009) / 336.0 - 1.5;
        let p = DVec3::new(h(1), h(7), h(13));
        let nearest = shape.nearest(p, 10.0).unwrap();
        assert!((nearest.signed_distance - exact(p)).abs() < 1e-12, "{p}");
        assert!((nearest.normal.length() - 1.0).abs() < 1e-12);
        let rebuilt = nearest.point + nearest.normal * nearest.signed_distance;
        assert!(rebuilt.distance(p) < 1e-12);
    }
}

#[test]
fn nothing_is_found_beyond_the_radius() {
    let shape = Shape::new(&cube());
    assert!(shape.nearest(DVec3::X * 1.5, 0.49).is_none());
    assert!(shape.nearest(DVec3::X * 1.5, 0.51).is_some());
}

#[test]
fn the_velocity_of_a_turning_obstacle_is_that_of_its_points() {
    let turn = Pose { rotation: DQuat::from_rotation_z(1e-6), ..Pose::IDENTITY };
    let obstacle = &moving(Pose::IDENTITY, turn)[0];
    let expected = DVec3::Z.cross(DVec3::X * 2.0) * 1e-6 / 0.005;
    assert!((obstacle.velocity_at(DVec3::X * 2.0) - expected).length() < 1e-9);
}

/// One big face above the cube's top, its middle sagging to a height.
fn sheet(height: f64) -> Vec<DVec3> {
    [(-4.0, -3.0), (4.0, -3.0), (0.0, 5.0)].map(|(x, y)| DVec3::new(x, y, height)).to_vec()
}

fn contacts_of(
    positions: &[DVec3],
    velocity: DVec3,
    obstacles: &[ObstacleMotion],
) -> Vec<crate::dynamics::ContactPoint> {
    contacts_at(SETTINGS.thickness, positions, velocity, obstacles)
}

/// Those of a fabric with a thickness of its own (m).
fn contacts_at(
    thickness: f64,
    positions: &[DVec3],
    velocity: DVec3,
    obstacles: &[ObstacleMotion],
) -> Vec<crate::dynamics::ContactPoint> {
    let faces = vec![[0, 1, 2]];
    let velocities = vec![velocity; positions.len()];
    let area = vec![1.0; positions.len()];
    let tree = FaceTree::new(positions, &faces);
    let thickness = vec![thickness; positions.len()];
    let cloth = Cloth {
        position: positions,
        velocity: &velocities,
        area: &area,
        thickness: &thickness,
        faces: &faces,
    };
    let mut memory = NearMemory::new(positions.len(), obstacles.len());
    contacts(cloth, &tree, obstacles, &mut memory, &SETTINGS)
}

/// Resolves one face; returns the impacts.
fn resolved(
    position_at_start: &[DVec3],
    position: &mut [DVec3],
    velocity: &mut [DVec3],
    obstacles: &[ObstacleMotion],
    settings: &Contact,
    depth: Depth,
) -> usize {
    let faces = [[0, 1, 2]];
    let mut tree = FaceTree::new(position_at_start, &faces);
    let area = [1.0; 3];
    let mut memory = NearMemory::new(3, obstacles.len());
    let mut cloth = MovedCloth {
        position,
        velocity,
        position_at_start,
        area: &area,
        thickness: &[settings.thickness; 3],
        mass: &area,
        faces: &faces,
    };
    resolve(&mut cloth, &mut tree, obstacles, &mut memory, settings, depth, None).impacts
}

#[test]
fn corners_of_an_obstacle_hold_a_face_that_has_no_node_near() {
    let positions = sheet(1.005);
    let found = contacts_of(&positions, DVec3::ZERO, &still());
    assert_eq!(found.len(), 4, "the four upper corners of the cube");
    for contact in &found {
        assert!((contact.gap + 0.005).abs() < 1e-12);
        assert!((contact.normal - DVec3::Z).length() < 1e-12);
        let weights: f64 = contact.nodes.iter().map(|(_, w)| w).sum();
        assert!((weights - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_thin_fabric_may_come_nearer_to_an_obstacle() {
    let positions = sheet(1.005);
    assert_eq!(contacts_at(0.004, &positions, DVec3::ZERO, &still()), []);
    let found = contacts_at(0.006, &positions, DVec3::ZERO, &still());
    assert!(found.len() == 4 && found.iter().all(|c| (c.gap + 0.001).abs() < 1e-12));
}

#[test]
fn a_face_that_sank_below_the_corners_is_lifted_out() {
    let start = sheet(1.02);
    let mut position = sheet(0.996);
    let mut velocity = vec![DVec3::NEG_Z * 4.8; 3];
    assert!(
        resolved(&start, &mut position, &mut velocity, &still(), &SETTINGS, Depth::OfTheStep) > 0
    );
    let found = contacts_of(&position, DVec3::ZERO, &still());
    assert!(found.iter().all(|c| c.gap > -SETTINGS.thickness));
}

#[test]
fn a_contact_is_foreseen_when_it_would_be_broken_within_the_step() {
    let positions =
        [DVec3::new(0.0, 0.0, 1.02), DVec3::new(0.1, 0.0, 1.5), DVec3::new(0.0, 0.1, 1.5)];
    assert!(contacts_of(&positions, DVec3::ZERO, &still()).is_empty());
    assert!(contacts_of(&positions, DVec3::Z * 9.0, &still()).is_empty());
    assert_eq!(contacts_of(&positions, DVec3::NEG_Z * 3.0, &still()).len(), 1);
    let rising = moving(Pose::IDENTITY, at(DVec3::Z * 0.015));
    assert_eq!(contacts_of(&positions, DVec3::ZERO, &rising).len(), 1);
}

#[test]
fn a_node_that_a_fast_obstacle_ran_over_is_carried_in_front_of_it() {
    let start =
        [DVec3::new(1.008, 0.0, 0.0), DVec3::new(3.0, 0.5, 0.0), DVec3::new(3.0, -0.5, 0.0)];
    let (mut position, mut velocity) = (start, [DVec3::ZERO; 3]);
    // Twenty thicknesses in a step.
    let obstacles = moving(Pose::IDENTITY, at(DVec3::X * 0.2));
    resolved(&start, &mut position, &mut velocity, &obstacles, &SETTINGS, Depth::OfTheStep);
    assert!((position[0].x - 1.201).abs() < 1e-9, "{}", position[0]);
    assert!((velocity[0].x - 40.0).abs() < 1e-6, "{}", velocity[0]);
}

#[test]
fn a_node_between_two_overlapping_parts_is_reported_as_trapped() {
    let shape = Arc::new(Shape::new(&cube()));
    let left = at(DVec3::X * -0.999);
    let right = at(DVec3::X * 0.999);
    let obstacles = vec![
        ObstacleMotion::new(shape.clone(), left, left, 0.005),
        ObstacleMotion::new(shape, right, right, 0.005),
    ];
    let start = [DVec3::ZERO, DVec3::Y * 9.0, DVec3::Z * 9.0];
    let (mut position, mut velocity) = (start, [DVec3::ZERO; 3]);
    resolved(&start, &mut position, &mut velocity, &obstacles, &SETTINGS, Depth::Any);
    assert_eq!(trapped_nodes(&position, &obstacles), 1);
    assert!(position.iter().all(|x| x.is_finite()));
}

#[test]
fn the_guard_refuses_a_face_through_an_obstacle_only() {
    let obstacles = still();
    let guard = ObstacleGuard { obstacles: &obstacles };
    let through =
        [DVec3::new(-2.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.1), DVec3::new(0.0, 3.0, 0.0)];
    let above = through.map(|p| p + DVec3::Z * 1.5);
    let change = |new: &[[DVec3; 3]], old: &[[DVec3; 3]]| Change {
        old_faces: old.to_vec(),
        new_faces: new.to_vec(),
    };
    assert!(!guard.allows(&change(&[above, through], &[above, above])));
    assert!(guard.allows(&change(&[above], &[above, above])));
    assert!(guard.allows(&change(&[through], &[through, above])), "it crosses already");
}

#[test]
fn nearest_planes_come_from_the_nearest_obstacle_in_range() {
    let shape = Arc::new(Shape::new(&cube()));
    let obstacles = [0.0, 2.5].map(|x| {
        let pose = at(DVec3::X * x);
        ObstacleMotion::new(shape.clone(), pose, pose, 0.005)
    });
    let planes = nearest_planes(&[DVec3::X * 1.1, DVec3::X * 1.4, DVec3::Z * 5.0], &obstacles, 0.3);
    assert!((planes[0].unwrap().normal - DVec3::X).length() < 1e-12);
    assert!((planes[1].unwrap().normal + DVec3::X).length() < 1e-12);
    assert!(planes[2].is_none());
}

/// Cloth resting on the left of two cubes whose right face has the corners of the other inside.
#[test]
fn a_corner_inside_another_part_does_not_pull_cloth_in() {
    let shape = Arc::new(Shape::new(&cube()));
    // The small cube is sunk in the large one; its upper corners are just below the surface.
    let small = Pose { scale: 0.5, translation: DVec3::Z * 0.497, ..Pose::IDENTITY };
    let obstacles =
        [Pose::IDENTITY, small].map(|p| ObstacleMotion::new(shape.clone(), p, p, 0.005));
    let positions = sheet(1.01);
    let found = contacts_of(&positions, DVec3::ZERO, &obstacles);
    assert!(found.iter().all(|c| c.normal.z > 0.99), "{found:?}");
    let (mut position, mut velocity) = (positions.clone(), vec![DVec3::ZERO; 3]);
    resolved(&positions, &mut position, &mut velocity, &obstacles, &SETTINGS, Depth::Any);
    assert_eq!(position, positions);
}

#[test]
fn a_node_that_went_deep_into_a_thin_part_leaves_where_it_came_in() {
    // A slab 0.02 thick; the node has gone three quarters of the way through.
    let slab = Surface {
        positions: cube().positions.iter().map(|p| *p * DVec3::new(1.0, 1.0, 0.01)).collect(),
        ..cube()
    };
    let shape = Arc::new(Shape::new(&slab));
    let obstacles = [ObstacleMotion::new(shape, Pose::IDENTITY, Pose::IDENTITY, 0.005)];
    let settings = Contact { thickness: 0.004, ..SETTINGS };
    let far = DVec3::new(0.0, 9.0, 1.0);
    let start = [DVec3::Z * 0.012, far, far + DVec3::X];
    let (mut position, mut velocity) = (start, [DVec3::NEG_Z * 3.4, DVec3::ZERO, DVec3::ZERO]);
    position[0] = DVec3::Z * -0.005;
    resolved(&start, &mut position, &mut velocity, &obstacles, &settings, Depth::OfTheStep);
    assert!((position[0].z - 0.0104).abs() < 1e-6, "{}", position[0]);
    assert!(velocity[0].z.abs() < 1e-12);
}

#[test]
fn a_corner_is_foreseen_to_hit_a_face_that_has_no_node_near() {
    let positions = sheet(1.025);
    assert!(contacts_of(&positions, DVec3::ZERO, &still()).is_empty());
    assert_eq!(contacts_of(&positions, DVec3::NEG_Z * 4.0, &still()).len(), 4);
    let rising = moving(Pose::IDENTITY, at(DVec3::Z * 0.02));
    assert_eq!(contacts_of(&positions, DVec3::ZERO, &rising).len(), 4);
}

#[test]
fn the_velocity_of_a_point_of_the_surface_is_that_of_what_moves_with_the_obstacle() {
    let turn =
        Pose { rotation: DQuat::from_rotation_z(0.4), translation: DVec3::X, ..Pose::IDENTITY };
    let obstacle = &moving(Pose::IDENTITY, turn)[0];
    let near = obstacle.nearest_at_start(DVec3::new(1.5, 0.3, -0.2), 1.0).unwrap();
    let by_triangle = obstacle.surface_velocity(near.triangle, near.barycentric);
    assert!((obstacle.velocity_at(near.point) - by_triangle).length() < 1e-9);
}

#[test]
fn how_far_a_point_is_from_where_it_is_carried_is_bounded_without_a_search() {
    let mut random = Random::new(3);
    let turn = Pose { rotation: DQuat::from_rotation_z(0.4), translation: DVec3::X, scale: 1.5 };
    let shape = Arc::new(Shape::new(&cube()));
    let bent = shape.positions().iter().map(|&p| p + random.vector() * 0.3).collect();
    let poses = [Pose::IDENTITY, turn];
    let rigid = ObstacleMotion::new(shape.clone(), poses[0], poses[1], 0.005);
    let bent = Arc::new(shape.moved(bent));
    let deforming = ObstacleMotion::deforming([shape, bent], poses, 0.005);
    let mut closest: f64 = f64::INFINITY;
    for _ in 0..1000 {
        let (start, end) = (random.vector() * 2.0, random.vector() * 2.0);
        let away = |o: &ObstacleMotion| end.distance(o.carried(start));
        let bound = |o: &ObstacleMotion| o.distance_from_carried_max(start, end);
        assert_eq!(away(&rigid).to_bits(), bound(&rigid).to_bits());
        assert!(away(&deforming) <= bound(&deforming));
        closest = closest.min(bound(&deforming) - away(&deforming));
    }
    assert!(closest < 0.3, "the bound is loose: {closest} m");
}
