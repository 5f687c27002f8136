//! Finer where neighbouring points part or close up.

use crate::math::{Mat3x2, SymTensor2};

/// M = (grad v)^T (grad v) / refine_velocity^2 (1/m^2): along a valid edge the velocity changes by
/// at most `refine_velocity` (m/s, above 0). `velocity_gradient` is grad v over the face (1/s)
/// ([`NSO12`](crate::papers::NSO12)).
pub fn velocity_metric(velocity_gradient: Mat3x2, refine_velocity: f64) -> SymTensor2 {
    velocity_gradient.gram() * refine_velocity.powi(-2)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mesh::Mesh;
    use crate::sizing::tests::{flat, sheet};

    fn metric_of_first_face(mesh: &Mesh) -> SymTensor2 {
        let face = mesh.face_ids().next().unwrap();
        let v = mesh.face_nodes(face).map(|n| mesh.velocity[n]);
        velocity_metric(Mat3x2::from_gradients(v, mesh.shape_gradients(face)), 0.5)
    }

    #[test]
    fn a_rigid_turn_changes_velocity_by_the_angular_speed_across_its_axis() {
        let mut mesh = sheet(2, 2, 0.1, flat);
        let angular_velocity = DVec3::new(0.0, 3.0, 0.0);
        for node in mesh.node_ids() {
            mesh.velocity[node] = angular_velocity.cross(mesh.position[node]) + DVec3::X;
        }
        let m = metric_of_first_face(&mesh);
        assert!((m.xx - 36.0).abs() < 1e-9, "{m:?}");
        assert!(m.xy.abs() < 1e-9 && m.yy.abs() < 1e-9, "{m:?}");
    }

    #[test]
    fn even_motion_asks_for_nothing() {
        let mut mesh = sheet(2, 2, 0.1, flat);
        for node in mesh.node_ids() {
            mesh.velocity[node] = DVec3::new(5.0, -3.0, 2.0);
        }
        assert!(metric_of_first_face(&mesh).trace() < 1e-20);
    }
}
