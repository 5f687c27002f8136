//! The system as a whole: laws that hold whatever the mesh.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::testing::{Random, fabric, seamed_strip, sheet};
use super::*;
use crate::mesh::{Id, Mesh};
use crate::scene::{Air, Dynamics, SolverChoice, StretchStiffness};

const DT: f64 = 5e-3;
const DENSITY: f64 = 0.15;
const STRETCH: StretchStiffness =
    StretchStiffness { uu: 800.0, uv: 150.0, vv: 500.0, shear: 200.0 };
const BENDING: f64 = 2e-5;

/// A system with constant stiffness, and the state of its meshes.
pub(super) fn system_of(meshes: &[&Mesh], damping: f64) -> (System, StepState) {
    let fabric = fabric(DENSITY, damping);
    let mut system = System::unfrozen(meshes, &vec![&fabric; meshes.len()]);
    system.frozen.stretch = vec![STRETCH; system.membranes.len()];
    system.frozen.bending = vec![BENDING; system.hinges.len()];
    for mesh in meshes {
        mesh.check().unwrap();
    }
    (system, StepState::gathered(meshes))
}

/// A sheet and a sewn strip, both crumpled.
pub(super) fn two_garments(damping: f64, seed: u64) -> (System, StepState) {
    let (system, mut state) = system_of(&[&sheet(4, 0.4, 0.2), &seamed_strip()], damping);
    let mut random = Random::new(seed);
    state.position.iter_mut().for_each(|x| *x += random.vector() * 0.02);
    state.velocity.iter_mut().for_each(|v| *v = random.vector());
    (system, state)
}

/// Solves to rounding.
fn directly(mut system: System) -> System {
    system.set_dynamics(Dynamics { solver: SolverChoice::Direct, ..Dynamics::default() });
    system
}

/// h f of the elastic forces: the right side of a step from rest.
fn elastic_impulse(system: &mut System, state: &StepState) -> Vec<DVec3> {
    let still = StepState { velocity: vec![DVec3::ZERO; state.velocity.len()], ..state.clone() };
    system.assemble(&still, &StepForces::NONE, DT);
    system.linear_system().1.to_vec()
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy_on_seams_and_in_several_garments() {
    let (mut system, state) = two_garments(0.0, 1);
    let impulse = elastic_impulse(&mut system, &state);
    let scale = impulse.iter().map(|i| i.length() / DT).fold(0.0, f64::max);
    for (node, impulse) in impulse.iter().enumerate() {
        for axis in 0..3 {
            let energy = |step: f64| {
                let mut moved = state.clone();
                moved.position[node][axis] += step;
                system.potential_energy(&moved)
            };
            let difference = (energy(1e-6) - energy(-1e-6)) / 2e-6;
            let error = impulse[axis] / DT + difference;
            assert!(error.abs() < 1e-6 * scale, "node {node}: off by {error} N");
        }
    }
}

#[test]
fn bending_forces_are_minus_the_gradient_of_their_energy() {
    let (mut system, state) = two_garments(0.0, 2);
    system.frozen.stretch.fill(StretchStiffness { uu: 0.0, uv: 0.0, vv: 0.0, shear: 0.0 });
    let impulse = elastic_impulse(&mut system, &state);
    let scale = impulse.iter().map(|i| i.length() / DT).fold(0.0, f64::max);
    for (node, impulse) in impulse.iter().enumerate() {
        for axis in 0..3 {
            let energy = |step: f64| {
                let mut moved = state.clone();
                moved.position[node][axis] += step;
                system.potential_energy(&moved)
            };
            let difference = (energy(1e-7) - energy(-1e-7)) / 2e-7;
            assert!((impulse[axis] / DT + difference).abs() < 1e-5 * scale);
        }
    }
}

#[test]
fn the_bending_tangent_is_exact_where_hinges_rest() {
    let (mut system, state) = two_garments(0.0, 3);
    system.frozen.stretch.fill(StretchStiffness { uu: 0.0, uv: 0.0, vv: 0.0, shear: 0.0 });
    for hinge in &mut system.hinges {
        hinge.rest_angle = bending::dihedral_angle(hinge.corners(&state.position)).unwrap();
    }
    let mut random = Random::new(4);
    let direction: Vec<DVec3> = state.position.iter().map(|_| random.vector()).collect();
    let at = |system: &mut System, step: f64| {
        let mut moved = state.clone();
        moved.position.iter_mut().zip(&direction).for_each(|(x, d)| *x += *d * step);
        elastic_impulse(system, &moved)
    };
    let step = 1e-7;
    let (plus, minus) = (at(&mut system, step), at(&mut system, -step));
    elastic_impulse(&mut system, &state);
    let (matrix, _) = system.linear_system();
    let mut expected = matrix.product(&direction);
    for (value, (mass, d)) in expected.iter_mut().zip(system.masses().iter().zip(&direction)) {
        *value -= *d * *mass;
    }
    let scale = expected.iter().map(|e| e.length()).fold(0.0, f64::max);
    for node in 0..expected.len() {
        let difference = (minus[node] - plus[node]) * (DT / (2.0 * step));
        assert!((difference - expected[node]).length() < 1e-5 * scale, "node {node}");
    }
}

#[test]
fn the_right_side_takes_forces_ahead_by_the_matrix() {
    let (mut system, state) = two_garments(0.02, 5);
    let still = elastic_impulse(&mut system, &state);
    system.assemble(&state, &StepForces::NONE, DT);
    let (matrix, ahead) = system.linear_system();
    let product = matrix.product(&state.velocity);
    let scale = product.iter().map(|p| p.length()).fold(0.0, f64::max);
    for node in 0..still.len() {
        let inertia = state.velocity[node] * system.masses()[node];
        let error = ahead[node] - (still[node] - product[node] + inertia);
        assert!(error.length() < 1e-12 * scale, "node {node}");
    }
}

#[test]
fn the_matrix_is_positive_definite_in_any_state() {
    for seed in 0..20 {
        let (mut system, state) = two_garments(0.01, seed);
        let air = Air { velocity: DVec3::new(4.0, 2.0, 1.0), tangential_drag: 0.5, density: 1.0 };
        system.assemble(&state, &StepForces { air, ..StepForces::NONE }, DT);
        let (matrix, _) = system.linear_system();
        let count = system.node_count();
        let dense = nalgebra::DMatrix::from_fn(3 * count, 3 * count, |row, col| {
            let (a, b) = (row / 3, col / 3);
            let Some(slot) = matrix.pattern().slot(a as u32, b as u32) else { return 0.0 };
            let block: DMat3 = matrix.blocks()[slot as usize];
            let block = if a >= b { block } else { block.transpose() };
            block.col(col % 3)[row % 3]
        });
        let least = dense.symmetric_eigenvalues().min();
        let lightest = system.masses().iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least > 0.99 * lightest, "eigenvalue {least} with seed {seed}");
    }
}

