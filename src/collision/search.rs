//! The broad phase of continuous collision: which pairs of features can touch during the step.
//!
//! Each obstacle looks at the cloth from its own space, where it rests: cloth that moves with it
//! hardly moves at all, and is dismissed by its distance.

use glam::DVec3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use rayon::prelude::*;

use super::face_tree::FaceTree;
use super::impact::{Impact, Pair};
use super::motion::ObstacleMotion;
use super::near::NearMemory;
use super::nearest::bounds;

/// Every point of a triangle is within this share of its longest edge from one of its corners.
const COVERING: f64 = 0.577_350_27;

/// The cloth over a step.
#[derive(Clone, Copy)]
pub(super) struct SweptCloth<'a> {
    /// (m, world).
    pub start: &'a [DVec3],
    /// (m, world).
    pub end: &'a [DVec3],
    pub tree: &'a FaceTree,
    /// Only faces with one of these nodes are looked at; `None` for all.
    pub among: Option<&'a [bool]>,
}

/// Impacts of the cloth on one obstacle; tolerance in m, world.
pub(super) fn impacts(
    cloth: SweptCloth<'_>,
    (number, obstacle): (usize, &ObstacleMotion),
    memory: &NearMemory,
    tolerance: f64,
) -> Vec<Impact> {
    if !may_meet(cloth, obstacle) {
        return Vec::new();
    }
    let tolerance = tolerance / obstacle.end.scale;
    let around = obstacle.swept_tree().root_aabb().loosened(tolerance);
    let view = |node: usize| NodeView::new(cloth, node, obstacle, &around);
    let views: Vec<NodeView> = (0..cloth.start.len()).into_par_iter().map(view).collect();
    let of_face = |face: usize| {
        let nodes = cloth.tree.topology().triangles()[face].map(|n| n as usize);
        let mut found = Vec::new();
        if cloth.among.is_none_or(|among| nodes.iter().any(|&n| among[n])) {
            let face = SweptFace { face: face as u32, nodes, views: &views, number, obstacle };
            if !face.is_beside() && !face.is_too_far(memory, tolerance) {
                face.push_impacts(cloth.tree, tolerance, &mut found);
            }
        }
        found
    };
    let faces = 0..cloth.tree.topology().triangles().len();
    faces.into_par_iter().with_min_len(64).flat_map_iter(of_face).collect()
}

/// Whether the boxes of cloth and obstacle over the step meet.
///
/// The obstacle sees the cloth on chords, see [`super::impact`]: with the turn T between the poses, as
/// a matrix, these are at most |T - 1| times the relative way off what the world sees.
fn may_meet(cloth: SweptCloth<'_>, obstacle: &ObstacleMotion) -> bool {
    let of_cloth = bounds(cloth.start).merged(&bounds(cloth.end));
    let ways = cloth.start.iter().zip(cloth.end).map(|(a, b)| a.distance_squared(*b));
    let way = ways.fold(0.0, f64::max).sqrt() + obstacle.pose_way_max(of_cloth);
    let reach = obstacle.turn() * way;
    // Ways too long for their squares; the step will be found out.
    if !reach.is_finite() {
        return true;
    }
    obstacle.swept_bounds().loosened(reach).intersects(&of_cloth)
}

/// A node as an obstacle sees it.
struct NodeView {
    /// At the start and at the end (m, own space).
    path: [DVec3; 2],
    /// A bit for each side of the obstacle's box beyond which the node stays.
    beyond: u8,
}

impl NodeView {
    fn new(cloth: SweptCloth<'_>, node: usize, obstacle: &ObstacleMotion, around: &Aabb) -> Self {
        let path = [
            obstacle.point_in_own_at_start(cloth.start[node]),
            obstacle.point_in_own_at_end(cloth.end[node]),
        ];
        let below = path[0].cmplt(around.mins) & path[1].cmplt(around.mins);
        let above = path[0].cmpgt(around.maxs) & path[1].cmpgt(around.maxs);
        Self { path, beyond: (below.bitmask() | above.bitmask() << 3) as u8 }
    }
}

/// A face of the cloth as an obstacle sees it.
struct SweptFace<'a> {
    face: u32,
    nodes: [usize; 3],
    views: &'a [NodeView],
    number: usize,
    obstacle: &'a ObstacleMotion,
}

impl SweptFace<'_> {
    fn is_beside(&self) -> bool {
        self.nodes.iter().fold(0xff, |all, &n| all & self.views[n].beyond) != 0
    }

    /// Whether the face is farther away than its nodes move.
    fn is_too_far(&self, memory: &NearMemory, tolerance: f64) -> bool {
        let at = self.nodes.map(|n| self.views[n].path[0]);
        let clearances = [0, 1, 2].map(|k| memory.clearance(self.nodes[k], self.number, at[k]));
        let least = clearances.into_iter().fold(f64::INFINITY, f64::min);
        let longest = at[0].distance(at[1]).max(at[1].distance(at[2])).max(at[2].distance(at[0]));
        let ways = self.nodes.map(|n| self.views[n].path[0].distance(self.views[n].path[1]));
        let way = ways.into_iter().fold(0.0, f64::max);
        least - COVERING * longest > way + tolerance
    }

    fn push_impacts(&self, tree: &FaceTree, tolerance: f64, found: &mut Vec<Impact>) {
        let [i, j, k] = self.nodes.map(|n| self.views[n].path);
        let points = [i[0], i[1], j[0], j[1], k[0], k[1]];
        let around = bounds(&points).loosened(tolerance);
        let seen = |node: usize| self.views[node].path;
        for triangle in self.obstacle.swept_tree().intersect_aabb(&around) {
            if self.is_on_one_side(triangle, &points, tolerance) {
                continue;
            }
            let obstacle = (self.number, self.obstacle);
            self.pairs(tree, triangle, |pair| {
                found.extend(pair.impact(obstacle, &seen, tolerance))
            });
        }
    }

    /// Whether the face stays on one side of the plane of a triangle that rests.
    fn is_on_one_side(&self, triangle: u32, points: &[DVec3; 6], tolerance: f64) -> bool {
        if !self.obstacle.is_rigid() {
            return false;
        }
        let shape = self.obstacle.shape_at_start();
        let normal = shape.face_normals()[triangle as usize];
        let level = normal.dot(shape.corners(triangle)[0]);
        points.iter().all(|p| normal.dot(*p) - level > tolerance)
            || points.iter().all(|p| normal.dot(*p) - level < -tolerance)
    }

    /// The pairs that this face and a triangle answer for.
    fn pairs(&self, tree: &FaceTree, triangle: u32, mut push: impl FnMut(Pair)) {
        let (shape, cloth) = (self.obstacle.shape_at_start(), tree.topology());
        for node in cloth.owned_corners(self.face) {
            push(Pair::NodeTriangle { node: node as usize, triangle });
        }
        for corner in shape.topology().owned_corners(triangle) {
            push(Pair::FaceCorner { nodes: self.nodes, corner: corner as usize });
        }
        for edge in shape.topology().owned_edges(triangle) {
            // Nothing straight can be stopped by an edge that is nowhere convex.
            let ridge = &shape.topology().edges()[edge as usize];
            if !(shape.is_convex(ridge) || self.obstacle.shape_at_end().is_convex(ridge)) {
                continue;
            }
            for own in cloth.owned_edges(self.face) {
                let nodes = cloth.edges()[own as usize].corners.map(|n| n as usize);
                push(Pair::EdgeEdge { nodes, edge });
            }
        }
    }
}
