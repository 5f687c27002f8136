//! Before frame 1: a coarse garment is refined and relaxed, so that the first frame does not jump.

use glam::DVec3;

use super::clock::StageClock;
use super::frame::FrameReport;
use super::refine::refine_uniformly;
use super::step::Regime;
use super::{MovingCloth, SimError, Simulation, SizingMode};

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
    /// motion are refined only.
    pub(super) fn settle(
        &mut self,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<(), SimError> {
        self.make_uniform();
        let at_rest = self.cloth.state.velocity.iter().all(|v| *v == DVec3::ZERO);
        for _ in 0..ROUNDS_MAX {
            let faces = self.face_count();
            if self.is_remeshing() {
                self.refine(clock, report);
            }
            let at_ease = !at_rest || self.relax(clock, report)?;
            let change = self.face_count().abs_diff(faces) as f64 / faces as f64;
            if at_ease && change < FACE_CHANGE_MIN {
                break;
            }
        }
        report.steps_taken = 0;
        Ok(())
    }

    fn make_uniform(&mut self) {
        let SizingMode::Uniform { edge_length } = self.settings.sizing else { return };
        if !self.scene.stages.remeshing && edge_length.is_none() {
            return;
        }
        for (mesh, garment) in self.garments.iter_mut().zip(&self.scene.garments) {
            let length = edge_length.unwrap_or(garment.sizing.edge_length_min);
            *mesh = refine_uniformly(std::mem::take(mesh), length, garment.sizing.aspect_min);
        }
        self.cloth = MovingCloth::new(&self.scene, &self.garments);
    }

    /// Some steps that each end at rest; true if the last one moved next to nothing.
    fn relax(
        &mut self,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) -> Result<bool, SimError> {
        if !self.scene.stages.dynamics {
            return Ok(true);
        }
        let limit = MOTION_IN_THICKNESSES * self.scene.contact.thickness;
        let mut farthest = f64::INFINITY;
        for _ in 0..STEPS_PER_ROUND {
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
        Ok(farthest < limit)
    }

    fn face_count(&self) -> usize {
        self.garments.iter().map(|g| g.face_count()).sum()
    }
}
