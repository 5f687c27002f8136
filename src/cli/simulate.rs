//! `shotsilk simulate`: a shot into a run folder.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use super::args::ShotArgs;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::output;
use super::progress::{Progress, ProgressMode};
use super::shot::{Shot, set_threads};
use super::summary::Summary;
use crate::run::{RunWriter, WriteOptions};
use crate::sim::SizingMode;

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
    let mut writer = RunWriter::create(&args.out, &shot.info, &shot.surfaces(), options)
        .map_err(Failure::from)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let frame_count = u64::from(shot.frames.last) + 1;
    let mut progress = Progress::new(frame_count, ProgressMode::detect(log));
    let mut summary = Summary::default();
    let result = shot.simulate(&interrupt, |frame| {
        if shot.frames.contains(frame.number) {
            writer.write(&frame).map_err(Failure::from)?;
        }
        summary.add(&frame, shot.scene.steps_per_frame);
        progress.frame(&frame, shot.info.first_frame);
        Ok(())
    });
    progress.finish();
    tracing::info!("{summary}");
    result.with_context(|| format!("cannot simulate the shot {:?}", shot.info.shot))?;
    writer.finish().map_err(Failure::from)?;
    output::print(args.out.display())
}
