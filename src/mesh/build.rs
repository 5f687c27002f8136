//! From lists of points and triangles to a mesh with connectivity, or to the reason why not.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::{CornerId, Flaw, Id, IdVec, Mesh, NodeId, NodeOrigin, VertexId, measure};
use crate::math::SymTensor2;

/// Material areas below this (m^2) cannot carry a deformation gradient in double precision.
const FACE_AREA_MIN: f64 = 1e-14;

/// A mesh as files give it. Indices count from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawMesh {
    /// World positions of the nodes (m).
    pub positions: Vec<DVec3>,
    /// World velocities of the nodes (m/s); empty means at rest.
    pub velocities: Vec<DVec3>,
    /// Per vertex its node and its material position (m).
    pub vertices: Vec<(u32, DVec2)>,
    /// Vertices of each triangle, counter-clockwise in material space.
    pub faces: Vec<[u32; 3]>,
    /// Rest angles of edges by their two nodes (rad); edges not named rest flat.
    pub rest_angles: Vec<([u32; 2], f64)>,
}

/// Why a list of triangles is not a mesh this program can simulate. Indices count from 0.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshError {
    #[error("the mesh has no faces")]
    Empty,
    #[error("face {face} names vertex {vertex}, but there are {count} vertices")]
    VertexOutOfRange { face: usize, vertex: u32, count: usize },
    #[error("vertex {vertex} names node {node}, but there are {count} nodes")]
    NodeOutOfRange { vertex: usize, node: u32, count: usize },
    #[error("there are {velocities} velocities for {nodes} nodes")]
    VelocityCount { velocities: usize, nodes: usize },
    #[error("the {what} of node {node} is not finite")]
    NonFiniteNode { what: &'static str, node: usize },
    #[error("the material position of vertex {vertex} is not finite")]
    NonFiniteVertex { vertex: usize },
    #[error("face {face} uses a node twice")]
    RepeatedNode { face: usize },
    #[error(
        "face {face} has material area {area:.3e} m^2, below the least, {FACE_AREA_MIN:.0e} m^2"
    )]
    ZeroArea { face: usize, area: f64 },
    #[error(
        "face {face} is clockwise in material space (area {area:.3e} m^2): mirror the panel's u or reverse the face"
    )]
    Inverted { face: usize, area: f64 },
    #[error("the edge between nodes {a} and {b} has more than two faces: the third is face {face}")]
    NonManifoldEdge { a: usize, b: usize, face: usize },
    #[error(
        "faces {first} and {second} run along the edge between nodes {a} and {b} in the same direction: one of them is inside out"
    )]
    InconsistentOrientation { a: usize, b: usize, first: usize, second: usize },
    #[error("the faces at node {node} touch only in that node")]
    NonManifoldNode { node: usize },
    #[error("the mesh is damaged: {0}")]
    Flawed(Flaw),
}

impl Mesh {
    /// Builds connectivity. Nodes at boundary corners and seams of this input, and those in
    /// `pinned`, are kept by remeshing. Nodes and vertices without a face are dropped.
    ///
    /// # Errors
    /// The first thing that keeps the input from being an oriented manifold with positive
    /// material areas.
    pub fn from_raw(raw: &RawMesh, pinned: &[u32]) -> Result<Mesh, MeshError> {
        check_indices(raw)?;
        check_shapes(raw)?;
        let (nodes, vertices) = used(raw);
        let mut mesh = arrays(raw, &nodes, &vertices);
        mesh.connect()?;
        mesh.set_rest_angles(raw, &nodes);
        mesh.keep_outline(pinned);
        Ok(mesh)
    }

    /// Joins faces along shared edges and gives each node one of its corners.
    fn connect(&mut self) -> Result<(), MeshError> {
        self.opposite = IdVec::filled(None, self.corner_count());
        self.corner_of_node = IdVec::filled(CornerId::from_index(0), self.node_count());
        let mut corners_by_edge: HashMap<(NodeId, NodeId), CornerId> = HashMap::new();
        for corner in self.corner_ids() {
            let [a, b] = self.edge_nodes(corner);
            if let Some(first) = corners_by_edge.insert((a, b), corner) {
                return Err(self.edge_error(first, corner));
            }
            if let Some(&other) = corners_by_edge.get(&(b, a)) {
                self.opposite[corner] = Some(other);
                self.opposite[other] = Some(corner);
            }
            let node = self.node_at(corner);
            self.corner_of_node[node] = corner;
        }
        self.check_fans()
    }

    /// Two faces use an edge in the same direction.
    fn edge_error(&self, first: CornerId, second: CornerId) -> MeshError {
        let [a, b] = self.edge_nodes(second);
        let (a, b) = (self.input_index(a), self.input_index(b));
        if self.opposite[first].is_some() {
            MeshError::NonManifoldEdge { a, b, face: second.face().index() }
        } else {
            MeshError::InconsistentOrientation {
                a,
                b,
                first: first.face().index(),
                second: second.face().index(),
            }
        }
    }

