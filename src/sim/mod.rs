//! The main loop.

mod frame;

pub use frame::{Frame, FrameReport, StageSeconds};