#[test]
fn a_rigid_motion_stores_no_energy_and_gives_no_force() {
    let (mut system, mut state) = system_of(&[&sheet(5, 0.5, 0.2)], 0.0);
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0);
    state.position.iter_mut().for_each(|x| *x = turn * *x + DVec3::new(0.3, -2.0, 1.0));
    assert!(system.potential_energy(&state) < 1e-20);
    let impulse = elastic_impulse(&mut system, &state);
    assert!(impulse.iter().all(|i| i.length() < 1e-12 * DT * STRETCH.uu));
}

#[test]
fn free_fall_is_exact() {
    let gravity = DVec3::new(0.0, 0.0, -9.81);
    let (mut system, mut state) = system_of(&[&sheet(5, 0.5, 0.2)], 0.01);
    let start = state.clone();
    let forces = StepForces { gravity, ..StepForces::NONE };
    for _ in 0..100 {
        system.step_frozen(&mut state, &forces, DT).unwrap();
    }
    // Backward Euler: x_n = x_0 + g h^2 n (n + 1) / 2.
    let fall = gravity * (DT * DT * 100.0 * 101.0 / 2.0);
    for (x, start) in state.position.iter().zip(&start.position) {
        assert!((*x - *start - fall).length() < 1e-11);
    }
    assert!(state.velocity.iter().all(|v| (*v - gravity * (100.0 * DT)).length() < 1e-11));
}

#[test]
fn linear_momentum_is_conserved_without_outside_forces() {
    let (system, mut state) = two_garments(0.003, 6);
    let mut system = directly(system);
    let momentum = |system: &System, state: &StepState| -> DVec3 {
        system.masses().iter().zip(&state.velocity).map(|(m, v)| *v * *m).sum()
    };
    let before = momentum(&system, &state);
    for _ in 0..50 {
        system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    }
    let drift = (momentum(&system, &state) - before).length();
    assert!(drift < 1e-10 * before.length().max(1e-3), "{drift} kg m/s");
}

