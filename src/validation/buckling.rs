//! A strip clamped with its width upright stays in its plane under little weight, and leaves it
//! sideways under more.
//!
//! The load is Gamma = 12 rho g L^3 / (E h^2), with rho per volume; as the sheet has it,
//! rho g L^3 / (D (1 - nu^2)) with rho per area. For h << w << L it buckles at the Gamma_c of
//! Michell and Prandtl's equations ([`RLBD21`](crate::papers::RLBD21)).

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use super::specimen::{Rest, Specimen};
use super::{Claim, Experiment, ExperimentError, fabric};
use crate::scene::{BendingModel, IsotropicSheet};

/// nu and Gamma_c.
pub const ONSETS: [(f64, f64); 4] = [(0.0, 18.178), (0.2, 16.594), (0.3, 15.943), (0.35, 15.645)];

const LENGTH: f64 = 0.4;
const WIDTH: f64 = LENGTH / 28.0;
/// Bending in the strip's plane, which the formula leaves out, raises the onset by about (h/w)^2.
const THICKNESS: f64 = WIDTH / 20.0;
const CELLS_ACROSS: f64 = 4.0;
const RIGIDITY: f64 = 1e-3;
const DENSITY: f64 = 0.2;

/// How much gravity is tilted sideways.
const IMPERFECTION: f64 = 1e-3;

/// Where the further lines are drawn through, in shares of the last one's end.
const NEARER: [[f64; 2]; 2] = [[0.6, 0.7], [0.8, 0.9]];

const TOLERANCE: f64 = 0.05;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout, (nu, onset): (f64, f64)| {
        let name = format!("buckling-onset/nu-{nu}/{}", layout.name());
        let claim = Claim::relative(name, onset, TOLERANCE);
        let model = BendingModel::default();
        Experiment::new(vec![claim], move || Ok(vec![onset_of(model, layout, nu)?]))
    };
    let all = |layout: Layout| ONSETS.map(|onset| of(layout, onset));
    all(Layout::Aligned).into_iter().chain(all(Layout::Irregular)).collect()
}

/// Gamma_c, after Southwell ([`S32`](crate::papers::S32)): the tip's way sideways grows like
/// Gamma / (1 - (Gamma / Gamma_c)^2), for a load and its opposite buckle alike; so Gamma over the
/// way, as a straight line in Gamma^2, ends at Gamma_c^2. A first line is drawn through small loads,
/// others ever closer to where it ends.
///
/// # Errors
/// If the strip does not come to rest under a load, or does not yield more under more.
pub fn onset_of(model: BendingModel, layout: Layout, nu: f64) -> Result<f64, ExperimentError> {
    let mut strip = upright(model, layout, nu);
    let mut stiffness = |gamma: f64| -> Result<f64, ExperimentError> {
        Ok(gamma / sideways(&mut strip, gamma, nu)?)
    };
    let mut onset = line_end([4.0, 8.0], &mut stiffness)?;
    for shares in NEARER {
        onset = line_end(shares.map(|share| share * onset), &mut stiffness)?;
    }
    Ok(onset)
}

fn line_end(
    gammas: [f64; 2],
    stiffness: &mut impl FnMut(f64) -> Result<f64, ExperimentError>,
) -> Result<f64, ExperimentError> {
    let squares = gammas.map(|gamma| gamma * gamma);
    let [a, b] = [stiffness(gammas[0])?, stiffness(gammas[1])?];
    if !(b < a) {
        return Err(ExperimentError::Nothing("the strip does not yield more under more load"));
    }
    Ok((squares[0] + (squares[1] - squares[0]) * a / (a - b)).sqrt())
}

/// How far the tip goes sideways at a load (m).
fn sideways(strip: &mut Specimen, gamma: f64, nu: f64) -> Result<f64, ExperimentError> {
    let gravity = gamma * RIGIDITY * (1.0 - nu * nu) / (DENSITY * LENGTH.powi(3));
    strip.gravity = DVec3::new(0.0, IMPERFECTION, -1.0) * gravity;
    let load = strip.mass() * gravity;
    strip.settle(&Rest { residual: 3e-7, load, first_step: 0.1, steps_max: 2000 })?;
    let way = strip.mean_position(|u| u.x == LENGTH).y;
    Ok(way)
}

/// Clamped at u = 0 like the cantilever.
fn upright(model: BendingModel, layout: Layout, nu: f64) -> Specimen {
    let cell = WIDTH / CELLS_ACROSS;
    let sheet = Sheet {
        origin: DVec2::new(-0.5 * cell, -0.5 * WIDTH),
        size: DVec2::new(LENGTH + 0.5 * cell, WIDTH),
        cell,
        layout,
        columns: vec![0.5 * cell],
    };
    let isotropic = IsotropicSheet {
        density: DENSITY,
        membrane_stiffness: fabric::homogeneous_stretching(RIGIDITY, nu, THICKNESS),
        poisson_ratio: nu,
        bending_rigidity: RIGIDITY,
    };
    let fabric = fabric::bending_by(model, isotropic);
    let mut strip = Specimen::new(sheet.mesh(|u| DVec3::new(u.x, 0.0, u.y)), &fabric);
    strip.clamp(|u| u.x < 0.75 * cell);
    strip
}
