//! After the implicit step: nothing may pass through an obstacle, or end inside one.
//!
//! The penalty layer of the step yields; at speed it can be crossed. Here nodes that ended below
//! the surface are led out, and stopped relative to the obstacle as an inelastic impact with
//! friction would; then [`stop`](super::stop) sees to it that nothing else has passed through on
//! its way, edges and faces included.

use glam::DVec3;
use parry3d_f64::bounding_volume::BoundingVolume;
use rayon::prelude::*;

use super::cloth::ClothContact;
use super::everywhere::stop_everywhere;
use super::face_tree::{FaceTree, Touch};
use super::motion::{At, ObstacleMotion};
use super::near::{Known, NearMemory};
use super::proximity::{Cloth, ObstacleCorner, is_inside_another, obstacle_corner};
use super::shape::Nearest;
use super::stop::{Stops, Surroundings, stop_at_obstacles};
use crate::scene::Contact;

/// Cloth is led out to this share of the contact thickness; the penalty layer does the rest.
pub(super) const FLOOR_IN_THICKNESSES: f64 = 0.1;

/// Parts that overlap hand a node to and fro; after so many rounds it is trapped.
const ROUNDS_MAX: usize = 4;

/// A hair of slack, in contact thicknesses, or rounding would count cloth that was just led out.
const SLACK_IN_THICKNESSES: f64 = 1e-9;

/// Halvings of the way of a node when looking for where it went in.
const ENTRY_HALVINGS: usize = 12;

/// Where the cloth is at the end of the step, to be corrected in place.
pub struct MovedCloth<'a> {
    pub position: &'a mut [DVec3],
    pub velocity: &'a mut [DVec3],
    /// Where each node was at the start of the step (m).
    pub position_at_start: &'a [DVec3],
    pub area: &'a [f64],
    /// As in [`Cloth`] (m).
    pub thickness: &'a [f64],
    /// (kg).
    pub mass: &'a [f64],
    pub faces: &'a [[u32; 3]],
}

/// How deep cloth is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// As deep as a node can have come within the step.
    OfTheStep,
    /// Anywhere inside: after an edit, or to be sure.
    Any,
}

/// What resolving did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Resolution {
    /// Nodes, edges and faces that had to be led out or stopped.
    pub impacts: usize,
    /// Those that could not be: caught between obstacles, or between layers that these hold.
    pub unresolved: usize,
}

/// Leads cloth out of the obstacles at the end of their step, and stops it where it passed through
/// one, or through cloth (with `own`), on its way. The tree is left fitted to the result.
pub fn resolve(
    cloth: &mut MovedCloth<'_>,
    tree: &mut FaceTree,
    obstacles: &[ObstacleMotion],
    memory: &mut NearMemory,
    settings: &Contact,
    depth: Depth,
    own: Option<&mut ClothContact>,
) -> Resolution {
    memory.forget_deforming(obstacles);
    let mut resolution = Resolution::default();
    let mut suspects: Vec<usize> = (0..cloth.position.len()).collect();
    for _ in 0..ROUNDS_MAX {
        let led = lead_nodes_out(cloth, &suspects, obstacles, memory, settings, depth);
        resolution.impacts += led.len();
        suspects = led;
        if depth == Depth::Any {
            tree.refit(cloth.position);
            let lifted = lift_faces(cloth, tree, obstacles, settings);
            resolution.impacts += lifted.len() / 3;
            suspects.extend(&lifted);
        }
        if suspects.is_empty() {
            break;
        }
    }
    let around = Surroundings { tree, obstacles, memory, settings };
    let mut stops = Stops::default();
    if depth == Depth::OfTheStep {
        stops = stop_at_obstacles(cloth, &around, None);
    }
    if let Some(own) = own {
        if depth == Depth::Any {
            own.expect_rest(tree, cloth.position_at_start, settings);
        }
        stops = stop_everywhere(cloth, &mut own.search(tree, settings), &around, stops);
    }
    resolution.impacts += stops.impacts;
    resolution.unresolved = stops.unresolved;
    tree.refit(cloth.position);
    resolution
}

/// Nodes inside an obstacle at the end of its step, as between two that overlap.
pub fn trapped_nodes(positions: &[DVec3], obstacles: &[ObstacleMotion]) -> usize {
    positions.par_iter().filter(|x| obstacles.iter().any(|o| o.contains_at_end(**x))).count()
}

/// Leads those of the suspects out that are inside; returns them.
fn lead_nodes_out(
    cloth: &mut MovedCloth<'_>,
    suspects: &[usize],
    obstacles: &[ObstacleMotion],
    memory: &mut NearMemory,
    settings: &Contact,
    depth: Depth,
) -> Vec<usize> {
    let floor = FLOOR_IN_THICKNESSES * settings.thickness;
    let mut led = Vec::new();
    for (number, obstacle) in obstacles.iter().enumerate() {
        let swept = obstacle.swept_bounds();
        for &node in suspects {
            let x = cloth.position[node];
            if x.distance_squared(x.clamp(swept.mins, swept.maxs)) > floor * floor {
                continue;
            }
            let own = obstacle.point_in_own_at_end(x);
            // What lies as deep as this has not come there within the step.
            if depth == Depth::OfTheStep
                && memory.clearance(node, number, own) * obstacle.end.scale > floor
            {
                continue;
            }
            let known = memory.of(node, number);
            let Some(exit) = exit(cloth, node, obstacle, known, settings, depth) else { continue };
            let lift = floor - exit.signed_distance;
            if lift <= SLACK_IN_THICKNESSES * settings.thickness {
                continue;
            }
            cloth.position[node] += exit.normal * lift;
            let surface_velocity = obstacle.surface_velocity(exit.triangle, exit.barycentric);
            let relative = cloth.velocity[node] - surface_velocity;
            cloth.velocity[node] =
                surface_velocity + after_impact(relative, exit.normal, settings.friction_obstacle);
            led.push(node);
        }
    }
    led
}

