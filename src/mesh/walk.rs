//! Walking the mesh: across edges, around nodes, over all edges.

use super::{CornerId, FaceId, Id, Mesh, NodeId, VertexId};

impl Mesh {
    /// The corner on the other side of the edge opposite to `corner`; `None` at the boundary.
    pub fn opposite(&self, corner: CornerId) -> Option<CornerId> {
        self.opposite[corner]
    }

    pub fn vertex_at(&self, corner: CornerId) -> VertexId {
        self.vertices_of_face[corner.face()][corner.position()]
    }

    pub fn node_at(&self, corner: CornerId) -> NodeId {
        self.node_of_vertex[self.vertex_at(corner)]
    }

    /// The vertices of the edge opposite to `corner`, as its face sees them, counter-clockwise.
    pub fn edge_vertices(&self, corner: CornerId) -> [VertexId; 2] {
        [self.vertex_at(corner.next()), self.vertex_at(corner.previous())]
    }

    /// The nodes of the edge opposite to `corner`.
    pub fn edge_nodes(&self, corner: CornerId) -> [NodeId; 2] {
        self.edge_vertices(corner).map(|v| self.node_of_vertex[v])
    }

    /// The face on the other side of the edge opposite to `corner`.
    pub fn neighbour(&self, corner: CornerId) -> Option<FaceId> {
        self.opposite(corner).map(CornerId::face)
    }

    /// Every edge once, named by one of its corners: the smaller of the two.
    pub fn edges(&self) -> impl Iterator<Item = CornerId> + '_ {
        self.opposite.enumerate().filter(|(c, o)| o.is_none_or(|o| *c < o)).map(|(c, _)| c)
    }

    /// True if the edge has faces on both sides which meet it with different vertices.
    pub fn is_seam(&self, corner: CornerId) -> bool {
        self.opposite(corner).is_some_and(|o| {
            let [a, b] = self.edge_vertices(corner);
            self.edge_vertices(o) != [b, a]
        })
    }

    pub fn is_boundary(&self, corner: CornerId) -> bool {
        self.opposite[corner].is_none()
    }

    /// The corners at a node, counter-clockwise; at a boundary node from one boundary edge to the
    /// other.
    pub fn corners_around(&self, node: NodeId) -> CornersAround<'_> {
        let start = self.corner_of_node[node];
        let mut first = start;
        while let Some(o) = self.opposite(first.previous()) {
            first = o.previous();
            if first == start {
                break;
            }
        }
        CornersAround { mesh: self, first, next: Some(first) }
    }

    pub fn is_boundary_node(&self, node: NodeId) -> bool {
        self.corners_around(node)
            .any(|c| self.is_boundary(c.next()) || self.is_boundary(c.previous()))
    }

    /// True if more than one vertex stands for the node.
    pub fn is_seam_node(&self, node: NodeId) -> bool {
        let mut corners = self.corners_around(node);
        let first = corners.next().map(|c| self.vertex_at(c));
        corners.any(|c| Some(self.vertex_at(c)) != first)
    }

    /// True if a seam runs through the node or, as at the tip of a dart, ends in it.
    pub fn touches_seam(&self, node: NodeId) -> bool {
        self.corners_around(node).any(|c| self.is_seam(c.next()) || self.is_seam(c.previous()))
    }

    /// A corner whose opposite edge joins the two nodes, if they are neighbours.
    pub fn edge_between(&self, a: NodeId, b: NodeId) -> Option<CornerId> {
        self.corners_around(a).find_map(|c| {
            if self.node_at(c.next()) == b {
                Some(c.previous())
            } else if self.node_at(c.previous()) == b {
                Some(c.next())
            } else {
                None
            }
        })
    }

    /// The nodes that share an edge with `node`, counter-clockwise.
    pub fn neighbours(&self, node: NodeId) -> impl Iterator<Item = NodeId> + '_ {
        self.corners_around(node).flat_map(move |c| {
            let last = self.is_boundary(c.next()).then(|| self.node_at(c.previous()));
            [Some(self.node_at(c.next())), last].into_iter().flatten()
        })
    }

    /// For each node, the faces around it are visited through `corners_around`; this is how many.
    pub fn valence(&self, node: NodeId) -> usize {
        self.corners_around(node).count()
    }

    pub(super) fn corner_count(&self) -> usize {
        self.vertices_of_face.len() * 3
    }

    pub(super) fn corner_ids(&self) -> impl Iterator<Item = CornerId> + use<> {
        (0..self.corner_count()).map(CornerId::from_index)
    }
}

/// See [`Mesh::corners_around`].
pub struct CornersAround<'a> {
    mesh: &'a Mesh,
    first: CornerId,
    next: Option<CornerId>,
}

impl Iterator for CornersAround<'_> {
    type Item = CornerId;

    fn next(&mut self) -> Option<CornerId> {
        let corner = self.next?;
        self.next = self
            .mesh
            .opposite(corner.next())
            .map(CornerId::next)
            .filter(|&following| following != self.first);
        Some(corner)
    }
}
