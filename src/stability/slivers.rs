//! Panels given with thinner and thinner triangles, kept or remeshed.

use super::drape;
use super::stage::{self, CELL, SIDE};
use super::stress::{Stress, Trial};
use crate::mesh::Mesh;
use crate::sim::{SimSettings, SizingMode};

const THINNESS: &[f64] = &[1.0, 10.0, 100.0, 1000.0, 1e4, 1e5, 1e6];

/// Shortest edge that the remesher makes (m).
const FINEST: f64 = 0.02;

pub fn kept() -> Stress {
    Stress {
        name: "slivers",
        about: "sheet dropped on a ball; every other column of the mesh narrowed",
        values: THINNESS,
        label,
        trial: |thinness| drape::of_mesh(sheet(thinness)),
    }
}

pub fn remeshed() -> Stress {
    Stress {
        name: "slivers, remeshed",
        about: "the same, given to the remesher",
        values: THINNESS,
        label,
        trial: remeshed_trial,
    }
}

fn label(thinness: f64) -> String {
    if thinness < 1e4 { format!("1:{thinness}") } else { format!("1:{thinness:e}") }
}

fn remeshed_trial(thinness: f64) -> Trial {
    let mut trial = drape::of_mesh(sheet(thinness));
    trial.settings = SimSettings { sizing: SizingMode::Adaptive };
    trial.scene.stages.remeshing = true;
    trial.scene.garments[0].sizing.edge_length_min = FINEST;
    trial
}

/// Columns in turn as wide as a cell and so many times narrower.
fn sheet(thinness: f64) -> Mesh {
    let narrow = CELL / thinness;
    let pairs = (SIDE / (CELL + narrow)).round();
    let scale = SIDE / (pairs * (CELL + narrow));
    let mut us = vec![-0.5 * SIDE];
    for k in 1..=pairs as u32 {
        let end = -0.5 * SIDE + f64::from(k) * scale * (CELL + narrow);
        us.extend([end - scale * narrow, end]);
    }
    let vs: Vec<f64> = stage::lines(SIDE, CELL).iter().map(|v| v - 0.5 * SIDE).collect();
    stage::grid(&us, &vs, drape::placed)
}
