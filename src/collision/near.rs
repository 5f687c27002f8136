//! What is known of how far the cloth's nodes are from the obstacles, so that little is asked twice.
//!
//! A node that was 5 cm off a rigid obstacle is at least 4 cm off after it has moved by 1 cm in the
//! obstacle's own space; and the triangle that was nearest is a good guess for the nearest now. Both
//! only save work: the answers are the same without. What is known is forgotten with every frame, so
//! that a frame depends on nothing but the one before.

use glam::DVec3;

use super::motion::{At, ObstacleMotion};
use super::shape::Nearest;

/// Per node and obstacle.
#[derive(Clone, Debug, Default)]
pub struct NearMemory {
    obstacle_count: usize,
    known: Vec<Known>,
}

/// What a search has shown of a node and an obstacle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// Where the node was, in the obstacle's own space (m).
    place: DVec3,
    /// Nothing of the obstacle was nearer (m, own space).
    clearance: f64,
    nearest: Option<u32>,
}

impl NearMemory {
    /// Knows nothing yet.
    pub fn new(node_count: usize, obstacle_count: usize) -> Self {
        Self { obstacle_count, known: vec![Known::default(); node_count * obstacle_count] }
    }

    /// Knows nothing again.
    pub fn forget(&mut self) {
        self.known.fill(Known::default());
    }

    /// Forgets how far off the obstacles are whose points move by themselves in a step: what was
    /// known of their distances no longer holds.
    pub fn forget_deforming(&mut self, obstacles: &[ObstacleMotion]) {
        for (number, _) in obstacles.iter().enumerate().filter(|(_, o)| !o.is_rigid()) {
            let of_obstacle = self.known.iter_mut().skip(number).step_by(self.obstacle_count);
            of_obstacle.for_each(|known| known.clearance = 0.0);
        }
    }

    /// Per node, what is known of every obstacle. As many nodes as were asked for; none without
    /// obstacles.
    pub fn by_node(&mut self) -> &mut [Known] {
        &mut self.known
    }

    /// How many values of [`by_node`](Self::by_node) belong to one node; at least 1.
    pub fn stride(&self) -> usize {
        self.obstacle_count.max(1)
    }

    pub fn of(&mut self, node: usize, obstacle: usize) -> &mut Known {
        &mut self.known[node * self.obstacle_count + obstacle]
    }

    /// No point of an obstacle is nearer (m, own space) to a node that is now at a place in the
    /// obstacle's own space.
    pub fn clearance(&self, node: usize, obstacle: usize, place: DVec3) -> f64 {
        self.known[node * self.obstacle_count + obstacle].clearance_at(place)
    }
}

impl Known {
    fn clearance_at(&self, place: DVec3) -> f64 {
        self.clearance - self.place.distance(place)
    }

    /// [`ObstacleMotion::nearest`] of a node, looked for a little farther than the radius (m) so
    /// that the next steps need not look again.
    pub fn nearest(
        &mut self,
        obstacle: &ObstacleMotion,
        at: At,
        point: DVec3,
        radius: f64,
    ) -> Option<Nearest> {
        if !obstacle.is_rigid() {
            let found = obstacle.nearest(at, point, radius, self.nearest);
            self.nearest = found.map(|n| n.triangle).or(self.nearest);
            return found;
        }
        let (place, scale) = match at {
            At::Start => (obstacle.point_in_own_at_start(point), obstacle.start.scale),
            At::End => (obstacle.point_in_own_at_end(point), obstacle.end.scale),
        };
        if self.clearance_at(place) * scale > radius {
            return None;
        }
        let looked = radius * FARTHER;
        let found = obstacle.nearest(at, point, looked, self.nearest);
        let distance = found.map_or(looked, |n| n.signed_distance.abs());
        *self = Known {
            place,
            clearance: distance / scale,
            nearest: found.map(|n| n.triangle).or(self.nearest),
        };
        found.filter(|n| n.signed_distance.abs() < radius)
    }
}

/// Looking this much farther costs less than looking again in the next step.
const FARTHER: f64 = 2.0;
