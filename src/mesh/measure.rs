//! Lengths, areas, gradients and angles, in material space and in the world.

use glam::{DMat2, DVec2, DVec3};

use super::{CornerId, FaceId, IdVec, Mesh, NodeId, VertexId};
use crate::math::Mat3x2;

impl Mesh {
    /// Material positions of a face's corners (m).
    pub fn face_material(&self, face: FaceId) -> [DVec2; 3] {
        self.face_vertices(face).map(|v| self.material(v))
    }

    /// World positions of a face's corners (m).
    pub fn face_positions(&self, face: FaceId) -> [DVec3; 3] {
        self.face_nodes(face).map(|n| self.position[n])
    }

    /// Signed area in material space (m^2), positive in a valid mesh.
    pub fn material_area(&self, face: FaceId) -> f64 {
        signed_area(self.face_material(face))
    }

    /// Area of the whole flat cloth (m^2).
    pub fn total_material_area(&self) -> f64 {
        self.face_ids().map(|f| self.material_area(f)).sum()
    }

    /// Material gradients of the face's three linear shape functions (1/m); they add up to zero.
    pub fn shape_gradients(&self, face: FaceId) -> [DVec2; 3] {
        shape_gradients(self.face_material(face))
    }

    /// F = dx/du, constant over the face.
    pub fn deformation_gradient(&self, face: FaceId) -> Mat3x2 {
        self.deformation_of(self.face_vertices(face))
    }

    /// F = dx/du of a face that three vertices would make.
    pub fn deformation_of(&self, vertices: [VertexId; 3]) -> Mat3x2 {
        let gradients = shape_gradients(vertices.map(|v| self.material(v)));
        Mat3x2::from_gradients(vertices.map(|v| self.vertex_position(v)), gradients)
    }

    /// World normal times twice the world area (m^2).
    pub fn area_vector(&self, face: FaceId) -> DVec3 {
        let [a, b, c] = self.face_positions(face);
        (b - a).cross(c - a)
    }

    /// Unit world normal; zero for a face without area.
    pub fn face_normal(&self, face: FaceId) -> DVec3 {
        self.area_vector(face).normalize_or_zero()
    }

    /// Unit normals per node, faces weighted by world area; zero where they cancel.
    pub fn node_normals(&self) -> IdVec<NodeId, DVec3> {
        let mut sum = IdVec::filled(DVec3::ZERO, self.node_count());
        for face in self.face_ids() {
            let n = self.area_vector(face);
            for node in self.face_nodes(face) {
                sum[node] += n;
            }
        }
        sum.iter().map(|n: &DVec3| n.normalize_or_zero()).collect()
    }

    /// A third of the material area of the faces around each node (m^2).
    pub fn node_areas(&self) -> IdVec<NodeId, f64> {
        let mut sum = IdVec::filled(0.0, self.node_count());
        for face in self.face_ids() {
            let third = self.material_area(face) / 3.0;
            for node in self.face_nodes(face) {
                sum[node] += third;
            }
        }
        sum
    }

    /// The angle between the normals of the two faces at the edge opposite to `corner` (rad),
    /// positive where the edge is a ridge seen from the side of the normals; `None` at the boundary
    /// or where a face or the edge has no extent.
    pub fn dihedral_angle(&self, corner: CornerId) -> Option<f64> {
        let other = self.opposite(corner)?;
        let [a, b] = self.edge_nodes(corner);
        let along = (self.position[b] - self.position[a]).try_normalize()?;
        let n0 = self.area_vector(corner.face()).try_normalize()?;
        let n1 = self.area_vector(other.face()).try_normalize()?;
        Some(n0.cross(n1).dot(along).atan2(n0.dot(n1)))
    }

    /// Length of the edge opposite to `corner` under the vertex metrics, squared: the larger of the
    /// two sides at a seam. An edge is valid if this is at most 1
    /// ([`VD15`](crate::papers::VD15) eq. 1).
    pub fn metric_length_squared(&self, corner: CornerId) -> f64 {
        let side = |c: CornerId| {
            let [i, j] = self.edge_vertices(c);
            let mean = (self.metric[i] + self.metric[j]) * 0.5;
            mean.quadratic_form(self.material(j) - self.material(i))
        };
        match self.opposite(corner) {
            Some(o) if self.is_seam(corner) => side(corner).max(side(o)),
            _ => side(corner),
        }
    }
}

/// Material gradients of the linear shape functions of a triangle (1/m).
fn shape_gradients([a, b, c]: [DVec2; 3]) -> [DVec2; 3] {
    let inverse = DMat2::from_cols(b - a, c - a).inverse();
    let (gb, gc) = (inverse.row(0), inverse.row(1));
    [-(gb + gc), gb, gc]
}

/// Half the cross product of two edges (m^2); positive for counter-clockwise corners.
pub fn signed_area([a, b, c]: [DVec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

/// 12 sqrt(3) A / P^2: 1 for an equilateral triangle, 0 for a degenerate one
/// ([`NSO12`](crate::papers::NSO12)).
pub fn aspect_ratio(corners: [DVec2; 3]) -> f64 {
    let [a, b, c] = corners;
    let perimeter = a.distance(b) + b.distance(c) + c.distance(a);
    if perimeter == 0.0 {
        return 0.0;
    }
    12.0 * 3f64.sqrt() * signed_area(corners) / (perimeter * perimeter)
}
