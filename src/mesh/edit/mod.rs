//! Local edits: split, collapse, flip. Each keeps connectivity whole and carries all state.
//!
//! While a mesh is edited, what a collapse removes stays in the arrays and is only marked, so that
//! ids stay what they are; [`MeshEditor::finish`] closes the gaps.

mod collapse;
mod compact;
mod flip;
mod split;

pub use collapse::{Collapse, CollapseRefusal};
pub use flip::FlipRefusal;

use super::{CornerId, FaceId, Id, Mesh, NodeId};

/// Edits a mesh. The mesh is whole again after [`finish`](Self::finish).
pub struct MeshEditor {
    mesh: Mesh,
    face_removed: Vec<bool>,
    node_removed: Vec<bool>,
    vertex_removed: Vec<bool>,
    removed_faces: usize,
}

impl MeshEditor {
    pub fn new(mesh: Mesh) -> Self {
        Self {
            face_removed: vec![false; mesh.face_count()],
            node_removed: vec![false; mesh.node_count()],
            vertex_removed: vec![false; mesh.vertex_count()],
            removed_faces: 0,
            mesh,
        }
    }

    /// The mesh as it is now. Ids that are not [alive](Self::is_alive) must not be followed.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub fn is_alive(&self, face: FaceId) -> bool {
        !self.face_removed[face.index()]
    }

    pub fn is_node_alive(&self, node: NodeId) -> bool {
        !self.node_removed[node.index()]
    }

    /// Faces that are alive.
    pub fn face_count(&self) -> usize {
        self.mesh.face_count() - self.removed_faces
    }

    /// Every edge of the faces that are alive, named by one of its corners.
    pub fn edges(&self) -> impl Iterator<Item = CornerId> + '_ {
        self.mesh.edges().filter(|c| self.is_alive(c.face()))
    }

    fn link(&mut self, corner: CornerId, other: Option<CornerId>) {
        self.mesh.opposite[corner] = other;
        if let Some(other) = other {
            self.mesh.opposite[other] = Some(corner);
        }
    }

    /// Gives the edge opposite to `corner` the neighbour and the rest angle which the edge opposite
    /// to `from` had.
    fn take_edge(&mut self, corner: CornerId, (other, rest_angle): (Option<CornerId>, f64)) {
        self.link(corner, other);
        self.mesh.rest_angle[corner] = rest_angle;
    }

    fn edge_state(&self, corner: CornerId) -> (Option<CornerId>, f64) {
        (self.mesh.opposite[corner], self.mesh.rest_angle[corner])
    }
}
