//! Small mathematics that every other module shares: 2x2 tensors and metrics, 3x2 derivatives,
//! segments and triangles in space, cubics over the unit interval, random numbers.

mod cubic;
mod disjoint;
mod mat3x2;
mod metric;
mod random;
mod segment;
mod tensor;
mod triangle;

pub use cubic::Cubic;
pub use disjoint::DisjointSets;
pub use mat3x2::Mat3x2;
pub use metric::{tensor_max, tensor_max_of, tensor_min};
pub use random::Random;
pub use segment::{SegmentPair, closest_points_of_segments, segment_distance_squared};
pub use tensor::{Eigen2, SymTensor2};
pub use triangle::{
    ClosestPoint, closest_point_on_triangle, crossing_places, segment_passes_through,
    triangles_cross,
};

use glam::{DMat3, DVec3};

/// a b^T.
pub fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
