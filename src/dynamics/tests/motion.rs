//! How cloth moves: laws of mechanics over many steps.

use glam::DVec3;

use super::super::testing::{Random, sheet};
use super::super::*;
use super::{DT, directly, momentum, system_of, two_garments};
use crate::scene::Air;

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
    let before = momentum(&system, &state);
    for _ in 0..50 {
        system.step_frozen(&mut state, &StepForces::NONE, DT).unwrap();
    }
    let drift = (momentum(&system, &state) - before).length();
    assert!(drift < 1e-10 * before.length().max(1e-3), "{drift} kg m/s");
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
