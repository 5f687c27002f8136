//! Cloth that runs into cloth during a step.

use glam::DVec3;
use rayon::prelude::*;

use super::layers::weighted;
use super::pairs::{ClothPair, are_apart};
use crate::collision::continuous::{Features, Sweep};
use crate::collision::topology::Topology;

/// A touch that would become a passage.
#[derive(Clone, Copy, Debug)]
pub(in crate::collision) struct ClothImpact {
    pub pair: ClothPair,
    pub nodes: [usize; 4],
    /// Of the offset from the second feature's touching point to the first's: they add up to 0.
    pub weights: [f64; 4],
    /// Share of the step.
    pub time: f64,
    /// Unit, from the second feature to the first where they touch.
    pub normal: DVec3,
    /// Of the first feature's point above the second's at the start of the step (m).
    pub height_before: f64,
}

/// Sine of the angle below which edges count as parallel.
const PARALLEL_SINE: f64 = 1e-6;

/// Impacts among the pairs, in order of time, then of the pairs; features with some nodes touch
/// at a distance (m) that is asked for.
pub(super) fn impacts(
    topology: &Topology,
    pairs: &[ClothPair],
    [start, end]: [&[DVec3]; 2],
    among: Option<&[bool]>,
    touch: impl Fn([usize; 4]) -> f64 + Sync,
) -> Vec<ClothImpact> {
    let of = |&pair: &ClothPair| {
        let nodes = pair.nodes(topology);
        let is_asked_for = among.is_none_or(|among| nodes.iter().any(|&n| among[n]));
        is_asked_for.then(|| ClothImpact::of(pair, nodes, [start, end], touch(nodes))).flatten()
    };
    let mut found: Vec<ClothImpact> = pairs.par_iter().with_min_len(1024).filter_map(of).collect();
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    found
}

impl ClothImpact {
    /// The impact of a pair that touches to `tolerance` (m) and would not end on the side where it
    /// began.
    pub fn of(
        pair: ClothPair,
        nodes: [usize; 4],
        [start, end]: [&[DVec3]; 2],
        tolerance: f64,
    ) -> Option<Self> {
        let sweep = Sweep { start: nodes.map(|n| start[n]), end: nodes.map(|n| end[n]) };
        let low = [0, 1, 2, 3].map(|k| sweep.start[k].min(sweep.end[k]));
        let high = [0, 1, 2, 3].map(|k| sweep.start[k].max(sweep.end[k]));
        if are_apart(pair.features, low, high, tolerance) {
            return None;
        }
        let touch = sweep.first_touch(pair.features, tolerance)?;
        let offset = weighted(start, nodes, touch.weights);
        let normal = normal(pair.features, sweep.at(touch.time), offset)?;
        let height_before = normal.dot(offset);
        if normal.dot(weighted(end, nodes, touch.weights)) > tolerance {
            return None;
        }
        let (weights, time) = (touch.weights, touch.time);
        Some(Self { pair, nodes, weights, time, normal, height_before })
    }
}

/// Unit, across both features where they touch, on the side of the offset at the start. Where they
/// span no plane, along the offset; `None` if there is none.
fn normal(features: Features, at: [DVec3; 4], offset: DVec3) -> Option<DVec3> {
    let (one, other) = match features {
        Features::VertexFace => (at[2] - at[1], at[3] - at[1]),
        Features::EdgeEdge => (at[1] - at[0], at[3] - at[2]),
    };
    let across = one.cross(other);
    if across.length() > PARALLEL_SINE * one.length() * other.length() {
        let normal = across.normalize();
        return Some(if normal.dot(offset) < 0.0 { -normal } else { normal });
    }
    offset.try_normalize()
}