#[test]
fn an_affine_map_gives_constant_stress_and_no_inner_force_on_an_irregular_mesh() {
    let mesh = sheet(6, 0.6, 0.3);
    let (mut system, mut state) = system_of(&[&mesh], 0.0);
    let (across, along) = (DVec3::new(1.1, 0.1, 0.2), DVec3::new(-0.1, 1.02, 0.05));
    for (x, u) in state.position.iter_mut().zip(mesh.vertex_ids().map(|v| mesh.material(v))) {
        let DVec2 { x: u, y: v } = u;
        *x = across * u + along * v;
    }
    let impulse = elastic_impulse(&mut system, &state);
    let scale = impulse.iter().map(|i| i.length()).fold(0.0, f64::max);
    for node in mesh.node_ids().filter(|&n| !mesh.is_boundary_node(n)) {
        assert!(impulse[node.index()].length() < 1e-12 * scale, "{node:?}");
    }
    let stresses = system.membranes.iter().map(|face| {
        stretch::stress(STRETCH, stretch::green_strain(face.gradient_of(&state.position)))
    });
    let first = stresses.clone().next().unwrap();
    for difference in stresses.map(|s| s - first) {
        assert!(difference.xx.abs() + difference.xy.abs() + difference.yy.abs() < 1e-9);
    }
}

#[test]
fn a_step_that_fails_leaves_the_state_as_it_was() {
    let (mut system, state) = two_garments(0.0, 7);
    let mut stepped = state.clone();
    let handles = [HandleSpring { node: 3, target: DVec3::NAN, stiffness: 1e3 }];
    let error =
        system.step_frozen(&mut stepped, &StepForces { handles: &handles, ..StepForces::NONE }, DT);
    assert_eq!(error, Err(StepError::NonFinite { what: "force", node: 3 }));
    assert_eq!(stepped, state);

    let handles = [HandleSpring { node: 3, target: DVec3::ZERO, stiffness: -1e9 }];
    let error =
        system.step_frozen(&mut stepped, &StepForces { handles: &handles, ..StepForces::NONE }, DT);
    assert!(matches!(error, Err(StepError::Solve(SolveError::NotPositiveDefinite { .. }))));
    assert_eq!(stepped, state);

    stepped.velocity[5].y = f64::INFINITY;
    let before = stepped.clone();
    let error = system.step_frozen(&mut stepped, &StepForces::NONE, DT);
    assert_eq!(error, Err(StepError::NonFinite { what: "velocity", node: 5 }));
    assert_eq!(stepped, before);
}

#[test]
fn energy_does_not_grow_without_outside_forces() {
    let (mut system, mut state) = system_of(&[&sheet(8, 0.4, 0.2)], 0.0);
    let mut random = Random::new(8);
    for (x, v) in state.position.iter_mut().zip(&mut state.velocity) {
        *x = *x * 1.05 + random.vector() * 1e-3;
        *v = random.vector() * 0.3;
    }
    let energy = |system: &System, state: &StepState| {
        system.potential_energy(state) + system.kinetic_energy(state)
    };
    let mut before = energy(&system, &state);
    let start = before;
    for step in 0..200 {
        system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
        let after = energy(&system, &state);
        assert!(after < before + 1e-3 * start, "step {step}: {before} J to {after} J");
        before = after;
    }
    assert!(before < 0.5 * start);
}

#[test]
fn damping_slows_vibration_but_not_flight() {
    let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.1)], 0.05);
    state.velocity.fill(DVec3::new(1.0, 2.0, 3.0));
    let before = system.kinetic_energy(&state);
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    assert!((system.kinetic_energy(&state) / before - 1.0).abs() < 1e-12);

    // A slow bending mode: backward Euler alone hardly touches it.
    let left_after = |damping: f64| {
        let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.1)], damping);
        state.velocity.iter_mut().zip(&state.position).for_each(|(v, x)| v.z = x.x * x.y);
        let before = system.kinetic_energy(&state);
        system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
        system.kinetic_energy(&state) / before
    };
    assert!(left_after(0.05) < left_after(0.0));
}

#[test]
fn a_handle_leads_its_node_to_the_target() {
    let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.1)], 0.0);
    let target = state.position[0] + 0.01 * DVec3::Z;
    for (stiffness, distance) in [(1e8, 1e-6), (1e3, 1e-3)] {
        let handles = [HandleSpring { node: 0, target, stiffness }];
        let forces = StepForces { handles: &handles, ..StepForces::NONE };
        for _ in 0..20 {
            system.step_frozen(&mut state, &forces, DT).unwrap();
        }
        assert!(state.position[0].distance(target) < distance);
    }
}

