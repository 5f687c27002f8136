//! `shotsilk figure`: pictures that exist already, side by side.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use super::args::parse_count;
use super::output::{self, PendingFile};
use super::sheet::parse_png_path;
use crate::sheet::{FigurePart, figure};

#[derive(Args, Debug)]
pub struct FigureArgs {
    /// The pictures, row by row
    #[arg(value_name = "PNG", required = true)]
    pictures: Vec<PathBuf>,
    /// Text under a picture; the first is the first picture's, and so on
    #[arg(long, value_name = "TEXT")]
    caption: Vec<String>,
    /// The PNG file to write
    #[arg(long, short, value_name = "FILE", value_parser = parse_png_path)]
    out: PathBuf,
    /// Pictures in a row
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = |text: &str| parse_count(text, 1..=64u32))]
    columns: u32,
    /// Width of a picture (px); all are as high as the first
    #[arg(long, value_name = "PX", default_value_t = 480, value_parser = |text: &str| parse_count(text, 64..=4096u32))]
    width: u32,
}

/// # Errors
/// If a picture cannot be read or the figure not be written.
pub fn run(args: &FigureArgs) -> Result<()> {
    let pending = PendingFile::create(&args.out)?;
    let mut parts = Vec::new();
    for (index, path) in args.pictures.iter().enumerate() {
        let picture = image::open(path).with_context(|| format!("cannot read {path:?}"))?;
        let caption = args.caption.get(index).cloned().unwrap_or_default();
        parts.push(FigurePart { picture: picture.to_rgba8(), caption });
    }
    pending.write_small_png(&figure(&parts, args.columns, args.width))?;
    output::print(args.out.display())
}
