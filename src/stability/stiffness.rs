//! Stiffer and stiffer cloth.

use super::drape;
use super::stage::cotton;
use super::stress::{Stress, Trial};

pub fn stress() -> Stress {
    Stress {
        name: "stiffness",
        about: "sheet dropped on a ball; cotton, so many times as stiff",
        values: &[1.0, 10.0, 100.0, 1000.0],
        label: |factor| format!("x{factor}"),
        trial,
    }
}

/// Stretching, shear and bending alike.
fn trial(factor: f64) -> Trial {
    let mut fabric = cotton();
    fabric.membrane_stiffness = fabric.membrane_stiffness.map(|k| k * factor);
    fabric.shear_stiffness *= factor;
    fabric.bending_rigidity = fabric.bending_rigidity.map(|k| k * factor);
    fabric.twist_rigidity *= factor;
    drape::trial(fabric)
}
