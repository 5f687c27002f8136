//! Where cloth meets obstacles: proximity for the implicit step, resolution after it, and a guard
//! for the remesher. The only place that knows parry.
//!
//! Before the step, nodes near obstacles, corners of obstacles near faces and sharp edges of
//! obstacles near edges become contacts. After it, whatever would have passed through a surface on
//! its way, points through triangles or edges through edges, is stopped. What passes through all the
//! same, as at a bad start, is taken apart once a frame (`contour`).

mod carry;
mod cloth;
mod continuous;
mod contour;
mod crossing_faces;
mod everywhere;
mod face_tree;
mod group;
mod guard;
mod impact;
mod motion;
mod near;
mod nearest;
mod obstacles;
mod proximity;
mod resolve;
mod ridge;
mod search;
mod shape;
mod stop;
mod topology;

pub use cloth::{ClothContact, ClothGuard, Crossing, WayBounds, crossing_pairs, crossings};
pub use continuous::{Features, FirstTouch, Sweep};
pub use contour::{
    Cut, CutNodes, Limits, Method, Round, TangledCloth, Untangling, contour_count, cuts, lift_cuts,
    stop_at_crossings, untangle,
};
pub use crossing_faces::{CrossingFaces, GarmentFace, crossing_faces};
pub use face_tree::{FaceTree, Touch};
pub use guard::ObstacleGuard;
pub use motion::ObstacleMotion;
pub use near::NearMemory;
pub use obstacles::Obstacles;
pub use proximity::{Cloth, contacts, nearest_planes};
pub use resolve::{Depth, MovedCloth, Resolution, resolve, trapped_nodes};
pub use shape::{Nearest, Shape};

#[cfg(test)]
mod judge;
#[cfg(test)]
mod tests;
