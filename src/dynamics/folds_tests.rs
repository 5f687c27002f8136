//! Bending of elastic sheets: energies of known shapes on meshes of every kind.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use nalgebra::{DMatrix, DVector};

use super::folds::FoldLaw;
use super::testing::{Random, gradient_error, seamed_strip, sheet};
use super::*;
use crate::mesh::{FaceId, Id, Mesh, RawMesh};
use crate::scene::{BendingModel, ElasticFabric, Fabric, IsotropicSheet};

const SHEET: IsotropicSheet = IsotropicSheet {
    density: 0.2,
    membrane_stiffness: 300.0,
    poisson_ratio: 0.0,
    bending_rigidity: 2e-5,
};
const PLATES: [BendingModel; 3] =
    [BendingModel::MidEdge, BendingModel::Quadratic, BendingModel::Moments];

fn fabric(poisson_ratio: f64, bending_model: BendingModel) -> Fabric {
    let sheet = IsotropicSheet { poisson_ratio, ..SHEET }.fabric();
    Fabric::Elastic(ElasticFabric { bending_model, ..sheet })
}

/// Warp four times as stiff as weft, little resistance to twist.
fn woven(bending_model: BendingModel) -> Fabric {
    let mut fabric = SHEET.fabric();
    fabric.bending_rigidity = [4e-5, 1e-5];
    fabric.twist_rigidity = 4e-6;
    Fabric::Elastic(ElasticFabric { bending_model, poisson_ratio: 0.2, ..fabric })
}

/// Bending energy alone (J).
fn bending_energy(mesh: &Mesh, fabric: &Fabric) -> f64 {
    let mut system = System::new(&[mesh], &[fabric]);
    let nothing = crate::scene::StretchStiffness { uu: 0.0, uv: 0.0, vv: 0.0, shear: 0.0 };
    system.frozen.stretch.fill(nothing);
    system.potential_energy(&StepState::gathered(&[mesh]))
}

/// A sheet of irregular triangles rolled up to a tube around y and sewn together.
fn tube(around: u32, along: u32, radius: f64, jitter: f64) -> Mesh {
    let mut random = Random::new(7);
    let mut raw = RawMesh::default();
    let cell = TAU * radius / f64::from(around);
    let shifts: Vec<DVec2> = (0..around * (along + 1))
        .map(|node| {
            let at_end = node < around || node >= around * along;
            let free = DVec2::new(1.0, if at_end { 0.0 } else { 1.0 });
            DVec2::new(random.number(), random.number()) * free * jitter
        })
        .collect();
    for row in 0..=along {
        for column in 0..=around {
            let node = row * around + column % around;
            let lattice = DVec2::new(f64::from(column), f64::from(row));
            let u = (lattice + shifts[node as usize]) * cell;
            if column < around {
                let (sine, cosine) = (u.x / radius).sin_cos();
                raw.positions.push(DVec3::new(radius * sine, u.y, radius * cosine));
            }
            raw.vertices.push((node, u));
        }
    }
    for (row, column) in (0..along).flat_map(|r| (0..around).map(move |c| (r, c))) {
        let a = row * (around + 1) + column;
        let (b, c, d) = (a + 1, a + around + 1, a + around + 2);
        raw.faces.extend(if (row + column) % 3 == 0 {
            [[a, b, c], [b, d, c]]
        } else {
            [[a, b, d], [a, d, c]]
        });
    }
    Mesh::from_raw(&raw, &[]).expect("a tube is a mesh")
}

/// A sheet bent to z = 1/2 u^T kappa u, so little that its lengths stay.
fn bent(mesh: &Mesh, kappa: [f64; 3]) -> Mesh {
    let mut mesh = mesh.clone();
    for vertex in mesh.vertex_ids() {
        let (u, node) = (mesh.material(vertex), mesh.node_of(vertex));
        let [xx, xy, yy] = kappa;
        let z = 0.5 * xx * u.x * u.x + xy * u.x * u.y + 0.5 * yy * u.y * u.y;
        mesh.position[node] = u.extend(z);
    }
    mesh
}

