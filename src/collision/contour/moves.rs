//! How far each node goes in a round of untangling.

use glam::DVec3;

use super::contours::Contour;
use super::point::CrossingPoint;
use super::regions::Regions;
use crate::collision::topology::Topology;

/// How crossings are taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The length of each contour is minimised ([`VMT06`](crate::papers::VMT06)): each crossing goes
    /// its own way and that of its whole contour.
    Contours,
    /// The same, but each crossing goes its own way only.
    Crossings,
    /// Each crossing is pushed along the normal of its face to the side that is nearer. Here to be
    /// compared with.
    PushApart,
}

/// Of an end's depth: pushed by no more, it would end in the face.
const PUSH_BEYOND: f64 = 1.1;

/// A way out of this length is gone by half of what is allowed in a round: shorter ones are those of
/// contours that are about as short as they get.
const HALFWAY: f64 = 0.5;

/// How much the way back of the smaller part of a layer counts against the way out of the contour,
/// which is 0 where moving the layers does not change its length: of tangles of random waves this
/// leaves the fewest.
const WAY_BACK_SHARE: f64 = 4.0;

/// Edges by which the motion of the crossings' nodes spreads to their surroundings, so that a layer
/// moves as a layer and not as a row of spikes.
const SPREADS: usize = 12;

/// The way of every node (m): of each crossing edge against its face by `step` (m) at most, each node
/// by its weight and in proportion to the inverse of its mass. Where a node takes part in several
/// crossings, their mean.
pub fn moves(
    topology: &Topology,
    positions: &[DVec3],
    mass: &[f64],
    points: &[CrossingPoint],
    contours: &[Contour],
    method: Method,
    step: f64,
) -> Vec<DVec3> {
    let ways = match method {
        Method::Contours => ways_of_contours(topology, positions, mass, points, contours),
        Method::Crossings => points.iter().map(|p| p.way_out(topology, positions)).collect(),
        Method::PushApart => Vec::new(),
    };
    let mut sums = vec![(DVec3::ZERO, 0.0); positions.len()];
    for (index, point) in points.iter().enumerate() {
        let apart = match method {
            Method::PushApart => {
                let (way, depth) = point.way_to_nearer_side(positions);
                way * (PUSH_BEYOND * depth).min(step)
            }
            Method::Contours | Method::Crossings => saturated(ways[index]) * step,
        };
        for (k, share) in point.shares(mass).into_iter().enumerate() {
            let weight = point.weights[k].abs();
            let sum = &mut sums[point.nodes[k]];
            *sum = (sum.0 + apart * (share * weight), sum.1 + weight);
        }
    }
    let moved = sums.iter().map(|(sum, w)| (*w > 0.0).then(|| *sum / *w)).collect();
    match method {
        Method::PushApart => unspread(moved),
        Method::Contours | Method::Crossings => spread(topology, moved),
    }
}

fn unspread(moved: Vec<Option<DVec3>>) -> Vec<DVec3> {
    moved.into_iter().map(Option::unwrap_or_default).collect()
}

fn ways_of_contours(
    topology: &Topology,
    positions: &[DVec3],
    mass: &[f64],
    points: &[CrossingPoint],
    contours: &[Contour],
) -> Vec<DVec3> {
    let regions = Regions::new(topology, mass, points);
    let mut ways = vec![DVec3::ZERO; points.len()];
    for contour in contours {
        let own = |&(p, _): &(usize, _)| {
            points[p].way_out(topology, positions)
                + WAY_BACK_SHARE * regions.way_back(&points[p]).unwrap_or_default()
        };
        let of_all: Vec<DVec3> = contour.points.iter().map(own).collect();
        let sum: DVec3 =
            contour.points.iter().zip(&of_all).map(|((_, layer), own)| *own * layer.sign()).sum();
        for ((p, layer), own) in contour.points.iter().zip(of_all) {
            ways[*p] = own + sum * layer.sign();
        }
    }
    ways
}

/// A vector of length below 1 in the same direction ([`VMT06`](crate::papers::VMT06)).
fn saturated(way: DVec3) -> DVec3 {
    way / (way.length_squared() + HALFWAY * HALFWAY).sqrt()
}

/// Nodes that no crossing moves go with their neighbours.
fn spread(topology: &Topology, moved: Vec<Option<DVec3>>) -> Vec<DVec3> {
    let is_given: Vec<bool> = moved.iter().map(Option::is_some).collect();
    let mut ways = unspread(moved);
    for _ in 0..SPREADS {
        let mut sums = vec![(DVec3::ZERO, 0.0); ways.len()];
        for edge in topology.edges() {
            let [a, b] = edge.corners.map(|n| n as usize);
            for (node, other) in [(a, b), (b, a)] {
                sums[node].0 += ways[other];
                sums[node].1 += 1.0;
            }
        }
        for (node, (sum, count)) in sums.into_iter().enumerate() {
            if !is_given[node] && count > 0.0 {
                ways[node] = sum / count;
            }
        }
    }
    ways
}
