//! Stops cloth that would pass through other cloth during the step.
//!
//! Impacts are resolved one by one in order of time, as inelastic ones with friction
//! ([`BFA02`](crate::papers::BFA02)), in a few rounds: each moves nodes, which may cause others.

use super::ROOM_IN_THICKNESSES;
use super::impact::{ClothImpact, impacts};
use super::layers::{Layers, weighted};
use super::pairs::ClothPairs;
use crate::collision::resolve::{MovedCloth, after_impact};
use crate::collision::stop::TOUCH_IN_THICKNESSES;
use crate::collision::topology::Topology;
use crate::scene::Contact;

/// Cloth that was nearer than it is held off ends as near as it was, but not nearer than this, in
/// touches; farther cloth this far off, in contact thicknesses: the penalty layer does the rest.
const FLOOR_IN_TOUCHES: f64 = 2.0;
const FLOOR_IN_THICKNESSES: f64 = 0.05;

/// Rounds of impacts one by one.
const IMPACT_ROUNDS: usize = 6;

/// What stopping did.
#[derive(Clone, Debug, Default)]
pub(in crate::collision) struct ClothStops {
    pub impacts: usize,
    /// Nodes that were moved.
    pub moved: Vec<bool>,
    /// Whether impacts are left.
    pub is_left: bool,
}

/// Looks for impacts of the cloth with itself.
pub(in crate::collision) struct ClothSearch<'a> {
    pub topology: &'a Topology,
    pub pairs: &'a mut ClothPairs,
    /// Nodes at places where cloth passes through itself: nothing stops these at one another.
    pub tangled: Option<&'a [bool]>,
    pub layers: &'a Layers,
    pub settings: &'a Contact,
}

impl ClothSearch<'_> {
    /// The distance at which features with these nodes touch (m).
    fn touch(&self, nodes: [usize; 4]) -> f64 {
        self.layers.touch(nodes, TOUCH_IN_THICKNESSES * self.settings.thickness)
    }

    /// Impacts of the cloth as it moved, with one of some nodes or with any.
    pub fn impacts(&mut self, cloth: &MovedCloth<'_>, among: Option<&[bool]>) -> Vec<ClothImpact> {
        let room = ROOM_IN_THICKNESSES * self.settings.thickness;
        self.pairs.cover(self.topology, cloth.position, room);
        if let Some(tangled) = self.tangled {
            self.pairs.leave_out(self.topology, tangled);
        }
        let ways = [cloth.position_at_start, &*cloth.position];
        impacts(self.topology, self.pairs.found(), ways, among, |nodes| self.touch(nodes))
    }
}

/// Rounds of impacts one by one; `among` are the nodes that moved since the last search, if it is
/// not the first.
pub(in crate::collision) fn stop_cloth(
    cloth: &mut MovedCloth<'_>,
    search: &mut ClothSearch<'_>,
    among: Option<&[bool]>,
) -> ClothStops {
    let mut stops = ClothStops { moved: vec![false; cloth.position.len()], ..Default::default() };
    let mut among = among.map(<[bool]>::to_vec);
    for _ in 0..IMPACT_ROUNDS {
        let found = search.impacts(cloth, among.as_deref());
        stops.is_left = !found.is_empty();
        if found.is_empty() {
            break;
        }
        let mut moves = vec![false; cloth.position.len()];
        for impact in found {
            let is_stale = impact.nodes.iter().any(|&n| moves[n]);
            let ways = [cloth.position_at_start, &*cloth.position];
            let now = match is_stale {
                true => {
                    ClothImpact::of(impact.pair, impact.nodes, ways, search.touch(impact.nodes))
                }
                false => Some(impact),
            };
            if let Some(impact) = now {
                resolve_one(cloth, search, &impact);
                impact.nodes.iter().for_each(|&n| moves[n] = true);
                stops.impacts += 1;
            }
        }
        stops.moved.iter_mut().zip(&moves).for_each(|(all, now)| *all |= now);
        among = Some(moves);
    }
    stops
}

/// The touching points end a little apart and no longer approach, by the least change of their
/// nodes: d_i = (w_i / m_i) / sum_k (w_k^2 / m_k) d.
fn resolve_one(cloth: &mut MovedCloth<'_>, search: &ClothSearch<'_>, impact: &ClothImpact) {
    let ClothImpact { nodes, weights, normal, height_before, .. } = *impact;
    let floor = height_before.clamp(
        FLOOR_IN_TOUCHES * search.touch(nodes),
        FLOOR_IN_THICKNESSES * search.settings.thickness,
    );
    let lift = normal * (floor - normal.dot(weighted(cloth.position, nodes, weights)));
    let relative = weighted(cloth.velocity, nodes, weights);
    let change = after_impact(relative, normal, search.settings.friction_cloth) - relative;
    let mobility = |k: usize| weights[k] / cloth.mass[nodes[k]].max(f64::MIN_POSITIVE);
    let whole: f64 = (0..4).map(|k| weights[k] * mobility(k)).sum();
    if !(whole > 0.0 && whole.is_finite()) {
        return;
    }
    for (k, &node) in nodes.iter().enumerate() {
        let share = mobility(k) / whole;
        cloth.position[node] += lift * share;
        cloth.velocity[node] += change * share;
    }
}
