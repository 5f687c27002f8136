//! One step of the main loop, halved where it fails.

use glam::DVec3;
use thiserror::Error;

use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use super::{MovingCloth, Simulation};
use crate::collision::{
    Cloth, ClothContact, Depth, FaceTree, MovedCloth, NearMemory, ObstacleMotion, Resolution,
    contacts, resolve,
};
use crate::dynamics::{ContactPoint, StepError, StepForces, StepState};
use crate::scene::Contact;

/// Why a simulation cannot go on.
#[derive(Debug, Error)]
pub enum SimError {
    #[error(
        "frame {frame}: the step at {time} s failed in {HALVINGS_MAX} halvings, down to {step_time:e} s: {cause}"
    )]
    Step { frame: u32, time: f64, step_time: f64, cause: StepError },
    #[error(
        "frame {frame} has {found} {what}, the scene has {expected}: it cannot go on from there"
    )]
    OtherScene { frame: u32, what: &'static str, found: usize, expected: usize },
}

/// What a step is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Regime {
    /// The shot goes on.
    Motion,
    /// Time stands still: no gravity, no air, obstacles at rest.
    Relaxation,
}

/// A step is halved at most so often: 5 ms become 78 microseconds. What fails in a step as short as
/// that is not the step's fault.
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
            let passed = match regime {
                Regime::Motion => duration * f64::from(done) / f64::from(whole),
                Regime::Relaxation => 0.0,
            };
            let start = time + passed;
            match self.try_step(start, step_time, regime, clock, report) {
                Ok(()) => {
                    report.steps_taken += 1;
                    done += part;
                }
                Err(cause) if halvings == HALVINGS_MAX => {
                    let frame = self.frame + u32::from(regime == Regime::Motion);
                    return Err(SimError::Step { frame, time: start, step_time, cause });
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
        let (before, obstacles) = self.implicit_step(time, step_time, regime, clock, report)?;
        clock.time(Stage::Collision, || self.resolve(&before, &obstacles, report));
        let end = match regime {
            Regime::Motion => time + step_time,
            Regime::Relaxation => time,
        };
        self.keep_if_finite(before, end)
    }

    /// A step up to where collisions are resolved: where the cloth was before it, and what the
    /// obstacles do in it.
    pub(super) fn implicit_step(
        &mut self,
        time: f64,
        step_time: f64,
        regime: Regime,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<(StepState, Vec<ObstacleMotion>), StepError> {
        let scene = self.scene.clone();
        let (end, gravity, air) = match regime {
            Regime::Motion => (time + step_time, scene.gravity, scene.air),
            Regime::Relaxation => (time, StepForces::NONE.gravity, StepForces::NONE.air),
        };
        let before = self.cloth.state.clone();
        let (obstacles, handles) = clock.time(Stage::Obstacles, || {
            let moving = self.obstacles.moving(&scene, [time, end], step_time);
            (moving, self.anchors.springs(&scene, &self.cloth.held, &before.position, end))
        });
        let contacts = clock.time(Stage::Proximity, || self.contacts(&obstacles, step_time));
        if scene.stages.dynamics {
            let forces = StepForces { gravity, air, handles: &handles, contacts: &contacts };
            let cloth = &mut self.cloth;
            let outcome = clock.time(Stage::Dynamics, || {
                cloth.system.step(&mut cloth.state, &forces, step_time)
            })?;
            let counts = &mut report.counts;
            counts.contacts = outcome.active_contacts as u64;
            counts.degenerate_hinges =
                counts.degenerate_hinges.max(outcome.degenerate_hinges as u64);
            counts.solutions += outcome.solutions as u64;
            counts.solver_iterations += outcome.solver_iterations as u64;
            counts.factorisations += outcome.factorisations as u64;
            counts.unconverged_steps += u64::from(!outcome.convergence.is_satisfied());
        }
        Ok((before, obstacles))
    }

    /// Ends a step: a state that is not finite is dropped for the one before.
    fn keep_if_finite(&mut self, before: StepState, end: f64) -> Result<(), StepError> {
        if let Err(error) = self.cloth.state.check_finite() {
            self.cloth.state = before;
            self.cloth.refit();
            return Err(error);
        }
        self.anchors.take_hold(&self.scene, &self.cloth.held, &before.position, end);
        Ok(())
    }

    /// Contacts with obstacles and of cloth with cloth; where cloth meets cloth is looked up for the
    /// whole step.
    fn contacts(&mut self, obstacles: &[ObstacleMotion], duration: f64) -> Vec<ContactPoint> {
        let (cloth, settings) = (&mut self.cloth, &self.scene.contact);
        let seen = Cloth {
            position: &cloth.state.position,
            velocity: &cloth.state.velocity,
            area: &cloth.area,
            thickness: &cloth.thickness,
            faces: &cloth.faces,
        };
        if let Some(own) = &mut cloth.own {
            own.expect_motion(seen, &cloth.tree, settings, duration);
        }
        if !self.scene.stages.proximity {
            return Vec::new();
        }
        let mut found = match obstacles.is_empty() {
            true => Vec::new(),
            false => contacts(seen, &cloth.tree, obstacles, &mut cloth.near, settings),
        };
        if let Some(own) = &cloth.own {
            found.extend(own.contacts(seen, &cloth.tree, settings, duration));
        }
        found
    }

    fn resolve(
        &mut self,
        before: &StepState,
        obstacles: &[ObstacleMotion],
        report: &mut FrameReport,
    ) {
        if obstacles.is_empty() && self.cloth.own.is_none() {
            return;
        }
        if self.scene.stages.collision {
            let done = self.cloth.lead_out(
                &before.position,
                obstacles,
                &self.scene.contact,
                Depth::OfTheStep,
            );
            report.note(done);
        } else {
            self.cloth.refit();
        }
    }
}

impl MovingCloth {
    /// Leads the cloth out of the obstacles; see [`resolve`].
    pub(super) fn lead_out(
        &mut self,
        position_at_start: &[DVec3],
        obstacles: &[ObstacleMotion],
        settings: &Contact,
        depth: Depth,
    ) -> Resolution {
        let (mut moved, tree, near, own) = self.parts(position_at_start);
        resolve(&mut moved, tree, obstacles, near, settings, depth, own)
    }

    /// The cloth where it is, from where it was at the start of a step.
    pub(super) fn moved<'a>(&'a mut self, position_at_start: &'a [DVec3]) -> MovedCloth<'a> {
        self.parts(position_at_start).0
    }

    /// What is corrected after a step, and all that is known of where it is.
    pub(super) fn parts<'a>(
        &'a mut self,
        position_at_start: &'a [DVec3],
    ) -> (MovedCloth<'a>, &'a mut FaceTree, &'a mut NearMemory, Option<&'a mut ClothContact>) {
        let moved = MovedCloth {
            position: &mut self.state.position,
            velocity: &mut self.state.velocity,
            position_at_start,
            area: &self.area,
            thickness: &self.thickness,
            mass: self.system.masses(),
            faces: &self.faces,
        };
        (moved, &mut self.tree, &mut self.near, self.own.as_mut())
    }
}
