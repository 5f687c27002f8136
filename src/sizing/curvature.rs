//! Finer where cloth is bent.

use crate::math::{Mat3x2, SymTensor2};
use crate::mesh::{FaceId, Mesh};

/// M = (grad n)^T (grad n) / refine_angle^2 (1/m^2): along a valid edge the vertex normals turn by
/// at most about `refine_angle` (rad, above 0). `normal_gradient` is grad n over the face (1/m)
/// ([`NSO12`](crate::papers::NSO12)).
pub fn curvature_metric(normal_gradient: Mat3x2, refine_angle: f64) -> SymTensor2 {
    normal_gradient.gram() * refine_angle.powi(-2)
}

/// M = II^2 / refine_angle^2 (1/m^2), as [`curvature_metric`] from the second fundamental form
/// (1/m) ([`NSO12`](crate::papers::NSO12)): folds sharper than vertex normals can tell, which
/// average over the faces around.
pub fn hinge_curvature_metric(form: SymTensor2, refine_angle: f64) -> SymTensor2 {
    form.squared() * refine_angle.powi(-2)
}

/// II = sum over the face's edges of theta l / (2 A) t t^T (1/m), with theta the edge's dihedral
/// angle, l its material length, t the material unit normal of the edge and A the face's material
/// area: half of each hinge belongs to the face. The boundary does not bend.
pub fn second_fundamental_form(mesh: &Mesh, face: FaceId) -> SymTensor2 {
    let two_areas = 2.0 * mesh.material_area(face);
    face.corners().into_iter().fold(SymTensor2::ZERO, |sum, corner| {
        let Some(angle) = mesh.dihedral_angle(corner) else { return sum };
        let [a, b] = mesh.edge_vertices(corner).map(|v| mesh.material(v));
        let across = (b - a).perp();
        // across = l t, so across across^T / l = l t t^T.
        sum + SymTensor2::outer(across) * (angle / (two_areas * across.length()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sizing::tests::{around_cylinder, flat, sheet};

    const RADIUS: f64 = 0.5;
    const ANGLE: f64 = 0.3;

    /// A face away from the boundary, where vertex normals see the cylinder on both sides.
    fn inner_face(mesh: &Mesh) -> FaceId {
        mesh.face_ids().nth(mesh.face_count() / 2 + 20).unwrap()
    }

    fn metrics(mesh: &Mesh, face: FaceId) -> [SymTensor2; 2] {
        let normals = mesh.node_normals();
        let corners = mesh.face_nodes(face).map(|n| normals[n]);
        let gradient = Mat3x2::from_gradients(corners, mesh.shape_gradients(face));
        [
            curvature_metric(gradient, ANGLE),
            hinge_curvature_metric(second_fundamental_form(mesh, face), ANGLE),
        ]
    }

    #[test]
    fn a_cylinder_is_curved_around_and_straight_along_its_axis() {
        let mesh = sheet(20, 20, 0.02, around_cylinder(RADIUS));
        let expected = (RADIUS * ANGLE).powi(-2);
        for m in metrics(&mesh, inner_face(&mesh)) {
            assert!((m.xx / expected - 1.0).abs() < 0.01, "{} instead of {expected}", m.xx);
            assert!(m.yy.abs() < 1e-3 * expected && m.xy.abs() < 1e-3 * expected, "{m:?}");
        }
    }

    #[test]
    fn a_flat_sheet_asks_for_nothing() {
        let mesh = sheet(8, 8, 0.05, flat);
        for m in mesh.face_ids().flat_map(|f| metrics(&mesh, f)) {
            assert!(m.trace().abs() < 1e-20, "{m:?}");
        }
    }
}
