//! Flip: an edge is replaced by the other diagonal of its two faces.

use super::MeshEditor;
use crate::mesh::{CornerId, FaceId, Mesh, signed_area};

/// Why an edge cannot be flipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlipRefusal {
    /// The edge has one face only.
    Boundary,
    /// The two faces do not lie side by side in the flat cloth.
    Seam,
    /// The edge has a rest angle that no other edge could take over.
    Crease,
    /// The other diagonal exists already.
    Occupied,
    /// A new face would have no area in material space.
    NotConvex,
}

impl MeshEditor {
    /// Whether topology and material space allow the edge opposite to `corner` to be flipped.
    ///
    /// # Errors
    /// The reason why not.
    pub fn check_flip(&self, corner: CornerId) -> Result<(), FlipRefusal> {
        let mesh = &self.mesh;
        let other = mesh.opposite(corner).ok_or(FlipRefusal::Boundary)?;
        if mesh.is_seam(corner) {
            return Err(FlipRefusal::Seam);
        }
        if mesh.rest_angle[corner] != 0.0 {
            return Err(FlipRefusal::Crease);
        }
        let [a, b, p, q] = mesh.diamond(corner, other).map(|v| mesh.material(v));
        let least = AREA_SHARE_MIN * (signed_area([p, a, b]) + signed_area([q, b, a]));
        if signed_area([p, a, q]) <= least || signed_area([q, b, p]) <= least {
            return Err(FlipRefusal::NotConvex);
        }
        if mesh.edge_between(mesh.node_at(corner), mesh.node_at(other)).is_some() {
            return Err(FlipRefusal::Occupied);
        }
        Ok(())
    }

    /// Flips the edge opposite to `corner`. Afterwards the new edge is opposite to `corner.next()`.
    /// Both faces take the larger view factor.
    ///
    /// # Errors
    /// As [`check_flip`](Self::check_flip); the mesh is then unchanged.
    pub fn flip(&mut self, corner: CornerId) -> Result<(), FlipRefusal> {
        self.check_flip(corner)?;
        let other = self.mesh.opposite(corner).ok_or(FlipRefusal::Boundary)?;
        let [a, b, p, q] = self.mesh.diamond(corner, other);
        let (beyond_bp, beyond_aq) =
            (self.edge_state(corner.next()), self.edge_state(other.next()));

        self.mesh.vertices_of_face[corner.face()][corner.previous().position()] = q;
        self.mesh.vertices_of_face[other.face()][other.previous().position()] = p;
        self.take_edge(corner, beyond_aq);
        self.take_edge(other, beyond_bp);
        self.link(corner.next(), Some(other.next()));
        self.mesh.rest_angle[corner.next()] = 0.0;
        self.mesh.rest_angle[other.next()] = 0.0;

        for (vertex, old, new) in
            [(a, other.previous(), corner.next()), (b, corner.previous(), other.next())]
        {
            let node = self.mesh.node_of_vertex[vertex];
            if self.mesh.corner_of_node[node] == old {
                self.mesh.corner_of_node[node] = new;
            }
        }
        self.share_view_factor(corner.face(), other.face());
        Ok(())
    }

    fn share_view_factor(&mut self, a: FaceId, b: FaceId) {
        let larger = self.mesh.view_factor[a].max(self.mesh.view_factor[b]);
        self.mesh.view_factor[a] = larger;
        self.mesh.view_factor[b] = larger;
    }
}

/// The least share of a diamond's area that a flipped face may have: slimmer faces are numerically
/// flat.
const AREA_SHARE_MIN: f64 = 1e-6;

impl Mesh {
    /// The vertices around an edge which is not a seam: its ends a, b, then the tips p at `corner`
    /// and q at `other`.
    pub(crate) fn diamond(&self, corner: CornerId, other: CornerId) -> [super::super::VertexId; 4] {
        let [a, b] = self.edge_vertices(corner);
        [a, b, self.vertex_at(corner), self.vertex_at(other)]
    }
}
