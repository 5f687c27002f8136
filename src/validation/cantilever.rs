//! A strip clamped level at one end droops under its own weight, whatever its mesh.
//!
//! With Gamma = rho g L^3 / D (rho per area) the drop H and the reach W of the tip follow from the
//! elastica ([`RLBD21`](crate::papers::RLBD21)): D theta'' = -rho g (L - s) cos theta.

use std::f64::consts::FRAC_PI_4;

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, GRAVITY, fabric};
use crate::mesh::Mesh;
use crate::scene::Fabric;

/// Gamma and H/W.
pub(super) const ELASTICA: [(f64, f64); 3] = [(5.0, 0.58572), (20.0, 1.86393), (100.0, 5.88810)];

/// Where the load is stepped up to on the way, so that the strip does not swing through.
const ON_THE_WAY: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

pub(super) const LENGTH: f64 = 0.2;
const DENSITY: f64 = 0.2;
/// As thick as this a homogeneous sheet would have the membrane stiffness used (m).
const THICKNESS: f64 = LENGTH / 100.0;
/// As thick as cloth is taut: triangles that do not lie along the fold cannot bend without
/// stretching.
const TAUT: f64 = LENGTH / 1000.0;
const CELLS_ACROSS: f64 = 8.0;
const CELLS_ALONG: f64 = 64.0;

const TOLERANCE: f64 = 0.02;

pub fn experiments() -> Vec<Experiment> {
    let fixed = Layout::ALL.map(|layout| experiment(layout, THICKNESS, "fixed"));
    let taut = [Layout::Aligned, Layout::Rotated(FRAC_PI_4)]
        .map(|layout| experiment(layout, TAUT, "fixed-taut"));
    fixed.into_iter().chain(taut).collect()
}

fn experiment(layout: Layout, thickness: f64, kind: &str) -> Experiment {
    let claim = |(gamma, ratio): (f64, f64)| {
        let name = format!("cantilever/gamma-{gamma}/{}/{kind}", layout.name());
        Claim::relative(name, ratio, TOLERANCE)
    };
    Experiment::new(ELASTICA.map(claim).into(), move || drop_to_reach(layout, thickness))
}

/// H / W at each load of the table.
fn drop_to_reach(layout: Layout, thickness: f64) -> Result<Vec<f64>, ExperimentError> {
    let cell = LENGTH / CELLS_ALONG;
    let mut strip = Specimen::new(strip(layout, cell), &fabric_of(GAMMA_NAMED, thickness));
    let clamp = held(cell);
    strip.clamp(|u| u.x < clamp);
    let (ratios, _) = ratios(&mut strip, &loads(), gravity, rest)?;
    Ok(ratios)
}

/// H / W of a strip under growing loads, at those of the table, and the steps until rest over all.
pub(super) fn ratios(
    strip: &mut Specimen,
    loads: &[f64],
    gravity: impl Fn(f64) -> DVec3,
    rest: impl Fn(&Specimen) -> Rest,
) -> Result<(Vec<f64>, usize), ExperimentError> {
    let (mut ratios, mut steps) = (Vec::new(), 0);
    for &gamma in loads {
        strip.gravity = gravity(gamma);
        steps += strip.settle(&rest(strip))?;
        if ELASTICA.iter().any(|(named, _)| *named == gamma) {
            let tip = strip.mean_position(|u| u.x == LENGTH);
            ratios.push(-tip.z / tip.x);
        }
    }
    Ok((ratios, steps))
}

/// The load at which the fabric has the weight of the earth.
const GAMMA_NAMED: f64 = 20.0;

/// A fabric of which a strip has this Gamma under the earth's gravity.
pub(super) fn fabric_for(gamma: f64) -> Fabric {
    fabric_of(gamma, THICKNESS)
}

fn fabric_of(gamma: f64, thickness: f64) -> Fabric {
    let rigidity = DENSITY * GRAVITY * LENGTH.powi(3) / gamma;
    fabric::plain(rigidity, fabric::homogeneous_stretching(rigidity, 0.0, thickness), DENSITY)
}

/// Gravity that brings the fabric of [`GAMMA_NAMED`] to another Gamma (m/s^2).
pub(super) fn gravity(gamma: f64) -> DVec3 {
    DVec3::NEG_Z * (GRAVITY * gamma / GAMMA_NAMED)
}

pub(super) fn loads() -> Vec<f64> {
    let mut loads: Vec<f64> = ON_THE_WAY.into();
    loads.extend(ELASTICA.map(|(gamma, _)| gamma));
    loads.sort_unstable_by(f64::total_cmp);
    loads.dedup();
    loads
}

pub(super) fn rest(strip: &Specimen) -> Rest {
    let load = strip.mass() * strip.gravity.length();
    Rest { residual: 1e-6, load, first_step: 0.02, steps_max: 1000 }
}

/// The strip before it bends. It is clamped at u = 0, half way between two rows of nodes that are
/// held half a cell before and behind: a fold at the second row bends the cell's length around it,
/// of which the clamp has one half and the strip the other.
pub(super) fn strip(layout: Layout, cell: f64) -> Mesh {
    let width = CELLS_ACROSS * LENGTH / CELLS_ALONG;
    let sheet = Sheet {
        origin: DVec2::new(-0.5 * cell, -0.5 * width),
        size: DVec2::new(LENGTH + 0.5 * cell, width),
        cell,
        layout,
        columns: vec![0.5 * cell],
    };
    sheet.mesh(|u| u.extend(0.0))
}

/// Nodes before this line are held (m, material).
pub(super) fn held(cell: f64) -> f64 {
    0.75 * cell
}