#[test]
fn a_tube_stores_half_the_rigidity_times_curvature_squared_whatever_its_mesh() {
    let radius = 0.1;
    for jitter in [0.0, 0.15, 0.3] {
        let tube = tube(60, 20, radius, jitter);
        let expected = 0.5 * 2e-5 / (radius * radius) * tube.total_material_area();
        let error = |model| bending_energy(&tube, &fabric(0.0, model)) / expected - 1.0;
        // Chords of an arc: folds of up to 0.2 rad.
        let limit = 4e-3;
        assert!(error(BendingModel::Moments).abs() < limit, "{}", error(BendingModel::Moments));
        assert!(error(BendingModel::Quadratic).abs() < limit, "{}", error(BendingModel::Quadratic));
        if jitter == 0.3 {
            assert!(error(BendingModel::MidEdge) > 0.05, "{}", error(BendingModel::MidEdge));
        }
    }
}

#[test]
fn a_twisted_sheet_stores_its_twist_energy_whatever_its_mesh() {
    let twist = 1e-3;
    for jitter in [0.0, 0.2, 0.35] {
        let mesh = bent(&sheet(12, 0.6, jitter), [0.0, twist, 0.0]);
        for nu in [0.0, 0.3] {
            // psi = (1 - nu) D kappa_xy^2.
            let expected = (1.0 - nu) * 2e-5 * twist * twist * mesh.total_material_area();
            for model in [BendingModel::Quadratic, BendingModel::Moments] {
                let error = bending_energy(&mesh, &fabric(nu, model)) / expected - 1.0;
                let limit = twist_limit(model);
                assert!(error.abs() < limit, "{model:?}, jitter {jitter}, nu {nu}: {error}");
            }
            let hinges = bending_energy(&mesh, &fabric(nu, BendingModel::Hinges)) / expected;
            assert!(hinges > 1.5, "hinges are too stiff against twist, here {hinges}");
        }
    }
}

/// A free edge carries no moment, nor does a twist along it; but leaving out a fold of a quadratic
/// surface does not mean quite that, and a sixth of the faces are at the rim.
fn twist_limit(model: BendingModel) -> f64 {
    if model == BendingModel::Moments { 1e-5 } else { 1e-2 }
}

#[test]
fn a_woven_twisted_sheet_stores_what_its_twist_rigidity_says() {
    let mesh = bent(&sheet(12, 0.6, 0.3), [0.0, 1e-3, 0.0]);
    let expected = 4e-6 * 1e-6 * mesh.total_material_area();
    for model in [BendingModel::Quadratic, BendingModel::Moments] {
        let error = bending_energy(&mesh, &woven(model)) / expected - 1.0;
        assert!(error.abs() < twist_limit(model), "{model:?}: {error}");
    }
}

/// What free edges take away goes with the side, what corners take away stays: the second difference
/// over three sizes of sheet leaves what goes with the area.
#[test]
fn a_quadratic_surface_has_the_energy_of_its_curvature() {
    let [xx, xy, yy] = [2e-3, -0.5e-3, 1e-3];
    let nu = 0.3;
    let density =
        0.5 * 2e-5 * (xx * xx + yy * yy + 2.0 * nu * xx * yy) + 2e-5 * (1.0 - nu) * xy * xy;
    for (model, jitter) in [
        (BendingModel::Quadratic, 0.0),
        (BendingModel::Quadratic, 0.3),
        (BendingModel::Moments, 0.0),
        (BendingModel::Moments, 0.3),
    ] {
        let of_cells = |cells: u32| {
            let mesh = bent(&sheet(cells, 0.05 * f64::from(cells), jitter), [xx, xy, yy]);
            bending_energy(&mesh, &fabric(nu, model))
        };
        let energy = of_cells(32) - 2.0 * of_cells(20) + of_cells(8);
        let cells = f64::from(32 * 32 - 2 * 20 * 20 + 8 * 8);
        let error = energy / (density * cells * 0.05 * 0.05) - 1.0;
        assert!(error.abs() < 0.01, "{model:?}, jitter {jitter}: {error}");
    }
}