/// Where a node should leave an obstacle, or how far it is off: the nearest point of the surface,
/// but for a node that went in deeper than the contact thickness the point where it went in, for in
/// a thin part the nearest point may be on the far side.
fn exit(
    cloth: &MovedCloth<'_>,
    node: usize,
    obstacle: &ObstacleMotion,
    known: &mut Known,
    settings: &Contact,
    depth: Depth,
) -> Option<Nearest> {
    let x = cloth.position[node];
    let start = cloth.position_at_start[node];
    let reach = match depth {
        Depth::OfTheStep => settings.thickness + obstacle.distance_from_carried_max(start, x),
        Depth::Any => f64::INFINITY,
    };
    let nearest = known.nearest(obstacle, At::End, x, reach)?;
    if nearest.signed_distance >= -settings.thickness {
        return Some(nearest);
    }
    // Only few come so deep: on a surface that deforms it takes a search to tell where they are
    // carried.
    let carried = obstacle.carried(start);
    let is_too_deep = -nearest.signed_distance > settings.thickness + x.distance(carried);
    if depth == Depth::OfTheStep && is_too_deep {
        return None;
    }
    if obstacle.contains_at_end(carried) {
        return Some(nearest);
    }
    let (mut outside, mut inside) = (carried, x);
    for _ in 0..ENTRY_HALVINGS {
        let middle = outside.midpoint(inside);
        *if obstacle.contains_at_end(middle) { &mut inside } else { &mut outside } = middle;
    }
    let entry = obstacle.nearest_at_end(outside, f64::INFINITY)?;
    let signed_distance = entry.normal.dot(x - entry.point);
    // Beside the entry the surface may curve away under the node.
    Some(if signed_distance < 0.0 { Nearest { signed_distance, ..entry } } else { nearest })
}

/// Lifts faces off obstacle corners that came through them; returns the nodes moved, three a face.
fn lift_faces(
    cloth: &mut MovedCloth<'_>,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    settings: &Contact,
) -> Vec<usize> {
    let mut moved = Vec::new();
    let around = tree.bounds().loosened(settings.thickness);
    for (own, obstacle) in obstacles.iter().enumerate() {
        if !obstacle.swept_bounds().intersects(&around) {
            continue;
        }
        let groups = obstacle.shape_at_end().groups();
        for &index in groups.iter().flat_map(|g| &g.corners) {
            let corner = obstacle_corner(obstacle, At::End, index);
            let p = corner.position;
            if p != p.clamp(around.mins, around.maxs) {
                continue;
            }
            let Some(touch) = sunk_face(cloth, tree, corner, settings) else { continue };
            if is_inside_another(obstacles, own, p, At::End) {
                continue;
            }
            let floor = FLOOR_IN_THICKNESSES * settings.thickness;
            let surface_velocity = obstacle.corner_velocity(index);
            lift_face(cloth, &touch, floor - touch.signed_distance, surface_velocity);
            moved.extend(touch.nodes);
        }
    }
    moved
}

/// The face that has sunk below a corner of an obstacle, within the contact thickness.
fn sunk_face(
    cloth: &MovedCloth<'_>,
    tree: &FaceTree,
    corner: ObstacleCorner,
    settings: &Contact,
) -> Option<Touch> {
    tree.touch(cloth.seen(), corner.position, corner.normal, settings.thickness)
        .filter(|touch| touch.signed_distance < 0.0)
}

/// Moves a point of a face along the normal by `lift` (m) and ends its approach, by the least
/// change of its nodes. Barycentric weights add up to 1, so their squares to at least 1/3.
pub(super) fn lift_face(
    cloth: &mut MovedCloth<'_>,
    touch: &Touch,
    lift: f64,
    surface_velocity: DVec3,
) {
    let spread: f64 = touch.weights.iter().map(|w| w * w).sum();
    let closing = touch.normal.dot(touch.weighted_sum(cloth.velocity) - surface_velocity);
    for (&node, weight) in touch.nodes.iter().zip(&touch.weights) {
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
            thickness: self.thickness,
            faces: self.faces,
        }
    }
}

/// The relative velocity after an inelastic impact with Coulomb friction
/// ([`BMF03`](crate::papers::BMF03)): the approach ends, and sliding loses at most friction times
/// the approach.
pub(super) fn after_impact(relative_velocity: DVec3, normal: DVec3, friction: f64) -> DVec3 {
    let approach = (-relative_velocity.dot(normal)).max(0.0);
    let along_normal = normal * relative_velocity.dot(normal);
    let sliding = relative_velocity - along_normal;
    let speed = sliding.length();
    let kept = if speed > 0.0 { (1.0 - friction * approach / speed).max(0.0) } else { 0.0 };
    along_normal + normal * approach + sliding * kept
}