    /// Every face at a node must be reachable around the node.
    fn check_fans(&self) -> Result<(), MeshError> {
        let mut face_count = IdVec::filled(0usize, self.node_count());
        for face in self.face_ids() {
            for node in self.face_nodes(face) {
                face_count[node] += 1;
            }
        }
        match self.node_ids().find(|&n| self.valence(n) != face_count[n]) {
            Some(node) => Err(MeshError::NonManifoldNode { node: self.input_index(node) }),
            None => Ok(()),
        }
    }

    fn input_index(&self, node: NodeId) -> usize {
        self.node_origin[node].input_index().map_or(node.index(), |i| i as usize)
    }

    fn set_rest_angles(&mut self, raw: &RawMesh, nodes: &[Option<NodeId>]) {
        self.rest_angle = IdVec::filled(0.0, self.corner_count());
        for &([a, b], angle) in &raw.rest_angles {
            let ends = [a, b].map(|n| nodes.get(n as usize).copied().flatten());
            let [Some(a), Some(b)] = ends else { continue };
            if let Some(corner) = self.edge_between(a, b) {
                self.rest_angle[corner] = angle;
                if let Some(other) = self.opposite(corner) {
                    self.rest_angle[other] = angle;
                }
            }
        }
    }

    /// Marks the nodes which give the flat cloth its shape, and the pinned ones, as kept.
    fn keep_outline(&mut self, pinned: &[u32]) {
        for node in self.node_ids() {
            let NodeOrigin::Input { index } = self.node_origin[node] else { continue };
            if pinned.contains(&index) || self.is_boundary_node(node) || self.touches_seam(node) {
                self.node_origin[node] = NodeOrigin::Kept { index };
            }
        }
    }
}

fn check_indices(raw: &RawMesh) -> Result<(), MeshError> {
    if raw.faces.is_empty() {
        return Err(MeshError::Empty);
    }
    let nodes = raw.positions.len();
    if !raw.velocities.is_empty() && raw.velocities.len() != nodes {
        return Err(MeshError::VelocityCount { velocities: raw.velocities.len(), nodes });
    }
    for (vertex, &(node, _)) in raw.vertices.iter().enumerate() {
        if node as usize >= nodes {
            return Err(MeshError::NodeOutOfRange { vertex, node, count: nodes });
        }
    }
    let count = raw.vertices.len();
    for (face, corners) in raw.faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= count) {
            return Err(MeshError::VertexOutOfRange { face, vertex, count });
        }
    }
    Ok(())
}

fn check_shapes(raw: &RawMesh) -> Result<(), MeshError> {
    for (what, values) in [("position", &raw.positions), ("velocity", &raw.velocities)] {
        if let Some(node) = values.iter().position(|x| !x.is_finite()) {
            return Err(MeshError::NonFiniteNode { what, node });
        }
    }
    if let Some(vertex) = raw.vertices.iter().position(|(_, u)| !u.is_finite()) {
        return Err(MeshError::NonFiniteVertex { vertex });
    }
    for (face, corners) in raw.faces.iter().enumerate() {
        let [a, b, c] = corners.map(|v| raw.vertices[v as usize].0);
        if a == b || b == c || c == a {
            return Err(MeshError::RepeatedNode { face });
        }
        let area = measure::signed_area(corners.map(|v| raw.vertices[v as usize].1));
        if area.abs() < FACE_AREA_MIN {
            return Err(MeshError::ZeroArea { face, area });
        }
        if area < 0.0 {
            return Err(MeshError::Inverted { face, area });
        }
    }
    Ok(())
}

/// The new ids of the nodes and vertices which a face uses.
fn used(raw: &RawMesh) -> (Vec<Option<NodeId>>, Vec<Option<VertexId>>) {
    let mut node_used = vec![false; raw.positions.len()];
    let mut vertex_used = vec![false; raw.vertices.len()];
    for &v in raw.faces.iter().flatten() {
        vertex_used[v as usize] = true;
        node_used[raw.vertices[v as usize].0 as usize] = true;
    }
    (numbered(&node_used), numbered(&vertex_used))
}

fn numbered<I: Id>(used: &[bool]) -> Vec<Option<I>> {
    let mut next = 0;
    used.iter()
        .map(|&used| {
            used.then(|| {
                next += 1;
                I::from_index(next - 1)
            })
        })
        .collect()
}

/// The mesh's arrays, without connectivity.
fn arrays(raw: &RawMesh, nodes: &[Option<NodeId>], vertices: &[Option<VertexId>]) -> Mesh {
    let mut mesh = Mesh::default();
    for (index, _) in nodes.iter().enumerate().filter(|(_, n)| n.is_some()) {
        mesh.position.push(raw.positions[index]);
        mesh.velocity.push(raw.velocities.get(index).copied().unwrap_or(DVec3::ZERO));
        mesh.node_origin.push(NodeOrigin::Input { index: index as u32 });
    }
    for (index, _) in vertices.iter().enumerate().filter(|(_, v)| v.is_some()) {
        let (node, material) = raw.vertices[index];
        mesh.node_of_vertex.push(nodes[node as usize].expect("the node of a used vertex is used"));
        mesh.material.push(material);
        mesh.metric.push(SymTensor2::ZERO);
    }
    for face in &raw.faces {
        mesh.vertices_of_face
            .push(face.map(|v| vertices[v as usize].expect("a face's vertex is used")));
        mesh.view_factor.push(1.0);
    }
    mesh
}
