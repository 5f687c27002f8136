//! A sheet pulled along and pressed together across wrinkles with a wavelength of its own.
//!
//! Between lines at a distance L that keep it flat, wrinkles of wave number k cost
//! D k^2 + T (pi / L)^2 / k^2 per shortening across, T the tension: least for
//! lambda = 2 sqrt(pi) (D / T)^(1/4) L^(1/2) ([`CM03`](crate::papers::CM03)).

use std::f64::consts::PI;

use glam::DVec2;

use super::sheet::{Layout, Sheet};
use super::specimen::Specimen;
use super::{Claim, Experiment, ExperimentError, fabric};

const LENGTH: f64 = 0.2;
const WAVELENGTH: f64 = LENGTH / 2.0;
/// Three wavelengths.
const WIDTH: f64 = 3.0 * WAVELENGTH;
const CELL: f64 = WAVELENGTH / 20.0;
/// (N/m).
const TENSION: f64 = 100.0;
const STRETCHING: f64 = 1e4;

/// Half waves across the width that are looked at.
const HALF_WAVES: [u32; 5] = [4, 5, 6, 7, 8];

/// Height of each of them at the start (m).
const SEED: f64 = 1e-7;

/// Steps that each end at rest: each multiplies a mode by the pressure over that at which the mode
/// would stand by itself.
const STEPS: usize = 20;

/// Steps before, in which seeds take the shape that the mesh gives them.
const STEPS_BEFORE: usize = 10;

pub fn experiments() -> Vec<Experiment> {
    let of = |layout: Layout| {
        let name = format!("wrinkle-wavelength/{}", layout.name());
        let claim = Claim::relative(name, WAVELENGTH, 0.05);
        Experiment::new(vec![claim], move || measure(layout))
    };
    vec![of(Layout::Aligned), of(Layout::Irregular)]
}

/// D such that the wavelength is [`WAVELENGTH`] (N m).
fn rigidity() -> f64 {
    TENSION * (WAVELENGTH / (2.0 * PI.sqrt() * LENGTH.sqrt())).powi(4)
}

/// The wavelength that would grow fastest (m): the vertex of a parabola through the growth of the
/// fastest mode and its neighbours over the logarithm of the wave number, in which growth is even.
fn measure(layout: Layout) -> Result<Vec<f64>, ExperimentError> {
    let sheet = Sheet {
        origin: DVec2::ZERO,
        size: DVec2::new(LENGTH, WIDTH),
        cell: CELL,
        layout,
        columns: Vec::new(),
    };
    let fabric = fabric::plain(rigidity(), STRETCHING, 0.2);
    // What just does not wrinkle: 2 sqrt(D T) pi / L.
    let pressure = 2.0 * (rigidity() * TENSION).sqrt() * PI / LENGTH;
    let stretch = DVec2::new(1.0 + TENSION / STRETCHING, 1.0 - pressure / STRETCHING);
    let mesh = sheet.mesh(|u| {
        let waves: f64 = HALF_WAVES.iter().map(|&n| mode(n, u)).sum();
        (u * stretch).extend(SEED * waves)
    });
    let mut specimen = Specimen::new(mesh, &fabric);
    let is_side = |u: DVec2| u.x == 0.0 || u.x == LENGTH || u.y == 0.0 || u.y == WIDTH;
    specimen.clamp_at(is_side, |u| (u * stretch).extend(0.0));
    let mut relax = |steps: usize| -> Result<[f64; HALF_WAVES.len()], ExperimentError> {
        for _ in 0..steps {
            specimen.state.velocity.fill(glam::DVec3::ZERO);
            specimen.step(1e3)?;
        }
        Ok(HALF_WAVES.map(|n| height(&specimen, n)))
    };
    let (before, after) = (relax(STEPS_BEFORE)?, relax(STEPS)?);
    let growth: Vec<f64> =
        after.iter().zip(before).map(|(after, before)| (after / before).abs().ln()).collect();
    Ok(vec![2.0 * WIDTH / fastest(&growth)?])
}

/// sin(pi u / L) sin(n pi v / W).
fn mode(half_waves: u32, u: DVec2) -> f64 {
    (PI * u.x / LENGTH).sin() * (f64::from(half_waves) * PI * u.y / WIDTH).sin()
}

/// The share of a mode in the heights of the nodes, each weighted by its mass (m).
fn height(specimen: &Specimen, half_waves: u32) -> f64 {
    let masses = specimen.system.masses();
    let (mut sum, mut squares) = (0.0, 0.0);
    for vertex in specimen.vertices(|_| true) {
        let node = specimen.node_of(vertex);
        let mode = mode(half_waves, specimen.mesh.material(vertex));
        sum += masses[node] * mode * specimen.state.position[node].z;
        squares += masses[node] * mode * mode;
    }
    sum / squares
}

/// The number of half waves that grows fastest, between whole numbers.
fn fastest(growth: &[f64]) -> Result<f64, ExperimentError> {
    let best = (1..growth.len() - 1).max_by(|&a, &b| growth[a].total_cmp(&growth[b]));
    let best = best.filter(|&b| growth[b] > growth[b - 1] && growth[b] > growth[b + 1]);
    let best = best.ok_or(ExperimentError::Nothing("no wavelength grows fastest"))?;
    let x = [best - 1, best, best + 1].map(|k| f64::from(HALF_WAVES[k]).ln());
    let slope = |a: usize, b: usize| (growth[best + b - 1] - growth[best + a - 1]) / (x[b] - x[a]);
    let bend = (slope(1, 2) - slope(0, 1)) / (x[2] - x[0]);
    let vertex = 0.5 * (x[0] + x[1]) - slope(0, 1) / (2.0 * bend);
    Ok(vertex.exp())
}
