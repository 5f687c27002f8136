//! Models of bending held against one another: a strip that droops, on meshes of every layout.
//!
//! Not a claim, but what the choice of [`BendingModel`] rests on. The strip is twice as long as the
//! cantilever and carried in the middle, so that symmetry clamps it: held rows of nodes would add
//! what the cloth between them gives way.

use glam::{DVec2, DVec3};

use super::cantilever::{ELASTICA, LENGTH, ratios};
use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{ExperimentError, GRAVITY, fabric};
use crate::dynamics::{StepState, System};
use crate::mesh::{Id, Mesh, RawMesh};
use crate::scene::{BendingModel, ElasticFabric, Fabric, IsotropicSheet};

/// All models, the one by itself first.
pub const MODELS: [BendingModel; 4] =
    [BendingModel::Hinges, BendingModel::MidEdge, BendingModel::Quadratic, BendingModel::Moments];

/// Loads on the way, so that the strip does not swing through.
const LOADS: [f64; 5] = [1.0, 5.0, 20.0, 50.0, 100.0];

const WIDTH: f64 = 0.05;
const DENSITY: f64 = 0.2;
const RIGIDITY: f64 = 1e-5;

/// What a strip is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    pub model: BendingModel,
    pub layout: Layout,
    /// Along the strip.
    pub cells: u32,
    /// L/h of a homogeneous strip of that membrane stiffness.
    pub slenderness: f64,
}

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Droop {
    /// (H/W) / (H/W of the elastica) - 1, at Gamma 5, 20 and 100.
    pub errors: [f64; 3],
    /// Steps until the strip was at rest, over all loads.
    pub steps: usize,
}

impl Droop {
    pub fn worst(&self) -> f64 {
        self.errors.iter().map(|e| e.abs()).fold(0.0, f64::max)
    }
}

/// # Errors
/// If the strip does not come to rest.
pub fn droop(trial: Trial) -> Result<Droop, ExperimentError> {
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::new(LENGTH, WIDTH),
        cell: LENGTH / f64::from(trial.cells),
        layout: trial.layout,
        columns: Vec::new(),
    };
    let half = sheet.mesh(|u| u.extend(0.0));
    let mut strip = Specimen::new(mirrored(&half), &homogeneous(trial.model, trial.slenderness));
    strip.clamp(|u| u.x == 0.0);
    let gravity = |gamma: f64| DVec3::NEG_Z * (gamma * RIGIDITY / (DENSITY * LENGTH.powi(3)));
    let rest = |strip: &Specimen| Rest {
        residual: 1e-5,
        load: strip.mass() * strip.gravity.length(),
        first_step: 0.05,
        steps_max: 2000,
    };
    let (ratios, steps) = ratios(&mut strip, &LOADS, gravity, rest)?;
    let errors = std::array::from_fn(|k| ratios[k] / ELASTICA[k].1 - 1.0);
    Ok(Droop { errors, steps })
}

/// H/W of a strip of 20 cm under its own weight on the earth, bent along warp and along weft.
///
/// # Errors
/// If a strip does not come to rest.
pub fn droop_of(fabric: &ElasticFabric) -> Result<[f64; 2], ExperimentError> {
    let turned = ElasticFabric {
        bending_rigidity: [fabric.bending_rigidity[1], fabric.bending_rigidity[0]],
        membrane_stiffness: [fabric.membrane_stiffness[1], fabric.membrane_stiffness[0]],
        ..fabric.clone()
    };
    Ok([hanging(fabric.clone())?, hanging(turned)?])
}

/// Cells along a strip by root Gamma: a long strip bends over L / sqrt(Gamma) below its clamp and
/// hangs from there.
const CELLS_PER_ROOT: f64 = 2.5;

