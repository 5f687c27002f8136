//! A triangle mesh which lives in two spaces: nodes in the world, vertices in the flat cloth.
//!
//! A vertex is a (node, material position) pair. A node on a seam or a dart has one vertex on each
//! side; the surface is connected through nodes, so a seam is an ordinary edge of the world mesh.
//! Connectivity is a corner table: each corner names the edge opposite to it and knows the corner
//! on the other side of that edge.

mod build;
mod check;
mod edit;
mod id;
mod measure;
mod order;
mod panels;
mod parts;
mod walk;

pub use build::{MeshError, RawMesh};
pub use check::Flaw;
pub use edit::{Collapse, CollapseRefusal, FlipRefusal, MeshEditor};
pub use id::{CornerId, FaceId, Id, IdVec, NodeId, VertexId};
pub use measure::{aspect_ratio, signed_area};
pub use panels::{Panel, Panels};
pub use parts::MeshParts;

use glam::{DVec2, DVec3};

use crate::math::SymTensor2;

/// One garment's mesh and the state it carries. Flat arrays; edited only through [`MeshEditor`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// World position per node (m).
    pub position: IdVec<NodeId, DVec3>,
    /// World velocity per node (m/s).
    pub velocity: IdVec<NodeId, DVec3>,
    /// Sizing tensor per vertex (1/m^2): the resolution asked for when the mesh was last remeshed.
    pub metric: IdVec<VertexId, SymTensor2>,
    /// View factor nu per face, 0..1: as it was when the mesh was last remeshed.
    pub view_factor: IdVec<FaceId, f64>,
    node_origin: IdVec<NodeId, NodeOrigin>,
    corner_of_node: IdVec<NodeId, CornerId>,
    node_of_vertex: IdVec<VertexId, NodeId>,
    material: IdVec<VertexId, DVec2>,
    vertices_of_face: IdVec<FaceId, [VertexId; 3]>,
    opposite: IdVec<CornerId, Option<CornerId>>,
    rest_angle: IdVec<CornerId, f64>,
}

/// Where a node comes from, and whether remeshing may take it away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeOrigin {
    /// Made by a split; may be collapsed away.
    Split,
    /// Node `index` of the garment's input, of no consequence to its shape; may be collapsed away.
    Input { index: u32 },
    /// Node `index` of the garment's input which is pinned, or shapes a boundary or a seam: stays.
    Kept { index: u32 },
}

impl NodeOrigin {
    /// The node's index in the garment's input.
    pub fn input_index(self) -> Option<u32> {
        match self {
            NodeOrigin::Split => None,
            NodeOrigin::Input { index } | NodeOrigin::Kept { index } => Some(index),
        }
    }

    pub fn is_kept(self) -> bool {
        matches!(self, NodeOrigin::Kept { .. })
    }
}

impl Mesh {
    pub fn node_count(&self) -> usize {
        self.position.len()
    }

    pub fn vertex_count(&self) -> usize {
        self.material.len()
    }

    pub fn face_count(&self) -> usize {
        self.vertices_of_face.len()
    }

    pub fn node_ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + ExactSizeIterator + use<> {
        self.position.ids()
    }

    pub fn vertex_ids(
        &self,
    ) -> impl DoubleEndedIterator<Item = VertexId> + ExactSizeIterator + use<> {
        self.material.ids()
    }

    pub fn face_ids(&self) -> impl DoubleEndedIterator<Item = FaceId> + ExactSizeIterator + use<> {
        self.vertices_of_face.ids()
    }

    /// The material position of a vertex (m).
    pub fn material(&self, vertex: VertexId) -> DVec2 {
        self.material[vertex]
    }

    pub fn node_of(&self, vertex: VertexId) -> NodeId {
        self.node_of_vertex[vertex]
    }

    /// The world position of a vertex's node (m).
    pub fn vertex_position(&self, vertex: VertexId) -> DVec3 {
        self.position[self.node_of_vertex[vertex]]
    }

    /// Counter-clockwise in material space.
    pub fn face_vertices(&self, face: FaceId) -> [VertexId; 3] {
        self.vertices_of_face[face]
    }

    pub fn face_nodes(&self, face: FaceId) -> [NodeId; 3] {
        self.vertices_of_face[face].map(|v| self.node_of_vertex[v])
    }

    pub fn node_origin(&self, node: NodeId) -> NodeOrigin {
        self.node_origin[node]
    }

    /// The dihedral angle at which the edge opposite to the corner stores no bending energy (rad).
    pub fn rest_angle(&self, corner: CornerId) -> f64 {
        self.rest_angle[corner]
    }

    /// The first position or velocity that is not a finite number.
    pub fn non_finite_node(&self) -> Option<NodeId> {
        self.node_ids().find(|&n| !(self.position[n].is_finite() && self.velocity[n].is_finite()))
    }
}

#[cfg(test)]
mod tests;
