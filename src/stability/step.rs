//! Longer and longer steps, linearised once or iterated.

use super::drape;
use super::stage::{self, CELL};
use super::stress::{Stress, Trial};

/// At most, in a step that is iterated.
const ITERATIONS: u32 = 20;

const STEPS: &[f64] = &[1.0 / 400.0, 1.0 / 200.0, 1.0 / 100.0, 1.0 / 50.0, 1.0 / 25.0];

pub fn linearised() -> Stress {
    Stress {
        name: "step",
        about: "sheet dropped on a ball; length of a step, linearised once",
        values: STEPS,
        label,
        trial: |step| trial(step, 1),
    }
}

pub fn iterated() -> Stress {
    Stress {
        name: "step, iterated",
        about: "the same, with up to 20 Newton iterations a step",
        values: STEPS,
        label,
        trial: |step| trial(step, ITERATIONS),
    }
}

fn label(step: f64) -> String {
    format!("1/{:.0} s", 1.0 / step)
}

fn trial(step: f64, iterations: u32) -> Trial {
    let mut trial = drape::of_mesh(stage::square(CELL, drape::placed));
    trial.scene.steps_per_frame = (trial.scene.frame_time() / step).round() as u32;
    trial.scene.dynamics.iterations = iterations;
    trial
}
