//! Steps with contacts.

use glam::DVec3;

use super::super::testing::sheet;
use super::super::*;
use super::{DT, directly, momentum, system_of, two_garments};

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

#[test]
fn a_direct_step_factorises_no_matrix_twice() {
    let (system, start) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
    let mut system = directly(system);
    let contacts = resting_contacts(&system, 0.1);
    let step = |system: &mut System, pull: f64, contacts: &[ContactPoint]| {
        let gravity = DVec3::new(pull, 0.0, -9.81);
        let forces = StepForces { gravity, contacts, ..StepForces::NONE };
        system.step_frozen(&mut start.clone(), &forces, DT).unwrap()
    };
    // Without contacts, with contacts that hold as they were taken, with contacts that slide.
    for (pull, contacts, are_corrected) in
        [(0.0, &[][..], false), (0.5, &contacts, false), (2.0, &contacts, true)]
    {
        let outcome = step(&mut system, pull, contacts);
        assert_eq!(outcome.solutions > 1, are_corrected, "{outcome:?}");
        assert_eq!(outcome.factorisations, outcome.solutions, "{outcome:?}");
    }
}
