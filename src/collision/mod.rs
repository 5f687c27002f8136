//! Where cloth meets obstacles: proximity for the implicit step, resolution after it, and a guard
//! for the remesher. The only place that knows parry.
//!
//! Nodes of the cloth are tested against obstacles, and corners of obstacles against faces of the
//! cloth. Edges are not tested against edges: a cloth edge can cut through a sharp ridge.

mod face_tree;
mod guard;
mod nearest;
mod obstacles;
mod proximity;
mod resolve;
mod shape;

pub use face_tree::{FaceTree, Touch};
pub use guard::ObstacleGuard;
pub use obstacles::{ObstacleMotion, Obstacles};
pub use proximity::{Cloth, contacts, nearest_planes};
pub use resolve::{Depth, MovedCloth, resolve, trapped_nodes};
pub use shape::{Nearest, Shape};

#[cfg(test)]
mod tests;
