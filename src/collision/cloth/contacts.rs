//! Cloth near cloth at the start of a step, as contacts for the implicit solution.

use glam::DVec3;
use rayon::prelude::*;

use super::layers::{Layers, weighted};
use super::pairs::{ClothPair, are_apart};
use crate::collision::continuous::{Features, corner_pairs, nearest};
use crate::collision::proximity::{Cloth, is_active};
use crate::collision::topology::Topology;
use crate::dynamics::ContactPoint;
use crate::scene::Contact;

/// Nearer points have no direction between them (m): a crossing, which the untangler looks after.
const DISTANCE_MIN: f64 = 1e-9;

/// An edge meets several others where a node meets one face; together they push about as hard.
const EDGE_SHARE: f64 = 1.0 / 3.0;

/// Cosine up to which a face may lean over from an edge to what the edge touches: rounding, and folds
/// that are hardly any.
const LEANING_MAX: f64 = 0.1;

/// Pairs that are nearer than they should be, or would be within the step if everything went on as
/// it goes; in the order of the pairs.
pub fn cloth_contacts(
    cloth: Cloth<'_>,
    topology: &Topology,
    layers: &Layers,
    pairs: &[ClothPair],
    settings: &Contact,
    duration: f64,
) -> Vec<ContactPoint> {
    let of = |&pair: &ClothPair| contact(cloth, topology, layers, pair, settings, duration);
    pairs.par_iter().with_min_len(1024).filter_map(of).collect()
}

fn contact(
    cloth: Cloth<'_>,
    topology: &Topology,
    layers: &Layers,
    pair: ClothPair,
    settings: &Contact,
    duration: f64,
) -> Option<ContactPoint> {
    let nodes = pair.nodes(topology);
    let place = |k: usize| cloth.position[nodes[k]];
    // No two points of the features close faster than the fastest two corners.
    let speed_squared = |&(i, j): &(usize, usize)| {
        (cloth.velocity[nodes[i]] - cloth.velocity[nodes[j]]).length_squared()
    };
    let fastest = corner_pairs(pair.features).iter().map(speed_squared).fold(0.0, f64::max);
    let reach = settings.thickness + duration * fastest.sqrt();
    let places = [0, 1, 2, 3].map(place);
    if are_apart(pair.features, places, places, reach) {
        return None;
    }
    let near = nearest(pair.features, places);
    let velocity = weighted(cloth.velocity, nodes, near.weights);
    let approach = velocity.length() * duration;
    if near.distance > settings.thickness + approach || near.distance < DISTANCE_MIN {
        return None;
    }
    let offset = weighted(cloth.position, nodes, near.weights);
    if !is_own(cloth, topology, layers, pair, near.weights, offset) {
        return None;
    }
    let thickness = layers.thickness(pair, nodes, near.weights, thickness_between(cloth, nodes));
    let contact = ContactPoint {
        nodes: [0, 1, 2, 3].map(|k| (nodes[k], near.weights[k])),
        normal: offset / near.distance,
        gap: near.distance - thickness,
        surface_velocity: DVec3::ZERO,
        stiffness: settings.stiffness * area(cloth, pair, nodes, near.weights),
        friction: settings.friction_cloth,
    };
    is_active(&contact, velocity, duration).then_some(contact)
}

/// How far two pieces of cloth are held apart (m): half of each one's thickness. The first of the
/// nodes belongs to one, the last to the other; all of a fabric have the same.
fn thickness_between(cloth: Cloth<'_>, nodes: [usize; 4]) -> f64 {
    0.5 * (cloth.thickness[nodes[0]] + cloth.thickness[nodes[3]])
}

/// Whether the nearest points are this pair's own, and nothing beside them is nearer. Where an edge's
/// is an end, or a node's lies on an edge of the face, other pairs have the same: one answers. Of
/// sheets that lie on one another, parallel edges are near, but their faces are nearer.
fn is_own(
    cloth: Cloth<'_>,
    topology: &Topology,
    layers: &Layers,
    pair: ClothPair,
    weights: [f64; 4],
    offset: DVec3,
) -> bool {
    let [a, b, c, d] = pair.corners;
    match pair.features {
        Features::EdgeEdge => {
            weights.iter().all(|w| *w != 0.0)
                && !leans(cloth, topology, edge_between(topology, a, b), offset)
                && !leans(cloth, topology, edge_between(topology, c, d), -offset)
        }
        Features::VertexFace => {
            let face = b / 3;
            let zero = [1, 2, 3].map(|k| weights[k] == 0.0);
            match (zero.iter().filter(|z| **z).count(), zero.iter().position(|z| *z)) {
                (0, _) => true,
                (1, Some(k)) => {
                    let edge = topology.edges_of(face)[k];
                    topology.owned(face).edge[k] && !leans(cloth, topology, edge, -offset)
                }
                // Node over node: the smaller answers.
                (2, _) => {
                    let [node, a, b, c] = pair.nodes(topology);
                    let k = (0..3).find(|&k| !zero[k]).unwrap_or(0);
                    let corner = [a, b, c][k];
                    topology.owned(face).corner[k]
                        && node < corner
                        && !has_nearer_neighbour(cloth, layers, corner, offset)
                        && !has_nearer_neighbour(cloth, layers, node, -offset)
                }
                _ => false,
            }
        }
    }
}

/// Whether an edge at a node leads towards what is `offset` away from it.
fn has_nearer_neighbour(cloth: Cloth<'_>, layers: &Layers, node: usize, offset: DVec3) -> bool {
    layers.neighbours(node).iter().any(|&n| {
        let edge = cloth.position[n as usize] - cloth.position[node];
        edge.dot(offset) > LEANING_MAX * edge.length() * offset.length()
    })
}

/// The edge of a face from one of its corners to another.
fn edge_between(topology: &Topology, from: u32, to: u32) -> u32 {
    topology.edges_of(from / 3)[3 - (from % 3 + to % 3) as usize]
}

/// Whether a face at an edge leans over to what the edge touches, which is at minus
/// `offset` from it.
fn leans(cloth: Cloth<'_>, topology: &Topology, edge: u32, offset: DVec3) -> bool {
    let edge = &topology.edges()[edge as usize];
    let [start, end] = edge.corners.map(|n| cloth.position[n as usize]);
    let along = (end - start).normalize_or_zero();
    [Some(edge.first), edge.second].into_iter().flatten().any(|side| {
        let into = cloth.position[side.opposite as usize] - start;
        let across = into - along * into.dot(along);
        across.dot(offset) < -LEANING_MAX * across.length() * offset.length()
    })
}

/// The area that a contact stands for (m^2): the smaller of the two sides'.
fn area(cloth: Cloth<'_>, pair: ClothPair, nodes: [usize; 4], weights: [f64; 4]) -> f64 {
    let side = |range: std::ops::Range<usize>| {
        range.map(|k| weights[k].abs() * cloth.area[nodes[k]]).sum::<f64>()
    };
    match pair.features {
        Features::VertexFace => side(0..1).min(side(1..4)),
        Features::EdgeEdge => EDGE_SHARE * side(0..2).min(side(2..4)),
    }
}
