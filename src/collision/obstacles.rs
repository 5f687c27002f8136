//! All obstacles of a scene, and where they are during a step.

use std::sync::Arc;

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;

use super::nearest::bounds;
use super::shape::{Nearest, Shape};
use crate::scene::{Pose, Scene};

/// The obstacles' shapes; where they are is said by an [`ObstacleMotion`].
#[derive(Clone, Debug)]
pub struct Obstacles {
    shapes: Vec<Arc<Shape>>,
}

impl Obstacles {
    pub fn new(scene: &Scene) -> Self {
        let shapes = scene.obstacles.iter().map(|o| Arc::new(Shape::new(&o.surface))).collect();
        Self { shapes }
    }

    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    pub fn shapes(&self) -> &[Arc<Shape>] {
        &self.shapes
    }

    /// Every obstacle's pose at a time (s).
    pub fn poses(scene: &Scene, time: f64) -> Vec<Pose> {
        scene.obstacles.iter().map(|o| scene.obstacle_pose(o, time)).collect()
    }

    /// The obstacles on their way from one set of poses to another.
    pub fn moving(&self, start: &[Pose], end: &[Pose], duration: f64) -> Vec<ObstacleMotion> {
        let parts = self.shapes.iter().zip(start.iter().zip(end));
        parts.map(|(shape, (s, e))| ObstacleMotion::new(shape.clone(), *s, *e, duration)).collect()
    }
}

/// One obstacle over one step.
#[derive(Clone, Debug)]
pub struct ObstacleMotion {
    pub shape: Arc<Shape>,
    pub start: Pose,
    pub end: Pose,
    /// (s).
    pub duration: f64,
    own_from_start: Pose,
    own_from_end: Pose,
    bounds_at_start: Aabb,
    bounds_at_end: Aabb,
}

impl ObstacleMotion {
    pub fn new(shape: Arc<Shape>, start: Pose, end: Pose, duration: f64) -> Self {
        Self {
            own_from_start: start.inverse(),
            own_from_end: end.inverse(),
            bounds_at_start: moved_bounds(&shape, start),
            bounds_at_end: moved_bounds(&shape, end),
            shape,
            start,
            end,
            duration,
        }
    }

    /// The velocity of the obstacle's material at a point it has at the start of the step (m/s).
    pub fn velocity_at(&self, point_at_start: DVec3) -> DVec3 {
        (self.carried(point_at_start) - point_at_start) / self.duration
    }

    /// The velocity of the obstacle's material at a point it has at the end of the step (m/s).
    pub fn velocity_at_end(&self, point_at_end: DVec3) -> DVec3 {
        let own = self.own_from_end.transform_point(point_at_end);
        (point_at_end - self.start.transform_point(own)) / self.duration
    }

    /// Where a point goes that is carried by the obstacle from the start to the end of the step.
    pub fn carried(&self, point_at_start: DVec3) -> DVec3 {
        self.end.transform_point(self.own_from_start.transform_point(point_at_start))
    }

    /// Whether a point is inside at the end of the step.
    pub fn contains_at_end(&self, point: DVec3) -> bool {
        self.contains(point, self.end, self.own_from_end, &self.bounds_at_end)
    }

    /// Whether a point is inside at the start of the step.
    pub fn contains_at_start(&self, point: DVec3) -> bool {
        self.contains(point, self.start, self.own_from_start, &self.bounds_at_start)
    }

    /// The nearest point of the surface at the start of the step, within a radius (m).
    pub fn nearest_at_start(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        self.nearest(point, radius, self.start, self.own_from_start, &self.bounds_at_start)
    }

    /// The nearest point of the surface at the end of the step, within a radius (m).
    pub fn nearest_at_end(&self, point: DVec3, radius: f64) -> Option<Nearest> {
        self.nearest(point, radius, self.end, self.own_from_end, &self.bounds_at_end)
    }

    /// The box around the obstacle over the whole step.
    pub fn swept_bounds(&self) -> Aabb {
        let (a, b) = (&self.bounds_at_start, &self.bounds_at_end);
        Aabb::new(a.mins.min(b.mins), a.maxs.max(b.maxs))
    }

    /// Whether a triangle crosses the surface at the end of the step.
    pub fn is_crossed_at_end(&self, triangle: [DVec3; 3]) -> bool {
        let around = bounds(&triangle);
        let apart = around.mins.cmpgt(self.bounds_at_end.maxs).any()
            || self.bounds_at_end.mins.cmpgt(around.maxs).any();
        !apart && self.shape.is_crossed_by(triangle.map(|p| self.own_from_end.transform_point(p)))
    }

    fn contains(
        &self,
        point: DVec3,
        world_from_own: Pose,
        own_from_world: Pose,
        bounds: &Aabb,
    ) -> bool {
        // Most points are outside the box: the surface need not be searched for them.
        point == point.clamp(bounds.mins, bounds.maxs)
            && self
                .nearest(point, f64::INFINITY, world_from_own, own_from_world, bounds)
                .is_some_and(|n| n.signed_distance < 0.0)
    }

    fn nearest(
        &self,
        point: DVec3,
        radius: f64,
        world_from_own: Pose,
        own_from_world: Pose,
        bounds: &Aabb,
    ) -> Option<Nearest> {
        if point.distance_squared(point.clamp(bounds.mins, bounds.maxs)) > radius * radius {
            return None;
        }
        let own = own_from_world.transform_point(point);
        let nearest = self.shape.nearest(own, radius * own_from_world.scale)?;
        Some(Nearest {
            signed_distance: nearest.signed_distance * world_from_own.scale,
            point: world_from_own.transform_point(nearest.point),
            normal: world_from_own.rotation * nearest.normal,
        })
    }
}

/// A box around the moved box: larger than need be, but cheap.
fn moved_bounds(shape: &Shape, pose: Pose) -> Aabb {
    let own = shape.bounds();
    let corner = |i: usize| {
        let pick = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        let p = DVec3::new(
            pick(0, own.mins.x, own.maxs.x),
            pick(1, own.mins.y, own.maxs.y),
            pick(2, own.mins.z, own.maxs.z),
        );
        pose.transform_point(p)
    };
    bounds(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner))
}
