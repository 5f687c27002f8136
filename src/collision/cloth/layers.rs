//! What contact of cloth with cloth needs to know of the garments: made once per topology.

use glam::{DVec2, DVec3};

use super::pairs::ClothPair;
use crate::collision::topology::{Edge, Topology};
use crate::mesh::{Mesh, Panels};

/// Features that are next to one another in the flat cloth are held off by this share of their
/// distance there at most: a fold may close on itself, and flat cloth is at ease.
const SHARE_OF_FLAT_DISTANCE: f64 = 0.5;

/// Features that an edge joins are held off by this share of the contact thickness at most: across a
/// seam, also of a panel with itself, their distance along the cloth is not that in the flat cloth.
const SHARE_OF_JOINED: f64 = 0.1;

/// Features touch from this share of the least height of their triangles in the flat cloth on, where
/// that is finer than the touch of all cloth: the sides of a sliver are no passage.
const TOUCH_IN_HEIGHTS: f64 = 0.25;

/// All garments' faces in one numbering, in the flat cloth and as neighbours.
pub struct Layers {
    /// Per face (m, flat cloth).
    material: Vec<[DVec2; 3]>,
    /// Per face, in a numbering over all garments.
    panel: Vec<u32>,
    /// Per node its neighbours: `neighbour[first[n]..first[n + 1]]`, ascending.
    first: Vec<u32>,
    neighbour: Vec<u32>,
    /// Per node the least height of the triangles around it (m, flat cloth).
    height: Vec<f64>,
}

impl Layers {
    /// The topology is that of all garments, in their order.
    pub fn new(garments: &[Mesh], topology: &Topology, node_count: usize) -> Self {
        let (mut material, mut panel) = (Vec::new(), Vec::new());
        let mut panel_count = 0;
        for mesh in garments {
            let panels = Panels::of(mesh);
            material.extend(mesh.face_ids().map(|f| mesh.face_material(f)));
            panel.extend(mesh.face_ids().map(|f| (panel_count + panels.of_face(f)) as u32));
            panel_count += panels.count();
        }
        let (first, neighbour) = neighbours(topology, node_count);
        let height = heights(&material, topology, node_count);
        Self { material, panel, first, neighbour, height }
    }

    /// The distance at which features with these nodes touch (m), given that of all cloth.
    pub(super) fn touch(&self, nodes: [usize; 4], touch: f64) -> f64 {
        let least = nodes.iter().map(|&n| self.height[n]).fold(f64::INFINITY, f64::min);
        touch.min(TOUCH_IN_HEIGHTS * least)
    }

    /// How far a pair is held apart (m), given the thickness of contact and the weights of the
    /// points that are nearest to one another.
    pub(super) fn thickness(
        &self,
        pair: ClothPair,
        nodes: [usize; 4],
        weights: [f64; 4],
        thickness: f64,
    ) -> f64 {
        let (one, other) = pair.split(nodes);
        let is_joined = one.iter().any(|&a| other.iter().any(|&b| self.are_neighbours(a, b)));
        let thickness = if is_joined { SHARE_OF_JOINED * thickness } else { thickness };
        let [a, b] = pair.faces().map(|f| self.panel[f]);
        if a != b {
            return thickness;
        }
        let flat: DVec2 = (0..4).map(|k| self.material_at(pair.corners[k]) * weights[k]).sum();
        thickness.min(SHARE_OF_FLAT_DISTANCE * flat.length())
    }

    /// Of every edge of the topology in the flat cloth, by the first face at it (m).
    pub fn flat_lengths(&self, topology: &Topology) -> Vec<f64> {
        let of = |(number, edge): (usize, &Edge)| {
            let face = edge.first.triangle;
            let opposite = topology.edges_of(face).iter().position(|&e| e as usize == number);
            let k = opposite.unwrap_or(0);
            let corners = self.material[face as usize];
            corners[(k + 1) % 3].distance(corners[(k + 2) % 3])
        };
        topology.edges().iter().enumerate().map(of).collect()
    }

    pub(super) fn node_count(&self) -> usize {
        self.first.len() - 1
    }

    /// The nodes that a node shares an edge with, ascending.
    pub(super) fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbour[self.first[node] as usize..self.first[node + 1] as usize]
    }

    fn material_at(&self, corner: u32) -> DVec2 {
        self.material[corner as usize / 3][corner as usize % 3]
    }

    fn are_neighbours(&self, a: usize, b: usize) -> bool {
        self.neighbours(a).binary_search(&(b as u32)).is_ok()
    }
}

/// Twice the area over the longest edge, the least of each node's triangles.
fn heights(material: &[[DVec2; 3]], topology: &Topology, node_count: usize) -> Vec<f64> {
    let mut heights = vec![f64::INFINITY; node_count];
    for (&[a, b, c], nodes) in material.iter().zip(topology.triangles()) {
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = (b - a).perp_dot(c - a).abs() / longest.max(f64::MIN_POSITIVE);
        for &node in nodes {
            let least = &mut heights[node as usize];
            *least = least.min(height);
        }
    }
    heights
}

fn neighbours(topology: &Topology, node_count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut pairs: Vec<[u32; 2]> =
        topology.edges().iter().flat_map(|e| [e.corners, [e.corners[1], e.corners[0]]]).collect();
    pairs.sort_unstable();
    let mut first = vec![0; node_count + 1];
    for [a, _] in &pairs {
        first[*a as usize + 1] += 1;
    }
    for node in 0..node_count {
        first[node + 1] += first[node];
    }
    (first, pairs.into_iter().map(|[_, b]| b).collect())
}

/// The weighted sum of the four points of a pair.
pub(super) fn weighted(values: &[DVec3], nodes: [usize; 4], weights: [f64; 4]) -> DVec3 {
    (0..4).map(|k| values[nodes[k]] * weights[k]).sum()
}
