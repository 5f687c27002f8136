//! Taking up a run that ended before its time, wherever that was: what stands of it, what is made
//! good, and what is left to be done.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;

use super::lock::Lock;
use super::place::{Lasting, Place, write_whole};
use super::stats::{self, STATS_COLUMNS, StatsFile};
use super::write::{make_folders, write_obstacles};
use super::{RunError, RunInfo, RunReader, RunWriter, WriteOptions};
use crate::scene::Surface;
use crate::sim::Frame;

/// A run that can be gone on with.
pub struct ResumedRun {
    pub writer: RunWriter,
    pub remainder: Remainder,
    /// What whoever asked for it should know, in words.
    pub warnings: Vec<String>,
}

/// What is left to be done of a run.
#[derive(Clone, Debug)]
pub enum Remainder {
    /// Everything: no state is there to go on from.
    All,
    /// The frames after this one.
    After(Box<Frame>),
    Nothing,
}

impl RunWriter {
    /// Opens a run again of which the frames `wanted` are to be there in the end; `info`,
    /// `obstacles` and `options` are those of a new run. It goes on after the last of them up to
    /// which none is missing or damaged, and what is there of later ones is forgotten. Lost rows of
    /// the statistics and OBJ files of the frames that stay are written again. Where there is nothing
    /// yet, a run is begun.
    ///
    /// # Errors
    /// If the folder holds something that is no run, a run that has lost its `run.json`, one of other
    /// input or another version of the program, one that has only later frames of those wanted, or
    /// one that another program is writing.
    pub fn resume(
        dir: &Path,
        info: &RunInfo,
        obstacles: &[Arc<Surface>],
        wanted: RangeInclusive<u32>,
        options: WriteOptions,
    ) -> Result<ResumedRun, RunError> {
        let place = Place { dir: dir.to_owned() };
        if dir.exists() && !dir.is_dir() {
            return Err(RunError::NotARun { path: place.dir });
        }
        if place.is_vacant()? || place.is_begun()? {
            let writer = Self::create(dir, info, obstacles, options)?;
            return Ok(ResumedRun { writer, remainder: Remainder::All, warnings: Vec::new() });
        }
        if place.is_broken()? {
            return Err(RunError::Broken { path: place.dir });
        }
        if !RunInfo::is_at(&place.info()) {
            return Err(RunError::NotARun { path: place.dir });
        }
        let lock = Lock::take(&place.lock())?;
        let mut warnings = checked(&place, info)?;
        make_folders(&place, options)?;
        place.remove_partials()?;
        // The obstacles are known: it is no loss if their file is not there or damaged.
        if RunReader::open(dir).is_err() {
            write_obstacles(&place, obstacles)?;
        }
        let run = RunReader::open(dir)?;
        let remainder = remainder(&run, wanted, &mut warnings)?;
        match &remainder {
            Remainder::Nothing => {}
            Remainder::All => place.forget_after(None, info.first_frame)?,
            Remainder::After(frame) => place.forget_after(Some(frame.number), info.first_frame)?,
        }
        let run = RunReader::open(dir)?;
        let writer = Self {
            stats: resumed_stats(&run, &place)?,
            place,
            first_frame: info.first_frame,
            obstacles: obstacles.to_vec(),
            options,
            _lock: lock,
        };
        writer.write_missing_obj(&run)?;
        Ok(ResumedRun { writer, remainder, warnings })
    }

    /// OBJ files of frames that are there.
    fn write_missing_obj(&self, run: &RunReader) -> Result<(), RunError> {
        let garments = if self.options.obj { run.info().garments.len() } else { 0 };
        let obstacles = if self.options.obj_obstacles { self.obstacles.len() } else { 0 };
        for &number in run.frames() {
            let shown = self.shown(number);
            let cloth = (0..garments).map(|index| self.place.cloth_obj(shown, index));
            let solid = (0..obstacles).map(|index| self.place.obstacle_obj(shown, index));
            if cloth.chain(solid).any(|path| !path.exists()) {
                self.write_obj(&run.frame(number)?)?;
            }
        }
        Ok(())
    }
}

/// Whether the run can be gone on with; returns what may make a difference.
fn checked(place: &Place, info: &RunInfo) -> Result<Vec<String>, RunError> {
    let found = RunInfo::read(&place.info())?;
    let path = place.dir.clone();
    if found.input_hash != info.input_hash {
        let (found, expected) = (found.input_hash, info.input_hash.clone());
        return Err(RunError::OtherInput { path, found, expected });
    }
    if found.program_version != info.program_version {
        let (found, expected) = (found.program_version, info.program_version.clone());
        return Err(RunError::OtherVersion { path, found, expected });
    }
    let mut warnings = Vec::new();
    if found.cpu_features != info.cpu_features {
        warnings.push(format!(
            "the run was begun on another kind of processor ({}) than this one ({}): the bits may \
             differ from those of a run on one of them",
            found.cpu_features.join(" "),
            info.cpu_features.join(" ")
        ));
    }
    Ok(warnings)
}

/// What is left of the frames `wanted`. Damaged frames are named in the warnings.
fn remainder(
    run: &RunReader,
    wanted: RangeInclusive<u32>,
    warnings: &mut Vec<String>,
) -> Result<Remainder, RunError> {
    let (first, last) = wanted.into_inner();
    let held = run.frames();
    match held.iter().find(|&&number| number >= first) {
        Some(&held) if held > first => {
            let path = run.dir().to_owned();
            return Err(RunError::BeginsLater { path, held, wanted: first });
        }
        _ => {}
    }
    // The first frame that is missing or damaged.
    let mut next = first;
    for &number in held.iter().filter(|&&number| number >= first) {
        if number != next || noted(run.check_frame(number), warnings)?.is_none() {
            break;
        }
        next += 1;
    }
    if next > last {
        return Ok(Remainder::Nothing);
    }
    for &number in held.iter().rev().filter(|&&number| number < next) {
        if let Some(frame) = noted(run.frame(number), warnings)? {
            return Ok(Remainder::After(Box::new(frame)));
        }
    }
    Ok(Remainder::All)
}

/// `None` and a warning for a damaged file.
fn noted<T>(
    outcome: Result<T, RunError>,
    warnings: &mut Vec<String>,
) -> Result<Option<T>, RunError> {
    match outcome {
        Ok(value) => Ok(Some(value)),
        Err(error) if error.is_damage() => {
            let cause = std::error::Error::source(&error);
            let why = cause.map(|cause| format!(": {cause}")).unwrap_or_default();
            warnings.push(format!("{error}{why}: the frame is computed again"));
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Statistics of the frames that are there: the rows that are whole, and those an interruption
/// swallowed from their frames' states.
fn resumed_stats(run: &RunReader, place: &Place) -> Result<StatsFile, RunError> {
    let path = place.stats();
    let mut rows: BTreeMap<i64, String> = stats::rows(&path).into_iter().collect();
    let mut lines = vec![STATS_COLUMNS.join(",")];
    for &number in run.frames() {
        let shown = i64::from(number) + run.info().first_frame;
        lines.push(match rows.remove(&shown) {
            Some(row) => row,
            // What writing it took is lost with the row.
            None => stats::row(shown, &run.frame(number)?, 0.0),
        });
    }
    let text = lines.join("\n") + "\n";
    if std::fs::read(&path).ok().as_deref() != Some(text.as_bytes()) {
        write_whole(&path, text.as_bytes(), Lasting::No)?;
    }
    StatsFile::append_to(&path)
}
