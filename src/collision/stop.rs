//! Stops cloth that would pass through an obstacle during the step.
//!
//! In rounds: all impacts are found, and resolved one by one in order of time as inelastic impacts
//! with friction ([`BFA02`](crate::papers::BFA02)), which moves nodes and may cause other impacts. What
//! is left after some rounds goes along with the obstacle, see [`carry`](super::carry): more and more
//! nodes do, until nothing passes. What then still does is counted.

use glam::DVec3;
use rayon::prelude::*;

use super::carry::Carriers;
use super::face_tree::FaceTree;
use super::impact::{Impact, Pair};
use super::motion::ObstacleMotion;
use super::near::NearMemory;
use super::resolve::{FLOOR_IN_THICKNESSES, MovedCloth, after_impact};
use super::search::{SweptCloth, impacts};
use crate::scene::Contact;

/// Cloth that comes as close as this, in contact thicknesses, touches.
pub(super) const TOUCH_IN_THICKNESSES: f64 = 1e-3;

/// Rounds of impacts one by one. A sheet on a needle, a box or a sphere needs two or three.
const IMPACT_ROUNDS: usize = 8;

/// Rounds in which what is left goes along. Each takes in at least one more node, or moves a group
/// farther out; where it takes more rounds, the cloth is caught.
const CARRY_ROUNDS: usize = 24;

/// What the cloth may run into, and what that is looked up in.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub tree: &'a FaceTree,
    pub obstacles: &'a [ObstacleMotion],
    pub memory: &'a NearMemory,
    pub settings: &'a Contact,
}

/// What stopping did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Stops {
    pub impacts: usize,
    /// Features that still pass through an obstacle, or faces that one cuts: caught between obstacles,
    /// or between parts of one.
    pub unresolved: usize,
}

/// Stops the cloth at the obstacles' surfaces, a little outside; `among` are the nodes that moved
/// since that was done before, `None` if it was not.
pub(super) fn stop_at_obstacles(
    cloth: &mut MovedCloth<'_>,
    around: &Surroundings<'_>,
    among: Option<&[bool]>,
) -> Stops {
    let rounds = [IMPACT_ROUNDS, CARRY_ROUNDS];
    stop_in_rounds(cloth, around, among, rounds)
}

/// With so many rounds of impacts one by one, and so many of going along.
pub(super) fn stop_in_rounds(
    cloth: &mut MovedCloth<'_>,
    around: &Surroundings<'_>,
    among: Option<&[bool]>,
    [impact_rounds, carry_rounds]: [usize; 2],
) -> Stops {
    let mut stops = Stops::default();
    let mut moved: Option<Vec<bool>> = among.map(<[bool]>::to_vec);
    let mut carriers = Carriers::new(cloth.position.len());
    for round in 0..impact_rounds + carry_rounds {
        let found = found_impacts(cloth, around, moved.as_deref());
        if found.is_empty() {
            stops.unresolved = cut_faces(cloth, around.obstacles);
            return stops;
        }
        let mut moves = vec![false; cloth.position.len()];
        stops.impacts += if round < impact_rounds {
            resolve_in_order(cloth, around, &found, &mut moves)
        } else {
            carriers.carry(cloth, around, &found, &mut moves)
        };
        if !moves.contains(&true) {
            break;
        }
        // Who goes along already may be left with an impact and not move.
        moved = (round < impact_rounds).then_some(moves);
    }
    let left = found_impacts(cloth, around, None).len();
    stops.unresolved = left.max(cut_faces(cloth, around.obstacles));
    stops
}

/// Faces that an obstacle which moves its points by itself cuts at the end of the step. Where it
/// folds into itself or turns inside out, outside and inside change places, and no impact tells.
pub(super) fn cut_faces(cloth: &MovedCloth<'_>, obstacles: &[ObstacleMotion]) -> usize {
    let of = |obstacle: &ObstacleMotion| {
        let corners = |face: &[u32; 3]| face.map(|n| cloth.position[n as usize]);
        let is_cut = |face: &&[u32; 3]| obstacle.is_crossed_at_end(corners(face));
        cloth.faces.par_iter().with_min_len(64).filter(is_cut).count()
    };
    obstacles.iter().filter(|obstacle| !obstacle.is_rigid()).map(of).sum()
}

/// In order of time, then of obstacles and faces.
pub(super) fn found_impacts(
    cloth: &MovedCloth<'_>,
    around: &Surroundings<'_>,
    among: Option<&[bool]>,
) -> Vec<Impact> {
    let Surroundings { tree, obstacles, memory, settings } = *around;
    let swept = SweptCloth { start: cloth.position_at_start, end: cloth.position, tree, among };
    let touch = TOUCH_IN_THICKNESSES * settings.thickness;
    let of = |obstacle| impacts(swept, obstacle, memory, touch);
    let mut found: Vec<Impact> = obstacles.iter().enumerate().flat_map(of).collect();
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    found
}

/// Resolves impacts one by one, those that are still some when it is their turn; returns how many.
fn resolve_in_order(
    cloth: &mut MovedCloth<'_>,
    around: &Surroundings<'_>,
    found: &[Impact],
    moves: &mut [bool],
) -> usize {
    let mut count = 0;
    for impact in found {
        let is_stale = nodes_of(impact).any(|n| moves[n]);
        let now = if is_stale {
            again(cloth, around, impact.pair, impact.obstacle)
        } else {
            Some(*impact)
        };
        if let Some(impact) = now {
            resolve_one(cloth, around.settings, &impact);
            nodes_of(&impact).for_each(|n| moves[n] = true);
            count += 1;
        }
    }
    count
}

/// The impact of a pair as the cloth is now.
pub(super) fn again(
    cloth: &MovedCloth<'_>,
    around: &Surroundings<'_>,
    pair: Pair,
    number: usize,
) -> Option<Impact> {
    let obstacle = &around.obstacles[number];
    let seen = |n: usize| {
        [
            obstacle.point_in_own_at_start(cloth.position_at_start[n]),
            obstacle.point_in_own_at_end(cloth.position[n]),
        ]
    };
    let touch = TOUCH_IN_THICKNESSES * around.settings.thickness / obstacle.end.scale;
    pair.impact((number, obstacle), &seen, touch)
}

/// The touching point ends a little above the surface and no longer approaches it, by the least
/// change of its nodes: d_i = (w_i / m_i) / sum_k (w_k^2 / m_k) d.
fn resolve_one(cloth: &mut MovedCloth<'_>, settings: &Contact, impact: &Impact) {
    let weighted =
        |values: &[DVec3]| impact.weights.iter().map(|&(n, w)| values[n] * w).sum::<DVec3>();
    let height = impact.normal.dot(weighted(cloth.position) - impact.surface_point);
    let lift = impact.normal * (FLOOR_IN_THICKNESSES * settings.thickness - height);
    let relative = weighted(cloth.velocity) - impact.surface_velocity;
    let change = after_impact(relative, impact.normal, settings.friction_obstacle) - relative;
    // A face is of one fabric: area stands for mass.
    let mobility = |n: usize, w: f64| w / cloth.area[n].max(f64::MIN_POSITIVE);
    let whole: f64 = impact.weights.iter().map(|&(n, w)| w * mobility(n, w)).sum();
    let shares = impact.weights.map(|(n, w)| (n, mobility(n, w) / whole));
    for (node, share) in shares {
        cloth.position[node] += lift * share;
        cloth.velocity[node] += change * share;
    }
}

fn nodes_of(impact: &Impact) -> impl Iterator<Item = usize> + use<> {
    impact.weights.into_iter().filter(|&(_, w)| w != 0.0).map(|(n, _)| n)
}
