//! The surface of an obstacle, ready for questions: how far, on which side, what crosses it.
//!
//! All in the obstacle's own space, so that nothing is rebuilt when it moves; where its points move
//! by themselves, the tree is refitted and the normals are computed again.

use std::sync::Arc;

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::group::Group;
use super::nearest::{NearTriangle, bounds, nearest_triangle};
use super::ridge::Ridge;
use super::topology::{Edge, Topology};
use crate::math::{closest_point_on_triangle, crossing_places, triangles_cross};
use crate::scene::Surface;

/// A closed surface with the pseudonormals that tell inside from outside.
#[derive(Clone, Debug)]
pub struct Shape {
    topology: Arc<Topology>,
    positions: Vec<DVec3>,
    /// Unit; zero for a triangle that has lost its area.
    face_normals: Vec<DVec3>,
    /// Sums of the unit normals of the triangles at each edge.
    edge_normals: Vec<DVec3>,
    vertex_normals: Vec<DVec3>,
    /// A third of the area of the triangles around each vertex.
    vertex_areas: Vec<f64>,
    groups: Vec<Group>,
    ridges: Vec<Ridge>,
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
    pub triangle: u32,
    pub barycentric: [f64; 3],
}

/// An edge is convex if the one triangle's far corner is below the other's plane by more than this
/// share of its distance from the edge: between coplanar triangles there is no ridge.
const CONVEX_SINE_MIN: f64 = 1e-9;

impl Shape {
    /// Points at the same place are one; triangles without area take no part.
    pub fn new(surface: &Surface) -> Self {
        let surface = surface.welded();
        let corner = |t: &[u32; 3]| t.map(|v| surface.positions[v as usize]);
        let has_area = |t: &&[u32; 3]| normal_of(corner(t)).is_some();
        let triangles = surface.triangles.iter().filter(has_area).copied().collect();
        Self::with_topology(Arc::new(Topology::new(triangles)), surface.positions)
    }

    /// # Panics
    /// If there are fewer positions than the triangles speak of.
    pub fn with_topology(topology: Arc<Topology>, positions: Vec<DVec3>) -> Self {
        let boxes: Vec<Aabb> = triangle_boxes(&topology, |v| bounds(&[positions[v as usize]]));
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        let triangles = 0..topology.triangles().len() as u32;
        let corners = triangles.flat_map(|t| topology.owned_corners(t)).map(|c| c as usize);
        let groups = Group::divided(corners.collect(), &positions);
        Self::measured(topology, positions, groups, tree)
    }

    /// The same surface with its points elsewhere.
    #[must_use]
    pub fn moved(&self, positions: Vec<DVec3>) -> Self {
        let mut tree = self.tree.clone();
        refit(&mut tree, &triangle_boxes(&self.topology, |v| bounds(&[positions[v as usize]])));
        let here = |g: &Group| Group::around(g.corners.clone(), &positions);
        let groups = self.groups.iter().map(here).collect();
        Self::measured(self.topology.clone(), positions, groups, tree)
    }

    /// A tree over the triangles on their way to where they are in `end`.
    pub fn swept_tree(&self, end: &Self) -> Bvh {
        let mut tree = self.tree.clone();
        let way = |v: u32| bounds(&[self.positions[v as usize], end.positions[v as usize]]);
        refit(&mut tree, &triangle_boxes(&self.topology, way));
        tree
    }

    fn measured(
        topology: Arc<Topology>,
        positions: Vec<DVec3>,
        groups: Vec<Group>,
        tree: Bvh,
    ) -> Self {
        let mut shape = Self {
            face_normals: Vec::with_capacity(topology.triangles().len()),
            edge_normals: vec![DVec3::ZERO; topology.edges().len()],
            vertex_normals: vec![DVec3::ZERO; positions.len()],
            vertex_areas: vec![0.0; positions.len()],
            topology,
            positions,
            groups,
            ridges: Vec::new(),
            tree,
        };
        shape.set_normals();
        let ridge = |e: &Edge| Ridge::new(e, shape.is_convex(e), &shape.face_normals);
        shape.ridges = shape.topology.edges().iter().filter_map(ridge).collect();
        shape
    }

    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    pub fn face_normals(&self) -> &[DVec3] {
        &self.face_normals
    }

    pub fn edge_normals(&self) -> &[DVec3] {
        &self.edge_normals
    }

    pub fn vertex_normals(&self) -> &[DVec3] {
        &self.vertex_normals
    }

    pub fn vertex_areas(&self) -> &[f64] {
        &self.vertex_areas
    }

