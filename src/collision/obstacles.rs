//! All obstacles of a scene, and where they are during a step.

use std::sync::Arc;

use super::motion::ObstacleMotion;
use super::shape::Shape;
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

    /// Every obstacle's pose at a time (s).
    pub fn poses(scene: &Scene, time: f64) -> Vec<Pose> {
        scene.obstacles.iter().map(|o| scene.obstacle_pose(o, time)).collect()
    }

    /// The obstacles on their way from one time to another (s), in a step of some duration (s).
    pub fn moving(
        &self,
        scene: &Scene,
        [from, to]: [f64; 2],
        duration: f64,
    ) -> Vec<ObstacleMotion> {
        let motion = |(shape, obstacle): (&Arc<Shape>, _)| {
            let [start, end] = [from, to].map(|time| scene.obstacle_pose(obstacle, time));
            ObstacleMotion::new(shape.clone(), start, end, duration)
        };
        self.shapes.iter().zip(&scene.obstacles).map(motion).collect()
    }
}
