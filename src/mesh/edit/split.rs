//! Split: a new node in the middle of an edge.

use super::MeshEditor;
use crate::mesh::{CornerId, Id, NodeId, NodeOrigin, VertexId};

impl MeshEditor {
    /// Splits the edge opposite to `corner` in its middle; returns the new node. Position, velocity
    /// and metric are interpolated, each side of a seam for itself; rest angle and view factor are
    /// inherited. Total mass and momentum of the linearly interpolated cloth are unchanged.
    pub fn split(&mut self, corner: CornerId) -> NodeId {
        let other = self.mesh.opposite(corner);
        let seam = self.mesh.is_seam(corner);
        let node = self.midpoint_node(corner);
        let vertex = self.midpoint_vertex(corner, node);
        let far = self.halve(corner, vertex);
        self.mesh.corner_of_node.push(corner.previous());
        if let Some(other) = other {
            let other_vertex = if seam { self.midpoint_vertex(other, node) } else { vertex };
            let other_far = self.halve(other, other_vertex);
            self.link(corner, Some(other_far));
            self.link(other, Some(far));
        }
        node
    }

    fn midpoint_node(&mut self, corner: CornerId) -> NodeId {
        let mesh = &mut self.mesh;
        let [a, b] = mesh.edge_nodes(corner);
        let position = 0.5 * (mesh.position[a] + mesh.position[b]);
        let velocity = 0.5 * (mesh.velocity[a] + mesh.velocity[b]);
        mesh.velocity.push(velocity);
        mesh.node_origin.push(NodeOrigin::Split);
        self.node_removed.push(false);
        mesh.position.push(position)
    }

    fn midpoint_vertex(&mut self, corner: CornerId, node: NodeId) -> VertexId {
        let mesh = &mut self.mesh;
        let [i, j] = mesh.edge_vertices(corner);
        let metric = (mesh.metric[i] + mesh.metric[j]) * 0.5;
        let material = 0.5 * (mesh.material[i] + mesh.material[j]);
        mesh.metric.push(metric);
        mesh.node_of_vertex.push(node);
        self.vertex_removed.push(false);
        mesh.material.push(material)
    }

    /// Cuts the corner's face from the corner to `vertex` on the opposite edge. The face keeps the
    /// half towards the next corner; returns the corner of the new face from which the cut runs.
    fn halve(&mut self, corner: CornerId, vertex: VertexId) -> CornerId {
        let (next, previous) = (corner.next(), corner.previous());
        let tip = self.mesh.vertex_at(corner);
        let end = self.mesh.vertex_at(previous);
        let edge = self.edge_state(corner);
        let side = self.edge_state(next);
        let view_factor = self.mesh.view_factor[corner.face()];

        let face = self.mesh.vertices_of_face.push([tip, vertex, end]);
        self.mesh.view_factor.push(view_factor);
        self.face_removed.push(false);
        for _ in 0..3 {
            self.mesh.opposite.push(None);
            self.mesh.rest_angle.push(0.0);
        }
        let [new_tip, new_vertex, new_end] = face.corners();
        self.take_edge(new_vertex, side);
        self.mesh.rest_angle[new_tip] = edge.1;

        self.mesh.vertices_of_face[corner.face()][previous.position()] = vertex;
        self.link(next, Some(new_end));
        self.mesh.rest_angle[next] = 0.0;

        let end_node = self.mesh.node_of_vertex[end];
        if self.mesh.corner_of_node[end_node] == previous {
            self.mesh.corner_of_node[end_node] = new_end;
        }
        debug_assert!(end_node.index() < self.mesh.node_count());
        new_tip
    }
}
