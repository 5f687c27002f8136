//! The criteria combined: one metric per face.

use glam::DVec3;

use super::{
    Plane, compression_metric, curvature_metric, hinge_curvature_metric, obstacle_metric,
    second_fundamental_form, velocity_metric,
};
use crate::math::{Mat3x2, SymTensor2, tensor_max};
use crate::mesh::{FaceId, IdVec, Mesh, NodeId};
use crate::scene::SizingSettings;

/// The metric each face asks for (1/m^2), whoever looks ([`NSO12`](crate::papers::NSO12)): the
/// tensor maximum of curvature (by vertex normals, then by hinges), velocity, compression and
/// obstacle, in this order; eigenvalues within the bounds on edge length; then the least aspect.
///
/// `planes` holds per node the nearest obstacle, where one is near enough to matter. Finite
/// tolerances must be above 0; an infinite one switches its criterion off.
pub fn base_metric(
    mesh: &Mesh,
    settings: &SizingSettings,
    planes: &IdVec<NodeId, Option<Plane>>,
) -> IdVec<FaceId, SymTensor2> {
    assert_eq!(planes.len(), mesh.node_count(), "there is a plane or none for every node");
    let normals = uses_normals(settings).then(|| mesh.node_normals());
    let least = settings.edge_length_max.powi(-2);
    let greatest = settings.edge_length_min.powi(-2);
    mesh.face_ids()
        .map(|face| {
            wanted_metric(mesh, settings, planes, normals.as_ref(), face)
                .clamp_eigenvalues(least, greatest)
                .with_aspect_at_least(settings.aspect_min)
        })
        .collect()
}

fn uses_normals(settings: &SizingSettings) -> bool {
    settings.refine_angle.is_finite() || settings.refine_compression.is_finite()
}

/// The criteria that are switched on, combined in their fixed order.
fn wanted_metric(
    mesh: &Mesh,
    settings: &SizingSettings,
    planes: &IdVec<NodeId, Option<Plane>>,
    normals: Option<&IdVec<NodeId, DVec3>>,
    face: FaceId,
) -> SymTensor2 {
    let nodes = mesh.face_nodes(face);
    let positions = nodes.map(|n| mesh.position[n]);
    let shapes = mesh.shape_gradients(face);
    let deformation = Mat3x2::from_gradients(positions, shapes);
    let normal_gradient = normals
        .map_or(Mat3x2::ZERO, |normals| Mat3x2::from_gradients(nodes.map(|n| normals[n]), shapes));
    let mut metric = SymTensor2::ZERO;
    if settings.refine_angle.is_finite() {
        let by_normals = curvature_metric(normal_gradient, settings.refine_angle);
        let form = second_fundamental_form(mesh, face);
        let by_hinges = hinge_curvature_metric(form, settings.refine_angle);
        metric = tensor_max(by_normals, by_hinges);
    }
    if settings.refine_velocity.is_finite() {
        let gradient = Mat3x2::from_gradients(nodes.map(|n| mesh.velocity[n]), shapes);
        metric = tensor_max(metric, velocity_metric(gradient, settings.refine_velocity));
    }
    if settings.refine_compression.is_finite() {
        let c = settings.refine_compression;
        metric = tensor_max(metric, compression_metric(deformation, normal_gradient, c));
    }
    let planes = nodes.map(|n| planes[n]);
    if planes.iter().any(Option::is_some) {
        metric = tensor_max(metric, obstacle_metric(deformation, positions, planes));
    }
    metric
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sizing::tests::{around_cylinder, flat, sheet};

    fn no_planes(mesh: &Mesh) -> IdVec<NodeId, Option<Plane>> {
        IdVec::filled(None, mesh.node_count())
    }

    #[test]
    fn a_sheet_at_rest_gets_the_longest_edges() {
        let mesh = sheet(4, 4, 0.05, flat);
        let settings = SizingSettings::default();
        for m in &base_metric(&mesh, &settings, &no_planes(&mesh)) {
            assert!((m.xx - 25.0).abs() < 1e-9 && (m.yy - 25.0).abs() < 1e-9, "{m:?}");
        }
    }

    #[test]
    fn bounds_and_aspect_hold_for_every_face() {
        let mesh = sheet(12, 12, 0.03, around_cylinder(0.05));
        let settings = SizingSettings::default();
        let planes = mesh
            .position
            .iter()
            .map(|x| Some(Plane { point: *x - DVec3::X * 0.001, normal: DVec3::X }))
            .collect();
        for m in &base_metric(&mesh, &settings, &planes) {
            let [large, small] = m.eigen().values;
            assert!(large <= 1e4 * (1.0 + 1e-12) && small >= 25.0 * (1.0 - 1e-12));
            assert!(small >= 0.04 * large * (1.0 - 1e-9), "{small} is too small for {large}");
        }
    }

    #[test]
    fn infinite_tolerances_leave_only_the_longest_edges() {
        let mut mesh = sheet(6, 6, 0.03, around_cylinder(0.05));
        mesh.velocity = mesh.position.iter().map(|x| *x * 100.0).collect();
        let settings = SizingSettings {
            refine_angle: f64::INFINITY,
            refine_compression: f64::INFINITY,
            refine_velocity: f64::INFINITY,
            ..SizingSettings::default()
        };
        for m in &base_metric(&mesh, &settings, &no_planes(&mesh)) {
            assert!((m.xx - 25.0).abs() < 1e-9 && m.xy.abs() < 1e-9 && (m.yy - 25.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_collapsed_face_still_has_a_finite_metric() {
        let mut mesh = sheet(3, 3, 0.05, flat);
        for x in mesh.position.iter_mut() {
            *x = DVec3::ZERO;
        }
        let metrics = base_metric(&mesh, &SizingSettings::default(), &no_planes(&mesh));
        assert!(metrics.iter().all(|m| m.is_finite()));
    }
}
