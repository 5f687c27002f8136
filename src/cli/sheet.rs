//! `shotsilk sheet`: a contact sheet.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use super::args::{FRAME_MAX, ShotArgs, parse_count};
use super::failure::Failure;
use super::footage::Footage;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::output::{self, PendingFile};
use super::pictures::{PictureArgs, Studio};
use crate::render::Headless;
use crate::run::RunInfo;
use crate::sheet::{Caption, SheetItem, SheetOptions, compose};
use crate::sim::Frame;

#[derive(Args, Debug)]
pub struct SheetArgs {
    #[command(flatten)]
    shot: ShotArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    /// The PNG file to write
    #[arg(long, short, value_name = "FILE", value_parser = parse_png_path)]
    out: PathBuf,
    /// Show every N-th frame
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = |text: &str| parse_count(text, 1..=FRAME_MAX))]
    every: u32,
    /// Width of a picture on the sheet (px)
    #[arg(long, value_name = "PX", default_value_t = 400, value_parser = |text: &str| parse_count(text, 64..=4096u32))]
    thumbnail_width: u32,
    /// Pairs of pictures in a row; without it as many as suit the sheet's shape
    #[arg(long, value_name = "N", value_parser = |text: &str| parse_count(text, 1..=64u32))]
    columns: Option<u32>,
    /// Leave the seconds out of the captions: sheets of equal runs are then equal
    #[arg(long)]
    no_seconds: bool,
}

/// Small pictures want fainter edges.
const WIRE_STRENGTH: f32 = 0.4;

/// # Errors
/// If shot, run, output or adapter are bad, or the simulation fails or is interrupted.
pub fn run(args: &SheetArgs, log: LogArgs) -> Result<()> {
    super::shot::set_threads(args.shot.threads)?;
    let gpu = Headless::new(&args.pictures.adapter).map_err(Failure::from)?;
    let pending = PendingFile::create(&args.out)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let footage = Footage::open(&args.shot, args.every, &interrupt, log)?;
    let mut studio = Studio::new(&footage, gpu, &args.pictures, Some(args.thumbnail_width))?;
    if !args.pictures.no_wireframe {
        studio.options_mut().wire_strength = WIRE_STRENGTH;
    }
    let mut items = Vec::new();
    for &number in footage.frames() {
        if let Some(signal) = interrupt.requested() {
            return Err(Failure::Interrupted(signal).into());
        }
        let frame = footage.frame(number)?;
        items.push(SheetItem {
            shot: studio.shot(&frame)?,
            witness: studio.witness(&frame)?,
            caption: caption(&frame, footage.info(), args),
        });
    }
    let options = SheetOptions {
        title: footage.info().shot.clone(),
        subtitle: subtitle(&footage),
        colour_by: studio.colour_by(),
        thumbnail_width: args.thumbnail_width,
        pairs_per_row: args.columns,
    };
    pending.write_png(&compose(&items, &options))?;
    output::print(args.out.display())
}

pub(super) fn parse_png_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        true => Ok(path),
        false => Err("it is a PNG file: let its name end in .png".to_owned()),
    }
}

fn caption(frame: &Frame, info: &RunInfo, args: &SheetArgs) -> Caption {
    Caption {
        frame: i64::from(frame.number) + info.first_frame,
        face_count: frame.face_count(),
        wall_seconds: (!args.no_seconds).then(|| frame.report.stages.total()),
        view_factor_mean: (info.sizing_mode == "view").then_some(frame.report.view_factor_mean),
    }
}

fn subtitle(footage: &Footage) -> String {
    let info = footage.info();
    let shown = |f: Option<&u32>| f.map_or(0, |&f| i64::from(f) + info.first_frame);
    let (first, last) = (shown(footage.frames().first()), shown(footage.frames().last()));
    format!("{} sizing, frames {first} to {last}, {} fps", info.sizing_mode, info.fps)
}
