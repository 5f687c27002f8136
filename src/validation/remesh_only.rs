//! What edits of the mesh cost while time stands still.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, fabric};
use crate::math::{Random, SymTensor2};
use crate::mesh::{Collapse, IdVec, Mesh, MeshEditor, NodeId};
use crate::remesh::{NoGuard, RemeshSettings, remesh};
use crate::scene::Fabric;

/// Of the tube, along its bend and across (m).
const SIZE: DVec2 = DVec2::new(0.4, 0.3);
const CELL: f64 = 0.015;

/// How much of either end is held (m).
const HELD: f64 = 1.5 * CELL;

/// (N m).
const RIGIDITY: f64 = 1e-4;

/// In units of what it takes to hold the tube bent, D / R.
const REST: Rest =
    Rest { residual: 1e-5, load: RIGIDITY * FRAC_PI_2 / SIZE.x, first_step: 1e-2, steps_max: 2000 };

pub fn experiments() -> Vec<Experiment> {
    let claims = vec![
        Claim::absolute("remesh-only/mass", 0.0, 1e-12),
        Claim::absolute("remesh-only/momentum", 0.0, 1e-12),
        Claim::absolute("remesh-only/bending-energy", 0.0, 1e-10),
    ];
    let remeshed = vec![
        Claim::absolute("remesh-only/refined-and-coarsened/mass", 0.0, 1e-12),
        Claim::absolute("remesh-only/refined-and-coarsened/momentum", 0.0, 1e-3),
        Claim::absolute("remesh-only/refined-and-coarsened/bending-energy-at-rest", 0.0, 0.05),
    ];
    vec![
        Experiment::new(claims, || changes(split_and_collapsed, Moment::AtOnce)),
        Experiment::new(remeshed, || changes(|m| Ok(refined_and_coarsened(m)), Moment::AtRest)),
    ]
}

/// When the bending energies are compared. New nodes lie on the faces they split, not on the tube:
/// at once, the folds of another mesh tell more of the old mesh than of the cloth.
#[derive(Clone, Copy, PartialEq)]
enum Moment {
    AtOnce,
    /// When both tubes have settled between the ends that hold them.
    AtRest,
}

/// The relative changes of mass, momentum and bending energy of a quarter of a tube, as it flies
/// and turns, by an edit.
fn changes(
    edit: impl Fn(Mesh) -> Result<Mesh, ExperimentError>,
    moment: Moment,
) -> Result<Vec<f64>, ExperimentError> {
    let fabric = fabric();
    let mesh = tube();
    let mut tubes = [mesh.clone(), edit(mesh)?].map(|mesh| Specimen::new(mesh, &fabric));
    let [before, after] = &tubes;
    let momentum = before.momentum();
    let mass_change = (after.mass() / before.mass() - 1.0).abs();
    let momentum_change = after.momentum().distance(momentum) / momentum.length();
    if moment == Moment::AtRest {
        for tube in &mut tubes {
            tube.clamp_at(|u| (u.x - 0.5 * SIZE.x).abs() > 0.5 * SIZE.x - HELD, on_tube);
            tube.settle(&REST)?;
        }
    }
    let [before, after] = tubes.map(|tube| bending_energy(&tube, &fabric));
    Ok(vec![mass_change, momentum_change, (after / before - 1.0).abs()])
}

/// Of a homogeneous sheet as thick as a hundredth of its length: of a tauter one, a coarse mesh locks.
fn fabric() -> Fabric {
    let stretching = fabric::homogeneous_stretching(RIGIDITY, 0.0, 0.01 * SIZE.x);
    fabric::plain(RIGIDITY, stretching, 0.2)
}

fn tube() -> Mesh {
    let (origin, layout) = (DVec2::ZERO, Layout::Irregular);
    let sheet = Sheet { origin, size: SIZE, cell: CELL, layout, columns: Vec::new() };
    let mut mesh = sheet.mesh(on_tube);
    let (speed, spin) = (DVec3::new(1.0, 2.0, 0.5), DVec3::new(0.0, 3.0, 1.0));
    for node in mesh.node_ids() {
        mesh.velocity[node] = speed + spin.cross(mesh.position[node]);
    }
    mesh
}

fn on_tube(u: DVec2) -> DVec3 {
    let radius = SIZE.x / FRAC_PI_2;
    let (sine, cosine) = (u.x / radius).sin_cos();
    DVec3::new(radius * sine, u.y, radius * cosine)
}

/// Energy of the specimen without that of its membrane (J).
fn bending_energy(specimen: &Specimen, fabric: &Fabric) -> f64 {
    use crate::dynamics::stretch::{energy_density, green_strain};
    let mesh = &specimen.mesh;
    let of = |f| {
        let deformation = mesh.deformation_gradient(f);
        let stiffness = fabric.stretch_stiffness(deformation);
        mesh.material_area(f) * energy_density(stiffness, green_strain(deformation))
    };
    let membrane: f64 = mesh.face_ids().map(of).sum();
    specimen.system.potential_energy(&specimen.state) - membrane
}

/// Remeshed to half as long edges, and to edges as long as the longest were.
fn refined_and_coarsened(mesh: Mesh) -> Mesh {
    let lengths = mesh.edges().map(|c| {
        let [a, b] = mesh.edge_vertices(c).map(|v| mesh.material(v));
        a.distance(b)
    });
    let longest = lengths.fold(0.0, f64::max);
    [0.5 * longest, longest].into_iter().fold(mesh, |mut mesh, length| {
        let metric = SymTensor2::isotropic((length * length).recip());
        mesh.metric = IdVec::filled(metric, mesh.vertex_count());
        remesh(mesh, &RemeshSettings::default(), &NoGuard).0
    })
}

/// A third of the edges are split, and every new node goes back to an end of the edge it came from.
fn split_and_collapsed(mesh: Mesh) -> Result<Mesh, ExperimentError> {
    let mut random = Random::new(5);
    let mut editor = MeshEditor::new(mesh);
    // By nodes, which stay while faces come and go.
    let edges = editor.edges().filter(|_| random.number() < -1.0 / 3.0);
    let edges: Vec<[NodeId; 2]> = edges.map(|c| editor.mesh().edge_nodes(c)).collect();
    for [kept, other] in edges {
        let lost = ExperimentError::Nothing("an edge was lost");
        let corner = editor.mesh().edge_between(kept, other).ok_or(lost)?;
        let removed = editor.split(corner);
        let corner = editor.mesh().edge_between(removed, kept);
        let corner = corner.expect("a split leaves an edge to either end");
        editor
            .collapse(Collapse { corner, removed, kept })
            .map_err(|_| ExperimentError::Nothing("a split could not be collapsed again"))?;
    }
    Ok(editor.finish())
}