#[test]
fn a_sheet_on_a_table_comes_to_rest_where_penalty_and_weight_balance() {
    let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.1)], 0.0);
    let gravity = DVec3::new(1.0, 0.0, -9.81);
    let stiffness = 100.0;
    for _ in 0..200 {
        let contacts: Vec<ContactPoint> = (0..system.node_count())
            .map(|node| ContactPoint {
                nodes: ContactPoint::weighted(&[(node, 1.0)]),
                normal: DVec3::Z,
                gap: state.position[node].z,
                surface_velocity: DVec3::ZERO,
                stiffness,
                friction: 0.3,
            })
            .collect();
        let forces = StepForces { gravity, contacts: &contacts, ..StepForces::NONE };
        let outcome = system.step_frozen(&mut state, &forces, DT).unwrap();
        assert_eq!(outcome.active_contacts, contacts.len());
    }
    let sunk: f64 = state.position.iter().map(|x| -x.z * stiffness).sum();
    let weight: f64 = system.masses().iter().sum::<f64>() * 9.81;
    assert!((sunk / weight - 1.0).abs() < 1e-3, "{sunk} N carry {weight} N");
    assert!(state.velocity.iter().all(|v| v.length() < 1e-3), "a slope of 0.1 does not slide");
}

#[test]
fn a_contact_between_garments_gets_its_blocks_and_keeps_momentum() {
    let (system, mut state) = two_garments(0.0, 9);
    let mut system = directly(system);
    let other = system.nodes_of(1).start;
    let nodes = ContactPoint::weighted(&[(other, 1.0), (0, -0.2), (1, -0.5), (5, -0.3)]);
    let contact = ContactPoint {
        nodes,
        normal: DVec3::Z,
        gap: -1e-3,
        surface_velocity: DVec3::ZERO,
        stiffness: 500.0,
        friction: 0.5,
    };
    state.velocity.fill(DVec3::ZERO);
    let contacts = [contact];
    let forces = StepForces { contacts: &contacts, ..StepForces::NONE };
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    let momentum = |system: &System, state: &StepState| -> DVec3 {
        system.masses().iter().zip(&state.velocity).map(|(m, v)| *v * *m).sum()
    };
    for _ in 0..3 {
        state.velocity.fill(DVec3::ZERO);
        let outcome = system.step_frozen(&mut state, &forces, DT).unwrap();
        assert_eq!(outcome.active_contacts, 1);
        let scale: f64 =
            system.masses().iter().zip(&state.velocity).map(|(m, v)| m * v.length()).sum();
        assert!(momentum(&system, &state).length() < 1e-10 * scale.max(1e-6));
    }
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    let counts = system.solver_counts();
    assert_eq!(counts.analyses, 2, "once without, once with the contact");
}

#[test]
fn collapsed_faces_are_counted_and_do_no_harm() {
    let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.1)], 0.0);
    state.position[6] = state.position[7];
    let outcome = system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    assert!(outcome.degenerate_hinges > 0);
}

#[test]
fn a_state_goes_to_the_meshes_and_comes_back() {
    let (mut sheet, mut strip) = (sheet(3, 0.3, 0.1), seamed_strip());
    let mut state = StepState::gathered(&[&sheet, &strip]);
    state.position.iter_mut().for_each(|x| *x += DVec3::X);
    state.velocity.fill(DVec3::Y);
    state.scatter(&mut [&mut sheet, &mut strip]);
    assert_eq!(StepState::gathered(&[&sheet, &strip]), state);
}

#[test]
fn the_solver_of_an_equal_mesh_needs_no_new_analysis() {
    let (system, mut state) = two_garments(0.0, 10);
    let mut system = directly(system);
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    let solver = system.into_solver();
    let (system, mut state) = two_garments(0.0, 11);
    let mut system = directly(system);
    system.set_solver(solver);
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    assert_eq!(system.solver_counts().analyses, 1);
}

#[test]
fn a_sheet_hung_by_two_corners_pulls_with_its_weight() {
    let (mut system, mut state) = system_of(&[&sheet(8, 0.4, 0.2)], 0.02);
    let gravity = DVec3::new(0.0, 0.0, -9.81);
    let handles =
        [72, 80].map(|node| HandleSpring { node, target: state.position[node], stiffness: 1e3 });
    let forces = StepForces { gravity, air: Air::default(), handles: &handles, contacts: &[] };
    for _ in 0..800 {
        system.step_frozen(&mut state, &forces, DT).unwrap();
    }
    let held: DVec3 = handles.iter().map(|h| h.force(state.position[h.node])).sum();
    let weight: f64 = system.masses().iter().sum::<f64>() * 9.81;
    assert!((held - weight * DVec3::Z).length() < 0.05 * weight, "{held} N hold {weight} N");
}

