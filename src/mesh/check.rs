//! The one validity checker: every test that touches a mesh calls it.

use thiserror::Error;

use super::{CornerId, FaceId, Id, Mesh, NodeId, VertexId};

/// What is wrong with a mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Flaw {
    #[error("an array of length {length} should have {expected} items: {name}")]
    ArrayLength { name: &'static str, length: usize, expected: usize },
    #[error("{face:?} names a vertex or node that does not exist")]
    IndexOutOfRange { face: FaceId },
    #[error("{face:?} uses a node twice")]
    RepeatedNode { face: FaceId },
    #[error("{face:?} has material area {area:e} m^2")]
    NonPositiveArea { face: FaceId, area: f64 },
    #[error("{corner:?} and the corner it calls opposite do not name the same edge")]
    UnmatchedEdge { corner: CornerId },
    #[error("{corner:?} and its opposite have different rest angles")]
    UnmatchedRestAngle { corner: CornerId },
    #[error("{node:?} starts at a corner of another node")]
    WrongCorner { node: NodeId },
    #[error("{node:?}: {reached} of its {count} faces are reached by walking around it")]
    BrokenFan { node: NodeId, reached: usize, count: usize },
    #[error("{vertex:?} has no face")]
    UnusedVertex { vertex: VertexId },
    #[error("the metric of {vertex:?} is not finite or has a negative eigenvalue")]
    BadMetric { vertex: VertexId },
    #[error("the view factor of {face:?} is {factor}, outside 0..1")]
    BadViewFactor { face: FaceId, factor: f64 },
    #[error("the rest angle at {corner:?} is not finite")]
    NonFiniteRestAngle { corner: CornerId },
    #[error("{node:?} is not finite")]
    NonFiniteNode { node: NodeId },
}

impl Mesh {
    /// Verifies every invariant of the structure; linear in the mesh's size.
    ///
    /// # Errors
    /// The first flaw found.
    pub fn check(&self) -> Result<(), Flaw> {
        self.check_lengths()?;
        self.check_faces()?;
        self.check_corners()?;
        self.check_state()?;
        self.check_nodes()
    }

    fn check_lengths(&self) -> Result<(), Flaw> {
        let (nodes, vertices) = (self.node_count(), self.vertex_count());
        let (faces, corners) = (self.face_count(), self.corner_count());
        for (name, length, expected) in [
            ("velocity", self.velocity.len(), nodes),
            ("node_origin", self.node_origin.len(), nodes),
            ("corner_of_node", self.corner_of_node.len(), nodes),
            ("metric", self.metric.len(), vertices),
            ("node_of_vertex", self.node_of_vertex.len(), vertices),
            ("view_factor", self.view_factor.len(), faces),
            ("opposite", self.opposite.len(), corners),
            ("rest_angle", self.rest_angle.len(), corners),
        ] {
            if length != expected {
                return Err(Flaw::ArrayLength { name, length, expected });
            }
        }
        Ok(())
    }

    fn check_faces(&self) -> Result<(), Flaw> {
        for face in self.face_ids() {
            let vertices = self.face_vertices(face);
            let in_range = |v: VertexId| {
                self.node_of_vertex.get(v).is_some_and(|&n| n.index() < self.node_count())
            };
            if !vertices.into_iter().all(in_range) {
                return Err(Flaw::IndexOutOfRange { face });
            }
            let [a, b, c] = self.face_nodes(face);
            if a == b || b == c || c == a {
                return Err(Flaw::RepeatedNode { face });
            }
            let area = self.material_area(face);
            // Written so that a NaN fails.
            if !(area > 0.0) {
                return Err(Flaw::NonPositiveArea { face, area });
            }
        }
        Ok(())
    }

    fn check_corners(&self) -> Result<(), Flaw> {
        for corner in self.corner_ids() {
            let Some(other) = self.opposite(corner) else { continue };
            let [a, b] = self.edge_nodes(corner);
            let matched = other.index() < self.corner_count()
                && other != corner
                && self.opposite(other) == Some(corner)
                && self.edge_nodes(other) == [b, a];
            if !matched {
                return Err(Flaw::UnmatchedEdge { corner });
            }
            if self.rest_angle[corner] != self.rest_angle[other] {
                return Err(Flaw::UnmatchedRestAngle { corner });
            }
        }
        Ok(())
    }

    fn check_state(&self) -> Result<(), Flaw> {
        for (vertex, metric) in self.metric.enumerate() {
            let eigenvalues = metric.eigen().values;
            // Rounding may leave a rank-one metric a hair below zero.
            let least = -1e-9 * eigenvalues[0].abs();
            if !metric.is_finite() || eigenvalues[1] < least {
                return Err(Flaw::BadMetric { vertex });
            }
        }
        for (face, &factor) in self.view_factor.enumerate() {
            if !(0.0..=1.0).contains(&factor) {
                return Err(Flaw::BadViewFactor { face, factor });
            }
        }
        match self.rest_angle.enumerate().find(|(_, angle)| !angle.is_finite()) {
            Some((corner, _)) => Err(Flaw::NonFiniteRestAngle { corner }),
            None => Ok(()),
        }
    }

    fn check_nodes(&self) -> Result<(), Flaw> {
        let mut face_count = vec![0usize; self.node_count()];
        let mut vertex_used = vec![false; self.vertex_count()];
        for face in self.face_ids() {
            for vertex in self.face_vertices(face) {
                vertex_used[vertex.index()] = true;
                face_count[self.node_of(vertex).index()] += 1;
            }
        }
        if let Some(index) = vertex_used.iter().position(|used| !used) {
            return Err(Flaw::UnusedVertex { vertex: VertexId::from_index(index) });
        }
        for node in self.node_ids() {
            let corner = self.corner_of_node[node];
            if corner.index() >= self.corner_count() || self.node_at(corner) != node {
                return Err(Flaw::WrongCorner { node });
            }
            let count = face_count[node.index()];
            // Bounded: a damaged mesh may send the walk in circles.
            let reached = self.corners_around(node).take(count + 1).count();
            if reached != count {
                return Err(Flaw::BrokenFan { node, reached, count });
            }
        }
        match self.non_finite_node() {
            Some(node) => Err(Flaw::NonFiniteNode { node }),
            None => Ok(()),
        }
    }
}
