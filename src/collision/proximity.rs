//! Which points of cloth and obstacles are about to touch in a step.

use glam::DVec3;

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
/// Sorted by obstacle and node, so that the result does not depend on how it was found.
pub fn contacts(
    cloth: Cloth<'_>,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    settings: &Contact,
) -> Vec<ContactPoint> {
    let mut found = Vec::new();
    for obstacle in obstacles {
        node_contacts(cloth, obstacle, settings, &mut found);
        corner_contacts(cloth, tree, obstacle, settings, &mut found);
    }
    found
}

/// Depth below the surface, in contact thicknesses, at which cloth is still found and led out.
const DEPTH_IN_THICKNESSES: f64 = 4.0;

fn node_contacts(
    cloth: Cloth<'_>,
    obstacle: &ObstacleMotion,
    settings: &Contact,
    found: &mut Vec<ContactPoint>,
) {
    let reach_min = DEPTH_IN_THICKNESSES * settings.thickness;
    let swept = obstacle.swept_bounds();
    for (node, (&x, &v)) in cloth.position.iter().zip(cloth.velocity).enumerate() {
        let travel = v.length() * obstacle.duration;
        if x.distance(x.clamp(swept.mins, swept.maxs)) > reach_min.max(settings.thickness + travel)
        {
            continue;
        }
        let approach = (v - obstacle.velocity_at(x)).length() * obstacle.duration;
        let reach = reach_min.max(settings.thickness + approach);
        let Some(nearest) = obstacle.nearest_at_start(x, reach) else { continue };
        let contact = ContactPoint {
            nodes: ContactPoint::weighted(&[(node, 1.0)]),
            normal: nearest.normal,
            gap: nearest.signed_distance - settings.thickness,
            surface_velocity: obstacle.velocity_at(nearest.point),
            stiffness: settings.stiffness * cloth.area[node],
            friction: settings.friction_obstacle,
        };
        keep_if_active(contact, v, obstacle.duration, found);
    }
}

fn corner_contacts(
    cloth: Cloth<'_>,
    tree: &FaceTree,
    obstacle: &ObstacleMotion,
    settings: &Contact,
    found: &mut Vec<ContactPoint>,
) {
    let scale = obstacle.start.scale;
    let areas = obstacle.shape.vertex_areas();
    for corner in obstacle_corners(obstacle, At::Start) {
        let Some(touch) = tree.touch(cloth, corner.position, corner.normal, settings.thickness)
        else {
            continue;
        };
        let velocity = (0..3).map(|k| cloth.velocity[touch.nodes[k]] * touch.weights[k]).sum();
        let contact = ContactPoint {
            nodes: ContactPoint::weighted(&[0, 1, 2].map(|k| (touch.nodes[k], touch.weights[k]))),
            normal: touch.normal,
            gap: touch.signed_distance - settings.thickness,
            surface_velocity: obstacle.velocity_at(corner.position),
            stiffness: settings.stiffness * areas[corner.index] * scale * scale,
            friction: settings.friction_obstacle,
        };
        keep_if_active(contact, velocity, obstacle.duration, found);
    }
}

fn keep_if_active(
    contact: ContactPoint,
    velocity: DVec3,
    duration: f64,
    found: &mut Vec<ContactPoint>,
) {
    let closing = contact.normal.dot(velocity - contact.surface_velocity) * duration;
    if contact.gap < 0.0 || contact.gap + closing < 0.0 {
        found.push(contact);
    }
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

pub(super) fn obstacle_corners(
    obstacle: &ObstacleMotion,
    at: At,
) -> impl Iterator<Item = ObstacleCorner> + '_ {
    let pose = match at {
        At::Start => obstacle.start,
        At::End => obstacle.end,
    };
    let shape = &obstacle.shape;
    shape.positions().iter().zip(shape.vertex_normals()).enumerate().map(move |(index, (p, n))| {
        ObstacleCorner { index, position: pose.transform_point(*p), normal: pose.rotation * *n }
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
    positions.iter().map(|&x| nearest(x)).collect()
}
