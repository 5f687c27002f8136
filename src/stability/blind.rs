//! A cut every frame with neither margin nor anticipation, coarser and coarser out of frame.

use super::cuts;
use super::stress::{Stress, Trial};
use super::whip::watched;

pub fn stress() -> Stress {
    Stress {
        name: "m = 0, T = 0",
        about: "a cut every frame, unforeseen and without margin; how many times coarser out of frame",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0],
        label: |coarser| format!("1/{coarser}"),
        trial,
    }
}

fn trial(coarser: f64) -> Trial {
    let mut trial = watched(|last| cuts::keys(last, 1));
    let view = &mut trial.scene.garments[0].view;
    view.nu_out = 1.0 / coarser;
    view.margin_m = 0.0;
    view.anticipation_frames = 0.0;
    trial
}
