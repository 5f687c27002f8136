//! Once a frame: faces that contact or remeshing has left beyond strain limits.

use super::Simulation;
use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use crate::collision::Depth;
use crate::dynamics::BeyondLimits;

/// Rounds in which faces are taken back as far as contact lets them.
const ROUNDS_MAX: usize = 8;

impl Simulation {
    /// Takes faces back within the limits of their fabrics, and says how many contact leaves beyond.
    ///
    /// Each round starts where contact has stopped the one before, so that nothing passes through
    /// anything: where both cannot be had, contact holds and the face stays stretched.
    pub(super) fn keep_within_limits(&mut self, clock: &mut StageClock, report: &mut FrameReport) {
        if !self.cloth.system.is_limited() {
            return;
        }
        let (time, step_time) = (self.time(), self.scene.step_time());
        let obstacles = clock.time(Stage::Obstacles, || self.obstacles_at_rest());
        let cloth = &mut self.cloth;
        let handles = self.anchors.springs(&self.scene, &cloth.held, &cloth.state.position, time);
        let mut beyond = BeyondLimits::default();
        for _ in 0..ROUNDS_MAX {
            let before = cloth.state.position.clone();
            beyond = clock.time(Stage::Dynamics, || {
                cloth.system.keep_within_limits(&mut cloth.state, &handles, step_time)
            });
            if beyond.found == 0 {
                break;
            }
            if self.scene.stages.collision {
                let done = clock.time(Stage::Collision, || {
                    if let Some(own) = &mut cloth.own {
                        own.expect_rest(&cloth.tree, &before, &self.scene.contact);
                    }
                    cloth.lead_out(&before, &obstacles, &self.scene.contact, Depth::OfTheStep)
                });
                report.note(done);
            }
            cloth.write_back(&mut self.garments);
        }
        if beyond.found > 0 {
            report.warnings.push(format!("{} faces stay beyond strain limits", beyond.found));
        }
    }
}
