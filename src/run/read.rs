//! Reading a run folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::place::Place;
use super::sealed::{FRAME, Kind, OBSTACLES, check_seal, unseal};
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
        let obstacles = read_sealed(&place.obstacles(), OBSTACLES, obstacles_from_bytes)?;
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
        let path = self.path_of(number)?;
        let frame = read_sealed(&path, FRAME, frame_from_bytes)?;
        if frame.number != number {
            return Err(RunError::WrongFrame { path, found: frame.number, expected: number });
        }
        match self.check_points(&frame) {
            Ok(()) => Ok(frame),
            Err(source) => Err(RunError::State { path, source }),
        }
    }

    /// Whether deforming obstacles have as many points as at rest.
    fn check_points(&self, frame: &Frame) -> Result<(), StateError> {
        for (&obstacle, points) in &frame.obstacle_points {
            let known = self.obstacles.get(obstacle as usize);
            if known.is_none_or(|surface| surface.positions.len() != points.len()) {
                return Err(StateError::Value {
                    what: "number of points of a deforming obstacle",
                    found: points.len() as u64,
                    expected: "as many as the obstacle has at rest",
                });
            }
        }
        Ok(())
    }

    /// Whether a frame's file is as it was written, at a small part of the cost of reading it.
    ///
    /// # Errors
    /// As [`frame`](Self::frame).
    pub fn check_frame(&self, number: u32) -> Result<(), RunError> {
        let path = self.path_of(number)?;
        let file = fs::read(&path).map_err(RunError::io("read", &path))?;
        check_seal(FRAME, &file).map_err(|source| RunError::State { path, source })
    }

    fn path_of(&self, number: u32) -> Result<PathBuf, RunError> {
        if self.frames.binary_search(&number).is_ok() {
            return Ok(self.place.frame(number));
        }
        let first_and_last = self.frames.first().copied().zip(self.last_frame());
        Err(RunError::NoSuchFrame {
            path: self.place.dir.clone(),
            number,
            first_and_last: first_and_last.map(<[u32; 2]>::from),
        })
    }
}

/// The content is read as that of the version it was written in.
pub(super) fn read_sealed<T>(
    path: &Path,
    kind: Kind,
    content_from_bytes: impl FnOnce(u32, &[u8]) -> Result<T, StateError>,
) -> Result<T, RunError> {
    let file = fs::read(path).map_err(RunError::io("read", path))?;
    unseal(kind, &file)
        .and_then(|(version, content)| content_from_bytes(version, &content))
        .map_err(|source| RunError::State { path: path.to_owned(), source })
}
