//! Writing a run folder, a frame at a time.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use cpu_time::ProcessTime;

use super::lock::Lock;
use super::obj::{cloth_obj, obstacle_obj};
use super::place::{Lasting, Place, write_whole};
use super::sealed::{FRAME, Kind, OBSTACLES, seal};
use super::state::{frame_bytes, obstacle_bytes};
use super::stats::StatsFile;
use super::{RunError, RunInfo};
use crate::scene::Surface;
use crate::sim::Frame;

/// What is written beside states and statistics, and what may be replaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Every garment at every frame as `obj/FFFF_CC.obj`.
    pub obj: bool,
    /// Every obstacle at every frame as `obj/FFFF_obs_PP.obj`.
    pub obj_obstacles: bool,
    /// Replaces the run that the folder holds; otherwise that is an error.
    pub overwrite: bool,
}

/// An open run folder. Dropped or killed at any time, it leaves a run which
/// [`RunWriter::resume`] continues.
pub struct RunWriter {
    pub(super) place: Place,
    pub(super) first_frame: i64,
    pub(super) obstacles: Vec<Arc<Surface>>,
    pub(super) options: WriteOptions,
    pub(super) stats: StatsFile,
    /// Given back when everything is written.
    pub(super) _lock: Lock,
}

impl RunWriter {
    /// Creates every output before the work starts. The folder may be missing or empty.
    ///
    /// # Errors
    /// If the folder holds a run and `overwrite` is off, or anything else, or cannot be written, or
    /// another program is writing it.
    pub fn create(
        dir: &Path,
        info: &RunInfo,
        obstacles: &[Arc<Surface>],
        options: WriteOptions,
    ) -> Result<Self, RunError> {
        let place = Place { dir: dir.to_owned() };
        let lock = place.claim(options.overwrite)?;
        write_whole(&place.info(), &info.to_json(), Lasting::Yes)?;
        make_folders(&place, options)?;
        write_obstacles(&place, obstacles)?;
        let stats = StatsFile::create(&place.stats())?;
        Ok(Self {
            place,
            first_frame: info.first_frame,
            obstacles: obstacles.to_vec(),
            options,
            stats,
            _lock: lock,
        })
    }

    /// Frames must come in order. The row of statistics comes last: a frame that has one is
    /// complete.
    pub fn write(&mut self, frame: &Frame) -> Result<(), RunError> {
        let started = ProcessTime::now();
        self.write_obj(frame)?;
        write_sealed(&self.place.frame(frame.number), FRAME, &frame_bytes(frame))?;
        self.stats.append(self.shown(frame.number), frame, started.elapsed().as_secs_f64())
    }

    /// The OBJ files asked for.
    pub(super) fn write_obj(&self, frame: &Frame) -> Result<(), RunError> {
        let shown = self.shown(frame.number);
        if self.options.obj {
            for (index, garment) in frame.garments.iter().enumerate() {
                let path = self.place.cloth_obj(shown, index);
                write_whole(&path, cloth_obj(garment).as_bytes(), Lasting::No)?;
            }
        }
        if self.options.obj_obstacles {
            let placed = self.obstacles.iter().zip(&frame.obstacle_poses);
            for (index, (surface, &pose)) in placed.enumerate() {
                let path = self.place.obstacle_obj(shown, index);
                let points = frame.points_of_obstacle(index, surface);
                write_whole(&path, obstacle_obj(surface, points, pose).as_bytes(), Lasting::No)?;
            }
        }
        Ok(())
    }

    pub(super) fn shown(&self, number: u32) -> i64 {
        i64::from(number) + self.first_frame
    }

    /// Makes sure that the statistics have reached the disk.
    pub fn finish(self) -> Result<(), RunError> {
        self.stats.sync()
    }
}

pub(super) fn make_folders(place: &Place, options: WriteOptions) -> Result<(), RunError> {
    let frames = place.frames();
    fs::create_dir_all(&frames).map_err(RunError::io("create", &frames))?;
    if options.obj || options.obj_obstacles {
        let objs = place.objs();
        fs::create_dir_all(&objs).map_err(RunError::io("create", &objs))?;
    }
    Ok(())
}

pub(super) fn write_obstacles(place: &Place, obstacles: &[Arc<Surface>]) -> Result<(), RunError> {
    write_sealed(&place.obstacles(), OBSTACLES, &obstacle_bytes(obstacles))
}

/// The file appears under its name when it is whole.
pub(super) fn write_sealed(path: &Path, kind: Kind, content: &[u8]) -> Result<(), RunError> {
    let file = seal(kind, content).map_err(RunError::io("compress", path))?;
    write_whole(path, &file, Lasting::No)
}
