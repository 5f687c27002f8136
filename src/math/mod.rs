//! Small mathematics that every other module shares: 2x2 tensors and metrics, 3x2 derivatives.

mod mat3x2;
mod metric;
mod segment;
mod tensor;

pub use mat3x2::Mat3x2;
pub use metric::{tensor_max, tensor_max_of, tensor_min};
pub use segment::segment_distance_squared;
pub use tensor::{Eigen2, SymTensor2};
