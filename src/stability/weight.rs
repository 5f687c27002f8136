//! Lighter and lighter, heavier and heavier cloth of the same stiffness.

use super::drape;
use super::stage::cotton;
use super::stress::{Stress, Trial};

pub fn lighter() -> Stress {
    Stress {
        name: "lighter",
        about: "sheet dropped on a ball; cotton, so many times as light",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0],
        label: |factor| format!("1/{factor}"),
        trial: |factor| trial(1.0 / factor),
    }
}

pub fn heavier() -> Stress {
    Stress {
        name: "heavier",
        about: "sheet dropped on a ball; cotton, so many times as heavy",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0],
        label: |factor| format!("x{factor}"),
        trial,
    }
}

fn trial(factor: f64) -> Trial {
    let mut fabric = cotton();
    fabric.density *= factor;
    drape::trial(fabric)
}
