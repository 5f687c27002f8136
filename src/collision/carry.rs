//! Cloth that goes along with an obstacle: the last resort where impacts one by one do not help.
//!
//! Seen from a rigid obstacle such cloth rests, and what rests meets nothing. Where an obstacle's
//! points move by themselves, cloth that is hit by points with different ways would be torn between
//! them: features that share nodes are one group, and a group goes one common way, the affine map that
//! is nearest to the ways of all points of the obstacle that have hit it. Where the obstacle moves
//! nearly like that, the group keeps its place on it. Where it does not, the group is moved as a whole
//! out of what it still meets, by a margin that doubles with every round.

use glam::{DMat3, DVec3};

use super::impact::{Impact, Pair};
use super::motion::ObstacleMotion;
use super::resolve::{FLOOR_IN_THICKNESSES, MovedCloth};
use super::stop::{Surroundings, again};
use crate::math::outer;

/// Sweeps over what a group meets, to move it out.
const SWEEPS: usize = 8;

/// How much the map of a group prefers a mere shift: the share of the group's own extent that counts
/// as a spread of the points that have hit it. Few points close together tell nothing about what is far
/// from them.
const SHIFT_PREFERENCE: f64 = 1e-2;

/// Which nodes go along with which obstacle.
pub(super) struct Carriers {
    by_node: Vec<Option<Carrier>>,
    groups: Vec<Group>,
}

/// What carries a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Carrier {
    /// Number of the obstacle.
    obstacle: usize,
    /// Only with an obstacle that deforms.
    group: Option<usize>,
}

/// Nodes that go a common way.
#[derive(Default)]
struct Group {
    /// Number of the obstacle.
    obstacle: usize,
    nodes: Vec<usize>,
    pairs: Vec<Pair>,
    rounds: i32,
    is_hit: bool,
}

impl Carriers {
    pub fn new(node_count: usize) -> Self {
        Self { by_node: vec![None; node_count], groups: Vec::new() }
    }

    /// The nodes of impacts go along with the obstacle from where they were at the start. Marks what
    /// moves, and returns how many nodes.
    pub fn carry(
        &mut self,
        cloth: &mut MovedCloth<'_>,
        around: &Surroundings<'_>,
        found: &[Impact],
        moves: &mut [bool],
    ) -> usize {
        for impact in found {
            let obstacle = &around.obstacles[impact.obstacle];
            if obstacle.is_rigid() {
                self.fix(cloth, obstacle, impact, moves);
            } else {
                self.join(impact);
            }
        }
        for number in 0..self.groups.len() {
            if std::mem::take(&mut self.groups[number].is_hit) {
                self.move_group(number, cloth, around, moves);
            }
        }
        moves.iter().filter(|&&m| m).count()
    }

    /// All nodes of the feature, whatever their weight, keep their place on a rigid obstacle.
    fn fix(
        &mut self,
        cloth: &mut MovedCloth<'_>,
        obstacle: &ObstacleMotion,
        impact: &Impact,
        moves: &mut [bool],
    ) {
        let carrier = Some(Carrier { obstacle: impact.obstacle, group: None });
        for (node, _) in impact.weights {
            if self.by_node[node] != carrier {
                self.by_node[node] = carrier;
                place_along(cloth, obstacle, node, DVec3::ZERO);
                moves[node] = true;
            }
        }
    }

    /// The feature's nodes, and all groups on the same obstacle that have one of them, become one
    /// group.
    fn join(&mut self, impact: &Impact) {
        let number = self.groups.len();
        let mut whole = Group { obstacle: impact.obstacle, is_hit: true, ..Group::default() };
        for (node, _) in impact.weights {
            match self.by_node[node] {
                Some(Carrier { obstacle, group: Some(group) }) if obstacle == impact.obstacle => {
                    if group != number {
                        let part = std::mem::take(&mut self.groups[group]);
                        for &n in &part.nodes {
                            self.by_node[n] = Some(Carrier { obstacle, group: Some(number) });
                        }
                        whole.nodes.extend(part.nodes);
                        whole.pairs.extend(part.pairs);
                        whole.rounds = whole.rounds.max(part.rounds);
                    }
                }
                _ => {
                    let carrier = Carrier { obstacle: impact.obstacle, group: Some(number) };
                    self.by_node[node] = Some(carrier);
                    whole.nodes.push(node);
                }
            }
        }
        if !whole.pairs.contains(&impact.pair) {
            whole.pairs.push(impact.pair);
        }
        self.groups.push(whole);
    }

