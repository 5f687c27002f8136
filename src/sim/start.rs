//! Before frame 1: a coarse garment is refined and relaxed, so that the first frame does not jump.

use std::ops::ControlFlow::{self, Break, Continue};

use glam::DVec3;

use super::clock::StageClock;
use super::frame::FrameReport;
use super::step::Regime;
use super::{SimError, Simulation, SizingMode};

/// Rounds of refining and relaxing.
const ROUNDS_MAX: usize = 12;

/// Steps of relaxation in a round: each ends at rest.
const STEPS_PER_ROUND: u32 = 8;

/// Relaxation ends when no node moves farther than this in a step, in contact thicknesses.
const MOTION_IN_THICKNESSES: f64 = 0.02;

/// A round that changes the number of faces by a smaller share has found the mesh.
const FACE_CHANGE_MIN: f64 = 0.02;

impl Simulation {
    /// Refines and relaxes in turn, while time stands still, until neither shape nor mesh changes
    /// much. Garments that are at ease as they are given stay so; garments that are given in
    /// motion are refined only. Breaks off where asked not to go on.
    pub(super) fn settle(
        &mut self,
        goes_on: &dyn Fn() -> bool,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<ControlFlow<()>, SimError> {
        if let SizingMode::Uniform { edge_length } = self.settings.sizing
            && (self.scene.stages.remeshing || edge_length.is_some())
        {
            self.make_uniform(edge_length, clock, report);
        }
        let at_rest = self.cloth.state.velocity.iter().all(|v| *v == DVec3::ZERO);
        for _ in 0..ROUNDS_MAX {
            let faces = self.face_count();
            if self.is_remeshing() {
                self.refine(clock, report);
            }
            let at_ease = match at_rest {
                true => match self.relax(goes_on, clock, report)? {
                    Continue(at_ease) => at_ease,
                    Break(()) => return Ok(Break(())),
                },
                false => true,
            };
            let change = self.face_count().abs_diff(faces) as f64 / faces as f64;
            if at_ease && change < FACE_CHANGE_MIN {
                report.steps_taken = 0;
                return Ok(Continue(()));
            }
        }
        report.steps_taken = 0;
        report.warnings.push(format!(
            "the cloth is not at ease after {ROUNDS_MAX} rounds of relaxation: it will move at frame 1"
        ));
        Ok(Continue(()))
    }

    /// Some steps that each end at rest; true if the last one moved next to nothing. Breaks off where
    /// asked not to go on.
    fn relax(
        &mut self,
        goes_on: &dyn Fn() -> bool,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<ControlFlow<(), bool>, SimError> {
        if !self.scene.stages.dynamics {
            return Ok(Continue(true));
        }
        let limit = MOTION_IN_THICKNESSES * self.scene.contact.thickness;
        let mut farthest = f64::INFINITY;
        self.let_go_of_tangles();
        for _ in 0..STEPS_PER_ROUND {
            if !goes_on() {
                return Ok(Break(()));
            }
            let before = self.cloth.state.position.clone();
            self.step(0.0, self.scene.step_time(), Regime::Relaxation, clock, report)?;
            self.cloth.state.velocity.fill(DVec3::ZERO);
            let moved = before.iter().zip(&self.cloth.state.position);
            farthest = moved.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            if farthest < limit {
                break;
            }
        }
        self.cloth.write_back(&mut self.garments);
        Ok(Continue(farthest < limit))
    }

    fn face_count(&self) -> usize {
        self.garments.iter().map(|g| g.face_count()).sum()
    }
}
