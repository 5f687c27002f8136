//! Contacts that are not what they were taken for within a step.
//!
//! Friction is linearised about the slip at the start of the step. A point that sticks there may be
//! torn off by forces far beyond mu N: linearised sticking would hold it all the same, and give way
//! only over many steps. A penalty is closed if inertia closes it, and would pull where the cloth
//! lifts off. After a solution such contacts are found, and the step is solved again with the
//! friction they really have, mu N against their slip, or without them.

use glam::DVec3;

use super::contact::{ContactPoint, ContactResponse};
use super::step::{StepForces, StepState};
use super::system::System;

/// What solutions have shown of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Finding {
    /// Linearised well enough.
    AsTaken,
    /// Torn off: the friction it has (N).
    Sliding(DVec3),
    /// Lifted off: no force.
    Open,
    /// Pressed closed against what inertia says: the pressure that friction counts on (N).
    Closed(f64),
}

/// A contact has broken away if its friction exceeds mu N by this factor: mu is met no better than
/// to this.
const EXCESS_FACTOR: f64 = 1.02;

/// The step is solved again if the forces that should not be are at least this share of all normal
/// forces: less does not change how the cloth moves, and a second solution costs as much as the
/// first.
const EXCESS_SHARE: f64 = 2e-3;

/// A step is solved again at most so often: the second time brings the friction of the new pressure;
/// a third changes next to nothing.
pub(super) const CORRECTIONS_MAX: usize = 2;

impl System {
    /// The contacts that push in a step, each with its response at the velocities of the start and
    /// as it has been found so far.
    pub(super) fn found_responses<'a>(
        &self,
        state: &StepState,
        forces: &StepForces<'a>,
        dt: f64,
    ) -> Vec<(&'a ContactPoint, ContactResponse)> {
        let found = |(index, contact): (usize, &'a ContactPoint)| {
            let finding = *self.findings.get(index).unwrap_or(&Finding::AsTaken);
            Some((contact, self.response_as_found(contact, finding, state, forces, dt)?))
        };
        forces.contacts.iter().enumerate().filter_map(found).collect()
    }

    fn response_as_found(
        &self,
        contact: &ContactPoint,
        finding: Finding,
        state: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Option<ContactResponse> {
        let taken = || self.response(contact, state, forces, dt);
        match finding {
            Finding::AsTaken => taken(),
            Finding::Sliding(force) => Some(taken()?.with_friction(contact.normal, force)),
            Finding::Open => None,
            Finding::Closed(pressure) => {
                let velocity = contact.weighted_sum(&state.velocity);
                let mass = contact.effective_mass(&self.masses);
                Some(contact.closed_response(velocity, pressure, mass, dt))
            }
        }
    }

    /// A contact's response at the start of a step; `None` if it will be open.
    fn response(
        &self,
        contact: &ContactPoint,
        state: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Option<ContactResponse> {
        let velocity = contact.weighted_sum(&state.velocity);
        let mass = contact.effective_mass(&self.masses);
        // A contact between points of cloth falls as a whole.
        contact.response(velocity, forces.gravity * contact.weight_sum(), mass, dt)
    }

    /// Notes the contacts that the solution (`change`) finds torn or lifted off; true if the step
    /// should be solved again.
    pub(super) fn examine_contacts(
        &mut self,
        state: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> bool {
        let (mut excess, mut pressure) = (0.0, 0.0);
        let mut findings = vec![Finding::AsTaken; forces.contacts.len()];
        for (index, contact) in forces.contacts.iter().enumerate() {
            let before = *self.findings.get(index).unwrap_or(&Finding::AsTaken);
            let change = contact.weighted_sum(&self.change);
            let Some(response) = self.response_as_found(contact, before, state, forces, dt) else {
                let velocity = contact.weighted_sum(&state.velocity) + change;
                findings[index] = before;
                if before == Finding::AsTaken && contact.depth_after(velocity, dt) > 0.0 {
                    let force = self.closing_force(contact, velocity, dt);
                    excess += force;
                    findings[index] = Finding::Closed(force);
                }
                continue;
            };
            let force = response.force - response.tangent * change;
            let normal = force.dot(contact.normal);
            let held = force - contact.normal * normal;
            let limit = contact.friction * normal.max(0.0);
            pressure += normal.max(0.0);
            findings[index] = match before {
                _ if normal < 0.0 => {
                    excess -= normal;
                    Finding::Open
                }
                // The pressure it was given was that of the solution before.
                Finding::Sliding(friction) => {
                    excess += (friction.length() - limit).abs();
                    Finding::Sliding(friction.normalize_or_zero() * limit)
                }
                _ if contact.friction > 0.0 && held.length() > EXCESS_FACTOR * limit => {
                    excess += held.length() - limit;
                    match before {
                        Finding::Closed(_) => Finding::Closed(normal),
                        _ => Finding::Sliding(held.normalize_or_zero() * limit),
                    }
                }
                Finding::Closed(_) => Finding::Closed(normal),
                other => other,
            };
        }
        let again = excess > EXCESS_SHARE * pressure;
        if again {
            self.findings = findings;
        }
        again
    }

    /// What keeps a contact that a solution has passed from being passed (N): the penalty at the
    /// depth it reached, but no more than stops the contact point within the step.
    fn closing_force(&self, contact: &ContactPoint, velocity: DVec3, dt: f64) -> f64 {
        let depth = contact.depth_after(velocity, dt);
        let mass = contact.effective_mass(&self.masses);
        (contact.stiffness * depth).min(mass * depth / (dt * dt))
    }
}
