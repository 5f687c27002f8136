//! Patch test: cloth mapped affinely is stressed the same everywhere, whatever its triangles.

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError};
use crate::dynamics::stretch::{green_strain, stress};
use crate::math::SymTensor2;
use crate::mesh::Mesh;
use crate::scene::Fabric;

/// What the map makes of u and v: stretched, sheared and turned out of the plane.
const MAP: [DVec3; 2] = [DVec3::new(1.1, 0.1, 0.2), DVec3::new(-0.1, 1.02, 0.05)];

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let claims = ["stress", "inner-force"].map(|what| {
            Claim::absolute(format!("patch-test/{}/{what}", layout.name()), 0.0, 1e-10)
        });
        Experiment::new(claims.into(), move || measure(layout))
    };
    [Layout::Rotated(0.3), Layout::Irregular].map(of).into()
}

/// The largest difference of stress between faces, and the largest force on an inner node, relative
/// to the stress, and to the stress times the side of a cell.
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let fabric = super::fabric::plain(1e-4, 500.0, 0.2);
    let size = DVec2::new(0.6, 0.4);
    let sheet = Sheet { origin: DVec2::ZERO, size, cell: 0.04, layout, columns: Vec::new() };
    let mut specimen = Specimen::new(sheet.mesh(|u| MAP[0] * u.x + MAP[1] * u.y), &fabric);
    let stresses = stresses(&specimen.mesh, &fabric);
    let scale = magnitude(stresses[0]);
    let apart = stresses.iter().map(|&s| magnitude(s - stresses[0])).fold(0.0, f64::max);
    let forces = specimen.forces();
    let inner = specimen.mesh.node_ids().zip(&forces);
    let inner = inner.filter(|(node, _)| !specimen.mesh.is_boundary_node(*node));
    let force = inner.map(|(_, force)| force.length()).fold(0.0, f64::max);
    Ok(vec![apart / scale, force / (scale * sheet.cell)])
}

/// Second Piola-Kirchhoff, per face (N/m).
fn stresses(mesh: &Mesh, fabric: &Fabric) -> Vec<SymTensor2> {
    let of = |f| {
        let deformation = mesh.deformation_gradient(f);
        stress(fabric.stretch_stiffness(deformation), green_strain(deformation))
    };
    mesh.face_ids().map(of).collect()
}

fn magnitude(s: SymTensor2) -> f64 {
    (s.xx * s.xx + 2.0 * s.xy * s.xy + s.yy * s.yy).sqrt()
}