    /// All corners of triangles, in groups.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    pub fn ridges(&self) -> &[Ridge] {
        &self.ridges
    }

    pub fn tree(&self) -> &Bvh {
        &self.tree
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.root_aabb()
    }

    /// The nearest point within a radius; `None` if there is none. The sign is that of the angle
    /// weighted pseudonormal ([`BA05`](crate::papers::BA05)): exact for a closed surface.
    pub fn nearest(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        nearest_triangle(&self.tree, point, radius, |t| self.corners(t))
            .map(|best| self.signed(point, best))
    }

    /// [`nearest`](Self::nearest), quicker where a guess at the nearest triangle is good.
    pub fn nearest_from(&self, point: DVec3, radius: f64, guess: u32) -> Option<Nearest> {
        let guessed = closest_point_on_triangle(point, self.corners(guess)).point.distance(point);
        // A hair more, so that the search finds the guess itself.
        self.nearest(point, radius.min(guessed * (1.0 + 1e-9) + f64::MIN_POSITIVE))
    }

    fn signed(&self, point: DVec3, best: NearTriangle) -> Nearest {
        let (triangle, barycentric) = (best.index, best.closest.barycentric);
        let outward = self.pseudonormal(triangle, barycentric);
        let away = point - best.closest.point;
        let sign = if outward.dot(away) < 0.0 { -1.0 } else { 1.0 };
        Nearest {
            signed_distance: sign * best.distance,
            point: best.closest.point,
            normal: (away * sign).try_normalize().unwrap_or(outward.normalize_or_zero()),
            triangle,
            barycentric,
        }
    }

    /// Whether a triangle crosses the surface.
    pub fn is_crossed_by(&self, triangle: [DVec3; 3]) -> bool {
        let around = bounds(&triangle);
        self.tree
            .intersect_aabb(&around)
            .any(|other| triangles_cross(triangle, self.corners(other)))
    }

    /// How many triangles of the surface a triangle crosses.
    pub fn crossing_count(&self, triangle: [DVec3; 3]) -> usize {
        let is_crossed = |other: &u32| triangles_cross(triangle, self.corners(*other));
        self.tree.intersect_aabb(&bounds(&triangle)).filter(is_crossed).count()
    }

    /// The mean of the places where edges of a triangle pass through the surface, and edges of the
    /// surface through the triangle; `None` if none does.
    pub fn middle_of_cut(&self, triangle: [DVec3; 3]) -> Option<DVec3> {
        let mut sum = (DVec3::ZERO, 0.0);
        for other in self.tree.intersect_aabb(&bounds(&triangle)) {
            let other = self.corners(other);
            for place in crossing_places(triangle, other) {
                sum = (sum.0 + place, sum.1 + 1.0);
            }
        }
        (sum.1 > 0.0).then(|| sum.0 / sum.1)
    }

    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.topology.triangles()[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// Whether something straight can rest on an edge: not in a hollow, nor between coplanar
    /// triangles. The rim of an open surface counts as convex.
    pub fn is_convex(&self, edge: &Edge) -> bool {
        let Some(second) = edge.second else { return true };
        let far = self.positions[second.opposite as usize];
        let arm = far - self.positions[edge.corners[0] as usize];
        let normal = self.face_normals[edge.first.triangle as usize];
        normal.dot(arm) < -CONVEX_SINE_MIN * arm.length()
    }

    fn pseudonormal(&self, triangle: u32, barycentric: [f64; 3]) -> DVec3 {
        let corners = self.topology.triangles()[triangle as usize];
        let edges = self.topology.edges_of(triangle);
        let vertex = |k: usize| self.vertex_normals[corners[k] as usize];
        let edge = |k: usize| self.edge_normals[edges[k] as usize];
        match barycentric.map(|b| b == 0.0) {
            [false, true, true] => vertex(0),
            [true, false, true] => vertex(1),
            [true, true, false] => vertex(2),
            [true, false, false] => edge(0),
            [false, true, false] => edge(1),
            [false, false, true] => edge(2),
            _ => self.face_normals[triangle as usize],
        }
    }

    fn set_normals(&mut self) {
        for (index, t) in self.topology.triangles().iter().enumerate() {
            let p = t.map(|v| self.positions[v as usize]);
            let normal = normal_of(p).unwrap_or_default();
            self.face_normals.push(normal);
            for edge in self.topology.edges_of(index as u32) {
                self.edge_normals[edge as usize] += normal;
            }
            let third = (p[1] - p[0]).cross(p[2] - p[0]).length() / 6.0;
            for k in 0..3 {
                let (to_next, to_last) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                // Without area there is no angle either, only what 0/0 makes of it.
                if normal != DVec3::ZERO {
                    let angle = to_next.angle_between(to_last);
                    self.vertex_normals[t[k] as usize] += normal * angle;
                }
                self.vertex_areas[t[k] as usize] += third;
            }
        }
        self.vertex_normals.iter_mut().for_each(|n| *n = n.normalize_or_zero());
    }
}

fn triangle_boxes(topology: &Topology, around: impl Fn(u32) -> Aabb) -> Vec<Aabb> {
    let merged = |a: Aabb, b: Aabb| Aabb::new(a.mins.min(b.mins), a.maxs.max(b.maxs));
    let of = |&[a, b, c]: &[u32; 3]| merged(merged(around(a), around(b)), around(c));
    topology.triangles().iter().map(of).collect()
}

fn refit(tree: &mut Bvh, boxes: &[Aabb]) {
    for (index, around) in boxes.iter().enumerate() {
        tree.insert_or_update_partially(*around, index as u32, 0.0);
    }
    tree.refit_without_opt();
}

fn normal_of([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    (b - a).cross(c - a).try_normalize()
}
