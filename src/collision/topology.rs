//! Which corners and edges triangles share, and which triangle answers for each.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Triangles and the edges between them.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    triangles: Vec<[u32; 3]>,
    edges: Vec<Edge>,
    /// Per triangle and corner, the edge opposite to the corner.
    edge_of: Vec<[u32; 3]>,
    owned: Vec<Owned>,
}

/// An edge and the first two triangles at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    pub corners: [u32; 2],
    pub first: Side,
    /// `None` at the boundary of an open surface.
    pub second: Option<Side>,
}

/// A triangle at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    pub triangle: u32,
    /// The corner opposite to the edge.
    pub opposite: u32,
}

/// Which of its corners, and of the edges opposite to them, a triangle answers for: of those
/// that several triangles share, one does, so that no pair of features is tested twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Owned {
    pub corner: [bool; 3],
    pub edge: [bool; 3],
}

impl Topology {
    pub fn new(triangles: Vec<[u32; 3]>) -> Self {
        let mut topology = Self { triangles, ..Self::default() };
        let corner_count = topology.triangles.iter().flatten().max().map_or(0, |&c| c as usize + 1);
        let mut has_owner = vec![false; corner_count];
        let mut known: HashMap<(u32, u32), u32> = HashMap::new();
        for (index, corners) in topology.triangles.iter().enumerate() {
            let mut owned = Owned::default();
            let mut edges = [0; 3];
            for k in 0..3 {
                owned.corner[k] = !std::mem::replace(&mut has_owner[corners[k] as usize], true);
                let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
                let side = Side { triangle: index as u32, opposite: corners[k] };
                match known.entry((a.min(b), a.max(b))) {
                    Entry::Vacant(place) => {
                        edges[k] = *place.insert(topology.edges.len() as u32);
                        owned.edge[k] = true;
                        topology.edges.push(Edge { corners: [a, b], first: side, second: None });
                    }
                    Entry::Occupied(place) => {
                        edges[k] = *place.get();
                        topology.edges[edges[k] as usize].second.get_or_insert(side);
                    }
                }
            }
            topology.owned.push(owned);
            topology.edge_of.push(edges);
        }
        topology
    }

    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Per corner of a triangle, the number of the edge opposite to it.
    pub fn edges_of(&self, triangle: u32) -> [u32; 3] {
        self.edge_of[triangle as usize]
    }

    pub fn owned(&self, triangle: u32) -> Owned {
        self.owned[triangle as usize]
    }

    /// The corners that a triangle answers for.
    pub fn owned_corners(&self, triangle: u32) -> impl Iterator<Item = u32> + use<> {
        let (corners, owned) = (self.triangles[triangle as usize], self.owned(triangle));
        (0..3).filter(move |&k| owned.corner[k]).map(move |k| corners[k])
    }

    /// The edges that a triangle answers for.
    pub fn owned_edges(&self, triangle: u32) -> impl Iterator<Item = u32> + use<> {
        let (edges, owned) = (self.edges_of(triangle), self.owned(triangle));
        (0..3).filter(move |&k| owned.edge[k]).map(move |k| edges[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_and_edge_of_a_tetrahedron_has_one_owner_and_two_sides() {
        let topology = Topology::new(vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let mut corners: Vec<u32> = (0..4).flat_map(|t| topology.owned_corners(t)).collect();
        let mut edges: Vec<u32> = (0..4).flat_map(|t| topology.owned_edges(t)).collect();
        corners.sort_unstable();
        edges.sort_unstable();
        assert_eq!((corners, edges), (vec![0, 1, 2, 3], vec![0, 1, 2, 3, 4, 5]));
        for edge in topology.edges() {
            let second = edge.second.expect("it is closed");
            let mut all = [edge.corners[0], edge.corners[1], edge.first.opposite, second.opposite];
            all.sort_unstable();
            assert_eq!(all, [0, 1, 2, 3]);
        }
    }

    #[test]
    fn a_lone_triangle_owns_what_it_has_and_its_edges_have_one_side() {
        let topology = Topology::new(vec![[4, 7, 5]]);
        assert_eq!(topology.owned(0), Owned { corner: [true; 3], edge: [true; 3] });
        assert!(topology.edges().iter().all(|e| e.second.is_none()));
        assert_eq!(topology.edges()[topology.edges_of(0)[1] as usize].corners, [5, 4]);
    }
}
