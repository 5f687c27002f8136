//! A tree over the cloth's faces in the world: built when the topology changes, refitted as the
//! cloth moves.

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::nearest::{bounds, nearest_triangle};
use super::proximity::Cloth;
use super::topology::Topology;

/// See the module.
pub struct FaceTree {
    topology: Topology,
    tree: Bvh,
}

/// A point of an obstacle and the point of the cloth nearest to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    pub nodes: [usize; 3],
    /// Barycentric.
    pub weights: [f64; 3],
    /// From the obstacle to the cloth, unit.
    pub normal: DVec3,
    /// (m); negative if the cloth has sunk in.
    pub signed_distance: f64,
}

impl FaceTree {
    pub fn new(positions: &[DVec3], faces: &[[u32; 3]]) -> Self {
        let mut tree = Self { topology: Topology::new(faces.to_vec()), tree: Bvh::default() };
        tree.rebuild(positions);
        tree
    }

    /// Becomes what a new one of the same faces would be.
    pub fn rebuild(&mut self, positions: &[DVec3]) {
        let faces = self.topology.triangles().iter();
        let boxes: Vec<Aabb> = faces.map(|f| bounds(&corners(positions, f))).collect();
        self.tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    }

    /// Follows the nodes to where they are now.
    pub fn refit(&mut self, positions: &[DVec3]) {
        for (index, face) in self.topology.triangles().iter().enumerate() {
            self.tree.insert_or_update_partially(
                bounds(&corners(positions, face)),
                index as u32,
                0.0,
            );
        }
        self.tree.refit_without_opt();
    }

    /// Of the faces, with nodes as corners.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Whether the box of a face is within a reach (m) of a point.
    pub fn is_within(&self, point: DVec3, reach: f64) -> bool {
        let is_near = |node: &BvhNode| {
            point.distance_squared(point.clamp(node.mins(), node.maxs())) <= reach * reach
        };
        self.tree.leaves(is_near).next().is_some()
    }

    /// The faces whose boxes meet a box.
    pub fn faces_in<'a>(&'a self, around: &'a Aabb) -> impl Iterator<Item = u32> + 'a {
        self.tree.intersect_aabb(around)
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.root_aabb()
    }

    /// The face nearest to a point of an obstacle with the given outward normal, within a reach
    /// (m). Cloth on the inner side counts as sunk in only straight below the point: further aside
    /// it belongs to another part of the surface.
    pub fn touch(
        &self,
        cloth: Cloth<'_>,
        point: DVec3,
        outward: DVec3,
        reach: f64,
    ) -> Option<Touch> {
        let best = nearest_triangle(&self.tree, point, reach, |face| {
            corners(cloth.position, &cloth.faces[face as usize])
        })?;
        let away = best.closest.point - point;
        let height = away.dot(outward);
        let is_outside = height > 0.0;
        if !is_outside && -height < SUNK_COSINE_MIN * best.distance {
            return None;
        }
        let side = if is_outside { 1.0 } else { -1.0 };
        Some(Touch {
            nodes: cloth.faces[best.index as usize].map(|n| n as usize),
            weights: best.closest.barycentric,
            normal: (away * side).try_normalize().unwrap_or(outward),
            signed_distance: side * best.distance,
        })
    }
}

/// Cosine of the widest angle from straight below at which cloth counts as sunk in: cloth pressed on
/// the corner of a cube is 55 degrees from the corner's normal.
const SUNK_COSINE_MIN: f64 = 0.5;

impl Touch {
    /// The cloth's point, or whatever the values belong to, at the touch.
    pub fn weighted_sum(&self, values: &[DVec3]) -> DVec3 {
        (0..3).map(|k| values[self.nodes[k]] * self.weights[k]).sum()
    }
}

fn corners(positions: &[DVec3], face: &[u32; 3]) -> [DVec3; 3] {
    face.map(|n| positions[n as usize])
}
