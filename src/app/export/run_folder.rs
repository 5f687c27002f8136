//! A run folder of frames that are there already.

use anyhow::{Result, anyhow, ensure};

use super::Task;
use super::job::Outcome;
use super::place::check_folder;
use super::stills::what_stays;
use crate::run::{RunError, RunInfo, RunWriter, WriteOptions};

/// Frames of one run, as `simulate` writes them. A folder that holds a run already is left alone.
///
/// # Errors
/// If other settings than the run's made one of the frames, a frame is missing, or the folder cannot be
/// written: the frames before stay.
pub(super) fn run(task: Task<'_>, frames: &[u32]) -> Result<Outcome> {
    let info = task.supply.info();
    for &number in frames {
        check_settings(task, &info, number)?;
    }
    let surfaces = task.supply.surfaces();
    check_folder(&task.request.to)?;
    let mut writer = RunWriter::create(&task.request.to, &info, &surfaces, WriteOptions::default())
        .map_err(refused)?;
    for &number in frames {
        if task.ticket.is_cancelled() {
            writer.finish()?;
            return Ok(Outcome::Cancelled(what_stays(task)));
        }
        let frame = task.frame(&info, number)?;
        // Whoever edits while this goes on makes frames of other settings.
        check_settings(task, &info, number)?;
        writer.write(&frame)?;
        task.ticket.step();
    }
    writer.finish()?;
    Ok(Outcome::Whole)
}

/// Without the options that `simulate` has and an export has not.
fn refused(error: RunError) -> anyhow::Error {
    match error {
        RunError::AlreadyARun { path } => {
            anyhow!("{:?} holds a run already: choose another folder", path.display())
        }
        other => other.into(),
    }
}

fn check_settings(task: Task<'_>, info: &RunInfo, number: u32) -> Result<()> {
    let found = task.settings_hash(info, number)?;
    let shown = i64::from(number) + info.first_frame;
    ensure!(
        found == info.input_hash,
        "frame {shown} was made with other settings (hash {}) than the shot has now (hash {}): a run \
         folder holds one simulation, so simulate the shot again from the start first",
        digits(&found),
        digits(&info.input_hash)
    );
    Ok(())
}

/// As many as tell hashes apart.
fn digits(hash: &str) -> String {
    hash.chars().take(12).collect()
}
