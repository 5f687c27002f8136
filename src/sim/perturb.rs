//! A start that differs by a hair: what grows from it is chaos and no error of the method.

use glam::DVec3;

use super::Simulation;

impl Simulation {
    /// Moves every node by the scene's perturbation, each in a direction of its own: that of its
    /// number, the same in every run.
    pub(super) fn perturb(&mut self) {
        let length = self.scene.start_perturbation;
        if length == 0.0 {
            return;
        }
        for (node, position) in (0..).zip(&mut self.cloth.state.position) {
            *position += direction(node) * length;
        }
        self.cloth.write_back(&mut self.garments);
    }
}

/// A unit vector that looks random and depends on the number alone.
fn direction(number: u64) -> DVec3 {
    let coordinate =
        |axis| 2.0 * (scrambled(3 * number + axis) >> 11) as f64 * 2f64.powi(-53) - 1.0;
    DVec3::new(coordinate(0), coordinate(1), coordinate(2)).try_normalize().unwrap_or(DVec3::Z)
}

/// The finaliser of splitmix64, which is public domain.
fn scrambled(number: u64) -> u64 {
    let x = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