    fn move_group(
        &mut self,
        number: usize,
        cloth: &mut MovedCloth<'_>,
        around: &Surroundings<'_>,
        moves: &mut [bool],
    ) {
        let (group, by_node) = (&mut self.groups[number], &self.by_node);
        // Others may have gone over to another obstacle.
        group.nodes.retain(|&n| by_node[n].is_some_and(|c| c.group == Some(number)));
        group.rounds += 1;
        let obstacle = &around.obstacles[group.obstacle];
        let own = |n: usize| obstacle.point_in_own_at_start(cloth.position_at_start[n]);
        let starts: Vec<DVec3> = group.nodes.iter().map(|&n| own(n)).collect();
        let way = CommonWay::new(obstacle, &group.pairs, &starts);
        for (&node, start) in group.nodes.iter().zip(starts) {
            place_along(cloth, obstacle, node, way.at(start));
            moves[node] = true;
        }
        group.move_out(cloth, around);
    }
}

impl Group {
    /// Out of what it still meets.
    fn move_out(&self, cloth: &mut MovedCloth<'_>, around: &Surroundings<'_>) {
        let obstacle = &around.obstacles[self.obstacle];
        let floor = FLOOR_IN_THICKNESSES * around.settings.thickness;
        // More than the longest way is never needed.
        let margin = (floor * 2f64.powi(self.rounds - 1)).min(floor + obstacle.own_way_max());
        for _ in 0..SWEEPS {
            let mut is_out = true;
            for &pair in &self.pairs {
                let Some(impact) = again(cloth, around, pair, self.obstacle) else {
                    continue;
                };
                let touching = impact.weights.iter().map(|&(n, w)| cloth.position[n] * w);
                let height = impact.normal.dot(touching.sum::<DVec3>() - impact.surface_point);
                let shift = impact.normal * (margin - height);
                for &node in &self.nodes {
                    cloth.position[node] += shift;
                    cloth.velocity[node] += shift / obstacle.duration;
                }
                is_out = false;
            }
            if is_out {
                break;
            }
        }
    }
}

/// Puts a node where the obstacle's pose carries it from the start, but for a way in the obstacle's
/// own space.
pub(super) fn place_along(
    cloth: &mut MovedCloth<'_>,
    obstacle: &ObstacleMotion,
    node: usize,
    own_way: DVec3,
) {
    let start = cloth.position_at_start[node];
    let own = obstacle.point_in_own_at_start(start) + own_way;
    cloth.position[node] = obstacle.end.transform_point(own);
    cloth.velocity[node] = (cloth.position[node] - start) / obstacle.duration;
}

/// The affine map nearest to the ways of some points of an obstacle, in its own space.
struct CommonWay {
    /// The middle of the points at the start (m).
    middle: DVec3,
    /// Of the middle (m).
    way: DVec3,
    /// How the way changes from there.
    gradient: DMat3,
}

impl CommonWay {
    /// The points are those of the features that have hit the group; `starts` is where its nodes were
    /// at the start (m, own space).
    fn new(obstacle: &ObstacleMotion, pairs: &[Pair], starts: &[DVec3]) -> Self {
        let corners: Vec<usize> = pairs.iter().flat_map(|p| p.corners(obstacle)).collect();
        let start = |c: usize| obstacle.shape_at_start().positions()[c];
        let way = |c: usize| obstacle.shape_at_end().positions()[c] - start(c);
        let mean = |of: &dyn Fn(usize) -> DVec3| {
            corners.iter().map(|&c| of(c)).sum::<DVec3>() / corners.len() as f64
        };
        let (middle, mean_way) = (mean(&start), mean(&way));
        let (mut spread, mut slope) = (DMat3::ZERO, DMat3::ZERO);
        for &c in &corners {
            let arm = start(c) - middle;
            spread += outer(arm, arm);
            slope += outer(way(c) - mean_way, arm);
        }
        let extent = starts.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max);
        let preference = SHIFT_PREFERENCE * extent * corners.len() as f64;
        let gradient = slope * (spread + DMat3::from_diagonal(DVec3::splat(preference))).inverse();
        let gradient = if gradient.is_finite() { gradient } else { DMat3::ZERO };
        Self { middle, way: mean_way, gradient }
    }

    /// Of what is at a point at the start (m, own space).
    fn at(&self, start: DVec3) -> DVec3 {
        self.way + self.gradient * (start - self.middle)
    }
}

#[cfg(test)]
#[path = "carry_tests.rs"]
mod tests;
