//! What a suite of measurements found, as charts and tables; plain data in, text out.

mod bending;
mod contact;
mod reference;
mod stability;
mod study;
mod untangling;
mod visible_error;

pub use bending::{BendingCandidate, bending_svg};
pub use contact::{ContactPoint, contact_svg};
pub use reference::{EdgeLengths, uniform_edge_length};
pub use stability::{StabilityMap, StressRow};
pub use study::{FrameFigures, Reference, Study, Subject};
pub use untangling::{UntanglingCurve, untangling_svg};
