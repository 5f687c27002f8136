//! View factors carried across edges, so that area-weighted averages keep silhouettes fine.

use crate::mesh::{FaceId, IdVec, Mesh};

/// View factors in which a hidden face has at least the average of its own and a neighbour's
/// factor, wherever the two differ by more than `threshold` ([`VD15`](crate::papers::VD15) 3.3).
/// Of several such neighbours the largest average counts; visible faces keep their factor.
///
/// Every average is of the given factors, so the order of edges does not matter. Of two hidden
/// faces it is the coarser that takes the average.
pub fn resampled(
    mesh: &Mesh,
    factor: &IdVec<FaceId, f64>,
    is_visible: impl Fn(FaceId) -> bool,
    threshold: f64,
) -> IdVec<FaceId, f64> {
    let raised = |face: FaceId| {
        let own = factor[face];
        face.corners()
            .into_iter()
            .filter_map(|corner| mesh.neighbour(corner).map(|other| factor[other]))
            .filter(|other| other - own > threshold)
            .fold(own, |largest, other| largest.max(0.5 * (own + other)))
    };
    mesh.face_ids().map(|face| if is_visible(face) { factor[face] } else { raised(face) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Id, RawMesh};
    use crate::sizing::tests::{flat, sheet};

    /// The same garment with its faces in the reverse order.
    fn reversed(mesh: &Mesh) -> Mesh {
        let raw = RawMesh {
            positions: mesh.position.iter().copied().collect(),
            vertices: mesh
                .vertex_ids()
                .map(|v| (mesh.node_of(v).index() as u32, mesh.material(v)))
                .collect(),
            faces: mesh
                .face_ids()
                .rev()
                .map(|f| mesh.face_vertices(f).map(|v| v.index() as u32))
                .collect(),
            ..RawMesh::default()
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    #[test]
    fn the_order_of_edges_does_not_matter() {
        let mesh = sheet(5, 5, 0.1, flat);
        let last = mesh.face_count() - 1;
        let nu = |i: usize| ((i * 7) % 11) as f64 / 11.0;
        let visible = |i: usize| i.is_multiple_of(3);
        let there = resampled(&mesh, &factors(&mesh, nu), |f| visible(f.index()), 0.1);
        let back = reversed(&mesh);
        let nu_back = factors(&back, |i| nu(last - i));
        let here = resampled(&back, &nu_back, |f| visible(last - f.index()), 0.1);
        assert!(there.iter().eq(here.as_slice().iter().rev()));
    }

    fn factors(mesh: &Mesh, f: impl Fn(usize) -> f64) -> IdVec<FaceId, f64> {
        mesh.face_ids().map(|face| f(face.index())).collect()
    }

    #[test]
    fn hidden_faces_at_a_silhouette_take_the_average() {
        let mesh = sheet(2, 1, 0.1, flat);
        // Faces 0 and 1 make the first square, 2 and 3 the second; 0 and 3 share its edge.
        let nu = factors(&mesh, |i| [1.0, 1.0, 0.2, 0.2][i]);
        let visible = |face: FaceId| face.index() < 2;
        let after = resampled(&mesh, &nu, visible, 0.1);
        let touching = FaceId::from_index(0);
        let neighbours: Vec<usize> = touching
            .corners()
            .into_iter()
            .filter_map(|c| mesh.neighbour(c))
            .map(FaceId::index)
            .filter(|&i| i >= 2)
            .collect();
        assert_eq!(neighbours.len(), 1);
        for face in mesh.face_ids() {
            let expected = if neighbours.contains(&face.index()) { 0.6 } else { nu[face] };
            assert_eq!(after[face], expected);
        }
    }

    #[test]
    fn averages_do_not_spread_any_further() {
        let mesh = sheet(6, 1, 0.1, flat);
        let nu = factors(&mesh, |i| if i < 4 { 1.0 } else { 0.01 });
        let after = resampled(&mesh, &nu, |face| face.index() < 4, 0.1);
        assert_eq!(after.iter().filter(|&&v| v == 0.5 * (1.0 + 0.01)).count(), 1);
        assert_eq!(after.iter().filter(|&&v| v == 0.01).count(), 7);
    }

    #[test]
    fn differences_up_to_the_threshold_stay() {
        let mesh = sheet(4, 4, 0.1, flat);
        let nu = factors(&mesh, |i| if i % 2 == 0 { 1.0 } else { 0.75 });
        assert_eq!(resampled(&mesh, &nu, |face| face.index() % 2 == 0, 0.25), nu);
    }

    #[test]
    fn visible_faces_keep_their_factor() {
        let mesh = sheet(4, 4, 0.1, flat);
        let nu = factors(&mesh, |i| (i % 5) as f64 * 0.2);
        assert_eq!(resampled(&mesh, &nu, |_| true, 0.0), nu);
    }
}
