//! The fail-safe of collision: what touches moves as one.
//!
//! Nodes of features that still run into one another are put into one zone
//! ([`HVTG08`](crate::papers::HVTG08)), which moves as a whole by its mean way: what does not move
//! against one another does not meet. A zone that an obstacle runs into rides on the obstacle. Zones
//! grow until nothing meets any more, or rounds run out; what then still meets is counted.

use glam::DVec3;

use super::stop::ClothSearch;
use crate::collision::carry::place_along;
use crate::collision::impact::Impact;
use crate::collision::motion::ObstacleMotion;
use crate::collision::resolve::MovedCloth;
use crate::math::DisjointSets;

/// Rounds; where it takes more, as along a chain of layers, what is left is reported.
const ROUNDS_MAX: usize = 48;

/// Of where a node is and goes: what rounding makes of ways that are the same.
const ROUNDING: f64 = 1e-12;

/// Groups of nodes that move as one.
pub(in crate::collision) struct Zones {
    sets: DisjointSets,
    /// Per first node of a zone: the obstacle it rides on, and the obstacle's way where it was met
    /// (m, own space).
    carrier: Vec<Option<(usize, DVec3)>>,
    /// Where and how fast nodes would end by themselves.
    free_position: Vec<DVec3>,
    free_velocity: Vec<DVec3>,
}

impl Zones {
    /// Every node by itself.
    pub fn new(cloth: &MovedCloth<'_>) -> Self {
        let count = cloth.position.len();
        Self {
            sets: DisjointSets::new(count),
            carrier: vec![None; count],
            free_position: cloth.position.to_vec(),
            free_velocity: cloth.velocity.to_vec(),
        }
    }

    /// Lets zones grow until nothing meets; returns the impacts left, which obstacles that hold the
    /// same cloth leave no way out of. `of_obstacles` finds impacts on obstacles with one of some
    /// nodes.
    pub fn settle(
        mut self,
        cloth: &mut MovedCloth<'_>,
        search: &mut ClothSearch<'_>,
        obstacles: &[ObstacleMotion],
        of_obstacles: impl Fn(&MovedCloth<'_>, Option<&[bool]>) -> Vec<Impact>,
    ) -> usize {
        let mut among: Option<Vec<bool>> = None;
        for _ in 0..ROUNDS_MAX {
            let mut changed = Vec::new();
            let mut left = 0;
            // What meets within one zone has not passed through itself: the zone goes as a rigid body,
            // and what touches in it touched before, or the chords of a turning carrier come nearer
            // than its arcs.
            let met = search.impacts(cloth, among.as_deref());
            debug_assert!(met.iter().all(|impact| self.goes_as_one(cloth, &impact.nodes)));
            for impact in met {
                self.join(&impact.nodes, &mut changed);
            }
            for impact in of_obstacles(cloth, among.as_deref()) {
                self.join(&impact.weights.map(|(node, _)| node), &mut changed);
                let zone = self.sets.root(impact.weights[0].0);
                match self.carrier[zone] {
                    None => {
                        let way = own_way(&impact, &obstacles[impact.obstacle]);
                        self.carrier[zone] = Some((impact.obstacle, way));
                        changed.push(zone);
                    }
                    // What rides on it rests on it.
                    Some((on, _)) if on == impact.obstacle && obstacles[on].is_rigid() => {}
                    Some(_) => left += 1,
                }
            }
            match (changed.is_empty(), &among) {
                (true, None) => return left,
                // What was left in an earlier round need not be among what moved last.
                (true, Some(_)) => {
                    among = None;
                    continue;
                }
                (false, _) => {}
            }
            among = Some(self.place(cloth, obstacles, &changed));
        }
        search.impacts(cloth, None).len() + of_obstacles(cloth, None).len()
    }

    /// Whether nodes are in several zones, or in one and go the same way. On a carrier they are taken to:
    /// where it turns, each has a way of its own.
    fn goes_as_one(&mut self, cloth: &MovedCloth<'_>, nodes: &[usize]) -> bool {
        let zone = self.sets.root(nodes[0]);
        if self.carrier[zone].is_some() || nodes.iter().any(|&n| self.sets.root(n) != zone) {
            return true;
        }
        let way = |n: usize| cloth.position[n] - cloth.position_at_start[n];
        let size = way(nodes[0]).length() + cloth.position[nodes[0]].length();
        nodes.iter().all(|&n| way(n).distance(way(nodes[0])) <= ROUNDING * size)
    }

    /// Makes one zone of several nodes'.
    fn join(&mut self, nodes: &[usize], changed: &mut Vec<usize>) {
        for pair in nodes.windows(2) {
            if let Some([kept, other]) = self.sets.join(pair[0], pair[1]) {
                self.carrier[kept] = self.carrier[kept].or(self.carrier[other]);
                changed.push(kept);
            }
        }
    }

    /// Puts the nodes of changed zones where their zones go; returns which these are.
    fn place(
        &mut self,
        cloth: &mut MovedCloth<'_>,
        obstacles: &[ObstacleMotion],
        changed: &[usize],
    ) -> Vec<bool> {
        let count = self.carrier.len();
        let mut is_changed = vec![false; count];
        for &node in changed {
            let zone = self.sets.root(node);
            is_changed[zone] = true;
        }
        let zones: Vec<usize> = (0..count).map(|node| self.sets.root(node)).collect();
        let mut sums = vec![(0.0, DVec3::ZERO, DVec3::ZERO); count];
        for (node, &zone) in zones.iter().enumerate().filter(|(_, z)| is_changed[**z]) {
            let mass = cloth.mass[node];
            let way = self.free_position[node] - cloth.position_at_start[node];
            let sum = &mut sums[zone];
            *sum = (sum.0 + mass, sum.1 + way * mass, sum.2 + self.free_velocity[node] * mass);
        }
        for (node, &zone) in zones.iter().enumerate().filter(|(_, z)| is_changed[**z]) {
            if let Some((number, own_way)) = self.carrier[zone] {
                place_along(cloth, &obstacles[number], node, own_way);
            } else {
                let (mass, way, momentum) = sums[zone];
                cloth.position[node] =
                    cloth.position_at_start[node] + way / mass.max(f64::MIN_POSITIVE);
                cloth.velocity[node] = momentum / mass.max(f64::MIN_POSITIVE);
            }
        }
        zones.into_iter().map(|zone| is_changed[zone]).collect()
    }
}

/// The way of an obstacle's touching point in its own space (m); none where the obstacle is rigid.
fn own_way(impact: &Impact, obstacle: &ObstacleMotion) -> DVec3 {
    let start = impact.surface_point - impact.surface_velocity * obstacle.duration;
    obstacle.point_in_own_at_end(impact.surface_point) - obstacle.point_in_own_at_start(start)
}
