//! One obstacle over one step.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::Bvh;

use super::nearest::bounds;
use super::shape::{Nearest, Shape};
use crate::scene::Pose;

/// An obstacle on its way from one pose to another; its points may move in its own space as well.
#[derive(Clone, Debug)]
pub struct ObstacleMotion {
    shape_at_start: Arc<Shape>,
    shape_at_end: Arc<Shape>,
    pub start: Pose,
    pub end: Pose,
    /// (s).
    pub duration: f64,
    /// As matrices: much is transformed.
    own_from_start: DAffine3,
    own_from_end: DAffine3,
    bounds_at_start: Aabb,
    bounds_at_end: Aabb,
    /// Only where points move in the obstacle's own space.
    deformation: Option<Deformation>,
}

/// What moves in an obstacle's own space.
#[derive(Clone, Debug)]
struct Deformation {
    /// Over the triangles on their way.
    swept_tree: Arc<Bvh>,
    /// The longest way of a point (m, own space).
    way_max: f64,
}

impl ObstacleMotion {
    /// A rigid obstacle.
    pub fn new(shape: Arc<Shape>, start: Pose, end: Pose, duration: f64) -> Self {
        Self::deforming([shape.clone(), shape], [start, end], duration)
    }

    /// An obstacle whose points move as well, on straight lines in its own space. Both shapes have
    /// the same triangles.
    pub fn deforming(shapes: [Arc<Shape>; 2], poses: [Pose; 2], duration: f64) -> Self {
        let [shape_at_start, shape_at_end] = shapes;
        let [start, end] = poses;
        let deformation = (!Arc::ptr_eq(&shape_at_start, &shape_at_end)).then(|| {
            let points = shape_at_start.positions().iter().zip(shape_at_end.positions());
            Deformation {
                swept_tree: Arc::new(shape_at_start.swept_tree(&shape_at_end)),
                way_max: points.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max),
            }
        });
        Self {
            own_from_start: affine(start.inverse()),
            own_from_end: affine(end.inverse()),
            bounds_at_start: moved_bounds(&shape_at_start, start),
            bounds_at_end: moved_bounds(&shape_at_end, end),
            shape_at_start,
            shape_at_end,
            start,
            end,
            duration,
            deformation,
        }
    }

    pub fn shape_at_start(&self) -> &Shape {
        &self.shape_at_start
    }

    pub fn shape_at_end(&self) -> &Shape {
        &self.shape_at_end
    }

    pub fn is_rigid(&self) -> bool {
        self.deformation.is_none()
    }

    /// A tree in the obstacle's own space over its triangles, wherever they are within the step.
    pub fn swept_tree(&self) -> &Bvh {
        self.deformation.as_ref().map_or(self.shape_at_start.tree(), |d| &d.swept_tree)
    }

    /// The longest way of a point of the obstacle in its own space (m, world).
    pub fn own_way_max(&self) -> f64 {
        let scale = self.start.scale.max(self.end.scale);
        self.deformation.as_ref().map_or(0.0, |d| d.way_max * scale)
    }

    /// In the obstacle's own space at the start of the step.
    pub fn point_in_own_at_start(&self, point: DVec3) -> DVec3 {
        self.own_from_start.transform_point3(point)
    }

    /// In the obstacle's own space at the end of the step.
    pub fn point_in_own_at_end(&self, point: DVec3) -> DVec3 {
        self.own_from_end.transform_point3(point)
    }

    /// The velocity of what moves with the obstacle's pose and is at a point at the start of the
    /// step (m/s).
    pub fn velocity_at(&self, point_at_start: DVec3) -> DVec3 {
        let own = self.own_from_start.transform_point3(point_at_start);
        (self.end.transform_point(own) - point_at_start) / self.duration
    }

    /// The velocity of a point of a triangle (m/s).
    pub fn surface_velocity(&self, triangle: u32, barycentric: [f64; 3]) -> DVec3 {
        let point = |shape: &Shape| {
            let [a, b, c] = shape.corners(triangle);
            a * barycentric[0] + b * barycentric[1] + c * barycentric[2]
        };
        let (from, to) = (point(&self.shape_at_start), point(&self.shape_at_end));
        (self.end.transform_point(to) - self.start.transform_point(from)) / self.duration
    }

    /// The velocity of a corner (m/s).
    pub fn corner_velocity(&self, corner: usize) -> DVec3 {
        let from = self.start.transform_point(self.shape_at_start.positions()[corner]);
        (self.end.transform_point(self.shape_at_end.positions()[corner]) - from) / self.duration
    }

    /// No point of the obstacle moves faster (m/s).
    pub fn speed_max(&self) -> f64 {
        // Of an affine motion the fastest point of a box is a corner.
        let by_pose = box_corners(self.shape_at_start.bounds())
            .map(|p| self.end.transform_point(p).distance(self.start.transform_point(p)));
        (by_pose.into_iter().fold(0.0, f64::max) + self.own_way_max()) / self.duration
    }

    /// No point of a box goes farther when it is carried by the pose (m).
    pub fn pose_way_max(&self, around: Aabb) -> f64 {
        let way = |p: DVec3| (self.velocity_at(p) * self.duration).length();
        box_corners(around).map(way).into_iter().fold(0.0, f64::max)
    }

    /// How much the obstacle turns and grows: the Frobenius norm of the change of its matrix, in
    /// terms of its scale at the end.
    pub fn turn(&self) -> f64 {
        let axes = DMat3::IDENTITY;
        let change = |axis: DVec3| {
            (self.end.transform_vector(axis) - self.start.transform_vector(axis)).length_squared()
        };
        let squared = change(axes.x_axis) + change(axes.y_axis) + change(axes.z_axis);
        squared.sqrt() / self.end.scale
    }

    /// Where a point goes that is carried by the obstacle from the start to the end of the step;
    /// where the obstacle's points move by themselves, with the one that is nearest.
    pub fn carried(&self, point_at_start: DVec3) -> DVec3 {
        let own = self.own_from_start.transform_point3(point_at_start);
        let way = match self.deformation {
            None => DVec3::ZERO,
            Some(_) => self.shape_at_start.nearest(own, f64::INFINITY).map_or(DVec3::ZERO, |n| {
                let [a, b, c] = self.shape_at_end.corners(n.triangle);
                let [u, v, w] = n.barycentric;
                a * u + b * v + c * w - n.point
            }),
        };
        self.end.transform_point(own + way)
    }

    /// A point that goes from one place to another ends no farther from where it would be
    /// [`carried`](Self::carried) (m): for a rigid obstacle its very distance from there, for others a
    /// bound that does not search the surface.
    pub fn distance_from_carried_max(&self, point_at_start: DVec3, point_at_end: DVec3) -> f64 {
        let own = self.own_from_start.transform_point3(point_at_start);
        point_at_end.distance(self.end.transform_point(own)) + self.own_way_max()
    }

    /// Whether a point is inside at the end of the step.
    pub fn contains_at_end(&self, point: DVec3) -> bool {
        self.contains(At::End, point)
    }

    /// Whether a point is inside at the start of the step.
    pub fn contains_at_start(&self, point: DVec3) -> bool {
        self.contains(At::Start, point)
    }

    /// The nearest point of the surface at the start of the step, within a radius (m).
    pub fn nearest_at_start(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        self.nearest(At::Start, point, radius, None)
    }

    /// The nearest point of the surface at the end of the step, within a radius (m).
    pub fn nearest_at_end(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        self.nearest(At::End, point, radius, None)
    }

    /// The nearest point of the surface at an end of the step, within a radius (m), looked for from
    /// a triangle that may be the nearest.
    pub fn nearest(
        &self,
        at: At,
        point: DVec3,
        radius: f64,
        guess: Option<u32>,
    ) -> Option<Nearest> {
        let (shape, world_from_own, own_from_world, bounds) = self.view(at);
        if point.distance_squared(point.clamp(bounds.mins, bounds.maxs)) > radius * radius {
            return None;
        }
        let own = own_from_world.transform_point3(point);
        let own_radius = radius / world_from_own.scale;
        let nearest = match guess {
            Some(triangle) => shape.nearest_from(own, own_radius, triangle)?,
            None => shape.nearest(own, own_radius)?,
        };
        Some(Nearest {
            signed_distance: nearest.signed_distance * world_from_own.scale,
            point: world_from_own.transform_point(nearest.point),
            normal: world_from_own.rotation * nearest.normal,
            ..nearest
        })
    }

    /// The box around the obstacle over the whole step.
    pub fn swept_bounds(&self) -> Aabb {
        let (a, b) = (&self.bounds_at_start, &self.bounds_at_end);
        Aabb::new(a.mins.min(b.mins), a.maxs.max(b.maxs))
    }

    /// Whether a triangle crosses the surface at the end of the step.
    pub fn is_crossed_at_end(&self, triangle: [DVec3; 3]) -> bool {
        self.near_in_own_at_end(triangle).is_some_and(|own| self.shape_at_end.is_crossed_by(own))
    }

    /// How many triangles of the surface a triangle crosses at the end of the step.
    pub fn crossing_count_at_end(&self, triangle: [DVec3; 3]) -> usize {
        let own = self.near_in_own_at_end(triangle);
        own.map_or(0, |own| self.shape_at_end.crossing_count(own))
    }

    /// A triangle in the obstacle's own space; `None` if its box is apart from the surface's.
    fn near_in_own_at_end(&self, triangle: [DVec3; 3]) -> Option<[DVec3; 3]> {
        let around = bounds(&triangle);
        let apart = around.mins.cmpgt(self.bounds_at_end.maxs).any()
            || self.bounds_at_end.mins.cmpgt(around.maxs).any();
        (!apart).then(|| triangle.map(|p| self.own_from_end.transform_point3(p)))
    }

    /// The middle of where a triangle crosses the surface at the end of the step; `None` if it does
    /// not.
    pub fn middle_of_cut_at_end(&self, triangle: [DVec3; 3]) -> Option<DVec3> {
        let own = triangle.map(|p| self.own_from_end.transform_point3(p));
        self.shape_at_end.middle_of_cut(own).map(|middle| self.end.transform_point(middle))
    }

    fn contains(&self, at: At, point: DVec3) -> bool {
        let bounds = self.view(at).3;
        // Most points are outside the box: the surface need not be searched for them.
        point == point.clamp(bounds.mins, bounds.maxs)
            && self.nearest(at, point, f64::INFINITY, None).is_some_and(|n| n.signed_distance < 0.0)
    }

    fn view(&self, at: At) -> (&Shape, Pose, DAffine3, &Aabb) {
        match at {
            At::Start => {
                (&self.shape_at_start, self.start, self.own_from_start, &self.bounds_at_start)
            }
            At::End => (&self.shape_at_end, self.end, self.own_from_end, &self.bounds_at_end),
        }
    }
}

/// Which end of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    Start,
    End,
}

fn affine(pose: Pose) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        DVec3::splat(pose.scale),
        pose.rotation,
        pose.translation,
    )
}

/// A box around the moved box: larger than need be, but cheap.
fn moved_bounds(shape: &Shape, pose: Pose) -> Aabb {
    bounds(&box_corners(shape.bounds()).map(|p| pose.transform_point(p)))
}

fn box_corners(around: Aabb) -> [DVec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|i: usize| {
        let pick = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        DVec3::new(
            pick(0, around.mins.x, around.maxs.x),
            pick(1, around.mins.y, around.maxs.y),
            pick(2, around.mins.z, around.maxs.z),
        )
    })
}
