//! A mesh as plain arrays and back, bit for bit: what a stored state consists of.
//!
//! Connectivity is stored and not rebuilt: the order in which a rebuilt mesh would visit the
//! corners of a node may differ, and with it the last bit of every sum around the node.

use glam::{DVec2, DVec3};

use super::{CornerId, Id, IdVec, Mesh, MeshError, NodeId, NodeOrigin, VertexId};
use crate::math::SymTensor2;

/// Every array of a [`Mesh`]; ids are plain indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshParts {
    /// Per node (m), world.
    pub position: Vec<DVec3>,
    /// Per node (m/s), world.
    pub velocity: Vec<DVec3>,
    pub node_origin: Vec<NodeOrigin>,
    /// Per node the corner at which a walk around it starts.
    pub corner_of_node: Vec<u32>,
    pub node_of_vertex: Vec<u32>,
    /// Per vertex (m), flat cloth.
    pub material: Vec<DVec2>,
    /// Per vertex (1/m^2).
    pub metric: Vec<SymTensor2>,
    /// Per face its vertices, counter-clockwise in material space.
    pub vertices_of_face: Vec<[u32; 3]>,
    /// Per face, 0..1.
    pub view_factor: Vec<f64>,
    /// Per corner the corner across its edge, if there is a face.
    pub opposite: Vec<Option<u32>>,
    /// Per corner (rad).
    pub rest_angle: Vec<f64>,
}

impl Mesh {
    /// Memory that the arrays hold (bytes).
    pub fn memory(&self) -> usize {
        // Exhaustive, so that a new array cannot be forgotten here.
        let Self {
            position,
            velocity,
            metric,
            view_factor,
            node_origin,
            corner_of_node,
            node_of_vertex,
            material,
            vertices_of_face,
            opposite,
            rest_angle,
        } = self;
        size_of_val(position.as_slice())
            + size_of_val(velocity.as_slice())
            + size_of_val(metric.as_slice())
            + size_of_val(view_factor.as_slice())
            + size_of_val(node_origin.as_slice())
            + size_of_val(corner_of_node.as_slice())
            + size_of_val(node_of_vertex.as_slice())
            + size_of_val(material.as_slice())
            + size_of_val(vertices_of_face.as_slice())
            + size_of_val(opposite.as_slice())
            + size_of_val(rest_angle.as_slice())
    }

    pub fn to_parts(&self) -> MeshParts {
        // Exhaustive, so that a new array cannot be forgotten here.
        let Self {
            position,
            velocity,
            metric,
            view_factor,
            node_origin,
            corner_of_node,
            node_of_vertex,
            material,
            vertices_of_face,
            opposite,
            rest_angle,
        } = self;
        MeshParts {
            position: position.as_slice().to_vec(),
            velocity: velocity.as_slice().to_vec(),
            node_origin: node_origin.as_slice().to_vec(),
            corner_of_node: corner_of_node.iter().map(|&c| number(c)).collect(),
            node_of_vertex: node_of_vertex.iter().map(|&n| number(n)).collect(),
            material: material.as_slice().to_vec(),
            metric: metric.as_slice().to_vec(),
            vertices_of_face: vertices_of_face.iter().map(|f| f.map(number)).collect(),
            view_factor: view_factor.as_slice().to_vec(),
            opposite: opposite.iter().map(|o| o.map(number)).collect(),
            rest_angle: rest_angle.as_slice().to_vec(),
        }
    }

    /// The mesh that [`Mesh::to_parts`] took apart.
    ///
    /// # Errors
    /// [`MeshError::Flawed`] with the first flaw of a mesh that breaks an invariant.
    pub fn from_parts(parts: MeshParts) -> Result<Mesh, MeshError> {
        let MeshParts {
            position,
            velocity,
            node_origin,
            corner_of_node,
            node_of_vertex,
            material,
            metric,
            vertices_of_face,
            view_factor,
            opposite,
            rest_angle,
        } = parts;
        let mesh = Mesh {
            position: position.into(),
            velocity: velocity.into(),
            metric: metric.into(),
            view_factor: view_factor.into(),
            node_origin: node_origin.into(),
            corner_of_node: ids::<NodeId, CornerId>(corner_of_node),
            node_of_vertex: ids::<VertexId, NodeId>(node_of_vertex),
            material: material.into(),
            vertices_of_face: vertices_of_face.into_iter().map(|f| f.map(id)).collect(),
            opposite: opposite.into_iter().map(|o| o.map(id)).collect(),
            rest_angle: rest_angle.into(),
        };
        mesh.check().map_err(MeshError::Flawed)?;
        Ok(mesh)
    }
}

fn number(id: impl Id) -> u32 {
    u32::try_from(id.index()).expect("ids fit in 32 bits")
}

fn id<I: Id>(number: u32) -> I {
    I::from_index(number as usize)
}

fn ids<K, I: Id>(numbers: Vec<u32>) -> IdVec<K, I> {
    numbers.into_iter().map(id).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Flaw, RawMesh};

    /// Two panels sewn along an edge, so that two nodes have two vertices each.
    fn sewn_panels() -> Mesh {
        let raw = RawMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.3)],
            velocities: vec![DVec3::Z, DVec3::ZERO, DVec3::X, DVec3::Y],
            vertices: vec![
                (0, DVec2::ZERO),
                (1, DVec2::X),
                (2, DVec2::Y),
                (1, DVec2::new(3.0, 0.0)),
                (3, DVec2::new(4.0, 0.0)),
                (2, DVec2::new(3.0, 1.0)),
            ],
            faces: vec![[0, 1, 2], [3, 4, 5]],
            rest_angles: vec![([1, 2], 0.25)],
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    #[test]
    fn a_mesh_taken_apart_and_put_together_is_the_same() {
        let mesh = sewn_panels();
        assert_eq!(Mesh::from_parts(mesh.to_parts()).unwrap(), mesh);
    }

    #[test]
    fn parts_that_break_an_invariant_are_refused() {
        let mut far_corner = sewn_panels().to_parts();
        far_corner.opposite[0] = Some(99);
        assert!(matches!(
            Mesh::from_parts(far_corner),
            Err(MeshError::Flawed(Flaw::UnmatchedEdge { .. }))
        ));

        let mut short = sewn_panels().to_parts();
        short.rest_angle.pop();
        assert!(matches!(
            Mesh::from_parts(short),
            Err(MeshError::Flawed(Flaw::ArrayLength { name: "rest_angle", .. }))
        ));

        let mut far_node = sewn_panels().to_parts();
        far_node.node_of_vertex[2] = 7;
        assert!(Mesh::from_parts(far_node).is_err());
    }
}
