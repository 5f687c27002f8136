//! Contacts that are not what they were taken for within a step.
//!
//! Friction is linearised about the slip at the start of the step. A point that sticks there may be
//! torn off by forces far beyond mu N: linearised sticking would hold it all the same, and give way
//! only over many steps. A penalty is closed if inertia closes it, and would pull where the cloth
//! lifts off. After a solution such contacts are found, and the step is solved again with the
//! friction they really have, mu N against their slip, or without them.

use glam::DVec3;

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
    /// Notes the contacts that the solution (velocity changes in the right side) finds torn or
    /// lifted off; true if the step should be solved again.
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
            let change = contact.weighted_sum(&self.right_side);
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
