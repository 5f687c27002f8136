//! What contours cut the layers into.

use glam::DVec3;

use super::point::CrossingPoint;
use crate::collision::topology::Topology;
use crate::math::DisjointSets;

/// A part counts as the smaller one if it has at most this share of the other's mass.
const SMALLER_SHARE: f64 = 0.8;

/// The parts of the cloth that are left when every edge that crosses a face is cut.
pub struct Regions {
    /// Per node.
    mass: Vec<f64>,
    region: Vec<usize>,
}

impl Regions {
    pub fn new(topology: &Topology, mass: &[f64], points: &[CrossingPoint]) -> Self {
        let mut is_cut = vec![false; topology.edges().len()];
        points.iter().for_each(|p| is_cut[p.crossing.edge as usize] = true);
        let mut sets = DisjointSets::new(mass.len());
        for (edge, _) in topology.edges().iter().zip(&is_cut).filter(|(_, cut)| !**cut) {
            sets.join(edge.corners[0] as usize, edge.corners[1] as usize);
        }
        let region: Vec<usize> = (0..mass.len()).map(|n| sets.root(n)).collect();
        let mut of_region = vec![0.0; mass.len()];
        for (node, &region) in region.iter().enumerate() {
            of_region[region] += mass[node];
        }
        Self { mass: region.iter().map(|&r| of_region[r]).collect(), region }
    }

    /// Unit, along the normal of the crossed face: which way the edge goes against it for the end that
    /// is in the smaller part of its layer to come back. `None` where neither part is, or the edge does
    /// not lead from one part to another.
    pub fn way_back(&self, point: &CrossingPoint) -> Option<DVec3> {
        let [start, end] = [point.nodes[0], point.nodes[1]];
        if self.region[start] == self.region[end] {
            return None;
        }
        // From the end that stays towards the end that comes back is out of the face on its side.
        if self.mass[start] < SMALLER_SHARE * self.mass[end] {
            Some(point.normal_towards_end())
        } else if self.mass[end] < SMALLER_SHARE * self.mass[start] {
            Some(-point.normal_towards_end())
        } else {
            None
        }
    }
}
