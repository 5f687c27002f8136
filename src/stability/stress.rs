//! One quantity that grows, and the scene it acts on.

use crate::scene::Scene;
use crate::sim::SimSettings;

/// A scene with one quantity that is made worse and worse.
#[derive(Clone, Copy, Debug)]
pub struct Stress {
    /// As in tables and for `--only`.
    pub name: &'static str,
    /// What is done, in a few words.
    pub about: &'static str,
    /// From mild to severe.
    pub values: &'static [f64],
    /// A value as it is shown, with its unit.
    pub label: fn(f64) -> String,
    pub trial: fn(f64) -> Trial,
}

/// A scene at one value of a stress, and what may be expected of its energy.
#[derive(Clone, Debug)]
pub struct Trial {
    pub scene: Scene,
    pub settings: SimSettings,
    /// Simulated after the start.
    pub frames: u32,
    /// From this frame on nothing outside does work on the cloth but gravity: obstacles and pins
    /// stand still, and so does the air. `None` if that never comes.
    pub passive_from: Option<u32>,
    /// How far the middle of the cloth's mass must come down, lest it hangs where nothing holds
    /// it (m); 0 where something does.
    pub fall_min: f64,
    /// Largest speed of what does work on the cloth (m/s): obstacles, pins, wind.
    pub drive_speed: f64,
}

impl Trial {
    /// Nothing outside moves at any time.
    pub fn passive(scene: Scene, settings: SimSettings, frames: u32) -> Self {
        Self { scene, settings, frames, passive_from: Some(0), fall_min: 0.0, drive_speed: 0.0 }
    }

    /// Obstacles or pins move at a speed (m/s) for some time (s); then they stand still for some
    /// frames.
    pub fn driven(
        scene: Scene,
        settings: SimSettings,
        [speed, duration]: [f64; 2],
        rest: u32,
    ) -> Self {
        // The frame in which they stop is the last that they work in.
        let passive_from = (duration / scene.frame_time() - 1e-6).ceil() as u32;
        let frames = passive_from + rest;
        Self {
            passive_from: Some(passive_from),
            drive_speed: speed,
            ..Self::passive(scene, settings, frames)
        }
    }
}
