//! The surface of an obstacle, ready for questions: how far, on which side, what crosses it.
//!
//! All in the obstacle's own space, so that nothing is rebuilt when it moves.

use std::collections::HashMap;

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::nearest::{bounds, nearest_triangle};
use crate::math::triangles_cross;
use crate::scene::Surface;

/// A closed surface with the pseudonormals that tell inside from outside.
#[derive(Clone, Debug)]
pub struct Shape {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    face_normals: Vec<DVec3>,
    /// Per triangle and corner, the normal of the edge opposite to the corner.
    edge_normals: Vec<[DVec3; 3]>,
    vertex_normals: Vec<DVec3>,
    /// A third of the area of the triangles around each vertex.
    vertex_areas: Vec<f64>,
    tree: Bvh,
}

/// The nearest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Negative inside.
    pub signed_distance: f64,
    pub point: DVec3,
    /// Unit, out of the obstacle, along the line to the point asked about; the surface's own
    /// normal where that line has no length.
    pub normal: DVec3,
}

impl Shape {
    /// Points at the same place are one; triangles without area take no part.
    pub fn new(surface: &Surface) -> Self {
        let surface = surface.welded();
        let corner = |t: &[u32; 3]| t.map(|v| surface.positions[v as usize]);
        let triangles: Vec<[u32; 3]> =
            surface.triangles.iter().filter(|t| normal_of(corner(t)).is_some()).copied().collect();
        let positions = surface.positions.clone();
        let boxes: Vec<Aabb> = triangles.iter().map(|t| bounds(&corner(t))).collect();
        let mut shape = Self {
            face_normals: triangles.iter().filter_map(|t| normal_of(corner(t))).collect(),
            edge_normals: Vec::new(),
            vertex_normals: vec![DVec3::ZERO; positions.len()],
            vertex_areas: vec![0.0; positions.len()],
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            positions,
            triangles,
        };
        shape.set_edge_normals();
        shape.set_vertex_normals();
        shape
    }

    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    pub fn vertex_normals(&self) -> &[DVec3] {
        &self.vertex_normals
    }

    pub fn vertex_areas(&self) -> &[f64] {
        &self.vertex_areas
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.root_aabb()
    }

    /// The nearest point within a radius; `None` if there is none. The sign is that of the angle
    /// weighted pseudonormal ([`BA05`](crate::papers::BA05)): exact for a closed surface.
    pub fn nearest(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        let best = nearest_triangle(&self.tree, point, radius, |t| self.corners(t))?;
        let outward = self.pseudonormal(best.index, best.closest.barycentric);
        let away = point - best.closest.point;
        let sign = if outward.dot(away) < 0.0 { -1.0 } else { 1.0 };
        let normal = (away * sign).try_normalize().unwrap_or(outward.normalize_or_zero());
        Some(Nearest { signed_distance: sign * best.distance, point: best.closest.point, normal })
    }

    /// Whether a triangle crosses the surface.
    pub fn is_crossed_by(&self, triangle: [DVec3; 3]) -> bool {
        let around = bounds(&triangle);
        self.tree
            .intersect_aabb(&around)
            .any(|other| triangles_cross(triangle, self.corners(other)))
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    fn pseudonormal(&self, triangle: u32, barycentric: [f64; 3]) -> DVec3 {
        let index = triangle as usize;
        let zero = barycentric.map(|b| b == 0.0);
        match zero {
            [false, true, true] => self.vertex_normals[self.triangles[index][0] as usize],
            [true, false, true] => self.vertex_normals[self.triangles[index][1] as usize],
            [true, true, false] => self.vertex_normals[self.triangles[index][2] as usize],
            [true, false, false] => self.edge_normals[index][0],
            [false, true, false] => self.edge_normals[index][1],
            [false, false, true] => self.edge_normals[index][2],
            _ => self.face_normals[index],
        }
    }

    fn set_edge_normals(&mut self) {
        let mut sums: HashMap<(u32, u32), DVec3> = HashMap::new();
        let key = |t: &[u32; 3], k: usize| {
            let (a, b) = (t[(k + 1) % 3], t[(k + 2) % 3]);
            (a.min(b), a.max(b))
        };
        for (t, n) in self.triangles.iter().zip(&self.face_normals) {
            for k in 0..3 {
                *sums.entry(key(t, k)).or_default() += *n;
            }
        }
        self.edge_normals =
            self.triangles.iter().map(|t| [0, 1, 2].map(|k| sums[&key(t, k)])).collect();
    }

    fn set_vertex_normals(&mut self) {
        for (index, t) in self.triangles.iter().enumerate() {
            let p = t.map(|v| self.positions[v as usize]);
            let third = (p[1] - p[0]).cross(p[2] - p[0]).length() / 6.0;
            for k in 0..3 {
                let (to_next, to_last) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                let angle = to_next.angle_between(to_last);
                self.vertex_normals[t[k] as usize] += self.face_normals[index] * angle;
                self.vertex_areas[t[k] as usize] += third;
            }
        }
        self.vertex_normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
    }
}

fn normal_of([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    (b - a).cross(c - a).try_normalize()
}
