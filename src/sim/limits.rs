//! Once a frame: faces that contact or remeshing has left beyond strain limits.

use glam::DVec3;

use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use super::{MovingCloth, Simulation};
use crate::collision::{Depth, ObstacleMotion, Resolution};
use crate::scene::Contact;

/// Rounds in which faces are taken back as far as contact lets them.
const ROUNDS_MAX: usize = 32;

impl Simulation {
    /// Takes faces back within the limits of their fabrics. Nodes are moved and not sped up, as where
    /// cloth is taken apart: no force has given it that velocity.
    ///
    /// Each round starts where contact has stopped the one before, so that nothing passes through
    /// anything: where both cannot be had, contact holds and the face stays stretched.
    pub(super) fn take_back_within_limits(
        &mut self,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) {
        if !self.scene.stages.dynamics || !self.cloth.system.is_limited() {
            return;
        }
        let mut done = Resolution::default();
        let mut is_moved = false;
        let mut obstacles = None;
        for _ in 0..ROUNDS_MAX {
            let start = self.cloth.state.position.clone();
            clock.time(Stage::Dynamics, || self.move_within_limits());
            if self.cloth.state.position == start {
                break;
            }
            is_moved = true;
            if self.scene.stages.collision {
                let obstacles = obstacles.get_or_insert_with(|| {
                    clock.time(Stage::Obstacles, || self.obstacles_at_rest())
                });
                let round = clock.time(Stage::Collision, || {
                    self.cloth.stop_on_the_way_from(&start, obstacles, &self.scene.contact)
                });
                done.impacts = done.impacts.max(round.impacts);
                done.unresolved = round.unresolved;
            } else {
                self.cloth.refit();
            }
        }
        if is_moved {
            report.note(done);
            self.cloth.write_back(&mut self.garments);
        }
    }

    /// Moves nodes so that faces come within limits, through whatever is in the way.
    fn move_within_limits(&mut self) {
        let (time, step_time) = (self.time(), self.scene.step_time());
        let cloth = &mut self.cloth;
        let position = &mut cloth.state.position;
        let handles = self.anchors.springs(&self.scene, &cloth.held, position, time);
        cloth.system.take_back_within_limits(position, &handles, step_time);
    }

    /// Says how many faces are beyond strain limits where all is done.
    pub(super) fn warn_of_limits(&self, report: &mut FrameReport) {
        if !self.cloth.system.is_limited() {
            return;
        }
        let count = self.cloth.system.count_beyond_limits(&self.cloth.state.position);
        if count > 0 {
            let warning = format!("{count} faces are beyond strain limits by over 1 %");
            report.warnings.push(warning);
        }
    }
}

impl MovingCloth {
    /// Stops the cloth where it passed through something on its way from where it was.
    fn stop_on_the_way_from(
        &mut self,
        start: &[DVec3],
        obstacles: &[ObstacleMotion],
        settings: &Contact,
    ) -> Resolution {
        if let Some(own) = &mut self.own {
            own.expect_rest(&self.tree, start, settings);
        }
        self.lead_out(start, obstacles, settings, Depth::OfTheStep)
    }
}