#[test]
fn a_badly_crumpled_sheet_calms_down() {
    let (mut system, mut state) = system_of(&[&sheet(8, 0.4, 0.2)], 0.0);
    let mut random = Random::new(12);
    state.position.iter_mut().for_each(|x| *x += random.vector() * 0.1);
    let start = system.potential_energy(&state);
    for _ in 0..400 {
        system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    }
    let left = system.potential_energy(&state) + system.kinetic_energy(&state);
    assert!(left < 0.1 * start, "{left} J of {start} J are left");
}

#[test]
fn a_scene_without_garments_steps() {
    let (mut system, mut state) = system_of(&[], 0.0);
    system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    assert_eq!(state, StepState::default());
}

#[test]
fn equal_steps_give_equal_bits() {
    let stepped = || {
        let (mut system, mut state) = two_garments(0.01, 13);
        for _ in 0..5 {
            system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
        }
        state
    };
    assert_eq!(stepped(), stepped());
}

/// Every node of a sheet in contact with the plane z = 0, pressed in as far as its weight asks.
fn resting_contacts(system: &System, friction: f64) -> Vec<ContactPoint> {
    let stiffness = 50.0;
    let contact = |(node, mass): (usize, &f64)| ContactPoint {
        nodes: ContactPoint::weighted(&[(node, 1.0)]),
        normal: DVec3::Z,
        gap: -mass * 9.81 / stiffness,
        surface_velocity: DVec3::ZERO,
        stiffness,
        friction,
    };
    system.masses().iter().enumerate().map(contact).collect()
}

#[test]
fn a_resting_sheet_slides_at_once_when_pulled_beyond_friction() {
    let (mut system, mut state) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
    let contacts = resting_contacts(&system, 0.1);
    let gravity = DVec3::new(2.0, 0.0, -9.81);
    let forces = StepForces { gravity, contacts: &contacts, ..StepForces::NONE };
    for _ in 0..4 {
        system.step_frozen(&mut state, &forces, DT).unwrap();
    }
    let expected = (2.0 - 0.1 * 9.81) * 4.0 * DT;
    for v in &state.velocity {
        assert!((v.x - expected).abs() < 0.02 * expected, "{v} m/s, expected {expected}");
    }
}

#[test]
fn a_resting_sheet_sticks_when_pulled_within_friction() {
    let (mut system, mut state) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
    let contacts = resting_contacts(&system, 0.3);
    let gravity = DVec3::new(2.0, 0.0, -9.81);
    let forces = StepForces { gravity, contacts: &contacts, ..StepForces::NONE };
    for _ in 0..40 {
        system.step_frozen(&mut state, &forces, DT).unwrap();
    }
    assert!(state.velocity.iter().all(|v| v.length() < 1e-4));
}

#[test]
fn a_contact_does_not_hold_back_cloth_that_is_pulled_off() {
    let pulled = |contacts: &dyn Fn(&System) -> Vec<ContactPoint>| {
        let (mut system, mut state) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
        let contacts = contacts(&system);
        let target = state.position[24] + DVec3::Z * 0.1;
        let handles = [HandleSpring { node: 24, target, stiffness: 100.0 }];
        let forces = StepForces { handles: &handles, contacts: &contacts, ..StepForces::NONE };
        system.step_frozen(&mut state, &forces, DT).unwrap();
        state.velocity[24]
    };
    // At no distance and with no weight, the contact can only pull.
    let touching = |system: &System| {
        let mut contacts = resting_contacts(system, 0.3);
        contacts.iter_mut().for_each(|c| c.gap = 0.0);
        contacts
    };
    let (held, free) = (pulled(&touching), pulled(&|_| Vec::new()));
    assert!((held - free).length() < 1e-3 * free.length(), "{held} and {free} m/s");
}

#[test]
fn a_contact_that_inertia_leaves_open_is_closed_where_the_cloth_is_pressed_into_it() {
    let (mut system, mut state) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
    let contacts: Vec<ContactPoint> = resting_contacts(&system, 0.3)
        .into_iter()
        .map(|c| ContactPoint { gap: 1e-4, stiffness: 1e4, ..c })
        .collect();
    let target = state.position[24] - DVec3::Z * 0.1;
    let handles = [HandleSpring { node: 24, target, stiffness: 100.0 }];
    let forces = StepForces { handles: &handles, contacts: &contacts, ..StepForces::NONE };
    let outcome = system.step_frozen(&mut state, &forces, DT).unwrap();
    assert!(outcome.active_contacts > 0);
    // 10 N on a penalty of 1e4 N/m.
    let deepest = state.position.iter().map(|x| x.z).fold(0.0, f64::min);
    assert!((-2e-3..0.0).contains(&deepest), "{deepest} m");
}
