//! A frame's state as a file of its own, outside any run folder: the bytes are those of a run's.

use std::fs;
use std::path::Path;

use super::RunError;
use super::place::write_whole;
use super::sealed::{FRAME, seal, unseal};
use super::state::{frame_bytes, frame_from_bytes};
use crate::sim::Frame;

/// Writes a state; the file appears under its name when it is whole.
///
/// # Errors
/// If the file system refuses.
pub fn write_frame_file(path: &Path, frame: &Frame) -> Result<(), RunError> {
    let file = seal(FRAME, &frame_bytes(frame)).map_err(RunError::io("compress", path))?;
    write_whole(path, &file)
}

/// The state, with the bits it was written with.
///
/// # Errors
/// If there is no such file, or it is damaged or of a later version.
pub fn read_frame_file(path: &Path) -> Result<Frame, RunError> {
    let file = fs::read(path).map_err(RunError::io("read", path))?;
    unseal(FRAME, &file)
        .and_then(|(version, content)| frame_from_bytes(version, &content))
        .map_err(|source| RunError::State { path: path.to_owned(), source })
}
