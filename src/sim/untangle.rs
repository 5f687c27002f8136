//! Once a frame: what passes through something all the same is taken apart.
//!
//! # What becomes of velocities
//! Untangling moves nodes and does not speed them up: a way back of 2 cm within a frame would be
//! 0.5 m/s, which no force has given the cloth. Where an edge passed through a face, what was left of
//! their motion against one another ends instead, or the next step would undo what was done.

use super::clock::{Stage, StageClock};
use super::frame::FrameReport;
use super::{MovingCloth, Simulation};
use crate::collision::{
    Crossing, Cut, Depth, Limits, Method, ObstacleMotion, TangledCloth, Untangling, crossings,
    cuts, lift_cuts, stop_at_crossings, trapped_nodes, untangle,
};

/// Of an edge against a face in a round, in contact thicknesses: layers that are that near are about to
/// part.
const STEP_IN_THICKNESSES: f64 = 0.5;

/// Of a node in a frame, in contact thicknesses: 2 cm of 5 mm, about what cloth falls in a frame that
/// has fallen for 5 cm. What takes more is taken apart over the next frames.
const WAY_IN_THICKNESSES: f64 = 4.0;

/// Rounds in a frame: a few more than the way takes.
const ROUNDS_MAX: usize = 16;

/// Rounds without a better state, after which none is expected.
const PATIENCE: usize = 12;

/// Before frame 0 there is nothing that a leap could disturb.
const START_WAY_IN_THICKNESSES: f64 = 100.0;
const START_ROUNDS_MAX: usize = 300;
const START_PATIENCE: usize = 60;

/// Rounds of lifting faces off obstacles, and those without fewer cuts after which no more are made.
const CUT_ROUNDS_MAX: usize = 16;
const CUT_PATIENCE: usize = 4;

/// Of a face off an obstacle in a round, in contact thicknesses.
const CUT_STEP_IN_THICKNESSES: f64 = 1.0;

/// When in a shot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moment {
    Start,
    Frame,
}

impl Simulation {
    /// A garment that is given inside an obstacle or other cloth is taken out before it is relaxed:
    /// contact would hold it there.
    pub(super) fn take_apart_at_start(&mut self, clock: &mut StageClock, report: &mut FrameReport) {
        if self.scene.stages.collision {
            let obstacles = self.obstacles_at_rest();
            if trapped_nodes(&self.cloth.state.position, &obstacles) > 0 {
                clock.time(Stage::Collision, || self.clear_obstacles(report));
            }
        }
        self.untangle(Moment::Start, clock, report);
        // What is left is said when frame 0 stands.
        report.warnings.clear();
    }

    /// Takes apart what passes through cloth or obstacles, and counts what is left.
    pub(super) fn untangle(
        &mut self,
        moment: Moment,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) {
        clock.time(Stage::Untangle, || {
            let cuts_left = self.clear_cuts(report);
            if cuts_left > 0 {
                report.warnings.push(format!("{cuts_left} faces of cloth cut obstacles"));
            }
            if self.scene.stages.self_contact {
                self.untangle_cloth(moment, report);
            }
        });
    }

    /// Has contact leave alone what passes through other cloth, so that it can come back.
    pub(super) fn let_go_of_tangles(&mut self) {
        if self.intersections == 0 || !self.scene.stages.untangling {
            return;
        }
        let cloth = &mut self.cloth;
        let found = crossings(&cloth.tree, &cloth.state.position);
        if let Some(own) = &mut cloth.own {
            own.let_go_of(&cloth.tree, &found);
        }
    }

    fn untangle_cloth(&mut self, moment: Moment, report: &mut FrameReport) {
        let found = crossings(&self.cloth.tree, &self.cloth.state.position);
        let count = found.len();
        report.intersections = Some(count);
        self.intersections = count;
        if count == 0 || !self.scene.stages.untangling {
            return;
        }
        let before = self.cloth.state.clone();
        let limits = self.limits(moment);
        let done = self.cloth.untangle(found, limits);
        let mut left = done.left.len();
        // What was moved may have come into an obstacle.
        if self.scene.stages.collision && !self.obstacles.is_empty() {
            self.clear_obstacles(report);
            left = crossings(&self.cloth.tree, &self.cloth.state.position).len();
        }
        if left > count {
            self.cloth.state = before;
            self.cloth.refit();
            left = count;
        }
        self.cloth.write_back(&mut self.garments);
        report.intersections = Some(left);
        self.intersections = left;
        if left > 0 {
            report.warnings.push(format!(
                "cloth passes through cloth: {left} of {count} crossings are left, in {} contours",
                done.contours_left
            ));
        }
    }

    fn limits(&self, moment: Moment) -> Limits {
        let thickness = self.scene.contact.thickness;
        let step = STEP_IN_THICKNESSES * thickness;
        match moment {
            Moment::Start => Limits {
                step,
                way: START_WAY_IN_THICKNESSES * thickness,
                rounds: START_ROUNDS_MAX,
                patience: START_PATIENCE,
            },
            Moment::Frame => Limits {
                step,
                way: WAY_IN_THICKNESSES * thickness,
                rounds: ROUNDS_MAX,
                patience: PATIENCE,
            },
        }
    }

    /// Lifts faces off obstacles that they cut; returns how many still do.
    fn clear_cuts(&mut self, report: &mut FrameReport) -> usize {
        let stages = &self.scene.stages;
        if self.obstacles.is_empty() || !stages.collision || !stages.untangling {
            return 0;
        }
        let obstacles = self.obstacles_at_rest();
        let settings = self.scene.contact;
        let cloth = &mut self.cloth;
        let mut found = cloth.cuts(&obstacles);
        if found.is_empty() {
            return 0;
        }
        let mut best = (found.len(), cloth.state.clone());
        let mut since_best = 0;
        for _ in 0..CUT_ROUNDS_MAX {
            let start = cloth.state.position.clone();
            let step = CUT_STEP_IN_THICKNESSES * settings.thickness;
            lift_cuts(&mut cloth.moved(&start), &found, &obstacles, &settings, step);
            let start = cloth.state.position.clone();
            cloth.lead_out(&start, &obstacles, &settings, Depth::Any);
            found = cloth.cuts(&obstacles);
            since_best += 1;
            if found.len() < best.0 {
                best = (found.len(), cloth.state.clone());
                since_best = 0;
            }
            if found.is_empty() || since_best == CUT_PATIENCE {
                break;
            }
        }
        cloth.state = best.1;
        cloth.refit();
        cloth.write_back(&mut self.garments);
        report.trapped_nodes = trapped_nodes(&self.cloth.state.position, &obstacles);
        best.0
    }
}

impl MovingCloth {
    /// Untangles the cloth, and ends the motion against one another of what crossed.
    fn untangle(&mut self, found: Vec<Crossing>, limits: Limits) -> Untangling {
        let Some(own) = &self.own else { return Untangling::default() };
        let flat_lengths = own.flat_lengths(&self.tree);
        let (topology, mass) = (self.tree.topology(), self.system.masses());
        stop_at_crossings(topology, &self.state.position, &mut self.state.velocity, mass, &found);
        let mut tangled = TangledCloth {
            position: &mut self.state.position,
            tree: &mut self.tree,
            mass,
            flat_lengths: &flat_lengths,
        };
        untangle(&mut tangled, found, Method::Contours, limits)
    }

    fn cuts(&self, obstacles: &[ObstacleMotion]) -> Vec<Cut> {
        cuts(&self.state.position, &self.faces, obstacles)
    }
}
