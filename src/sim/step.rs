//! One step of the main loop, halved where it fails.

use glam::DVec3;
use thiserror::Error;

use super::Simulation;
use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use crate::collision::{Cloth, MovedCloth, ObstacleMotion, Obstacles, contacts, resolve};
use crate::dynamics::{StepError, StepForces, StepState};
use crate::scene::Air;

/// Why a simulation cannot go on.
#[derive(Debug, Error)]
pub enum SimError {
    #[error(
        "frame {frame}: the step at {time} s failed in {HALVINGS_MAX} halvings, down to {step_time:e} s: {cause}"
    )]
    Step { frame: u32, time: f64, step_time: f64, cause: StepError },
}

/// What a step is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Regime {
    /// The shot goes on.
    Motion,
    /// Time stands still: no gravity, no air, obstacles at rest.
    Relaxation,
}

/// A step is halved at most so often: 5 ms become 78 microseconds, below which rounding errors grow
/// faster than the step shrinks.
const HALVINGS_MAX: u32 = 6;

impl Simulation {
    /// Advances from `time` by `duration` (s), in as many parts as it takes.
    pub(super) fn step(
        &mut self,
        time: f64,
        duration: f64,
        regime: Regime,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<(), SimError> {
        let mut halvings = 0;
        let mut done = 0u32;
        // Time is counted in parts of the smallest step so that the parts add up exactly.
        let whole = 1u32 << HALVINGS_MAX;
        while done < whole {
            let part = whole >> halvings;
            let step_time = duration * f64::from(part) / f64::from(whole);
            let start = time + duration * f64::from(done) / f64::from(whole);
            match self.try_step(start, step_time, regime, clock, report) {
                Ok(()) => {
                    report.steps_taken += 1;
                    done += part;
                }
                Err(cause) if halvings == HALVINGS_MAX => {
                    return Err(SimError::Step {
                        frame: self.frame + 1,
                        time: start,
                        step_time,
                        cause,
                    });
                }
                Err(cause) => {
                    halvings += 1;
                    report.warnings.push(format!("step at {start:.4} s halved: {cause}"));
                }
            }
        }
        Ok(())
    }

    /// One step, all of it or nothing.
    fn try_step(
        &mut self,
        time: f64,
        step_time: f64,
        regime: Regime,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<(), StepError> {
        let scene = self.scene.clone();
        let (end, gravity, air) = match regime {
            Regime::Motion => (time + step_time, scene.gravity, scene.air),
            Regime::Relaxation => (time, DVec3::ZERO, Air { density: 0.0, ..scene.air }),
        };
        let (obstacles, handles) = clock.time(Stage::Obstacles, || {
            let poses = [time, end].map(|t| Obstacles::poses(&scene, t));
            let moving = self.obstacles.moving(&poses[0], &poses[1], step_time);
            let position = &self.cloth.state.position;
            (moving, self.anchors.springs(&scene, &self.garments, position, end))
        });
        let contacts = match scene.stages.proximity {
            true => clock.time(Stage::Proximity, || self.contacts(&obstacles)),
            false => Vec::new(),
        };
        let before = self.cloth.state.clone();
        if scene.stages.dynamics {
            let forces = StepForces { gravity, air, handles: &handles, contacts: &contacts };
            let cloth = &mut self.cloth;
            clock.time(Stage::Dynamics, || {
                cloth.system.step(&mut cloth.state, &forces, step_time)
            })?;
        }
        clock.time(Stage::Collision, || self.resolve(&before, &obstacles, report));
        Ok(())
    }

    fn contacts(&self, obstacles: &[ObstacleMotion]) -> Vec<crate::dynamics::ContactPoint> {
        let cloth = &self.cloth;
        let seen = Cloth {
            position: &cloth.state.position,
            velocity: &cloth.state.velocity,
            area: &cloth.area,
            faces: &cloth.faces,
        };
        contacts(seen, &cloth.tree, obstacles, &self.scene.contact)
    }

    fn resolve(
        &mut self,
        before: &StepState,
        obstacles: &[ObstacleMotion],
        report: &mut FrameReport,
    ) {
        if obstacles.is_empty() || !self.scene.stages.collision {
            return;
        }
        let cloth = &mut self.cloth;
        let mut moved = MovedCloth {
            position: &mut cloth.state.position,
            velocity: &mut cloth.state.velocity,
            position_at_start: &before.position,
            area: &cloth.area,
            faces: &cloth.faces,
        };
        let resolved = resolve(&mut moved, &mut cloth.tree, obstacles, &self.scene.contact);
        report.trapped_nodes = resolved.trapped;
    }
}
