//! The cantilever of [`cantilever`](super::cantilever), remeshed as fine as its curvature asks
//! whenever it has come to rest under a part of its load.

use glam::{DVec2, DVec3};

use super::cantilever::{ELASTICA, fabric_for, gravity, loads, rest};
use super::sheet::{Layout, Sheet};
use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError};
use crate::mesh::{IdVec, Mesh};
use crate::remesh::{NoGuard, RemeshSettings, remesh};
use crate::scene::SizingSettings;
use crate::sizing::{base_metric, faces_to_vertices};

const LENGTH: f64 = 0.2;
const WIDTH: f64 = LENGTH / 8.0;

/// Cells along the strip before it is first refined.
const CELLS: f64 = 20.0;

/// (m).
const EDGE_MIN: f64 = LENGTH / 80.0;

const TOLERANCE: f64 = 0.05;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let claim = |(gamma, ratio): (f64, f64)| {
            let name = format!("cantilever/gamma-{gamma}/{}/remeshed", layout.name());
            Claim::relative(name, ratio, TOLERANCE)
        };
        Experiment::new(ELASTICA.map(claim).into(), move || drop_to_reach(layout))
    };
    [Layout::Aligned, Layout::Rotated(std::f64::consts::FRAC_PI_4), Layout::Irregular]
        .map(of)
        .into()
}

fn sizing() -> SizingSettings {
    SizingSettings {
        refine_angle: 0.05,
        edge_length_min: EDGE_MIN,
        edge_length_max: LENGTH / 20.0,
        ..SizingSettings::default()
    }
}

/// H / W at each load of the table.
fn drop_to_reach(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let fabric = fabric_for(20.0);
    let mut mesh = strip(layout);
    let mut ratios = Vec::new();
    for gamma in loads() {
        for _ in 0..2 {
            let mut strip = Specimen::new(mesh, &fabric);
            strip.clamp_at(|u| u.x < EDGE_MIN, |u| u.extend(0.0));
            strip.gravity = gravity(gamma);
            strip.settle(&rest(&strip))?;
            mesh = refined(strip.into_mesh());
        }
        if ELASTICA.iter().any(|(named, _)| *named == gamma) {
            let mut strip = Specimen::new(mesh, &fabric);
            strip.clamp_at(|u| u.x < EDGE_MIN, |u| u.extend(0.0));
            strip.gravity = gravity(gamma);
            strip.settle(&rest(&strip))?;
            let tip: DVec3 = strip.mean_position(|u| u.x == LENGTH);
            ratios.push(-tip.z / tip.x);
            mesh = strip.into_mesh();
        }
    }
    Ok(ratios)
}

/// Clamped at u = 0 half way between two rows, as [`cantilever`](super::cantilever) is, so close
/// that there is no room for another between them.
fn strip(layout: Layout) -> Mesh {
    let origin = DVec2::new(-0.5 * EDGE_MIN, -0.5 * WIDTH);
    let size = DVec2::new(LENGTH + 0.5 * EDGE_MIN, WIDTH);
    let columns = vec![0.5 * EDGE_MIN];
    Sheet { origin, size, cell: LENGTH / CELLS, layout, columns }.mesh(|u| u.extend(0.0))
}

/// Remeshed by its shape alone: nothing is near, and nothing moves.
fn refined(mut mesh: Mesh) -> Mesh {
    mesh.velocity = IdVec::filled(DVec3::ZERO, mesh.node_count());
    let sizing = sizing();
    let planes = IdVec::filled(None, mesh.node_count());
    let metric = base_metric(&mesh, &sizing, &planes);
    mesh.metric = faces_to_vertices(&mesh, &metric);
    let settings = RemeshSettings { aspect_min: sizing.aspect_min, ..RemeshSettings::default() };
    remesh(mesh, &settings, &NoGuard).0
}
