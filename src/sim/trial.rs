//! The next step as the cloth would go if it did not meet itself: what ways of stopping it are held
//! against one another on.

use super::clock::StageClock;
use super::frame::FrameReport;
use super::step::Regime;
use super::{SimError, Simulation};
use crate::collision::{Depth, resolve};
use crate::dynamics::StepState;

/// A step with contacts and obstacles, before it is seen to that cloth does not pass through cloth.
#[derive(Clone, Debug)]
pub struct TrialStep {
    pub start: StepState,
    pub end: StepState,
    /// (s).
    pub duration: f64,
    /// Per node, as are all but the faces: material area (m^2).
    pub area: Vec<f64>,
    /// (kg).
    pub mass: Vec<f64>,
    /// How far it is held off (m).
    pub thickness: Vec<f64>,
    /// Their nodes, in one numbering over all garments.
    pub faces: Vec<[u32; 3]>,
}

impl Simulation {
    /// The first step of the frame after the last published one. The simulation stays at that frame,
    /// and goes on as if nothing had been asked.
    ///
    /// # Errors
    /// If the step fails; it is not halved.
    pub fn trial_step(&mut self) -> Result<TrialStep, SimError> {
        let mut clock = StageClock::start();
        let mut report = FrameReport::default();
        self.begin_frame(&mut clock);
        let (time, duration) = (self.time(), self.scene.step_time());
        let moved =
            self.implicit_step(time, duration, Regime::Motion, &mut clock, &mut report).map_err(
                |cause| SimError::Step { frame: self.frame + 1, time, step_time: duration, cause },
            );
        self.cloth.system.lift_compensation();
        let (start, obstacles) = moved?;
        let settings = self.scene.contact;
        let (mut cloth, tree, near, _) = self.cloth.parts(&start.position);
        resolve(&mut cloth, tree, &obstacles, near, &settings, Depth::OfTheStep, None);
        let cloth = &self.cloth;
        let trial = TrialStep {
            end: cloth.state.clone(),
            start,
            duration,
            area: cloth.area.clone(),
            mass: cloth.system.masses().to_vec(),
            thickness: cloth.thickness.clone(),
            faces: cloth.faces.clone(),
        };
        // Back to what was published.
        self.cloth.forget_the_past(&self.garments, &mut clock);
        Ok(trial)
    }
}
