//! Iterated steps: the energy and its derivatives, and that the iterations arrive.

use glam::DVec3;

use super::contact::IteratedContact;
use super::iterate::Iterate;
use super::testing::{Random, sheet};
use super::tests::{system_of, two_garments};
use super::*;
use crate::scene::{Air, Dynamics};

const DT: f64 = 5e-3;

/// Something of every force at once.
struct Surroundings {
    handles: Vec<HandleSpring>,
    contacts: Vec<ContactPoint>,
}

impl Surroundings {
    fn of(state: &StepState) -> Self {
        let contact = |(node, gap, normal): (usize, f64, DVec3)| ContactPoint {
            nodes: ContactPoint::weighted(&[(node, 0.7), (node + 1, 0.3)]),
            normal,
            gap,
            surface_velocity: DVec3::new(0.3, -0.2, 0.1),
            stiffness: 300.0,
            friction: 0.4,
        };
        let tilted = DVec3::new(0.6, 0.0, 0.8);
        Self {
            handles: vec![HandleSpring {
                node: 2,
                target: state.position[2] + DVec3::X * 0.01,
                stiffness: 200.0,
            }],
            contacts: [(4, -2e-3, DVec3::Z), (9, 1e-3, tilted), (12, -1e-3, DVec3::X)]
                .map(contact)
                .to_vec(),
        }
    }

    fn forces(&self) -> StepForces<'_> {
        StepForces {
            gravity: DVec3::new(0.0, 1.0, -9.81),
            air: Air { density: 1.2, velocity: DVec3::new(3.0, 0.0, 1.0), tangential_drag: 0.3 },
            handles: &self.handles,
            contacts: &self.contacts,
        }
    }
}

#[test]
fn what_is_out_of_balance_is_minus_the_gradient_of_the_incremental_energy() {
    let (mut system, start) = two_garments(0.004, 21);
    let around = Surroundings::of(&start);
    let forces = around.forces();
    let mut random = Random::new(22);
    let tried: Vec<DVec3> = start.velocity.iter().map(|v| *v + random.vector() * 0.5).collect();
    let at = Iterate::at_start(&start).moved(&tried, 1.0, &start, DT);
    let contacts = system.iterated_contacts(&at, &forces, DT);
    system.balance(&at, &start, &forces, &contacts, DT);
    let balance = system.linear_system().1.to_vec();
    let scale = balance.iter().map(|b| b.length()).fold(0.0, f64::max);
    for node in 0..balance.len() {
        for axis in DVec3::AXES {
            let energy = |step: f64| {
                let mut change = vec![DVec3::ZERO; tried.len()];
                change[node] = axis;
                let moved = at.moved(&change, step, &start, DT);
                system.incremental_energy(&moved, &start, &forces, &contacts, DT)
            };
            let difference = (energy(1e-4) - energy(-1e-4)) / 2e-4;
            let error = balance[node].dot(axis) + difference;
            assert!(error.abs() < 1e-5 * scale, "node {node}: off by {error} N s");
        }
    }
}

#[test]
fn friction_and_its_energy_agree_when_sticking_and_when_slipping() {
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&[(0, 1.0)]),
        normal: DVec3::Z,
        gap: -1e-3,
        surface_velocity: DVec3::X,
        stiffness: 500.0,
        friction: 0.3,
    };
    let mass = 1e-4;
    for slip in [1e-6, 1e-3, 0.5] {
        let velocity = DVec3::new(1.0 + slip, 0.5 * slip, -0.02);
        let at = IteratedContact::at(&contact, velocity, mass, DT);
        let force = at.response(&contact, velocity, DT).unwrap().force;
        for axis in DVec3::AXES {
            let step = 1e-4 * slip;
            let energy = |s: f64| at.energy(&contact, velocity + axis * s, DT);
            let difference = (energy(step) - energy(-step)) / (2.0 * step * DT);
            assert!((force.dot(axis) + difference).abs() < 1e-4 * force.length(), "slip {slip}");
        }
        assert!(force.truncate().length() < contact.friction * at.pressure * (1.0 + 1e-12));
    }
}

#[test]
fn one_iteration_is_the_linearised_step() {
    let (mut system, state) = two_garments(0.01, 23);
    let (mut linearised, mut once) = (state.clone(), state.clone());
    system.step_frozen(&mut linearised, &StepForces::NONE, DT).unwrap();
    system.set_dynamics(Dynamics {
        iterations: 2,
        tolerance: f64::INFINITY,
        ..Dynamics::default()
    });
    let at = Iterate::at_start(&state);
    let mut outcome = StepOutcome::default();
    system.first_direction(&state, &StepForces::NONE, DT, &mut outcome).unwrap();
    once.velocity = at.moved(&system.change, 1.0, &state, DT).velocity;
    for (a, b) in once.velocity.iter().zip(&linearised.velocity) {
        assert!((*a - *b).length() < 1e-12);
    }
}

