//! Springs that hold nodes, or lead them along.

use glam::DVec3;

/// A spring from a node to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandleSpring {
    /// Global number of the node.
    pub node: usize,
    /// Where the spring pulls the node to at the end of the step (m, world).
    pub target: DVec3,
    /// (N/m). 1e3 yields visibly to a garment's weight, 1e8 does not.
    pub stiffness: f64,
}

impl HandleSpring {
    /// f = k (target - x) (N).
    pub fn force(&self, position: DVec3) -> DVec3 {
        self.stiffness * (self.target - position)
    }

    /// W = 1/2 k |target - x|^2 (J).
    pub fn energy(&self, position: DVec3) -> f64 {
        0.5 * self.stiffness * self.target.distance_squared(position)
    }
}
