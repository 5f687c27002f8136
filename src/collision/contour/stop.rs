//! Ends the motion against one another of what crosses.

use glam::DVec3;

use super::point::CrossingPoint;
use crate::collision::cloth::Crossing;
use crate::collision::topology::Topology;

/// Where an edge passes through a face, both points get the same velocity (m/s), by the least change
/// of their nodes for their masses (kg): momentum is kept, energy lost. One crossing after the other.
pub fn stop_at_crossings(
    topology: &Topology,
    positions: &[DVec3],
    velocities: &mut [DVec3],
    mass: &[f64],
    found: &[Crossing],
) {
    for point in found.iter().filter_map(|&c| CrossingPoint::of(topology, positions, c)) {
        let relative: DVec3 = (0..5).map(|k| velocities[point.nodes[k]] * point.weights[k]).sum();
        for (k, share) in point.shares(mass).into_iter().enumerate() {
            velocities[point.nodes[k]] -= relative * share;
        }
    }
}
