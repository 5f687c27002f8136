//! A start that differs by a hair: what grows from it is chaos and no error of the method.

use glam::DVec3;

use super::Simulation;
use crate::math::Random;

impl Simulation {
    /// Moves every node by the scene's perturbation, each in a direction of its own, the same in
    /// every run.
    pub(super) fn perturb(&mut self) {
        let length = self.scene.start_perturbation;
        if length == 0.0 {
            return;
        }
        let mut random = Random::new(0);
        for position in &mut self.cloth.state.position {
            *position += random.vector().try_normalize().unwrap_or(DVec3::Z) * length;
        }
        self.cloth.write_back(&mut self.garments);
    }
}
