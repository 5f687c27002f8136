//! Cuts to and away from a sheet that falls on a ball, in shorter and shorter shots.

use glam::DVec3;

use super::stress::Stress;
use super::whip::{looking, watched};
use crate::shot::CameraKey;

pub fn stress() -> Stress {
    Stress {
        name: "cuts",
        about: "cuts to and away from a sheet dropped on a ball; frames between two cuts",
        values: &[12.0, 6.0, 3.0, 2.0, 1.0],
        label: |frames| format!("{frames} frames"),
        trial: |frames| watched(|last| keys(last, frames as u32)),
    }
}

/// In turn at the sheet from the front, away from it, and at it from behind.
pub fn keys(last: u32, every: u32) -> Vec<CameraKey> {
    let key = |frame: u32| {
        let still = looking(frame);
        let eye = match frame / every % 4 {
            0 => still.eye,
            2 => still.eye * DVec3::new(-1.0, -1.0, 1.0),
            _ => return CameraKey { target: still.eye * 2.0, cut: frame > 0, ..still },
        };
        CameraKey { eye, cut: frame > 0, ..still }
    };
    (0..=last).step_by(every as usize).map(key).collect()
}