fn hanging(fabric: ElasticFabric) -> Result<f64, ExperimentError> {
    let gamma = fabric.density * GRAVITY * LENGTH.powi(3) / fabric.bending_rigidity[0];
    let cell = LENGTH / (CELLS_PER_ROOT * gamma.sqrt()).clamp(20.0, 200.0);
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::new(LENGTH, 4.0 * cell),
        cell,
        layout: Layout::Aligned,
        columns: Vec::new(),
    };
    let half = sheet.mesh(|u| u.extend(0.0));
    let mut strip = Specimen::new(mirrored(&half), &Fabric::Elastic(fabric));
    strip.clamp(|u| u.x == 0.0);
    // Each load three times the last.
    let steps = (gamma.max(1.0).ln() / 3f64.ln()).ceil() as i32;
    for left in (0..=steps).rev() {
        strip.gravity = DVec3::NEG_Z * GRAVITY / 3f64.powi(left);
        let load = strip.mass() * strip.gravity.length();
        strip.settle(&Rest { residual: 1e-4, load, first_step: 0.02, steps_max: 3000 })?;
    }
    let tip = strip.mean_position(|u| u.x == LENGTH);
    Ok(-tip.z / tip.x)
}

/// A curled sheet of about 3200 faces, to see what a model costs.
pub fn curled(model: BendingModel) -> (System, StepState) {
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::splat(LENGTH),
        cell: LENGTH / 40.0,
        layout: Layout::Irregular,
        columns: Vec::new(),
    };
    let radius = 0.05;
    let mesh = sheet.mesh(|u| {
        let (sine, cosine) = (u.x / radius).sin_cos();
        DVec3::new(radius * sine, u.y, radius * cosine)
    });
    let system = System::new(&[&mesh], &[&homogeneous(model, 100.0)]);
    (system, StepState::gathered(&[&mesh]))
}

fn homogeneous(model: BendingModel, slenderness: f64) -> Fabric {
    let sheet = IsotropicSheet {
        density: DENSITY,
        membrane_stiffness: 12.0 * RIGIDITY * (slenderness / LENGTH).powi(2),
        poisson_ratio: 0.0,
        bending_rigidity: RIGIDITY,
    };
    fabric::bending_by(model, sheet)
}

/// A flat sheet at u >= 0 and its mirror image, one across the line u = 0.
fn mirrored(half: &Mesh) -> Mesh {
    let mut points: Vec<DVec2> = half.vertex_ids().map(|v| half.material(v)).collect();
    let mut image = Vec::with_capacity(points.len());
    for k in 0..points.len() {
        let u = points[k];
        image.push(if u.x == 0.0 { k as u32 } else { points.len() as u32 });
        if u.x != 0.0 {
            points.push(DVec2::new(-u.x, u.y));
        }
    }
    let mut faces = Vec::with_capacity(2 * half.face_count());
    for face in half.face_ids() {
        let [a, b, c] = half.face_vertices(face).map(|v| v.index() as u32);
        faces.extend([[a, b, c], [c, b, a].map(|k| image[k as usize])]);
    }
    let raw = RawMesh {
        positions: points.iter().map(|u| u.extend(0.0)).collect(),
        vertices: (0..).zip(points).collect(),
        faces,
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("a mirrored mesh is a mesh")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_droop_as_the_elastica_does_on_meshes_of_every_layout() {
        for layout in [Layout::Aligned, Layout::Rotated(0.5), Layout::Irregular] {
            let (cells, model) = (24, BendingModel::Moments);
            let droop = droop(Trial { model, layout, cells, slenderness: 100.0 }).unwrap();
            assert!(droop.worst() < 0.02, "{}: {:?}", layout.name(), droop.errors);
        }
    }

    #[test]
    fn a_mirrored_sheet_is_twice_as_large() {
        let sheet = Sheet {
            origin: DVec2::ZERO,
            size: DVec2::new(0.2, 0.05),
            cell: 0.01,
            layout: Layout::Irregular,
            columns: Vec::new(),
        };
        let mesh = mirrored(&sheet.mesh(|u| u.extend(0.0)));
        mesh.check().unwrap();
        assert!((mesh.total_material_area() - 0.02).abs() < 1e-12);
    }
}
