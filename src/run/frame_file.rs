//! A frame's state as a file of its own, outside any run folder: the bytes are those of a run's.

use std::path::Path;

use super::RunError;
use super::read::read_sealed;
use super::sealed::FRAME;
use super::state::{frame_bytes, frame_from_bytes};
use super::write::write_sealed;
use crate::sim::Frame;

/// Writes a state; the file appears under its name when it is whole.
///
/// # Errors
/// If the file system refuses.
pub fn write_frame_file(path: &Path, frame: &Frame) -> Result<(), RunError> {
    write_sealed(path, FRAME, &frame_bytes(frame))
}

/// The state, with the bits it was written with.
///
/// # Errors
/// If there is no such file, or it is damaged or of a later version.
pub fn read_frame_file(path: &Path) -> Result<Frame, RunError> {
    read_sealed(path, FRAME, frame_from_bytes)
}
