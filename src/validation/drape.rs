//! A round cloth draped over a smaller round support: how much of the free ring's shadow is left.
//!
//! Cusick's drape coefficient: DC = (A_shadow - A_support) / (A_flat - A_support), for a disc of
//! 30 cm on a support of 18 cm.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::sheet::Scatter;
use super::specimen::{Rest, Specimen};
use super::triangulate::delaunay;
use super::{Claim, Experiment, ExperimentError, GRAVITY, fabric};
use crate::mesh::{Mesh, RawMesh};
use crate::scene::Fabric;

/// (m).
const RADIUS: f64 = 0.15;
const SUPPORT: f64 = 0.09;

/// Rings of nodes from the edge of the support to that of the cloth; one more is held inside.
const RINGS: u32 = 9;

/// Height of the bumps that tell folds where to begin (m).
const BUMPS: f64 = 1e-4;

/// A typical cloth of its kind.
struct Cloth {
    name: &'static str,
    /// (kg/m^2).
    density: f64,
    /// (N m).
    rigidity: f64,
    /// Least and largest drape coefficient of its kind (%).
    range: [f64; 2],
}

/// Densities and rigidities from the middle of what is measured of such cloths; the same along warp
/// and weft.
const CLOTHS: [Cloth; 3] = [
    Cloth { name: "cotton", density: 0.13, rigidity: 9e-6, range: [60.0, 76.0] },
    Cloth { name: "silk", density: 0.08, rigidity: 1.2e-6, range: [20.0, 40.0] },
    Cloth { name: "denim", density: 0.40, rigidity: 5e-5, range: [70.0, 90.0] },
];

/// (N/m).
const STRETCHING: f64 = 1e3;

pub fn experiments() -> Vec<Experiment> {
    let of = |cloth: Cloth| {
        let [low, high] = cloth.range;
        let name = format!("drape/{}-percent", cloth.name);
        let claim = Claim::absolute(name, 0.5 * (low + high), 0.5 * (high - low));
        let fabric = fabric::plain(cloth.rigidity, STRETCHING, cloth.density);
        Experiment::new(vec![claim], move || Ok(vec![100.0 * coefficient(&fabric)?]))
    };
    CLOTHS.map(of).into()
}

/// Cusick's drape coefficient of a fabric, 0..1.
///
/// # Errors
/// If the cloth does not come to rest.
pub fn coefficient(fabric: &Fabric) -> Result<f64, ExperimentError> {
    let mut cloth = Specimen::new(ring(), fabric);
    cloth.clamp(|u| u.length() < SUPPORT * (1.0 + 1e-9));
    let mut random = Scatter(11);
    for vertex in cloth.vertices(|u| u.length() > SUPPORT * (1.0 + 1e-9)) {
        let node = cloth.node_of(vertex);
        cloth.state.position[node].z += BUMPS * random.number();
    }
    cloth.gravity = DVec3::NEG_Z * GRAVITY;
    let load = cloth.mass() * GRAVITY;
    cloth.settle(&Rest { residual: 1e-4, load, first_step: 0.01, steps_max: 2000 })?;
    let area = |radius: f64| PI * radius * radius;
    Ok((shadow(&cloth) - area(SUPPORT)) / (area(RADIUS) - area(SUPPORT)))
}

/// The area that the cloth's edge encloses, seen from above (m^2), the cut corners of its polygon
/// made up for.
fn shadow(cloth: &Specimen) -> f64 {
    let mut edge = cloth.vertices(|u| u.length() > RADIUS * (1.0 - 1e-9));
    let angle = |v: &crate::mesh::VertexId| cloth.mesh.material(*v).to_angle();
    edge.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let enclosed = |at: &dyn Fn(usize) -> DVec2| -> f64 {
        (0..edge.len()).map(|k| 0.5 * at(k).perp_dot(at((k + 1) % edge.len()))).sum()
    };
    let flat = enclosed(&|k| cloth.mesh.material(edge[k]));
    let seen = enclosed(&|k| cloth.state.position[cloth.node_of(edge[k])].truncate());
    seen * PI * RADIUS * RADIUS / flat
}

/// The free part of the cloth and two rings that the support holds.
fn ring() -> Mesh {
    let spacing = (RADIUS - SUPPORT) / f64::from(RINGS);
    let mut points = Vec::new();
    for ring in 0..=RINGS + 1 {
        let radius = SUPPORT + spacing * (f64::from(ring) - 1.0);
        let count = (TAU * radius / spacing).round() as u32;
        // Neighbouring rings stand in each other's gaps, as far as their counts allow.
        let first = 0.5 * f64::from(ring % 2);
        let at = |k: u32| DVec2::from_angle(TAU * (f64::from(k) + first) / f64::from(count));
        points.extend((0..count).map(|k| at(k) * radius));
    }
    let inner = |u: DVec2| u.length() < SUPPORT - 0.5 * spacing;
    let mut faces = delaunay(&points);
    faces.retain(|t| !t.iter().all(|&k| inner(points[k as usize])));
    let raw = RawMesh {
        positions: points.iter().map(|u| u.extend(0.0)).collect(),
        vertices: (0..).zip(points).collect(),
        faces,
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("a ring is a mesh")
}
