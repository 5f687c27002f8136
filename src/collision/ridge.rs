//! Sharp edges of obstacles against edges of the cloth: without these contacts cloth that hangs over
//! a ridge would be held at its nodes only, and cut between them.

use glam::DVec3;
use parry3d_f64::bounding_volume::BoundingVolume;
use rayon::prelude::*;

use super::face_tree::FaceTree;
use super::motion::{At, ObstacleMotion};
use super::nearest::bounds;
use super::proximity::{Cloth, is_active, is_inside_another};
use super::topology::Edge;
use crate::dynamics::ContactPoint;
use crate::math::closest_points_of_segments;
use crate::scene::Contact;

/// Flatter edges are left to nodes and corners: cosine of 30 degrees between the triangles' normals.
const SHARP_COSINE_MAX: f64 = 0.866;

/// How far the line between the nearest points may lean over one of the triangles at the ridge, as
/// a sine: beyond, the triangle is nearer than the ridge.
const LEANING_MAX: f64 = 1e-3;

/// A sharp edge and the unit normals beside it; one of them twice at the rim of an open surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    pub corners: [u32; 2],
    pub normals: [DVec3; 2],
}

impl Ridge {
    /// The ridge that an edge is, if it is convex and sharp.
    pub fn new(edge: &Edge, is_convex: bool, face_normals: &[DVec3]) -> Option<Self> {
        let first = face_normals[edge.first.triangle as usize];
        let second = edge.second.map_or(first, |s| face_normals[s.triangle as usize]);
        let is_sharp = edge.second.is_none() || first.dot(second) < SHARP_COSINE_MAX;
        (is_convex && is_sharp).then_some(Self { corners: edge.corners, normals: [first, second] })
    }
}

/// A ridge in the world at the start of the step.
struct PlacedRidge {
    ends: [DVec3; 2],
    normals: [DVec3; 2],
    /// Along the triangles, away from the ridge; unit.
    along_faces: [DVec3; 2],
    /// Of the obstacle's material at both ends (m/s).
    velocities: [DVec3; 2],
}

/// Contacts of one obstacle's ridges with edges of the cloth, in order of ridges.
pub(super) fn ridge_contacts(
    cloth: Cloth<'_>,
    cloth_speed_max: f64,
    tree: &FaceTree,
    obstacles: &[ObstacleMotion],
    own: usize,
    settings: &Contact,
    found: &mut Vec<ContactPoint>,
) {
    let obstacle = &obstacles[own];
    let of_ridge = |ridge: &Ridge| {
        let placed = placed(ridge, obstacle);
        let speed = placed.velocities.map(DVec3::length).into_iter().fold(0.0, f64::max);
        let reach = settings.thickness + (speed + cloth_speed_max) * obstacle.duration;
        let around = bounds(&placed.ends).loosened(reach);
        let mut contacts = Vec::new();
        if !tree.bounds().intersects(&around) {
            return contacts;
        }
        for face in tree.faces_in(&around) {
            for edge in tree.topology().owned_edges(face) {
                let nodes =
                    tree.topology().edges()[edge as usize].corners.map(|node| node as usize);
                contacts.extend(
                    ridge_contact(cloth, nodes, &placed, obstacle.duration, settings)
                        .filter(|(point, _)| !is_inside_another(obstacles, own, *point, At::Start))
                        .map(|(_, contact)| contact),
                );
            }
        }
        contacts
    };
    found.par_extend(obstacle.shape_at_start().ridges().par_iter().flat_map_iter(of_ridge));
}

fn placed(ridge: &Ridge, obstacle: &ObstacleMotion) -> PlacedRidge {
    let positions = obstacle.shape_at_start().positions();
    let ends = ridge.corners.map(|c| obstacle.start.transform_point(positions[c as usize]));
    let normals = ridge.normals.map(|n| obstacle.start.rotation * n);
    let along = (ends[1] - ends[0]).normalize_or_zero();
    // The first triangle runs along the edge from its first corner to its second, the other back.
    let along_faces = [normals[0].cross(along), along.cross(normals[1])];
    let velocities = ridge.corners.map(|c| obstacle.corner_velocity(c as usize));
    PlacedRidge { ends, normals, along_faces, velocities }
}

/// The contact of an edge of the cloth with a ridge, and the ridge's point. Where the nearest point
/// of either is an end, nodes and corners tell of it.
fn ridge_contact(
    cloth: Cloth<'_>,
    nodes: [usize; 2],
    ridge: &PlacedRidge,
    duration: f64,
    settings: &Contact,
) -> Option<(DVec3, ContactPoint)> {
    let pair = closest_points_of_segments(nodes.map(|n| cloth.position[n]), ridge.ends);
    let is_inner = |t: f64| t > 0.0 && t < 1.0;
    if !(is_inner(pair.first) && is_inner(pair.second)) {
        return None;
    }
    let distance = pair.offset.length();
    let away = pair.offset.try_normalize()?;
    let is_over = |direction: DVec3| {
        ridge.along_faces.iter().all(|along| direction.dot(*along) <= LEANING_MAX)
            && direction.dot(ridge.normals[0] + ridge.normals[1]) > 0.0
    };
    // Further below, the cloth is on the other side of a thin part.
    let (normal, signed_distance) = match (is_over(away), is_over(-away)) {
        (true, _) => (away, distance),
        (false, true) if distance < settings.thickness => (-away, -distance),
        _ => return None,
    };
    let weights = [(nodes[0], 1.0 - pair.first), (nodes[1], pair.first)];
    let weighted = |values: [f64; 2]| values[0] * weights[0].1 + values[1] * weights[1].1;
    let contact = ContactPoint {
        nodes: ContactPoint::weighted(&weights),
        normal,
        gap: signed_distance - cloth.thickness[nodes[0]],
        surface_velocity: ridge.velocities[0].lerp(ridge.velocities[1], pair.second),
        stiffness: settings.stiffness * weighted(nodes.map(|n| cloth.area[n])),
        friction: settings.friction_obstacle,
    };
    let velocity = contact.weighted_sum(cloth.velocity);
    let point = ridge.ends[0].lerp(ridge.ends[1], pair.second);
    is_active(&contact, velocity, duration).then_some((point, contact))
}
