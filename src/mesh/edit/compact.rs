//! Closing the gaps that collapses leave.

use super::MeshEditor;
use crate::mesh::{CornerId, FaceId, Id, IdVec, Mesh, NodeId, VertexId};

impl MeshEditor {
    /// The mesh with everything removed gone, the order of the rest unchanged.
    pub fn finish(self) -> Mesh {
        let Self { mut mesh, face_removed, node_removed, vertex_removed, removed_faces } = self;
        if removed_faces == 0 {
            return mesh;
        }
        let new_node = Renumbering::<NodeId>::new(&node_removed);
        let new_vertex = Renumbering::<VertexId>::new(&vertex_removed);
        let new_face = Renumbering::<FaceId>::new(&face_removed);
        let new_corner = |c: CornerId| new_face.of(c.face()).corner(c.position());

        mesh.position.retain_by(|n| !node_removed[n.index()]);
        mesh.velocity.retain_by(|n| !node_removed[n.index()]);
        mesh.node_origin.retain_by(|n| !node_removed[n.index()]);
        mesh.corner_of_node.retain_by(|n| !node_removed[n.index()]);
        mesh.corner_of_node.iter_mut().for_each(|c| *c = new_corner(*c));

        mesh.metric.retain_by(|v| !vertex_removed[v.index()]);
        mesh.material.retain_by(|v| !vertex_removed[v.index()]);
        mesh.node_of_vertex.retain_by(|v| !vertex_removed[v.index()]);
        mesh.node_of_vertex.iter_mut().for_each(|n| *n = new_node.of(*n));

        mesh.view_factor.retain_by(|f| !face_removed[f.index()]);
        mesh.vertices_of_face.retain_by(|f| !face_removed[f.index()]);
        mesh.vertices_of_face.iter_mut().flatten().for_each(|v| *v = new_vertex.of(*v));
        mesh.rest_angle.retain_by(|c: CornerId| !face_removed[c.face().index()]);
        mesh.opposite.retain_by(|c: CornerId| !face_removed[c.face().index()]);
        mesh.opposite.iter_mut().for_each(|o| *o = o.map(new_corner));
        mesh
    }
}

/// Old ids to new ones.
struct Renumbering<I>(IdVec<I, I>);

impl<I: Id> Renumbering<I> {
    fn new(removed: &[bool]) -> Self {
        let mut next = 0;
        Self(
            removed
                .iter()
                .map(|&removed| {
                    let id = I::from_index(next);
                    next += usize::from(!removed);
                    id
                })
                .collect(),
        )
    }

    /// Meaningless for what has been removed.
    fn of(&self, old: I) -> I {
        self.0[old]
    }
}
