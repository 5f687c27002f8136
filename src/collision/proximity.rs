//! Which points of cloth and obstacles are about to touch in a step.

use glam::DVec3;
use rayon::prelude::*;

use super::face_tree::FaceTree;
use super::group::Group;
use super::motion::{At, ObstacleMotion};
use super::near::{Known, NearMemory};
use super::ridge::ridge_contacts;
use crate::dynamics::ContactPoint;
use crate::scene::Contact;
use crate::sizing::Plane;

/// The cloth as contact sees it: all garments in one numbering of nodes.
#[derive(Clone, Copy, Debug)]
pub struct Cloth<'a> {
    /// (m).
    pub position: &'a [DVec3],
    /// (m/s).
    pub velocity: &'a [DVec3],
    /// Material area of each node (m^2).
    pub area: &'a [f64],
    /// Distance at which each node is held off (m): its fabric's, at most that of the scene's
    /// contact. All nodes of a face have the same.
    pub thickness: &'a [f64],
    /// Nodes of each face.
    pub faces: &'a [[u32; 3]],
}

/// Contacts which hold already, or would be broken within the step if everything went on as it
/// goes: nodes against obstacles, corners of obstacles against faces, sharp edges of obstacles
/// against edges.
///
/// In order of nodes, then of obstacles and their corners and edges, however many threads look for
/// them.
pub fn contacts(
    cloth: Cloth<'_>,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    memory: &mut NearMemory,
    settings: &Contact,
) -> Vec<ContactPoint> {
    // Collected in the order of nodes and corners, whoever finds them first.
    memory.forget_deforming(obstacles);
    let stride = memory.stride();
    let of_node = |(node, known): (usize, &mut [Known])| {
        let of_obstacle = |(obstacle, known): (&ObstacleMotion, &mut Known)| {
            node_contact(cloth, node, obstacle, known, settings)
        };
        obstacles.iter().zip(known).filter_map(of_obstacle).collect::<Vec<_>>()
    };
    let nodes = memory.by_node().par_chunks_mut(stride).enumerate();
    let mut found: Vec<ContactPoint> = nodes.flat_map_iter(of_node).collect();
    let speed_max = cloth.velocity.iter().map(|v| v.length_squared()).fold(0.0, f64::max).sqrt();
    for own in 0..obstacles.len() {
        corner_contacts(cloth, speed_max, tree, obstacles, own, settings, &mut found);
        ridge_contacts(cloth, speed_max, tree, obstacles, own, settings, &mut found);
    }
    found
}

/// Depth below the surface, in contact thicknesses, at which cloth is still found and led out.
const DEPTH_IN_THICKNESSES: f64 = 4.0;

fn node_contact(
    cloth: Cloth<'_>,
    node: usize,
    obstacle: &ObstacleMotion,
    known: &mut Known,
    settings: &Contact,
) -> Option<ContactPoint> {
    let (x, v) = (cloth.position[node], cloth.velocity[node]);
    let reach_min = DEPTH_IN_THICKNESSES * settings.thickness;
    let travel = v.length() * obstacle.duration;
    let swept = obstacle.swept_bounds();
    let bounds_reach = reach_min.max(settings.thickness + travel);
    if x.distance_squared(x.clamp(swept.mins, swept.maxs)) > bounds_reach * bounds_reach {
        return None;
    }
    let approach = (v - obstacle.velocity_at(x)).length() * obstacle.duration;
    let reach = reach_min.max(settings.thickness + approach + obstacle.own_way_max());
    let nearest = known.nearest(obstacle, At::Start, x, reach)?;
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&[(node, 1.0)]),
        normal: nearest.normal,
        gap: nearest.signed_distance - cloth.thickness[node],
        surface_velocity: obstacle.surface_velocity(nearest.triangle, nearest.barycentric),
        stiffness: settings.stiffness * cloth.area[node],
        friction: settings.friction_obstacle,
    };
    is_active(&contact, v, obstacle.duration).then_some(contact)
}

/// Corners of one obstacle against faces.
fn corner_contacts(
    cloth: Cloth<'_>,
    cloth_speed_max: f64,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    own: usize,
    settings: &Contact,
    found: &mut Vec<ContactPoint>,
) {
    let obstacle = &obstacles[own];
    let approach = (obstacle.speed_max() + cloth_speed_max) * obstacle.duration;
    let near = corners_near(tree, obstacle, settings.thickness + approach);
    let of_corner = |corner: usize| {
        let corner = obstacle_corner(obstacle, At::Start, corner);
        let contact = corner_contact(cloth, cloth_speed_max, tree, obstacle, corner, settings)?;
        (!is_inside_another(obstacles, own, corner.position, At::Start)).then_some(contact)
    };
    found.par_extend(near.into_par_iter().filter_map(of_corner));
}

