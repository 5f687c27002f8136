//! Where cloth passes through cloth: edges through faces.

use glam::DVec3;
use rayon::prelude::*;

use crate::collision::face_tree::FaceTree;
use crate::collision::nearest::bounds;
use crate::collision::topology::Topology;
use crate::math::segment_passes_through;

/// An edge that passes through a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Crossing {
    /// Number of the edge in the topology of the tree.
    pub edge: u32,
    pub face: u32,
}

/// All crossings, in order of edges. The tree is fitted to the positions; features with a common
/// node do not cross. An edge that only touches a face, or lies in its plane, does not cross it.
pub fn crossings(tree: &FaceTree, positions: &[DVec3]) -> Vec<Crossing> {
    let topology = tree.topology();
    let of_edge = |edge: usize| {
        let ends = topology.edges()[edge].corners;
        let line = ends.map(|n| positions[n as usize]);
        let around = bounds(&line);
        let mut found: Vec<Crossing> = tree
            .faces_in(&around)
            .filter(|&face| {
                let nodes = topology.triangles()[face as usize];
                let has_common = ends.iter().any(|n| nodes.contains(n));
                !has_common && segment_passes_through(line, nodes.map(|n| positions[n as usize]))
            })
            .map(|face| Crossing { edge: edge as u32, face })
            .collect();
        found.sort_unstable();
        found
    };
    (0..topology.edges().len()).into_par_iter().with_min_len(256).flat_map_iter(of_edge).collect()
}

/// Pairs of faces of which an edge of one passes through the other, the smaller number first; in order,
/// each once. `found` are all crossings.
pub fn crossing_pairs(topology: &Topology, found: &[Crossing]) -> Vec<[u32; 2]> {
    let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(2 * found.len());
    for crossing in found {
        let edge = topology.edges()[crossing.edge as usize];
        for side in [Some(edge.first), edge.second].into_iter().flatten() {
            let (face, through) = (side.triangle, crossing.face);
            pairs.push([face.min(through), face.max(through)]);
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
