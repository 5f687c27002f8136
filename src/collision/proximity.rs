//! Which points of cloth and obstacles are about to touch in a step.

use glam::DVec3;
use rayon::prelude::*;

use super::face_tree::FaceTree;
use super::obstacles::ObstacleMotion;
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
    /// Nodes of each face.
    pub faces: &'a [[u32; 3]],
}

/// Contacts which hold already, or would be broken within the step if everything went on as it
/// goes: nodes against obstacles, and corners of obstacles against faces.
///
/// In order of nodes, then of corners, however many threads look for them.
pub fn contacts(
    cloth: Cloth<'_>,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    settings: &Contact,
) -> Vec<ContactPoint> {
    // Collected in the order of nodes and corners, whoever finds them first.
    let of_node =
        |node: usize| obstacles.iter().filter_map(move |o| node_contact(cloth, node, o, settings));
    let mut found: Vec<ContactPoint> =
        (0..cloth.position.len()).into_par_iter().flat_map_iter(of_node).collect();
    for obstacle in obstacles {
        let of_corner = |corner| corner_contact(cloth, tree, obstacle, corner, settings);
        found.par_extend(
            (0..obstacle.shape.positions().len())
                .into_par_iter()
                .filter_map(|index| of_corner(obstacle_corner(obstacle, At::Start, index))),
        );
    }
    found
}

/// Depth below the surface, in contact thicknesses, at which cloth is still found and led out.
const DEPTH_IN_THICKNESSES: f64 = 4.0;

fn node_contact(
    cloth: Cloth<'_>,
    node: usize,
    obstacle: &ObstacleMotion,
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
    let nearest = obstacle.nearest_at_start(x, reach_min.max(settings.thickness + approach))?;
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&[(node, 1.0)]),
        normal: nearest.normal,
        gap: nearest.signed_distance - settings.thickness,
        surface_velocity: obstacle.velocity_at(nearest.point),
        stiffness: settings.stiffness * cloth.area[node],
        friction: settings.friction_obstacle,
    };
    is_active(&contact, v, obstacle.duration).then_some(contact)
}

fn corner_contact(
    cloth: Cloth<'_>,
    tree: &FaceTree,
    obstacle: &ObstacleMotion,
    corner: ObstacleCorner,
    settings: &Contact,
) -> Option<ContactPoint> {
    let around = tree.bounds();
    let aside = corner.position.clamp(around.mins, around.maxs);
    if corner.position.distance_squared(aside) > settings.thickness * settings.thickness {
        return None;
    }
    let touch = tree.touch(cloth, corner.position, corner.normal, settings.thickness)?;
    let velocity = (0..3).map(|k| cloth.velocity[touch.nodes[k]] * touch.weights[k]).sum();
    let scale = obstacle.start.scale;
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&[0, 1, 2].map(|k| (touch.nodes[k], touch.weights[k]))),
        normal: touch.normal,
        gap: touch.signed_distance - settings.thickness,
        surface_velocity: obstacle.velocity_at(corner.position),
        stiffness: settings.stiffness * obstacle.shape.vertex_areas()[corner.index] * scale * scale,
        friction: settings.friction_obstacle,
    };
    is_active(&contact, velocity, obstacle.duration).then_some(contact)
}

/// Whether the contact holds, or would be broken if both sides went on as they go.
fn is_active(contact: &ContactPoint, velocity: DVec3, duration: f64) -> bool {
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

/// Which end of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    Start,
    End,
}

pub(super) fn obstacle_corner(obstacle: &ObstacleMotion, at: At, index: usize) -> ObstacleCorner {
    let pose = match at {
        At::Start => obstacle.start,
        At::End => obstacle.end,
    };
    ObstacleCorner {
        index,
        position: pose.transform_point(obstacle.shape.positions()[index]),
        normal: pose.rotation * obstacle.shape.vertex_normals()[index],
    }
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
