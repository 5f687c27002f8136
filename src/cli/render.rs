//! `shotsilk render`: PNG frames.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use super::args::{FRAME_MAX, ShotArgs, parse_count};
use super::failure::Failure;
use super::footage::Footage;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::output::{self, PendingFolder};
use super::pictures::{PictureArgs, Studio};
use super::progress::{Progress, ProgressMode};
use crate::render::{Headless, screen_edges};
use crate::sim::Frame;

#[derive(Args, Debug)]
pub struct RenderArgs {
    #[command(flatten)]
    shot: ShotArgs,
    #[command(flatten)]
    pictures: PictureArgs,
    /// The folder to write, as FFFF.shot.png and FFFF.witness.png
    #[arg(long, short, value_name = "FOLDER")]
    out: PathBuf,
    /// Which view to draw
    #[arg(long, value_enum, default_value_t = Views::Both)]
    view: Views,
    /// Draw every N-th frame
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = |text: &str| parse_count(text, 1..=FRAME_MAX))]
    every: u32,
    /// Width of the pictures (px); without it the shot's own
    #[arg(long, value_name = "PX", value_parser = |text: &str| parse_count(text, 16..=16384u32))]
    width: Option<u32>,
    /// Draw the legend of the colours into the pictures
    #[arg(long)]
    legend: bool,
    /// Print how long the visible edges are at each frame, as CSV: in the cloth (m), on the image (px)
    #[arg(long)]
    edge_lengths: bool,
}

/// `--view`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Views {
    Shot,
    Witness,
    Both,
}

/// Height of a legend's text (px).
const LEGEND_PX: f32 = 14.0;

/// # Errors
/// If shot, run, folder or adapter are bad, or the simulation fails or is interrupted.
pub fn run(args: &RenderArgs, log: LogArgs) -> Result<()> {
    super::shot::set_threads(args.shot.threads)?;
    let gpu = Headless::new(&args.pictures.adapter).map_err(Failure::from)?;
    let folder = PendingFolder::create(&args.out)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let footage = Footage::open(&args.shot, args.every, &interrupt, log)?;
    let mut studio = Studio::new(&footage, gpu, &args.pictures, args.width)?;
    studio.options_mut().legend_px = args.legend.then_some(LEGEND_PX);
    let mut lengths = vec!["frame,faces,visible_faces,edge_length_m,edge_length_px".to_owned()];
    let mut progress = Progress::new(footage.frames().len() as u64, ProgressMode::detect(log));
    for &number in footage.frames() {
        if let Some(signal) = interrupt.requested() {
            return Err(Failure::Interrupted(signal).into());
        }
        let frame = footage.frame(number)?;
        let shown = i64::from(number) + footage.info().first_frame;
        if args.view != Views::Witness {
            folder.file(&format!("{shown:04}.shot.png"))?.write_png(&studio.shot(&frame)?)?;
        }
        if args.view != Views::Shot {
            folder.file(&format!("{shown:04}.witness.png"))?.write_png(&studio.witness(&frame)?)?;
        }
        if args.edge_lengths {
            lengths.push(edge_lengths(&frame, &footage));
        }
        progress.frame(&frame, footage.info().first_frame);
    }
    progress.finish();
    output::print(args.out.display())?;
    if args.edge_lengths { output::print(lengths.join("\n")) } else { Ok(()) }
}

/// A row of the table that `--edge-lengths` prints; empty where nothing is visible.
fn edge_lengths(frame: &Frame, footage: &Footage) -> String {
    let view = footage.camera().view(f64::from(frame.number));
    let shown = i64::from(frame.number) + footage.info().first_frame;
    let faces = frame.face_count();
    match screen_edges(&frame.garments, &view) {
        None => format!("{shown},{faces},0,,"),
        Some(edges) => format!(
            "{shown},{faces},{},{:.6},{:.3}",
            edges.face_count, edges.length, edges.length_px
        ),
    }
}
