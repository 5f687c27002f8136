//! A feature of the cloth that runs into one of an obstacle during the step.
//!
//! All is seen from the obstacle: in its own space a rigid obstacle is at rest, and the cloth moves
//! on straight lines from where it is seen at the start to where it is seen at the end. For an
//! obstacle that is only shifted this is the true motion. Seen from an obstacle that turns by an
//! angle a, a point at distance r from the axis moves on a chord instead of an arc, which is at most
//! r (1 - cos(a/2)) away: 1.1 mm for 10 degrees in a step and 30 cm. The obstacle keeps its shape and
//! its size however fast it turns, and both ends of the step are exact.

use glam::DVec3;

use super::continuous::{Features, Sweep};
use super::motion::ObstacleMotion;
use super::shape::Shape;
use super::topology::Edge;

/// What may touch what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pair {
    /// A node of the cloth and a triangle of an obstacle.
    NodeTriangle { node: usize, triangle: u32 },
    /// A face of the cloth, by its nodes, and a corner of an obstacle.
    FaceCorner { nodes: [usize; 3], corner: usize },
    /// An edge of the cloth, by its nodes, and an edge of an obstacle.
    EdgeEdge { nodes: [usize; 2], edge: u32 },
}

/// A touch that would become a passage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Impact {
    pub pair: Pair,
    /// Number of the obstacle.
    pub obstacle: usize,
    /// Share of the step.
    pub time: f64,
    /// The touching point of the cloth: nodes and weights that add up to 1.
    pub weights: [(usize, f64); 3],
    /// Out of the obstacle, unit, in the world at the end of the step.
    pub normal: DVec3,
    /// The obstacle's touching point, in the world at the end of the step (m).
    pub surface_point: DVec3,
    /// Of the obstacle's touching point (m/s).
    pub surface_velocity: DVec3,
}

/// Sine of the angle below which edges count as parallel: their common normal is then taken from
/// where they were.
const PARALLEL_SINE: f64 = 1e-6;

/// The nodes of the cloth as one obstacle sees them: its own space, at the start and at the end.
pub(super) type Seen<'a> = &'a dyn Fn(usize) -> [DVec3; 2];

impl Pair {
    /// The impact of a pair, if they touch (to `tolerance`, m in the obstacle's own space) and the
    /// cloth, which was outside, would not end up outside.
    pub fn impact(
        self,
        (number, obstacle): (usize, &ObstacleMotion),
        seen: Seen<'_>,
        tolerance: f64,
    ) -> Option<Impact> {
        let (features, sweep) = self.sweep(obstacle, seen);
        let touch = sweep.first_touch(features, tolerance)?;
        let split = self.weights_of_cloth(touch.weights);
        let sum = |points: [DVec3; 4], w: [f64; 4]| (0..4).map(|k| points[k] * w[k]).sum::<DVec3>();
        let offset = |points: [DVec3; 4]| sum(points, split.both);
        let offsets = [sweep.start, sweep.end].map(offset);
        let shapes = [obstacle.shape_at_start(), obstacle.shape_at_end()];
        let shape = shapes[usize::from(touch.time > 0.5)];
        let normal = self.normal(shape, sweep.at(touch.time), offsets[0])?;
        let [mut before, mut after] = offsets.map(|offset| offset.dot(normal));
        if !obstacle.is_rigid() {
            // A triangle that turns by itself has other normals at the ends of the step: what is
            // outside there by one of them may have been, and what is inside by one of them is.
            let height = |k: usize, points: [DVec3; 4]| {
                self.normal(shapes[k], points, offsets[0]).map(|n| offsets[k].dot(n))
            };
            before = height(0, sweep.start).map_or(before, |h| h.max(before));
            after = height(1, sweep.end).map_or(after, |h| h.min(after));
        }
        if before < -tolerance || after > tolerance {
            return None;
        }
        let own = [sweep.start, sweep.end].map(|points| sum(points, split.obstacle));
        let surface_point = obstacle.end.transform_point(own[1]);
        let surface_velocity =
            (surface_point - obstacle.start.transform_point(own[0])) / obstacle.duration;
        Some(Impact {
            pair: self,
            obstacle: number,
            time: touch.time,
            weights: self.weights(split.both),
            normal: obstacle.end.rotation * normal,
            surface_point,
            surface_velocity,
        })
    }

