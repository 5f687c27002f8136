//! Frames for threads that may wait for the disk, such as exports.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::keeper::path_of;
use super::key::FrameKey;
use super::planner::chain;
use crate::run::{RunReader, read_frame_file};
use crate::sim::Frame;

/// The frames that were at hand when this was made.
#[derive(Clone)]
pub struct FrameReader {
    pub(super) held: BTreeMap<FrameKey, Arc<Frame>>,
    pub(super) folder: Option<PathBuf>,
    pub(super) run: Option<Arc<RunReader>>,
}

impl FrameReader {
    /// May read from the disk.
    ///
    /// # Errors
    /// In words, if the frame is nowhere or its file is damaged.
    pub fn frame(&self, key: FrameKey, number: u32) -> Result<Arc<Frame>, String> {
        if let Some(frame) = self.held.get(&key) {
            return Ok(frame.clone());
        }
        let frame = match (&self.run, &self.folder) {
            (Some(run), _) => run.frame(number).map_err(|error| chain(&error))?,
            (None, Some(folder)) => {
                read_frame_file(&path_of(folder, key)).map_err(|error| chain(&error))?
            }
            (None, None) => return Err("it is no longer in memory".to_owned()),
        };
        Ok(Arc::new(frame))
    }
}
