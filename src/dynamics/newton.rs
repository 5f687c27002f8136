//! The step iterated: Newton's method on the incremental potential, with a line search.
//!
//! Every matrix is positive definite (see [`stretch`](super::stretch) and
//! [`bending`](super::bending)), so each direction goes downhill; the line search makes it arrive.
//! The first direction is that of the linearised step, whose contacts are predicted: it is only asked
//! to lower the energy, and taken as it is if it does not.

use glam::DVec3;

use super::contact::{ContactPoint, ContactResponse, IteratedContact};
use super::iterate::Iterate;
use super::solve::Accuracy;
use super::step::{Convergence, StepError, StepForces, StepOutcome, StepState};
use super::system::System;

/// Share of the decrease promised by the slope that a step must give.
const ARMIJO_SHARE: f64 = 1e-4;

/// Halvings of a direction before it is given up: a millionth of it changes nothing.
const HALVINGS_MAX: u32 = 20;

/// Change of energy that is rounding, as a share of the energy.
const ROUNDING_SHARE: f64 = 1e-13;

/// Newton iterations that strain limits ask for: linearised, a limit that a face reaches or leaves
/// within the step, or meets while it turns, is met too early, too late or not at all. The second
/// puts most of it right, and projection the rest; without the second a flag stops flapping.
const LIMITED_ITERATIONS: u32 = 2;

/// Of the first direction where only strain limits ask for iterations: what it misses is left to the
/// others.
const FIRST_ACCURACY: Accuracy = Accuracy { tolerance: 1e-2, least: 0.0 };

impl System {
    pub(super) fn iterated_step(
        &mut self,
        start: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Result<(Iterate, StepOutcome), StepError> {
        let mut iterate = Iterate::at_start(start);
        let mut outcome =
            StepOutcome { convergence: Convergence::IterationsUsedUp, ..Default::default() };
        for iteration in 0..self.iterations_max() {
            let contacts = self.iterated_contacts(&iterate, forces, dt);
            if iteration == 0 {
                self.first_direction(start, forces, dt, &mut outcome)?;
            } else {
                self.direction(&iterate, start, forces, &contacts, dt, &mut outcome)?;
            }
            outcome.solutions += 1;
            let farthest = self.change.iter().map(|dv| dv.length()).fold(0.0, f64::max);
            if iteration > 0 && farthest < self.settings.tolerance {
                iterate = iterate.moved(&self.change, 1.0, start, dt);
                outcome.convergence = Convergence::Reached;
                break;
            }
            // The first right side is linearised elsewhere and with other contacts: no slope of the
            // energy here.
            let slope = if iteration == 0 { 0.0 } else { self.descent() };
            match self.line_search(&iterate, start, forces, &contacts, slope, dt) {
                Some(next) => iterate = next,
                // Not a minimum of anything, but what a linearised step would do.
                None if iteration == 0 => iterate = iterate.moved(&self.change, 1.0, start, dt),
                None => {
                    outcome.convergence = Convergence::Stalled;
                    break;
                }
            }
        }
        Ok((iterate, outcome))
    }

    /// Newton iterations of a step at most: as set, or as many as strain limits may ask for.
    pub(super) fn iterations_max(&self) -> u32 {
        self.settings.iterations.max(if self.is_limited() { LIMITED_ITERATIONS } else { 1 })
    }

    /// The linearised step, as a change from rest.
    pub(super) fn first_direction(
        &mut self,
        start: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
        outcome: &mut StepOutcome,
    ) -> Result<(), StepError> {
        self.findings.clear();
        outcome.degenerate_hinges = self.assemble(start, forces, dt);
        outcome.active_contacts = self.add_found_contacts(start, forces, dt);
        // Long steps converge to another end from a first direction that is off.
        self.solve_change(match self.settings.iterations {
            0 | 1 => FIRST_ACCURACY,
            _ => Accuracy::FINE,
        })?;
        self.change.iter_mut().zip(&start.velocity).for_each(|(change, v)| *change += *v);
        Ok(())
    }

    /// Newton's direction at an iterate, to a few digits: what it misses is left to the next.
    fn direction(
        &mut self,
        iterate: &Iterate,
        start: &StepState,
        forces: &StepForces<'_>,
        contacts: &[IteratedContact],
        dt: f64,
        outcome: &mut StepOutcome,
    ) -> Result<(), StepError> {
        let (degenerate, active) = self.balance(iterate, start, forces, contacts, dt);
        outcome.degenerate_hinges = outcome.degenerate_hinges.max(degenerate);
        outcome.active_contacts = active;
        self.change.fill(DVec3::ZERO);
        self.solve_change(Accuracy::ROUGH)
    }

    /// Matrix and right side at an iterate, contacts included; returns how many hinges have no
    /// angle, and how many contacts push.
    pub(super) fn balance(
        &mut self,
        iterate: &Iterate,
        start: &StepState,
        forces: &StepForces<'_>,
        contacts: &[IteratedContact],
        dt: f64,
    ) -> (usize, usize) {
        self.make_room_for(forces.contacts);
        let degenerate = self.assemble_at(iterate, start, None, forces, dt);
        let pushing: Vec<(&ContactPoint, ContactResponse)> = forces
            .contacts
            .iter()
            .zip(contacts)
            .filter_map(|(contact, at)| {
                let velocity = contact.weighted_sum(&iterate.velocity);
                Some((contact, at.response(contact, velocity, dt)?))
            })
            .collect();
        let active = pushing.len();
        self.add_contacts(pushing.into_iter(), dt);
        (degenerate, active)
    }

    /// The contacts at an iterate, with the pressure that friction counts on until the next.
    pub(super) fn iterated_contacts(
        &self,
        iterate: &Iterate,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Vec<IteratedContact> {
        let at = |contact: &ContactPoint| {
            let velocity = contact.weighted_sum(&iterate.velocity);
            IteratedContact::at(contact, velocity, contact.effective_mass(&self.masses), dt)
        };
        forces.contacts.iter().map(at).collect()
    }

    /// How fast the energy falls along `change`, per share of it (J).
    fn descent(&self) -> f64 {
        self.right_side.iter().zip(&self.change).map(|(b, d)| b.dot(*d)).sum::<f64>().max(0.0)
    }

    /// The iterate after the largest share 1, 1/2, 1/4, ... of `change` that lowers the energy;
    /// `None` if none does.
    fn line_search(
        &self,
        iterate: &Iterate,
        start: &StepState,
        forces: &StepForces<'_>,
        contacts: &[IteratedContact],
        slope: f64,
        dt: f64,
    ) -> Option<Iterate> {
        let energy = |at: &Iterate| self.incremental_energy(at, start, forces, contacts, dt);
        let before = energy(iterate);
        let mut share = 1.0;
        for _ in 0..=HALVINGS_MAX {
            let trial = iterate.moved(&self.change, share, start, dt);
            let promised = ARMIJO_SHARE * share * slope;
            if energy(&trial) <= before - promised + ROUNDING_SHARE * before.abs() {
                return Some(trial);
            }
            share *= 0.5;
        }
        None
    }
}