#[test]
fn iterations_arrive_where_forces_balance_even_from_a_crumpled_state_at_large_steps() {
    let (mut system, mut state) = system_of(&[&sheet(8, 0.4, 0.2)], 0.0);
    system.set_dynamics(Dynamics { iterations: 200, tolerance: 1e-8, ..Dynamics::default() });
    let mut random = Random::new(24);
    state.position.iter_mut().for_each(|x| *x += random.vector() * 0.03);
    for dt in [5e-3, 4e-2] {
        let (start, forces) = (state.clone(), StepForces::NONE);
        let outcome = system.step_frozen(&mut state, &forces, dt).unwrap();
        assert_eq!(outcome.convergence, Convergence::Reached, "{outcome:?}");
        let end = Iterate { position: state.position.clone(), velocity: state.velocity.clone() };
        system.balance(&end, &start, &forces, &[], dt);
        let left = system.linear_system().1.iter().map(|b| b.length()).fold(0.0, f64::max);
        let scale = system.masses()[40] * 1.0;
        assert!(left < 1e-6 * scale, "{left} N s are out of balance");
    }
}

#[test]
fn a_converged_step_never_gains_energy() {
    let (mut system, mut state) = system_of(&[&sheet(8, 0.4, 0.2)], 0.0);
    system.set_dynamics(Dynamics { iterations: 100, tolerance: 1e-9, ..Dynamics::default() });
    let mut random = Random::new(25);
    for (x, v) in state.position.iter_mut().zip(&mut state.velocity) {
        *x = *x * 1.05 + random.vector() * 5e-3;
        *v = random.vector();
    }
    let energy = |system: &System, state: &StepState| {
        system.potential_energy(state) + system.kinetic_energy(state)
    };
    let mut before = energy(&system, &state);
    for step in 0..40 {
        let outcome = system.step_frozen(&mut state, &StepForces::NONE, 4.0 * DT).unwrap();
        assert_eq!(outcome.convergence, Convergence::Reached, "step {step}");
        let after = energy(&system, &state);
        assert!(after <= before * (1.0 + 1e-9), "step {step}: {before} J to {after} J");
        before = after;
    }
}

#[test]
fn iterated_contact_holds_a_fast_sheet_that_a_linearised_step_lets_sink() {
    let (mut system, mut state) = system_of(&[&sheet(6, 0.3, 0.2)], 0.0);
    system.set_dynamics(Dynamics { iterations: 30, tolerance: 1e-7, ..Dynamics::default() });
    state.velocity.fill(DVec3::new(1.0, 0.0, -2.0));
    let contacts: Vec<ContactPoint> = (0..system.node_count())
        .map(|node| ContactPoint {
            nodes: ContactPoint::weighted(&[(node, 1.0)]),
            normal: DVec3::Z,
            gap: 2e-3,
            surface_velocity: DVec3::ZERO,
            stiffness: 1e5,
            friction: 0.2,
        })
        .collect();
    let forces = StepForces { contacts: &contacts, ..StepForces::NONE };
    let outcome = system.step_frozen(&mut state, &forces, DT).unwrap();
    assert_eq!(outcome.convergence, Convergence::Reached);
    for (v, z) in state.velocity.iter().zip(state.position.iter().map(|x| x.z)) {
        assert!((z + 2e-3).abs() < 1e-4, "height {z} m");
        // Coulomb: the tangential loss is mu times the impulse along the normal.
        let (lost, stopped) = (1.0 - v.x, v.z + 2.0);
        assert!((lost - 0.2 * stopped).abs() < 1e-3 * stopped, "{lost} m/s for {stopped} m/s");
    }
}

#[test]
fn a_first_direction_that_does_not_lower_the_energy_does_not_freeze_the_cloth() {
    let (mut system, mut state) = system_of(&[&sheet(4, 0.4, 0.2)], 0.0);
    system.set_dynamics(Dynamics { iterations: 2, tolerance: 1e-9, ..Dynamics::default() });
    state.velocity.fill(DVec3::new(0.0, 0.0, -5.0));
    let wall: Vec<ContactPoint> = (0..system.node_count())
        .map(|node| ContactPoint {
            nodes: ContactPoint::weighted(&[(node, 1.0)]),
            normal: DVec3::Z,
            gap: 0.0,
            // It comes up as fast as the sheet comes down.
            surface_velocity: DVec3::new(0.0, 0.0, 5.0),
            stiffness: 1e3,
            friction: 0.5,
        })
        .collect();
    let forces = StepForces { contacts: &wall, ..StepForces::NONE };
    system.step_frozen(&mut state, &forces, DT).unwrap();
    assert!(state.velocity.iter().all(|v| v.z > 0.5), "{}", state.velocity[0]);
}