/// h f of the elastic forces: the right side of a step from rest.
fn impulse(system: &mut System, position: &[DVec3], dt: f64) -> Vec<DVec3> {
    let velocity = vec![DVec3::ZERO; position.len()];
    let still = StepState { position: position.to_vec(), velocity };
    system.assemble(&still, &StepForces::NONE, dt);
    system.linear_system().1.to_vec()
}

#[test]
fn forces_are_minus_the_gradient_of_every_models_energy() {
    for model in PLATES {
        let fabric = woven(model);
        let meshes = [sheet(4, 0.4, 0.2), seamed_strip()];
        let mut system = System::new(&[&meshes[0], &meshes[1]], &[&fabric, &fabric]);
        system.frozen.stretch.iter_mut().for_each(|k| {
            *k = crate::scene::StretchStiffness { uu: 0.0, uv: 0.0, vv: 0.0, shear: 0.0 };
        });
        let mut state = StepState::gathered(&[&meshes[0], &meshes[1]]);
        let mut random = Random::new(21);
        state.position.iter_mut().for_each(|x| *x += random.vector() * 0.02);
        let forces = impulse(&mut system, &state.position, 1.0);
        let error = gradient_error(&system, &state, &forces, 1e-6);
        assert!(error < 1e-5, "{model:?}: off by {error}");
    }
}

#[test]
fn rigid_motions_and_rest_angles_store_no_energy() {
    let strip = seamed_strip();
    for model in PLATES {
        let mut system = System::new(&[&strip], &[&woven(model)]);
        for hinge in &mut system.hinges {
            hinge.rest_angle = 0.0;
        }
        let mut state = StepState::gathered(&[&strip]);
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0);
        state.position.iter_mut().for_each(|x| *x = turn * *x + DVec3::new(0.3, -2.0, 1.0));
        let fold = system.hinges.iter().map(|h| h.fold_at(&state.position).abs());
        assert!(fold.fold(0.0, f64::max) < 1e-12);
        let bending: f64 =
            system.garments.iter().map(|g| system.elastic_bending(g, &state.position)).sum();
        assert!(bending < 1e-25, "{model:?}: {bending} J");
    }
}

/// All eigenvalues of T^-1/2 K T^-1/2, K what makes moments of folds and T what the matrix has.
fn shares_of_the_matrix(law: &FoldLaw) -> DVector<f64> {
    let count = law.tangent().len();
    let columns = (0..count).map(|k| {
        let mut column = vec![0.0; count];
        column[k] = 1.0 / law.tangent()[k].sqrt();
        law.moments(&mut column);
        let scaled = column.iter().zip(law.tangent()).map(|(moment, t)| moment / t.sqrt());
        DVector::from_iterator(count, scaled)
    });
    let columns: Vec<_> = columns.collect();
    DMatrix::from_columns(&columns).symmetric_eigenvalues()
}

#[test]
fn energies_are_positive_and_at_most_twice_what_the_matrix_has() {
    let meshes =
        [sheet(5, 0.3, 0.0), sheet(6, 0.3, 0.2), sheet(5, 0.3, 0.35), tube(8, 3, 0.1, 0.2)];
    let with_sliver = with_sliver(&meshes[1]);
    for mesh in meshes.iter().chain([&with_sliver]) {
        for model in PLATES {
            for fabric in [fabric(0.3, model), woven(model)] {
                let system = System::new(&[mesh], &[&fabric]);
                let shares = shares_of_the_matrix(system.garments[0].fold_law.as_ref().unwrap());
                let (least, largest) = (shares.min(), shares.max());
                assert!(0.0 < least && largest <= 2.0, "{model:?}: {least}, {largest}");
            }
        }
    }
}

