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
}

/// A contact has broken away if its friction exceeds mu N by this factor: below, the linearisation
/// is corrected by the next step.
const EXCESS_FACTOR: f64 = 1.15;

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
            let response = self.response(contact, state, forces, dt)?;
            match self.findings.get(index).unwrap_or(&Finding::AsTaken) {
                Finding::AsTaken => Some((contact, response)),
                Finding::Sliding(force) => {
                    Some((contact, response.with_friction(contact.normal, *force)))
                }
                Finding::Open => None,
            }
        };
        forces.contacts.iter().enumerate().filter_map(found).collect()
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
        let weight_sum: f64 = contact.weights().map(|(_, weight)| weight).sum();
        contact.response(velocity, forces.gravity * weight_sum, mass, dt)
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
            let Some(response) = self.response(contact, state, forces, dt) else { continue };
            let change = contact.weighted_sum(&self.change);
            let force = response.force - response.tangent * change;
            let normal = force.dot(contact.normal);
            let held = force - contact.normal * normal;
            let limit = contact.friction * normal.max(0.0);
            pressure += normal.max(0.0);
            findings[index] = match self.findings.get(index).unwrap_or(&Finding::AsTaken) {
                Finding::Open => Finding::Open,
                _ if normal < 0.0 => {
                    excess -= normal;
                    Finding::Open
                }
                // The pressure it was given was that of the solution before.
                Finding::Sliding(friction) => {
                    excess += (friction.length() - limit).abs();
                    Finding::Sliding(friction.normalize_or_zero() * limit)
                }
                Finding::AsTaken
                    if contact.friction > 0.0 && held.length() > EXCESS_FACTOR * limit =>
                {
                    excess += held.length() - limit;
                    Finding::Sliding(held.normalize_or_zero() * limit)
                }
                Finding::AsTaken => Finding::AsTaken,
            };
        }
        let again = excess > EXCESS_SHARE * pressure;
        if again {
            self.findings = findings;
        }
        again
    }
}
