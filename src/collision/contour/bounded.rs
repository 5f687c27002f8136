//! No round of untangling may crumple or tear the cloth.

use glam::DVec3;

use crate::collision::topology::Topology;

/// Cosine of the angle by which a face turns in a round at most: one that turns farther may come to
/// lie upside down beside its neighbours.
const TURN_COSINE_MIN: f64 = 0.7;

/// Edges grow to this multiple of their length in the flat cloth at most; longer ones do not grow. With
/// 1.2, steep tangles stay, for what bulges cannot come back.
const STRETCH_MAX: f64 = 1.4;

/// Edges shrink to this share of their length in the flat cloth at least; shorter ones do not shrink.
const SHRINK_MIN: f64 = 0.3;

/// Halvings of the way of nodes of a face that would suffer; then they stay.
const HALVINGS: u32 = 4;

/// Rounds of nodes that stay: where these make others stay, and so on, nothing moves in the end.
const STAYS: u32 = 24;

/// Shortens the ways (m) until no face suffers.
pub fn keep_fabric_sound(
    topology: &Topology,
    positions: &[DVec3],
    flat_lengths: &[f64],
    ways: &mut [DVec3],
) {
    for halving in 0..HALVINGS + STAYS {
        let mut suffers = vec![false; ways.len()];
        let mut any = false;
        for (face, nodes) in topology.triangles().iter().enumerate() {
            let nodes = nodes.map(|n| n as usize);
            if nodes.iter().all(|&n| ways[n] == DVec3::ZERO) {
                continue;
            }
            let before = nodes.map(|n| positions[n]);
            let after = nodes.map(|n| positions[n] + ways[n]);
            let flat = topology.edges_of(face as u32).map(|e| flat_lengths[e as usize]);
            if !is_sound(before, after, flat) {
                nodes.iter().for_each(|&n| suffers[n] = true);
                any = true;
            }
        }
        if !any {
            return;
        }
        let share = if halving < HALVINGS { 0.5 } else { 0.0 };
        ways.iter_mut().zip(&suffers).filter(|(_, s)| **s).for_each(|(way, _)| *way *= share);
    }
    ways.fill(DVec3::ZERO);
}

/// `flat` are the lengths of the edges opposite to the corners.
fn is_sound(before: [DVec3; 3], after: [DVec3; 3], flat: [f64; 3]) -> bool {
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    let [old, new] = [before, after].map(normal);
    let turns = old.dot(new) < TURN_COSINE_MIN * old.length() * new.length();
    let spoilt = |k: usize| {
        let length = |p: [DVec3; 3]| p[(k + 1) % 3].distance(p[(k + 2) % 3]);
        let [old, new] = [before, after].map(length);
        (new > old && new > STRETCH_MAX * flat[k]) || (new < old && new < SHRINK_MIN * flat[k])
    };
    !turns && !(0..3).any(spoilt)
}
