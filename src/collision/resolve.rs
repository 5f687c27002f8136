//! After the implicit step: nothing may end inside an obstacle.
//!
//! The penalty layer of the step yields; at speed it can be crossed. Here cloth that ended below
//! the surface is led out, and stopped relative to the obstacle as an inelastic impact with
//! friction would.

use glam::DVec3;

use super::face_tree::{FaceTree, Touch};
use super::obstacles::ObstacleMotion;
use super::proximity::{At, Cloth, obstacle_corner};
use crate::scene::Contact;

/// What resolution did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResolveReport {
    /// Nodes and faces that had to be led out.
    pub impacts: usize,
    /// Nodes that are still inside an obstacle, as between two that overlap.
    pub trapped: usize,
}

/// Cloth is led out to this share of the contact thickness; the penalty layer does the rest.
const FLOOR_IN_THICKNESSES: f64 = 0.1;

/// Parts that overlap hand a node to and fro; after so many rounds it is trapped.
const ROUNDS_MAX: usize = 4;

/// Where the cloth is at the end of the step, to be corrected in place.
pub struct MovedCloth<'a> {
    pub position: &'a mut [DVec3],
    pub velocity: &'a mut [DVec3],
    /// Where each node was at the start of the step (m).
    pub position_at_start: &'a [DVec3],
    pub area: &'a [f64],
    pub faces: &'a [[u32; 3]],
}

/// Leads cloth out of the obstacles at the end of their step; the tree is left fitted to the
/// result.
pub fn resolve(
    cloth: &mut MovedCloth<'_>,
    tree: &mut FaceTree,
    obstacles: &[ObstacleMotion],
    settings: &Contact,
) -> ResolveReport {
    let mut report = ResolveReport::default();
    for round in 0..ROUNDS_MAX {
        let led_out: usize = obstacles.iter().map(|o| lead_nodes_out(cloth, o, settings)).sum();
        if round == 0 {
            report.impacts += led_out;
        }
        report.trapped = led_out;
        if led_out == 0 {
            break;
        }
    }
    tree.refit(cloth.position, cloth.faces);
    let lifted: usize = obstacles.iter().map(|o| lift_faces(cloth, tree, o, settings)).sum();
    if lifted > 0 {
        report.impacts += lifted;
        tree.refit(cloth.position, cloth.faces);
    }
    report
}

fn lead_nodes_out(
    cloth: &mut MovedCloth<'_>,
    obstacle: &ObstacleMotion,
    settings: &Contact,
) -> usize {
    let floor = FLOOR_IN_THICKNESSES * settings.thickness;
    let swept = obstacle.swept_bounds();
    let mut count = 0;
    for node in 0..cloth.position.len() {
        let x = cloth.position[node];
        let start = cloth.position_at_start[node];
        if x.distance(x.clamp(swept.mins, swept.maxs)) > floor {
            continue;
        }
        let carried = obstacle.velocity_at(start) * obstacle.duration;
        let reach = settings.thickness + (x - start - carried).length();
        let Some(nearest) = obstacle.nearest_at_end(x, reach) else { continue };
        let lift = floor - nearest.signed_distance;
        // A hair of slack, or rounding would count a node that was just led out.
        if lift <= 1e-9 * settings.thickness {
            continue;
        }
        cloth.position[node] += nearest.normal * lift;
        let surface_velocity = obstacle.velocity_at(nearest.point);
        cloth.velocity[node] = surface_velocity
            + after_impact(
                cloth.velocity[node] - surface_velocity,
                nearest.normal,
                settings.friction_obstacle,
            );
        count += 1;
    }
    count
}

fn lift_faces(
    cloth: &mut MovedCloth<'_>,
    tree: &FaceTree,
    obstacle: &ObstacleMotion,
    settings: &Contact,
) -> usize {
    let floor = FLOOR_IN_THICKNESSES * settings.thickness;
    let around = tree.bounds();
    let mut count = 0;
    for index in 0..obstacle.shape.positions().len() {
        let corner = obstacle_corner(obstacle, At::End, index);
        let p = corner.position;
        if p.distance(p.clamp(around.mins, around.maxs)) > settings.thickness {
            continue;
        }
        let Some(touch) = tree.touch(cloth.seen(), p, corner.normal, settings.thickness) else {
            continue;
        };
        if touch.signed_distance < 0.0 {
            lift_face(cloth, &touch, floor - touch.signed_distance, obstacle.velocity_at(p));
            count += 1;
        }
    }
    count
}

/// Moves a point of a face along the normal by `lift` (m) and ends its approach, by the least
/// change of its nodes. Barycentric weights add up to 1, so their squares to at least 1/3.
fn lift_face(cloth: &mut MovedCloth<'_>, touch: &Touch, lift: f64, surface_velocity: DVec3) {
    let spread: f64 = touch.weights.iter().map(|w| w * w).sum();
    let nodes = touch.nodes.iter().zip(&touch.weights);
    let closing: f64 = nodes
        .clone()
        .map(|(&n, w)| w * touch.normal.dot(cloth.velocity[n] - surface_velocity))
        .sum();
    for (&node, weight) in nodes {
        let share = weight / spread;
        cloth.position[node] += touch.normal * (lift * share);
        cloth.velocity[node] -= touch.normal * (closing.min(0.0) * share);
    }
}

impl MovedCloth<'_> {
    fn seen(&self) -> Cloth<'_> {
        Cloth {
            position: self.position,
            velocity: self.velocity,
            area: self.area,
            faces: self.faces,
        }
    }
}

/// The relative velocity after an inelastic impact with Coulomb friction
/// ([`BMF03`](crate::papers::BMF03)): the approach ends, and sliding loses at most friction times
/// the approach.
fn after_impact(relative_velocity: DVec3, normal: DVec3, friction: f64) -> DVec3 {
    let approach = (-relative_velocity.dot(normal)).max(0.0);
    let along_normal = normal * relative_velocity.dot(normal);
    let sliding = relative_velocity - along_normal;
    let speed = sliding.length();
    let kept = if speed > 0.0 { (1.0 - friction * approach / speed).max(0.0) } else { 0.0 };
    along_normal + normal * approach + sliding * kept
}
