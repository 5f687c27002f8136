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
    Crossing, Cut, CutNodes, Depth, Limits, Method, ObstacleMotion, Resolution, TangledCloth,
    Untangling, contour_count, crossing_pairs, crossings, cuts, lift_cuts, stop_at_crossings,
    trapped_nodes, untangle,
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

    /// Takes apart what passes through cloth or obstacles, and counts what is left in the end.
    pub(super) fn untangle(
        &mut self,
        moment: Moment,
        clock: &mut StageClock,
        report: &mut FrameReport,
    ) {
        clock.time(Stage::Untangle, || {
            let stages = self.scene.stages;
            let obstacles = self.obstacles_at_rest();
            let mut cuts = self.cloth.cuts(&obstacles);
            if stages.collision && stages.untangling && free_count(&cuts) > 0 {
                cuts = self.lift_off_obstacles(cuts, &obstacles, report);
            }
            let crossings = stages.self_contact.then(|| {
                let found = self.cloth.crossings();
                if found.is_empty() || !stages.untangling {
                    return found;
                }
                let left = self.untangle_cloth(found, moment, report);
                cuts = self.cloth.cuts(&obstacles);
                left
            });
            self.count_what_is_left(&cuts, crossings.as_deref(), report);
            report.trapped_nodes = trapped_nodes(&self.cloth.state.position, &obstacles);
        });
    }

    fn count_what_is_left(
        &mut self,
        cuts: &[Cut],
        crossings: Option<&[Crossing]>,
        report: &mut FrameReport,
    ) {
        let free = free_count(cuts);
        if free > 0 {
            report.warnings.push(format!("{free} faces of cloth cut obstacles"));
        }
        let pairs_of_cuts: usize = cuts.iter().map(|cut| cut.triangle_count).sum();
        let topology = self.cloth.tree.topology();
        report.intersections =
            crossings.map(|found| crossing_pairs(topology, found).len() + pairs_of_cuts);
        self.intersections = report.intersections.unwrap_or(0);
    }

    /// Has contact leave alone what passes through other cloth, so that it can come back.
    pub(super) fn let_go_of_tangles(&mut self) {
        if self.intersections == 0 || !self.scene.stages.untangling {
            return;
        }
        let cloth = &mut self.cloth;
        let found = cloth.crossings();
        if let Some(own) = &mut cloth.own {
            own.let_go_of(&cloth.tree, &found);
        }
    }

    /// Returns the crossings left of those found, and says how many, unless none is.
    fn untangle_cloth(
        &mut self,
        found: Vec<Crossing>,
        moment: Moment,
        report: &mut FrameReport,
    ) -> Vec<Crossing> {
        let before = self.cloth.state.clone();
        let limits = self.limits(moment);
        let mut left = self.cloth.untangle(found.clone(), limits).left;
        // What was moved may have come into an obstacle.
        let mut led_out = Resolution::default();
        if self.scene.stages.collision && !self.obstacles.is_empty() {
            led_out = self.led_out_of_obstacles();
            left = self.cloth.crossings();
        }
        let count = found.len();
        if left.len() > count {
            self.cloth.state = before;
            self.cloth.refit();
            left = found;
        } else {
            report.note(led_out);
        }
        self.cloth.write_back(&mut self.garments);
        if !left.is_empty() {
            let contours = contour_count(&self.cloth.tree, &self.cloth.state.position, &left);
            report.warnings.push(format!(
                "cloth passes through cloth: {} of {count} crossings are left, in {contours} {}",
                left.len(),
                if contours == 1 { "contour" } else { "contours" }
            ));
        }
        left
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

    /// Lifts faces off obstacles that they cut; returns which still do, in the best state of all rounds.
    fn lift_off_obstacles(
        &mut self,
        mut found: Vec<Cut>,
        obstacles: &[ObstacleMotion],
        report: &mut FrameReport,
    ) -> Vec<Cut> {
        let settings = self.scene.contact;
        let cloth = &mut self.cloth;
        let mut best = (found.clone(), cloth.state.clone(), Resolution::default());
        let mut done = Resolution::default();
        let mut since_best = 0;
        for _ in 0..CUT_ROUNDS_MAX {
            let start = cloth.state.position.clone();
            let step = CUT_STEP_IN_THICKNESSES * settings.thickness;
            lift_cuts(&mut cloth.moved(&start), &found, obstacles, &settings, step);
            let start = cloth.state.position.clone();
            let round = cloth.lead_out(&start, obstacles, &settings, Depth::Any);
            done.impacts += round.impacts;
            // Each round goes on from the one before it: what passed then has passed.
            done.unresolved = done.unresolved.max(round.unresolved);
            found = cloth.cuts(obstacles);
            since_best += 1;
            if free_count(&found) < free_count(&best.0) {
                best = (found.clone(), cloth.state.clone(), done);
                since_best = 0;
            }
            if free_count(&found) == 0 || since_best == CUT_PATIENCE {
                break;
            }
        }
        let (left, state, done) = best;
        report.note(done);
        cloth.state = state;
        cloth.refit();
        cloth.write_back(&mut self.garments);
        left
    }
}

/// Cuts that can be lifted off.
fn free_count(cuts: &[Cut]) -> usize {
    cuts.iter().filter(|cut| cut.nodes == CutNodes::Free).count()
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

    fn crossings(&self) -> Vec<Crossing> {
        crossings(&self.tree, &self.state.position)
    }

    fn cuts(&self, obstacles: &[ObstacleMotion]) -> Vec<Cut> {
        cuts(&self.state.position, &self.faces, obstacles)
    }
}
