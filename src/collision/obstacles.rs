//! All obstacles of a scene, and where they are during a step.

use std::sync::Arc;

use super::motion::ObstacleMotion;
use super::shape::Shape;
use super::topology::Topology;
use crate::scene::{Deformation, Obstacle, Pose, Scene, Welding};

/// The obstacles' shapes; where they are is said by an [`ObstacleMotion`].
#[derive(Clone, Debug)]
pub struct Obstacles {
    parts: Vec<Part>,
}

/// The shape of one obstacle.
#[derive(Clone, Debug)]
enum Part {
    Rigid(Arc<Shape>),
    Deforming {
        deformation: Arc<Deformation>,
        welding: Welding,
        first: Arc<Shape>,
        /// The shape asked for last, and its time (s): the end of a step is the start of the next.
        latest: (f64, Arc<Shape>),
    },
}

impl Obstacles {
    pub fn new(scene: &Scene) -> Self {
        Self { parts: scene.obstacles.iter().map(Part::new).collect() }
    }

    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Every obstacle's pose at a time (s).
    pub fn poses(scene: &Scene, time: f64) -> Vec<Pose> {
        scene.obstacles.iter().map(|o| scene.obstacle_pose(o, time)).collect()
    }

    /// The obstacles on their way from one time to another (s), in a step of some duration (s).
    pub fn moving(&mut self, scene: &Scene, times: [f64; 2], duration: f64) -> Vec<ObstacleMotion> {
        let motion = |(part, obstacle): (&mut Part, _)| {
            let poses = times.map(|time| scene.obstacle_pose(obstacle, time));
            ObstacleMotion::deforming(times.map(|time| part.shape(time)), poses, duration)
        };
        self.parts.iter_mut().zip(&scene.obstacles).map(motion).collect()
    }
}

impl Part {
    fn new(obstacle: &Obstacle) -> Self {
        let Some(deformation) = &obstacle.deformation else {
            return Part::Rigid(Arc::new(Shape::new(&obstacle.surface)));
        };
        let welding = Welding::new(deformation.keys().iter().map(|k| k.positions.as_slice()));
        let renumbered = |t: &[u32; 3]| welding.renumbered(*t);
        let has_corners = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let triangles = obstacle.surface.triangles.iter().map(renumbered).filter(has_corners);
        let topology = Arc::new(Topology::new(triangles.collect()));
        let key = &deformation.keys()[0];
        let first = Arc::new(Shape::with_topology(topology, welding.welded(&key.positions)));
        Part::Deforming {
            deformation: deformation.clone(),
            welding,
            latest: (key.time, first.clone()),
            first,
        }
    }

    fn shape(&mut self, time: f64) -> Arc<Shape> {
        match self {
            Part::Rigid(shape) => shape.clone(),
            Part::Deforming { deformation, welding, first, latest } => {
                let time = deformation.clamped(time);
                if latest.0 != time {
                    // From the first shape whatever was asked for before: trees that are refitted
                    // from one another would come to depend on the way.
                    let positions = welding.welded(&deformation.positions(time));
                    *latest = (time, Arc::new(first.moved(positions)));
                }
                latest.1.clone()
            }
        }
    }
}
