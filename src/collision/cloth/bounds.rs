//! How far every node may go from where it is so that cloth cannot touch cloth, wherever the others go
//! within theirs ([`CHLMYY25`](crate::papers::CHLMYY25)): what the search for impacts is held
//! against. The simulation does not use it; `docs/contact.md` says why.

use glam::DVec3;

use super::pairs::{ClothPairs, are_apart};
use crate::collision::continuous::{TOLERANCE_OF_SIZE_MIN, nearest, size};
use crate::collision::face_tree::FaceTree;

/// Share of the distance between two features that the nodes of each may go: less than half, or both
/// could meet in the middle. The paper's gamma_p.
const SHARE: f64 = 0.45;

/// Bounds on the ways of nodes from where they are.
pub struct WayBounds {
    pairs: ClothPairs,
    /// Per node (m).
    bound: Vec<f64>,
}

impl WayBounds {
    /// Lets nothing move yet.
    pub fn new(tree: &FaceTree, position: &[DVec3]) -> Self {
        let pairs = ClothPairs::new(position, tree.topology());
        Self { pairs, bound: vec![0.0; position.len()] }
    }

    /// Finds the bounds from where nodes are (m). The radius (m) is how far around its features each
    /// node looks, and the bound of one that finds nothing is a share of it.
    ///
    /// b_v = 0.45 min(r, d) with the least distance d from v to a face, from an edge at v to an edge
    /// or from a face at v to a node that have no node in common. Features that touch or cross, and
    /// those whose distance is no number, leave their nodes none.
    pub fn find(&mut self, tree: &FaceTree, position: &[DVec3], radius: f64) {
        let topology = tree.topology();
        self.pairs.find(topology, position, |_| DVec3::ZERO, 0.5 * radius);
        self.bound.clear();
        self.bound.resize(position.len(), SHARE * radius);
        for pair in self.pairs.found() {
            let nodes = pair.nodes(topology);
            let places = nodes.map(|n| position[n]);
            let largest = nodes.iter().map(|&n| self.bound[n]).fold(0.0, f64::max);
            // What is as far apart as this takes nothing from any of them.
            if are_apart(pair.features, places, places, largest / SHARE) {
                continue;
            }
            let distance = nearest(pair.features, places).distance;
            let slack = TOLERANCE_OF_SIZE_MIN * size(pair.features, places);
            let certain = if distance > slack { distance - slack } else { 0.0 };
            for node in nodes {
                self.bound[node] = self.bound[node].min(SHARE * certain);
            }
        }
    }

    /// Per node (m).
    pub fn by_node(&self) -> &[f64] {
        &self.bound
    }

    /// Pairs of features that were found near one another.
    pub fn pair_count(&self) -> usize {
        self.pairs.found().len()
    }

    /// Moves the nodes from where the bounds were found towards their ends (m), none by more than its
    /// bound, but for the mean way, which brings nothing together. Returns how many did not arrive.
    pub fn advance(&self, position: &mut [DVec3], ends: &[DVec3]) -> usize {
        let ways = position.iter().zip(ends).map(|(x, end)| *end - *x);
        let mean = ways.sum::<DVec3>() / position.len().max(1) as f64;
        let mut held = 0;
        for ((x, &end), &bound) in position.iter_mut().zip(ends).zip(&self.bound) {
            let way = end - *x - mean;
            let length = way.length();
            if length <= bound {
                *x = end;
            } else {
                *x += mean + way * (bound / length);
                held += 1;
            }
        }
        held
    }
}

#[cfg(test)]
#[path = "bounds_tests.rs"]
mod tests;
