//! Writing a run folder, a frame at a time.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use cpu_time::ProcessTime;

use super::obj::{cloth_obj, obstacle_obj};
use super::place::{Place, write_whole};
use super::sealed::{FRAME_MAGIC, OBSTACLES_MAGIC, seal};
use super::state::{frame_bytes, obstacle_bytes};
use super::stats::{self, StatsFile};
use super::{RunError, RunInfo, RunReader};
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

/// An open run folder. Dropped at any time, it leaves a run which [`RunWriter::resume`] continues.
pub struct RunWriter {
    place: Place,
    first_frame: i64,
    obstacles: Vec<Arc<Surface>>,
    options: WriteOptions,
    stats: StatsFile,
}

impl RunWriter {
    /// Creates every output before the work starts. The folder may be missing or empty.
    ///
    /// # Errors
    /// If the folder holds a run and `overwrite` is off, or anything else, or cannot be written.
    pub fn create(
        dir: &Path,
        info: &RunInfo,
        obstacles: &[Arc<Surface>],
        options: WriteOptions,
    ) -> Result<Self, RunError> {
        let place = Place { dir: dir.to_owned() };
        place.claim(options.overwrite)?;
        write_whole(&place.info(), &info.to_json())?;
        make_folders(&place, options)?;
        write_sealed(&place.obstacles(), OBSTACLES_MAGIC, &obstacle_bytes(obstacles))?;
        let stats = StatsFile::create(&place.stats())?;
        let first_frame = info.first_frame;
        Ok(Self { place, first_frame, obstacles: obstacles.to_vec(), options, stats })
    }

    /// Goes on writing after frame `last` of a run; later frames are forgotten. `info` is that of
    /// the simulation which goes on. `overwrite` is of no consequence.
    ///
    /// # Errors
    /// If the run comes from other input, has no frame `last`, or cannot be written.
    pub fn resume(
        run: &RunReader,
        info: &RunInfo,
        last: u32,
        options: WriteOptions,
    ) -> Result<Self, RunError> {
        let place = Place { dir: run.dir().to_owned() };
        let found = &run.info().input_hash;
        if *found != info.input_hash {
            return Err(RunError::OtherInput {
                path: place.dir,
                found: found.clone(),
                expected: info.input_hash.clone(),
            });
        }
        run.frame(last)?;
        make_folders(&place, options)?;
        place.forget_after(last)?;
        let stats = resumed_stats(run, &place, last)?;
        let first_frame = run.info().first_frame;
        Ok(Self { place, first_frame, obstacles: run.obstacles(), options, stats })
    }

    /// Frames must come in order. The row of statistics comes last: a frame that has one is
    /// complete.
    pub fn write(&mut self, frame: &Frame) -> Result<(), RunError> {
        let started = ProcessTime::now();
        let shown = i64::from(frame.number) + self.first_frame;
        if self.options.obj {
            for (index, garment) in frame.garments.iter().enumerate() {
                let path = self.place.cloth_obj(shown, index);
                write_whole(&path, cloth_obj(garment).as_bytes())?;
            }
        }
        if self.options.obj_obstacles {
            let placed = self.obstacles.iter().zip(&frame.obstacle_poses);
            for (index, (surface, &pose)) in placed.enumerate() {
                let path = self.place.obstacle_obj(shown, index);
                write_whole(&path, obstacle_obj(surface, pose).as_bytes())?;
            }
        }
        write_sealed(&self.place.frame(frame.number), FRAME_MAGIC, &frame_bytes(frame))?;
        self.stats.append(shown, frame, started.elapsed().as_secs_f64())
    }

    /// Makes sure that the statistics have reached the disk.
    pub fn finish(self) -> Result<(), RunError> {
        self.stats.sync()
    }
}

fn make_folders(place: &Place, options: WriteOptions) -> Result<(), RunError> {
    let frames = place.frames();
    fs::create_dir_all(&frames).map_err(RunError::io("create", &frames))?;
    if options.obj || options.obj_obstacles {
        let objs = place.objs();
        fs::create_dir_all(&objs).map_err(RunError::io("create", &objs))?;
    }
    Ok(())
}

fn write_sealed(path: &Path, magic: &[u8; 8], content: &[u8]) -> Result<(), RunError> {
    let file = seal(magic, content).map_err(RunError::io("compress", path))?;
    write_whole(path, &file)
}

/// Statistics up to `last`: the rows that are there, and those an interruption swallowed from
/// their frames' states.
fn resumed_stats(run: &RunReader, place: &Place, last: u32) -> Result<StatsFile, RunError> {
    let first_frame = run.info().first_frame;
    let last_shown = i64::from(last) + first_frame;
    let mut rows: BTreeMap<i64, String> = stats::rows(&place.stats()).into_iter().collect();
    for &number in run.frames() {
        let shown = i64::from(number) + first_frame;
        if number <= last && !rows.contains_key(&shown) {
            // What writing it took is lost with the row.
            rows.insert(shown, stats::row(shown, &run.frame(number)?, 0.0));
        }
    }
    let mut lines = vec![stats::STATS_COLUMNS.join(",")];
    lines.extend(rows.into_iter().filter(|(shown, _)| *shown <= last_shown).map(|(_, row)| row));
    write_whole(&place.stats(), (lines.join("\n") + "\n").as_bytes())?;
    StatsFile::append_to(&place.stats())
}
