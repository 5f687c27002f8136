//! Two ways of keeping cloth out of cloth, on the same steps: looking for impacts on the whole way and
//! stopping these, which is what the simulation does; and letting every node go no farther than its
//! bound ([`WayBounds`]), again and again.
//!
//! Nothing is known exactly but the aim, that nothing crosses. What it costs, and how much of the step's
//! motion is left, is a matter of measurement.

use cpu_time::ThreadTime;
use glam::DVec3;

use crate::collision::{
    Cloth, ClothContact, Depth, FaceTree, MovedCloth, NearMemory, WayBounds, crossings, resolve,
};
use crate::mesh::Mesh;
use crate::scene::Contact;
use crate::sim::TrialStep;

/// Rounds of bounds at most. As many searches of a step would cost more than its solution.
pub const ROUNDS_MAX: usize = 16;

/// The least of so many times is that of nobody interfering.
const REPEATS: usize = 3;

/// Nodes up to this share are the slow ones when the speed of a step is told.
const SPEED_PERCENTILE: f64 = 0.95;

/// What was made of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    pub node_count: usize,
    pub face_count: usize,
    /// How far 95 % of the nodes go at most beyond the mean way, in contact thicknesses.
    pub speed: f64,
    pub searched: Searched,
    /// A radius each.
    pub bounded: Vec<Bounded>,
}

/// By looking for impacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Searched {
    /// CPU time (s) of finding what may meet, and of stopping what does.
    pub seconds: [f64; 2],
    pub impacts: usize,
    /// Share of the step's motion but for the mean way, by mass: 1 - sum m |x - x_end| / sum m |x_end - x_start -
    /// mean|; 1 where nothing moves.
    pub motion_kept: f64,
    /// Edges through faces at the end.
    pub crossings: usize,
}

/// By bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounded {
    /// How far is looked, in contact thicknesses.
    pub radius: f64,
    /// Until every node arrives, [`ROUNDS_MAX`] at most.
    pub rounds: Vec<BoundRound>,
    /// Edges through faces at the end.
    pub crossings: usize,
}

/// The bounds found once, and gone by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundRound {
    /// CPU time (s).
    pub seconds: f64,
    /// Pairs of features looked at.
    pub pairs: usize,
    /// Share of the nodes that did not arrive.
    pub held_share: f64,
    /// Share of the motion since the start of the step, as that of [`Searched`].
    pub motion_kept: f64,
}

impl Comparison {
    /// Both ways on a step of some garments; the radii are in contact thicknesses. `None` if cloth
    /// passes through cloth at the start: neither is made for that.
    ///
    /// Takes the time of the thread it runs on: to be called where rayon has no other.
    pub fn of(
        trial: &TrialStep,
        garments: &[Mesh],
        settings: &Contact,
        radii: &[f64],
    ) -> Option<Self> {
        let start = &trial.start.position;
        let mut tree = FaceTree::new(start, &trial.faces);
        if !crossings(&tree, start).is_empty() {
            return None;
        }
        let bounded = radii.iter().map(|&radius| bounded(trial, &mut tree, settings, radius));
        let bounded = bounded.collect();
        Some(Self {
            node_count: start.len(),
            face_count: trial.faces.len(),
            speed: speed(trial) / settings.thickness,
            searched: searched(trial, garments, &mut tree, settings),
            bounded,
        })
    }
}

fn searched(
    trial: &TrialStep,
    garments: &[Mesh],
    tree: &mut FaceTree,
    settings: &Contact,
) -> Searched {
    let TrialStep { start, end, area, mass, thickness, faces, duration } = trial;
    let seen =
        Cloth { position: &start.position, velocity: &start.velocity, area, thickness, faces };
    let mut own = ClothContact::new(garments, tree, &start.position);
    let mut done = Searched { seconds: [f64::INFINITY; 2], ..Searched::default() };
    for _ in 0..REPEATS {
        tree.refit(&start.position);
        let mut after = end.clone();
        let begun = ThreadTime::now();
        own.expect_motion(seen, tree, settings, *duration);
        let found = ThreadTime::now();
        let mut cloth = MovedCloth {
            position: &mut after.position,
            velocity: &mut after.velocity,
            position_at_start: &start.position,
            area,
            thickness,
            mass,
            faces,
        };
        let mut near = NearMemory::new(start.position.len(), 0);
        let depth = Depth::OfTheStep;
        let made = resolve(&mut cloth, tree, &[], &mut near, settings, depth, Some(&mut own));
        let seconds = [found.duration_since(begun), found.elapsed()].map(|d| d.as_secs_f64());
        done = Searched {
            seconds: [0, 1].map(|k| seconds[k].min(done.seconds[k])),
            impacts: made.impacts,
            motion_kept: motion_kept(trial, &after.position),
            crossings: crossings(tree, &after.position).len(),
        };
    }
    done
}

fn bounded(trial: &TrialStep, tree: &mut FaceTree, settings: &Contact, radius: f64) -> Bounded {
    let mut bounds = WayBounds::new(tree, &trial.start.position);
    let mut position = trial.start.position.clone();
    let mut rounds = Vec::new();
    while rounds.len() < ROUNDS_MAX {
        let mut seconds = f64::INFINITY;
        let mut after = (0, position.clone());
        for _ in 0..REPEATS {
            after.1.clone_from(&position);
            let begun = ThreadTime::now();
            bounds.find(tree, &position, radius * settings.thickness);
            after.0 = bounds.advance(&mut after.1, &trial.end.position);
            seconds = begun.elapsed().as_secs_f64().min(seconds);
        }
        position = after.1;
        rounds.push(BoundRound {
            seconds,
            pairs: bounds.pair_count(),
            held_share: after.0 as f64 / position.len().max(1) as f64,
            motion_kept: motion_kept(trial, &position),
        });
        if after.0 == 0 {
            break;
        }
    }
    tree.refit(&position);
    Bounded { radius, rounds, crossings: crossings(tree, &position).len() }
}

/// The share of a step's motion that is left where nodes end elsewhere than they would.
fn motion_kept(trial: &TrialStep, position: &[DVec3]) -> f64 {
    let ways = relative_ways(trial);
    let all: f64 = trial.mass.iter().zip(&ways).map(|(m, way)| m * way).sum();
    let off = position.iter().zip(&trial.end.position).map(|(x, end)| x.distance(*end));
    let lost: f64 = trial.mass.iter().zip(off).map(|(m, off)| m * off).sum();
    if all > 0.0 { 1.0 - lost / all } else { 1.0 }
}

/// (m).
fn speed(trial: &TrialStep) -> f64 {
    let mut ways = relative_ways(trial);
    ways.sort_by(f64::total_cmp);
    let last = ways.len().saturating_sub(1) as f64;
    ways.get((SPEED_PERCENTILE * last).round() as usize).copied().unwrap_or(0.0)
}

/// Of every node beyond the mean way (m).
fn relative_ways(trial: &TrialStep) -> Vec<f64> {
    let (start, end) = (&trial.start.position, &trial.end.position);
    let ways: Vec<DVec3> = start.iter().zip(end).map(|(a, b)| *b - *a).collect();
    let mean = ways.iter().sum::<DVec3>() / ways.len().max(1) as f64;
    ways.into_iter().map(|way| way.distance(mean)).collect()
}

#[cfg(test)]
#[path = "way_bounds_tests.rs"]
mod tests;
