//! Where contact of cloth with cloth is of no use: around places where it passes through itself.

use super::crossings::Crossing;
use super::layers::Layers;
use crate::collision::topology::Topology;

/// Per node whether it, or a neighbour, belongs to an edge or face that crosses: as far as a contour
/// may move within a frame. `None` if nothing crosses.
pub(super) fn tangled_nodes(
    topology: &Topology,
    layers: &Layers,
    crossings: &[Crossing],
) -> Option<Vec<bool>> {
    if crossings.is_empty() {
        return None;
    }
    let mut tangled = vec![false; layers.node_count()];
    for crossing in crossings {
        let ends = topology.edges()[crossing.edge as usize].corners;
        let corners = topology.triangles()[crossing.face as usize];
        for node in ends.into_iter().chain(corners) {
            tangled[node as usize] = true;
            for &neighbour in layers.neighbours(node as usize) {
                tangled[neighbour as usize] = true;
            }
        }
    }
    Some(tangled)
}
