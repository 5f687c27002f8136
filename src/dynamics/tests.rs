//! The system as a whole: laws that hold whatever the mesh.

mod contacts;
mod motion;

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::testing::{Random, fabric, gradient_error, seamed_strip, sheet};
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

/// (N).
fn elastic_forces(system: &mut System, state: &StepState) -> Vec<DVec3> {
    elastic_impulse(system, state).into_iter().map(|impulse| impulse / DT).collect()
}

/// (kg m/s).
fn momentum(system: &System, state: &StepState) -> DVec3 {
    system.masses().iter().zip(&state.velocity).map(|(m, v)| *v * *m).sum()
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy_on_seams_and_in_several_garments() {
    let (mut system, state) = two_garments(0.0, 1);
    let forces = elastic_forces(&mut system, &state);
    let error = gradient_error(&system, &state, &forces, 1e-6);
    assert!(error < 1e-6, "off by {error}");
}

#[test]
fn bending_forces_are_minus_the_gradient_of_their_energy() {
    let (mut system, state) = two_garments(0.0, 2);
    system.frozen.stretch.fill(StretchStiffness { uu: 0.0, uv: 0.0, vv: 0.0, shear: 0.0 });
    let forces = elastic_forces(&mut system, &state);
    let error = gradient_error(&system, &state, &forces, 1e-7);
    assert!(error < 1e-5, "off by {error}");
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