/// The mesh with a node more, in face 0 so close to an edge that a face is a billion times as long
/// as high.
fn with_sliver(mesh: &Mesh) -> Mesh {
    let [a, b, c] = mesh.face_vertices(FaceId::from_index(0)).map(|v| v.index() as u32);
    let mut raw = RawMesh {
        positions: mesh.position.iter().copied().collect(),
        vertices: mesh
            .vertex_ids()
            .map(|v| (mesh.node_of(v).index() as u32, mesh.material(v)))
            .collect(),
        faces: mesh.face_ids().map(|f| mesh.face_vertices(f).map(|v| v.index() as u32)).collect(),
        ..RawMesh::default()
    };
    let weights = [1e-9, 0.5, 0.5 - 1e-9];
    let corners = [a, b, c].map(|v| raw.vertices[v as usize]);
    let node = raw.positions.len() as u32;
    let middle = raw.vertices.len() as u32;
    let position = corners.iter().zip(weights).map(|(v, w)| raw.positions[v.0 as usize] * w).sum();
    let material = corners.iter().zip(weights).map(|(v, w)| v.1 * w).sum();
    raw.positions.push(position);
    raw.vertices.push((node, material));
    raw.faces[0] = [a, b, middle];
    raw.faces.extend([[b, c, middle], [c, a, middle]]);
    Mesh::from_raw(&raw, &[]).expect("a sliver has an area")
}

#[test]
fn a_sliver_changes_next_to_nothing() {
    let radius = 0.1;
    let tube = with_sliver(&tube(60, 20, radius, 0.3));
    let fabric = fabric(0.0, BendingModel::Moments);
    let system = System::new(&[&tube], &[&fabric]);
    assert_eq!(system.bending_fallbacks().count(), 0);
    let expected = 0.5 * 2e-5 / (radius * radius) * tube.total_material_area();
    let error = bending_energy(&tube, &fabric) / expected - 1.0;
    assert!(error.abs() < 4e-3, "{error}");
}

#[test]
fn moments_that_cannot_be_had_fall_back_to_mid_edge_normals_and_say_so() {
    let mesh = sheet(3, 0.3, 0.1);
    // No fabric that can be loaded is as bad as a Poisson's ratio beyond 1.
    let fabrics = [0.3, 1.5].map(|nu| fabric(nu, BendingModel::Moments));
    let system = System::new(&[&mesh, &mesh], &[&fabrics[0], &fabrics[1]]);
    assert_eq!(system.bending_fallbacks().collect::<Vec<_>>(), [1]);
    let mid_edge = System::new(&[&mesh], &[&fabric(1.5, BendingModel::MidEdge)]);
    let laws = [&system.garments[1], &mid_edge.garments[0]].map(|g| g.fold_law.as_ref().unwrap());
    assert_eq!(laws[0].tangent(), laws[1].tangent());
}

#[test]
fn a_sheet_that_nothing_bends_has_hinges_without_stiffness() {
    let limp = IsotropicSheet { bending_rigidity: 0.0, ..SHEET }.fabric();
    let system = System::new(&[&sheet(3, 0.3, 0.1)], &[&Fabric::Elastic(limp)]);
    assert!(system.garments[0].fold_law.is_none());
    assert!(system.frozen.bending.iter().all(|&k| k == 0.0));
}

#[test]
fn a_crumpled_elastic_sheet_calms_down() {
    for model in PLATES {
        let mesh = sheet(8, 0.4, 0.2);
        let mut system = System::new(&[&mesh], &[&woven(model)]);
        let mut state = StepState::gathered(&[&mesh]);
        let mut random = Random::new(12);
        state.position.iter_mut().for_each(|x| *x += random.vector() * 0.02);
        let energy = |system: &System, state: &StepState| {
            system.potential_energy(state) + system.kinetic_energy(state)
        };
        let start = energy(&system, &state);
        for _ in 0..200 {
            system.step(&mut state, &StepForces::NONE, 5e-3).unwrap();
        }
        let left = energy(&system, &state);
        assert!(left < 0.05 * start, "{model:?}: {left} J of {start} J are left");
    }
}