    /// The corners of the obstacle's feature; of an edge, those of the triangles at it.
    pub fn corners(self, obstacle: &ObstacleMotion) -> Vec<usize> {
        let corners = |t: u32| obstacle.shape_at_start().topology().triangles()[t as usize];
        match self {
            Self::NodeTriangle { triangle, .. } => corners(triangle).map(|c| c as usize).to_vec(),
            Self::FaceCorner { corner, .. } => vec![corner],
            Self::EdgeEdge { edge, .. } => {
                let Edge { corners: [a, b], first, second } = edge_of(obstacle, edge);
                let opposite =
                    [Some(first), second].into_iter().flatten().map(|side| side.opposite);
                [a, b].into_iter().chain(opposite).map(|c| c as usize).collect()
            }
        }
    }

    fn sweep(self, obstacle: &ObstacleMotion, seen: Seen<'_>) -> (Features, Sweep) {
        let corner = |c: usize| {
            [obstacle.shape_at_start().positions()[c], obstacle.shape_at_end().positions()[c]]
        };
        let (features, points) = match self {
            Pair::NodeTriangle { node, triangle } => {
                let [a, b, c] = obstacle.shape_at_start().topology().triangles()[triangle as usize]
                    .map(|c| corner(c as usize));
                (Features::VertexFace, [seen(node), a, b, c])
            }
            Pair::FaceCorner { nodes, corner: c } => {
                let [i, j, k] = nodes.map(seen);
                (Features::VertexFace, [corner(c), i, j, k])
            }
            Pair::EdgeEdge { nodes, edge } => {
                let [i, j] = nodes.map(seen);
                let [a, b] = edge_of(obstacle, edge).corners.map(|c| corner(c as usize));
                (Features::EdgeEdge, [i, j, a, b])
            }
        };
        (features, Sweep { start: points.map(|p| p[0]), end: points.map(|p| p[1]) })
    }

    /// From the weights of a touch those whose offset leads from the obstacle to the cloth, and those
    /// of the obstacle's point alone.
    fn weights_of_cloth(self, w: [f64; 4]) -> Split {
        match self {
            Pair::NodeTriangle { .. } => Split { both: w, obstacle: [0.0, -w[1], -w[2], -w[3]] },
            Pair::FaceCorner { .. } => {
                Split { both: w.map(|w| -w), obstacle: [1.0, 0.0, 0.0, 0.0] }
            }
            Pair::EdgeEdge { .. } => Split { both: w, obstacle: [0.0, 0.0, -w[2], -w[3]] },
        }
    }

    fn weights(self, both: [f64; 4]) -> [(usize, f64); 3] {
        match self {
            Pair::NodeTriangle { node, .. } => [(node, 1.0), (node, 0.0), (node, 0.0)],
            Pair::FaceCorner { nodes: [i, j, k], .. } => [(i, both[1]), (j, both[2]), (k, both[3])],
            Pair::EdgeEdge { nodes: [i, j], .. } => [(i, both[0]), (j, both[1]), (j, 0.0)],
        }
    }

    /// Unit, out of the obstacle, in its own space; `at` is where the points are when they touch.
    /// `None` if nothing tells.
    fn normal(self, shape: &Shape, at: [DVec3; 4], offset_before: DVec3) -> Option<DVec3> {
        let across = (at[2] - at[1]).cross(at[3] - at[1]).try_normalize();
        let on_side_of = |n: DVec3, outward: DVec3| if n.dot(outward) < 0.0 { -n } else { n };
        match self {
            Pair::NodeTriangle { triangle, .. } => {
                across.or_else(|| shape.face_normals()[triangle as usize].try_normalize())
            }
            Pair::FaceCorner { corner, .. } => {
                let outward = shape.vertex_normals()[corner];
                across.map_or(outward.try_normalize(), |n| Some(on_side_of(n, outward)))
            }
            Pair::EdgeEdge { edge, .. } => {
                let outward = shape.edge_normals()[edge as usize];
                let (cloth, ridge) = (at[1] - at[0], at[3] - at[2]);
                let common = cloth.cross(ridge);
                if common.length() > PARALLEL_SINE * cloth.length() * ridge.length() {
                    return Some(on_side_of(common.normalize(), outward));
                }
                let along = ridge.normalize_or_zero();
                let beside = offset_before - along * offset_before.dot(along);
                let beside = beside.try_normalize().map(|n| on_side_of(n, outward));
                beside.or_else(|| outward.try_normalize())
            }
        }
    }
}

struct Split {
    both: [f64; 4],
    obstacle: [f64; 4],
}

fn edge_of(obstacle: &ObstacleMotion, edge: u32) -> Edge {
    obstacle.shape_at_start().topology().edges()[edge as usize]
}
