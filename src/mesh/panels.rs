//! The pieces that a garment is cut from: faces that hang together in the flat cloth.
//!
//! Pieces may lie over one another in the flat cloth, so that a material position alone does not
//! name a point. Remeshing keeps the nodes which give a piece its shape, with their index in the
//! garment's input: they tell which piece of one mesh is which of another.

use super::{FaceId, Id, IdVec, Mesh, VertexId};
use crate::math::DisjointSets;

/// One of a garment's pieces, counted from 0.
pub type Panel = usize;

/// What names a piece in every mesh of a garment: the first node of its outline in the input, and
/// where in the flat cloth it lies there.
type Key = (u32, [u64; 2]);

/// Which face belongs to which piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Panels {
    of_face: IdVec<FaceId, Panel>,
    /// Per piece; ascending, pieces without an outline last.
    keys: Vec<Option<Key>>,
}

impl Panels {
    pub fn of(mesh: &Mesh) -> Self {
        let roots = roots(mesh);
        let mut first_key: IdVec<VertexId, Option<Key>> = IdVec::filled(None, roots.len());
        for vertex in mesh.vertex_ids() {
            let origin = mesh.node_origin(mesh.node_of(vertex));
            let Some(index) = origin.input_index().filter(|_| origin.is_kept()) else { continue };
            let key = (index, mesh.material(vertex).to_array().map(f64::to_bits));
            let first = &mut first_key[roots[vertex]];
            *first = Some(first.map_or(key, |first| first.min(key)));
        }
        let mut order: Vec<VertexId> = mesh.vertex_ids().filter(|&v| roots[v] == v).collect();
        order.sort_by_key(|&root| (first_key[root].is_none(), first_key[root], root));
        let mut panel_of_root = IdVec::filled(0, roots.len());
        for (panel, &root) in order.iter().enumerate() {
            panel_of_root[root] = panel;
        }
        let panel_of = |face| panel_of_root[roots[mesh.face_vertices(face)[0]]];
        Self {
            of_face: mesh.face_ids().map(panel_of).collect(),
            keys: order.iter().map(|&root| first_key[root]).collect(),
        }
    }

    pub fn of_face(&self, face: FaceId) -> Panel {
        self.of_face[face]
    }

    pub fn count(&self) -> usize {
        self.keys.len()
    }

    /// True if a piece of one is the piece of the other with the same number. Meshes of one piece
    /// need not come from the same input.
    pub fn agree_with(&self, other: &Self) -> bool {
        self.keys == other.keys || (self.count() == 1 && other.count() == 1)
    }
}

/// Per vertex a vertex that stands for its piece: the same for all that faces join.
fn roots(mesh: &Mesh) -> IdVec<VertexId, VertexId> {
    let mut pieces = DisjointSets::new(mesh.vertex_count());
    for face in mesh.face_ids() {
        let [a, b, c] = mesh.face_vertices(face).map(VertexId::index);
        pieces.join(a, b);
        pieces.join(a, c);
    }
    mesh.vertex_ids().map(|v| VertexId::from_index(pieces.root(v.index()))).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::mesh::RawMesh;

    /// Two triangles over the same piece of the plane, sewn along one edge; `swapped` lists them in
    /// the other order.
    fn sewn(swapped: bool) -> Mesh {
        let mut faces = vec![[0, 1, 2], [3, 4, 5]];
        if swapped {
            faces.reverse();
        }
        let raw = RawMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.3)],
            vertices: vec![
                (0, DVec2::ZERO),
                (1, DVec2::X),
                (2, DVec2::Y),
                (1, DVec2::ZERO),
                (3, DVec2::X),
                (2, DVec2::Y),
            ],
            faces,
            ..RawMesh::default()
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    #[test]
    fn a_seam_parts_the_flat_cloth() {
        let mesh = sewn(false);
        let panels = Panels::of(&mesh);
        assert_eq!(panels.count(), 2);
        let faces: Vec<FaceId> = mesh.face_ids().collect();
        assert_ne!(panels.of_face(faces[0]), panels.of_face(faces[1]));
    }

    #[test]
    fn pieces_have_the_same_number_whatever_the_order_of_faces() {
        let (mesh, swapped) = (sewn(false), sewn(true));
        let (a, b) = (Panels::of(&mesh), Panels::of(&swapped));
        assert!(a.agree_with(&b));
        let faces: Vec<FaceId> = mesh.face_ids().collect();
        assert_eq!(a.of_face(faces[0]), b.of_face(faces[1]));
    }
}
