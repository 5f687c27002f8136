//! From faces, where metrics are computed, to vertices, where remeshing reads them.

use crate::math::SymTensor2;
use crate::mesh::{FaceId, IdVec, Mesh, VertexId};

/// The mean of the metrics of the faces around each vertex, weighted by material area
/// ([`VD15`](crate::papers::VD15) 3.3). A node on a seam keeps one metric on each side.
pub fn faces_to_vertices(
    mesh: &Mesh,
    face_metric: &IdVec<FaceId, SymTensor2>,
) -> IdVec<VertexId, SymTensor2> {
    let mut sums = IdVec::filled((SymTensor2::ZERO, 0.0), mesh.vertex_count());
    for face in mesh.face_ids() {
        let area = mesh.material_area(face);
        for vertex in mesh.face_vertices(face) {
            let (sum, total): &mut (SymTensor2, f64) = &mut sums[vertex];
            *sum += face_metric[face] * area;
            *total += area;
        }
    }
    sums.iter().map(|&(sum, area)| sum * (1.0 / area)).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::mesh::RawMesh;

    /// Two triangles of areas 2 and 4 that share an edge in the world; `vertices` says whether in
    /// material space as well.
    fn pair(vertices: Vec<(u32, DVec2)>, faces: Vec<[u32; 3]>) -> Mesh {
        let positions = vec![DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0, DVec3::ONE * 4.0];
        let raw = RawMesh { positions, vertices, faces, ..RawMesh::default() };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    fn blended(mesh: &Mesh) -> Vec<f64> {
        let faces = vec![SymTensor2::isotropic(3.0), SymTensor2::isotropic(6.0)];
        faces_to_vertices(mesh, &IdVec::from(faces)).iter().map(|m| m.xx).collect()
    }

    #[test]
    fn a_vertex_gets_the_mean_weighted_by_area() {
        let u = |x: f64, y: f64| DVec2::new(x, y);
        let vertices = vec![(0, u(0.0, 0.0)), (1, u(2.0, 0.0)), (2, u(0.0, 2.0)), (3, u(3.0, 3.0))];
        let mesh = pair(vertices, vec![[0, 1, 2], [1, 3, 2]]);
        assert!(
            blended(&mesh).iter().zip([3.0, 5.0, 5.0, 6.0]).all(|(a, b)| (a - b).abs() < 1e-12)
        );
    }

    #[test]
    fn a_seam_has_one_metric_on_each_side() {
        let u = |x: f64, y: f64| DVec2::new(x, y);
        let mut vertices = vec![(0, u(0.0, 0.0)), (1, u(2.0, 0.0)), (2, u(0.0, 2.0))];
        vertices.extend([(1, u(12.0, 0.0)), (3, u(13.0, 3.0)), (2, u(10.0, 2.0))]);
        let mesh = pair(vertices, vec![[0, 1, 2], [3, 4, 5]]);
        let expected = [3.0, 3.0, 3.0, 6.0, 6.0, 6.0];
        assert!(blended(&mesh).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
