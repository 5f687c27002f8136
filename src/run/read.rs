//! Reading a run folder.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use super::place::Place;
use super::sealed::{FRAME_MAGIC, OBSTACLES_MAGIC, unseal};
use super::state::{frame_from_bytes, obstacles_from_bytes};
use super::{RunError, RunInfo, StateError};
use crate::scene::Surface;
use crate::sim::Frame;

/// A run folder as it was when opened.
#[derive(Debug)]
pub struct RunReader {
    place: Place,
    info: RunInfo,
    frames: Vec<u32>,
    obstacles: Vec<Arc<Surface>>,
}

impl RunReader {
    /// # Errors
    /// If the folder is none that this program can read. States are not read yet.
    pub fn open(dir: &Path) -> Result<Self, RunError> {
        let place = Place { dir: dir.to_owned() };
        if !place.info().is_file() {
            return Err(RunError::NotARun { path: dir.to_owned() });
        }
        let info = RunInfo::read(&place.info())?;
        let frames = place.frame_numbers()?;
        let obstacles = read_sealed(&place.obstacles(), OBSTACLES_MAGIC, obstacles_from_bytes)?;
        Ok(Self { place, info, frames, obstacles })
    }

    /// True if `dir` looks like a run folder, of whatever version.
    pub fn is_run(dir: &Path) -> bool {
        RunInfo::is_at(&Place { dir: dir.to_owned() }.info())
    }

    pub fn dir(&self) -> &Path {
        &self.place.dir
    }

    pub fn info(&self) -> &RunInfo {
        &self.info
    }

    /// The frames that are there, in order, counted from the start of the simulation.
    pub fn frames(&self) -> &[u32] {
        &self.frames
    }

    pub fn last_frame(&self) -> Option<u32> {
        self.frames.last().copied()
    }

    /// In their own space, in the order of a frame's `obstacle_poses`.
    pub fn obstacles(&self) -> Vec<Arc<Surface>> {
        self.obstacles.clone()
    }

    /// The state at the end of a frame, with the bits it was written with.
    ///
    /// # Errors
    /// If there is no such frame, or its file is damaged or of a later version.
    pub fn frame(&self, number: u32) -> Result<Frame, RunError> {
        if self.frames.binary_search(&number).is_err() {
            let first_and_last = self.frames.first().copied().zip(self.last_frame());
            return Err(RunError::NoSuchFrame {
                path: self.place.dir.clone(),
                number,
                first_and_last: first_and_last.map(<[u32; 2]>::from),
            });
        }
        let path = self.place.frame(number);
        let frame = read_sealed(&path, FRAME_MAGIC, frame_from_bytes)?;
        if frame.number == number {
            Ok(frame)
        } else {
            Err(RunError::WrongFrame { path, found: frame.number, expected: number })
        }
    }
}

fn read_sealed<T>(
    path: &Path,
    magic: &[u8; 8],
    content_from_bytes: impl FnOnce(&[u8]) -> Result<T, StateError>,
) -> Result<T, RunError> {
    let file = fs::read(path).map_err(RunError::io("read", path))?;
    // Version 1 is the only one so far; later ones choose their reader here.
    unseal(magic, &file)
        .and_then(|(_version, content)| content_from_bytes(&content))
        .map_err(|source| RunError::State { path: path.to_owned(), source })
}
