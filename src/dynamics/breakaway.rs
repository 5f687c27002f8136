//! Contacts that broke away within a step.
//!
//! Friction is linearised about the slip at the start of the step. A point that sticks there may be
//! torn off by forces far beyond mu N: linearised sticking would hold it all the same, and give way
//! only over many steps. After the first solution such points are found, and the step is solved
//! again with the friction they really have, mu N against their slip.

use glam::DVec3;

use super::step::{StepForces, StepState};
use super::system::System;

/// A contact has broken away if its friction exceeds mu N by this factor: below, the linearisation
/// is corrected by the next step.
const EXCESS_FACTOR: f64 = 1.5;

/// The step is solved again if the friction in excess is at least this share of all mu N: less does
/// not change how the cloth moves, and a second solution costs as much as the first.
const EXCESS_SHARE: f64 = 0.02;

impl System {
    /// Notes the contacts that the solution (velocity changes in the right side) tears off; true
    /// if the step should be solved again.
    pub(super) fn note_breakaway(
        &mut self,
        state: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> bool {
        let (mut excess, mut available) = (0.0, 0.0);
        let mut broken = vec![None; forces.contacts.len()];
        for (contact, broken) in forces.contacts.iter().zip(&mut broken) {
            let Some(response) = self.response(contact, state, forces, dt) else { continue };
            let change = contact.weighted_sum(&self.right_side);
            let force = response.force - response.tangent * change;
            let limit = contact.friction * force.dot(contact.normal).max(0.0);
            let held = force - contact.normal * force.dot(contact.normal);
            available += limit;
            if held.length() > EXCESS_FACTOR * limit {
                excess += held.length() - limit;
                *broken = Some(held.normalize_or_zero() * limit);
            }
        }
        let again = excess > EXCESS_SHARE * available;
        if again {
            self.breakaway = broken;
        }
        again
    }

    /// All contacts stick or slip as they did before.
    pub(super) fn forget_breakaway(&mut self) {
        self.breakaway = Vec::<Option<DVec3>>::new();
    }
}
