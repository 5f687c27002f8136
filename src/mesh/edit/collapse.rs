//! Collapse: an edge is shortened to nothing, and one of its nodes goes.

use super::MeshEditor;
use crate::mesh::{CornerId, FaceId, Id, NodeId, VertexId};

/// An edge and which of its ends goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Collapse {
    /// The edge is opposite to this corner.
    pub corner: CornerId,
    pub removed: NodeId,
    pub kept: NodeId,
}

/// Why an edge cannot be collapsed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CollapseRefusal {
    /// The node is pinned or gives the cloth its shape.
    Kept,
    /// A boundary node may only move along the boundary.
    LeavesBoundary,
    /// A seam node may only move along the seam.
    LeavesSeam,
    /// A node joined to both ends by edges, but not by a face of the edge: faces would fold over.
    Pinched,
    /// A face would remain without neighbours to take its edges over.
    Ear,
    /// The edge has a rest angle, which would be lost.
    Crease,
}

impl MeshEditor {
    /// The two ways to collapse the edge opposite to `corner`.
    pub fn collapses(&self, corner: CornerId) -> [Collapse; 2] {
        let [a, b] = self.mesh.edge_nodes(corner);
        [Collapse { corner, removed: a, kept: b }, Collapse { corner, removed: b, kept: a }]
    }

    /// Whether topology allows the collapse.
    ///
    /// # Errors
    /// The reason why not.
    pub fn check_collapse(&self, collapse: Collapse) -> Result<(), CollapseRefusal> {
        let mesh = &self.mesh;
        let Collapse { corner, removed, kept } = collapse;
        if mesh.node_origin[removed].is_kept() {
            return Err(CollapseRefusal::Kept);
        }
        if mesh.is_boundary_node(removed) && !mesh.is_boundary(corner) {
            return Err(CollapseRefusal::LeavesBoundary);
        }
        if mesh.is_seam_node(removed) && !mesh.is_seam(corner) {
            return Err(CollapseRefusal::LeavesSeam);
        }
        let sides = [Some(corner), mesh.opposite(corner)];
        for side in sides.into_iter().flatten() {
            if mesh.is_boundary(side.next()) && mesh.is_boundary(side.previous()) {
                return Err(CollapseRefusal::Ear);
            }
        }
        if mesh.corners_around(removed).any(|c| mesh.rest_angle[c.next()] != 0.0) {
            return Err(CollapseRefusal::Crease);
        }
        let tips = sides.map(|side| side.map(|c| mesh.node_at(c)));
        let pinched = mesh.neighbours(removed).any(|n| {
            n != kept && !tips.contains(&Some(n)) && mesh.neighbours(kept).any(|m| m == n)
        });
        if pinched { Err(CollapseRefusal::Pinched) } else { Ok(()) }
    }

    /// For each vertex of the removed node the vertex of the kept node that takes its place: as the
    /// faces on either side of the edge see them.
    pub fn replacements(&self, collapse: Collapse) -> [Option<(VertexId, VertexId)>; 2] {
        let pair = |corner: CornerId| {
            let [i, j] = self.mesh.edge_vertices(corner);
            if self.mesh.node_of(i) == collapse.removed { (i, j) } else { (j, i) }
        };
        let first = pair(collapse.corner);
        let second = self.mesh.opposite(collapse.corner).map(pair).filter(|p| *p != first);
        [Some(first), second]
    }

    /// The corners at the removed node whose faces stay.
    pub fn moved_corners(&self, collapse: Collapse) -> impl Iterator<Item = CornerId> + '_ {
        let gone =
            [Some(collapse.corner.face()), self.mesh.opposite(collapse.corner).map(CornerId::face)];
        self.mesh.corners_around(collapse.removed).filter(move |c| !gone.contains(&Some(c.face())))
    }

    /// Collapses the edge. The kept node's state is unchanged.
    ///
    /// # Errors
    /// As [`check_collapse`](Self::check_collapse); the mesh is then unchanged.
    pub fn collapse(&mut self, collapse: Collapse) -> Result<(), CollapseRefusal> {
        self.check_collapse(collapse)?;
        let replacements = self.replacements(collapse);
        let moved: Vec<CornerId> = self.moved_corners(collapse).collect();
        let sides = [Some(collapse.corner), self.mesh.opposite(collapse.corner)];
        for &corner in &moved {
            let old = self.mesh.vertex_at(corner);
            let new = replacements.iter().flatten().find(|(from, _)| *from == old);
            let (_, new) = new.expect("a node off the seam has one vertex, one on it two");
            self.mesh.vertices_of_face[corner.face()][corner.position()] = *new;
        }
        for side in sides.into_iter().flatten() {
            self.close_face(side, collapse);
        }
        self.mesh.corner_of_node[collapse.kept] =
            *moved.first().expect("a node that may go has more faces than the edge's two");
        self.node_removed[collapse.removed.index()] = true;
        for (old, _) in replacements.into_iter().flatten() {
            self.vertex_removed[old.index()] = true;
        }
        Ok(())
    }

    /// Removes the face at `corner` and joins what lies behind its two other edges.
    fn close_face(&mut self, corner: CornerId, collapse: Collapse) {
        let next_goes = self.mesh.node_at(corner.next()) == collapse.removed;
        let (at_removed, at_kept) = if next_goes {
            (corner.next(), corner.previous())
        } else {
            (corner.previous(), corner.next())
        };
        let tip = self.mesh.node_at(corner);
        let beyond_kept_edge = self.edge_state(at_removed);
        let beyond_removed_edge = self.mesh.opposite(at_kept);
        match (beyond_removed_edge, beyond_kept_edge.0) {
            (Some(outer), _) => self.take_edge(outer, beyond_kept_edge),
            (None, Some(inner)) => self.mesh.opposite[inner] = None,
            (None, None) => unreachable!("an ear is refused"),
        }
        let survivor = beyond_removed_edge.or(beyond_kept_edge.0).map(CornerId::face);
        let face = survivor.expect("an ear is refused");
        self.mesh.corner_of_node[tip] = self.corner_at(face, tip);
        self.remove_face(corner.face());
    }

    fn corner_at(&self, face: FaceId, node: NodeId) -> CornerId {
        let corner = face.corners().into_iter().find(|c| self.mesh.node_at(*c) == node);
        corner.expect("the face beside an edge has the edge's nodes")
    }

    fn remove_face(&mut self, face: FaceId) {
        self.face_removed[face.index()] = true;
        self.removed_faces += 1;
    }
}
