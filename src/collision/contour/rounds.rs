//! The rounds of untangling.

use glam::DVec3;

use super::bounded::keep_fabric_sound;
use super::contours::{Contour, contours};
use super::moves::{Method, moves};
use super::point::CrossingPoint;
use crate::collision::cloth::{Crossing, crossings};
use crate::collision::face_tree::FaceTree;

/// The cloth of all garments.
pub struct TangledCloth<'a> {
    pub position: &'a mut [DVec3],
    /// Fitted to the positions, before and after.
    pub tree: &'a mut FaceTree,
    /// (kg).
    pub mass: &'a [f64],
    /// Of the tree's edges, in the flat cloth (m).
    pub flat_lengths: &'a [f64],
}

/// How far untangling goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Of an edge against a face in a round (m).
    pub step: f64,
    /// Of a node in all rounds (m).
    pub way: f64,
    pub rounds: usize,
    /// Rounds without a better state, after which no more are made.
    pub patience: usize,
}

/// What stood at the beginning of a round.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Round {
    pub crossings: usize,
    pub contours: usize,
    /// Of all contours (m).
    pub length: f64,
}

/// What untangling did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Untangling {
    /// The crossings left.
    pub left: Vec<Crossing>,
    pub contours_left: usize,
    /// At the start and after every round, whether it was for the better or not.
    pub rounds: Vec<Round>,
}

/// What is known of a state of the cloth.
struct Tangle {
    found: Vec<Crossing>,
    points: Vec<CrossingPoint>,
    contours: Vec<Contour>,
}

/// Moves nodes until nothing crosses, or limits are reached; keeps the state with the fewest
/// crossings, of these that with the shortest contours, which may be that of the beginning. `found`
/// are all crossings at the beginning.
pub fn untangle(
    cloth: &mut TangledCloth<'_>,
    found: Vec<Crossing>,
    method: Method,
    limits: Limits,
) -> Untangling {
    let start: Vec<DVec3> = cloth.position.to_vec();
    let mut now = Tangle::of(cloth, found);
    let mut rounds = vec![now.summary()];
    let mut best = (now.summary(), now.found.clone(), start.clone());
    let mut since_best = 0;
    while !now.found.is_empty() && rounds.len() <= limits.rounds && since_best < limits.patience {
        go(cloth, &now, &start, method, limits);
        cloth.tree.refit(cloth.position);
        now = Tangle::of(cloth, crossings(cloth.tree, cloth.position));
        let summary = now.summary();
        rounds.push(summary);
        since_best += 1;
        if summary.is_better_than(best.0) {
            best = (summary, now.found.clone(), cloth.position.to_vec());
            since_best = 0;
        }
    }
    if since_best > 0 {
        cloth.position.copy_from_slice(&best.2);
        cloth.tree.refit(cloth.position);
    }
    Untangling { contours_left: best.0.contours, left: best.1, rounds }
}

/// Goes one round.
fn go(cloth: &mut TangledCloth<'_>, now: &Tangle, start: &[DVec3], method: Method, limits: Limits) {
    let topology = cloth.tree.topology();
    let (points, contours) = (&now.points, &now.contours);
    let mut ways =
        moves(topology, cloth.position, cloth.mass, points, contours, method, limits.step);
    for (node, way) in ways.iter_mut().enumerate() {
        let end = cloth.position[node] + *way;
        if *way != DVec3::ZERO {
            *way = start[node] + (end - start[node]).clamp_length_max(limits.way)
                - cloth.position[node];
        }
    }
    keep_fabric_sound(topology, cloth.position, cloth.flat_lengths, &mut ways);
    cloth.position.iter_mut().zip(&ways).for_each(|(x, way)| *x += *way);
}

impl Tangle {
    fn of(cloth: &TangledCloth<'_>, found: Vec<Crossing>) -> Self {
        let topology = cloth.tree.topology();
        let point = |c: &Crossing| CrossingPoint::of(topology, cloth.position, *c);
        let points: Vec<CrossingPoint> = found.iter().filter_map(point).collect();
        let contours = contours(topology, cloth.position, &points);
        Self { found, points, contours }
    }

    fn summary(&self) -> Round {
        Round {
            crossings: self.found.len(),
            contours: self.contours.len(),
            length: self.contours.iter().map(|c| c.length).sum(),
        }
    }
}

impl Round {
    fn is_better_than(&self, other: Round) -> bool {
        (self.crossings, self.length) < (other.crossings, other.length)
    }
}
