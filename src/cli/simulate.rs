//! `shotsilk simulate`: a shot into a run folder.

use std::path::{Path, PathBuf};

use anyhow::{Context, Error, Result};
use clap::Args;

use super::args::ShotArgs;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::output;
use super::progress::{Progress, ProgressMode};
use super::shot::{Shot, set_threads};
use super::summary::Summary;
use crate::run::{Remainder, RunWriter, WriteOptions};
use crate::sim::{Frame, SizingMode};

#[derive(Args, Debug)]
pub struct SimulateArgs {
    #[command(flatten)]
    shot: ShotArgs,
    /// The run folder to write
    #[arg(long, short, value_name = "FOLDER")]
    out: PathBuf,
    /// Replace a run that the folder holds
    #[arg(long)]
    overwrite: bool,
    /// Go on with a run that was interrupted, killed, or asked for fewer frames; the bits are those
    /// of a run that never stopped. All other arguments as before. Where there is no run yet, begin one
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Write every garment at every frame as OBJ
    #[arg(long)]
    obj: bool,
    /// Write every obstacle at every frame as OBJ
    #[arg(long)]
    obj_obstacles: bool,
}

/// # Errors
/// If the shot is bad, the folder cannot be written, the simulation fails or is interrupted.
pub fn run(args: &SimulateArgs, log: LogArgs) -> Result<()> {
    set_threads(args.shot.threads)?;
    let shot = Shot::open(&args.shot)?;
    if shot.settings.sizing == SizingMode::View && shot.scene.viewers.is_empty() {
        tracing::warn!("there is no camera, so nothing is coarsened: name one with --camera");
    }
    let options = WriteOptions {
        obj: args.obj,
        obj_obstacles: args.obj_obstacles,
        overwrite: args.overwrite,
    };
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let (mut writer, start) = if args.resume {
        let Some(resumed) = resumed(&args.out, &shot, options)? else {
            return output::print(args.out.display());
        };
        resumed
    } else {
        let writer = RunWriter::create(&args.out, &shot.info, &shot.surfaces(), options);
        (writer.map_err(Failure::from)?, None)
    };
    let done = start.as_ref().map_or(0, |frame| u64::from(frame.number) + 1);
    let frame_count = u64::from(shot.frames.last) + 1 - done;
    let mut progress = Progress::new(frame_count, ProgressMode::detect(log));
    let mut summary = Summary::default();
    let result = shot.simulate(start.as_ref(), &interrupt, |frame| {
        if shot.frames.contains(frame.number) {
            writer.write(&frame).map_err(Failure::from)?;
        }
        summary.add(&frame, shot.scene.steps_per_frame);
        progress.frame(&frame, shot.info.first_frame);
        Ok(())
    });
    progress.finish();
    tracing::info!("{summary}");
    result
        .map_err(pausing)
        .with_context(|| format!("cannot simulate the shot {:?}", shot.info.shot))?;
    writer.finish().map_err(Failure::from)?;
    output::print(args.out.display())
}

/// The run taken up again, and the frame to go on from if there is one; `None` if there is nothing
/// to be done.
fn resumed(
    folder: &Path,
    shot: &Shot,
    options: WriteOptions,
) -> Result<Option<(RunWriter, Option<Frame>)>> {
    let wanted = shot.frames.first..=shot.frames.last;
    let run = RunWriter::resume(folder, &shot.info, &shot.surfaces(), wanted, options)
        .map_err(Failure::from)?;
    for warning in &run.warnings {
        tracing::warn!("{warning}");
    }
    let shown = |number: u32| i64::from(number) + shot.info.first_frame;
    Ok(match run.remainder {
        Remainder::All => {
            tracing::info!("no frame is there to go on from: starting at frame {}", shown(0));
            Some((run.writer, None))
        }
        Remainder::After(frame) => {
            tracing::info!("going on after frame {}", shown(frame.number));
            Some((run.writer, Some(*frame)))
        }
        Remainder::Nothing => {
            let [first, last] = [shot.frames.first, shot.frames.last].map(shown);
            tracing::info!("nothing to be done: frames {first} to {last} are there");
            run.writer.finish().map_err(Failure::from)?;
            None
        }
    })
}

/// An interruption of a run says how to go on.
fn pausing(error: Error) -> Error {
    match error.downcast() {
        Ok(Failure::Interrupted(signal)) => Failure::Paused(signal).into(),
        Ok(failure) => failure.into(),
        Err(error) => error,
    }
}