/// The corners of an obstacle which may be within a reach (m) of the cloth, in order.
fn corners_near(tree: &FaceTree, obstacle: &ObstacleMotion, reach: f64) -> Vec<usize> {
    let shape = obstacle.shape_at_start();
    let is_near = |group: &&Group| {
        let centre = obstacle.start.transform_point(group.centre);
        tree.is_within(centre, group.radius * obstacle.start.scale + reach)
    };
    let mut near: Vec<usize> =
        shape.groups().iter().filter(is_near).flat_map(|g| g.corners.clone()).collect();
    near.sort_unstable();
    near
}

fn corner_contact(
    cloth: Cloth<'_>,
    cloth_speed_max: f64,
    tree: &FaceTree,
    obstacle: &ObstacleMotion,
    corner: ObstacleCorner,
    settings: &Contact,
) -> Option<ContactPoint> {
    let surface_velocity = obstacle.corner_velocity(corner.index);
    let approach = (surface_velocity.length() + cloth_speed_max) * obstacle.duration;
    let reach = settings.thickness + approach;
    let touch = tree.touch(cloth, corner.position, corner.normal, reach)?;
    // Further below, the cloth is on the other side of a thin part.
    if touch.signed_distance < -settings.thickness {
        return None;
    }
    let velocity = touch.weighted_sum(cloth.velocity);
    let scale = obstacle.start.scale;
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&[0, 1, 2].map(|k| (touch.nodes[k], touch.weights[k]))),
        normal: touch.normal,
        gap: touch.signed_distance - cloth.thickness[touch.nodes[0]],
        surface_velocity,
        stiffness: settings.stiffness
            * obstacle.shape_at_start().vertex_areas()[corner.index]
            * scale
            * scale,
        friction: settings.friction_obstacle,
    };
    is_active(&contact, velocity, obstacle.duration).then_some(contact)
}

/// Whether the contact holds, or would be broken if both sides went on as they go.
pub(super) fn is_active(contact: &ContactPoint, velocity: DVec3, duration: f64) -> bool {
    let closing = contact.normal.dot(velocity - contact.surface_velocity) * duration;
    contact.gap < 0.0 || contact.gap + closing < 0.0
}

/// A vertex of an obstacle's surface, in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObstacleCorner {
    pub index: usize,
    pub position: DVec3,
    /// Unit, outward.
    pub normal: DVec3,
}

pub(super) fn obstacle_corner(obstacle: &ObstacleMotion, at: At, index: usize) -> ObstacleCorner {
    let (shape, pose) = match at {
        At::Start => (obstacle.shape_at_start(), obstacle.start),
        At::End => (obstacle.shape_at_end(), obstacle.end),
    };
    ObstacleCorner {
        index,
        position: pose.transform_point(shape.positions()[index]),
        normal: pose.rotation * shape.vertex_normals()[index],
    }
}

/// Whether a corner of one obstacle lies inside another: there cloth cannot touch it.
pub(super) fn is_inside_another(
    obstacles: &[ObstacleMotion],
    own: usize,
    corner: DVec3,
    at: At,
) -> bool {
    obstacles.iter().enumerate().any(|(index, other)| {
        index != own
            && match at {
                At::Start => other.contains_at_start(corner),
                At::End => other.contains_at_end(corner),
            }
    })
}

/// Per node the nearest obstacle plane within a range (m), where the obstacles are at the end of
/// their step.
pub fn nearest_planes(
    positions: &[DVec3],
    obstacles: &[ObstacleMotion],
    range: f64,
) -> Vec<Option<Plane>> {
    let nearest = |x: DVec3| {
        let mut best: Option<super::Nearest> = None;
        for obstacle in obstacles {
            let reach = best.map_or(range, |b| b.signed_distance.abs());
            best = obstacle.nearest_at_end(x, reach).or(best);
        }
        best.map(|b| Plane { point: b.point, normal: b.normal })
    };
    positions.par_iter().map(|&x| nearest(x)).collect()
}
