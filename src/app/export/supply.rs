//! Where an export takes its frames from.

use std::sync::Arc;

use crate::run::RunInfo;
use crate::scene::Surface;
use crate::shot::CameraPath;
use crate::sim::Frame;

/// The frames of a shot, its cameras and names. An export asks from its own thread.
pub trait FrameSupply: Send {
    /// A finished frame, counted from the start of the simulation. May read from the disk; the export
    /// cannot be cancelled until it returns.
    ///
    /// # Errors
    /// Why there is no such frame, in words without its number.
    fn frame(&self, number: u32) -> Result<Arc<Frame>, String>;

    /// The hash of the settings that made a frame, as in [`RunInfo::input_hash`].
    ///
    /// # Errors
    /// As [`FrameSupply::frame`].
    fn settings_hash(&self, number: u32) -> Result<String, String>;

    /// The obstacles' surfaces at rest, in the order of a frame's poses.
    fn surfaces(&self) -> Vec<Arc<Surface>>;

    /// The shot camera; the witness's view needs none.
    fn camera(&self) -> Option<CameraPath>;

    /// What a run of these frames would say of itself: names, rate, first frame, settings.
    fn info(&self) -> RunInfo;
}
