//! A guess of how a step ends.

use glam::DVec3;

use super::step::StepState;

/// Velocities tried for the end of a step, and the positions they lead to: x = x_0 + h v.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Iterate {
    pub position: Vec<DVec3>,
    pub velocity: Vec<DVec3>,
}

impl Iterate {
    /// Everything stands still where the step starts.
    pub fn at_start(start: &StepState) -> Self {
        let velocity = vec![DVec3::ZERO; start.velocity.len()];
        Self { position: start.position.clone(), velocity }
    }

    /// This iterate after a share of a change of its velocities.
    pub fn moved(&self, change: &[DVec3], share: f64, start: &StepState, dt: f64) -> Self {
        let velocity: Vec<DVec3> =
            self.velocity.iter().zip(change).map(|(v, dv)| *v + *dv * share).collect();
        let position = start.position.iter().zip(&velocity).map(|(x, v)| *x + *v * dt).collect();
        Self { position, velocity }
    }
}
