//! `shotsilk compare`: one result against another, for people and for continuous integration.

mod bless;
mod pictures;
mod runs;

pub use runs::{page, shaded_difference};

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use image::RgbaImage;

use super::args::parse_frames;
use super::failure::Failure;
use super::log::LogArgs;
use super::output::{self, PendingFile};
use crate::compare::{Comparison, Kind, Tolerance};
use crate::render::AdapterChoice;
use crate::request::FrameRange;
use crate::run::RunReader;

#[derive(Args, Debug)]
pub struct CompareArgs {
    /// The reference: a run, a PNG picture or sheet, or a folder of PNG pictures
    a: PathBuf,
    /// What is held against it, of the same kind
    b: PathBuf,
    /// JSON file of limits; above one of them the exit code is 6
    #[arg(long, value_name = "FILE")]
    tolerance: Option<PathBuf>,
    /// PNG file to write: A, B and where they differ; of several frames or pictures the worst
    #[arg(long, value_name = "FILE", value_parser = parse_png)]
    diff: Option<PathBuf>,
    /// JSON file to write, or - for stdout in place of the table
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
    /// JUnit XML file to write
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// CSV file to write, a row a frame or picture
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Accept B: copy its pictures over those of A
    #[arg(long, conflicts_with_all = ["tolerance", "diff", "json", "junit", "csv"])]
    bless: bool,
    #[command(flatten)]
    runs: RunsArgs,
}

/// What only runs have.
#[derive(Args, Debug)]
struct RunsArgs {
    /// Frames of runs, both ends included, counted from 0; N means 0..N
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    frames: Option<FrameRange>,
    /// A run like A that starts a hair apart: from the first frame on where B is off and it is more
    /// than a quarter as far from A, all is chaos and not judged
    #[arg(long, value_name = "RUN")]
    floor: Option<PathBuf>,
    /// Pixels looked at for each of the shot's, in width and height
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, value_parser = parse_scale)]
    scale: f64,
    /// Compare shaded pictures of the frames as well; a limit of flip asks for it too
    #[arg(long)]
    shaded: bool,
    /// The graphics adapter for shaded pictures: software, hardware, or part of a name
    #[arg(long, default_value = "software")]
    adapter: AdapterChoice,
}

impl RunsArgs {
    /// A flag that was given but means nothing for pictures.
    fn given(&self) -> Option<&'static str> {
        let Self { frames, floor, scale, shaded, adapter: _ } = self;
        [
            (frames.is_some(), "--frames"),
            (floor.is_some(), "--floor"),
            (*scale != 1.0, "--scale"),
            (*shaded, "--shaded"),
        ]
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
    }
}

/// What is written besides the table.
struct Outputs {
    diff: Option<PendingFile>,
    json: Option<PendingFile>,
    junit: Option<PendingFile>,
    csv: Option<PendingFile>,
    json_to_stdout: bool,
}

/// # Errors
/// If an input is bad or an output cannot be written; if a limit is exceeded.
pub fn run(args: &CompareArgs, log: LogArgs) -> Result<()> {
    let are_runs = are_runs(args)?;
    if args.bless {
        return match are_runs {
            true => Err(Failure::Usage("--bless accepts pictures, not runs".into()).into()),
            false => bless::accept(&args.a, &args.b),
        };
    }
    let kind = if are_runs { Kind::Runs } else { Kind::Pictures };
    let tolerance = args.tolerance.as_deref().map(|path| read_tolerance(path, kind)).transpose()?;
    let outputs = Outputs::create(args)?;
    let (comparison, diff) = match are_runs {
        true => runs::compare(args, tolerance, log)?,
        false => pictures::compare(args, tolerance)?,
    };
    outputs.write(&comparison, diff.as_ref())?;
    match comparison.failed().count() {
        0 if comparison.has_passed() => Ok(()),
        0 => Err(Failure::Check(nothing_judged(args)).into()),
        count => {
            let (name, total) = (comparison.kind.item_name(), comparison.items.len());
            let why = format!("{:?} differs from {:?}", comparison.b, comparison.a);
            Err(Failure::Check(format!("{why} in {count} of {total} {name}s")).into())
        }
    }
}

fn nothing_judged(args: &CompareArgs) -> String {
    let floor = args.runs.floor.as_deref().unwrap_or(Path::new(""));
    format!(
        "nothing was judged: from the first frame on, {:?} is more than a quarter as far from {:?} \
         as {:?} is",
        floor.display(),
        args.a.display(),
        args.b.display()
    )
}

/// True for two runs, false for two pictures or two folders of pictures.
fn are_runs(args: &CompareArgs) -> Result<bool> {
    for path in [&args.a, &args.b] {
        fs::metadata(path)
            .with_context(|| format!("cannot read {:?}", path.display()))
            .map_err(bad_input)?;
    }
    let kind = |path: &Path| (RunReader::is_run(path), path.is_dir());
    let kinds = [kind(&args.a), kind(&args.b)];
    if kinds[0] != kinds[1] {
        let name = |(is_run, is_folder)| match (is_run, is_folder) {
            (true, _) => "a run",
            (false, true) => "a folder of pictures",
            (false, false) => "a picture",
        };
        let [a, b] = kinds.map(name);
        let (a_path, b_path) = (args.a.display(), args.b.display());
        let why =
            format!("{a_path:?} is {a} but {b_path:?} is {b}: only like is compared with like");
        return Err(Failure::BadInput(why).into());
    }
    let are_runs = kinds[0].0;
    match args.runs.given() {
        Some(flag) if !are_runs => Err(Failure::Usage(format!("{flag} needs two runs")).into()),
        _ => Ok(are_runs),
    }
}

/// The limits, with a warning of those that mean nothing for what is compared.
fn read_tolerance(path: &Path, kind: Kind) -> Result<Tolerance> {
    let read = || -> Result<Tolerance> {
        let name = path.display().to_string();
        let tolerance = Tolerance::from_json(&name, &fs::read_to_string(path)?)?;
        for metric in tolerance.idle_limits(kind)? {
            let (limited, things) = (metric.name(), kind.name());
            tracing::warn!("{name:?} limits {limited}, which {things} do not have");
        }
        Ok(tolerance)
    };
    read()
        .with_context(|| format!("cannot read the tolerance {:?}", path.display()))
        .map_err(bad_input)
}

/// The same error, known as bad input to the exit code.
fn bad_input(error: anyhow::Error) -> anyhow::Error {
    Failure::BadInput(format!("{error:#}")).into()
}

impl Outputs {
    fn create(args: &CompareArgs) -> Result<Self> {
        let pending = |path: &Option<PathBuf>| path.as_deref().map(PendingFile::create).transpose();
        let json_to_stdout = args.json.as_deref() == Some(Path::new("-"));
        Ok(Self {
            diff: pending(&args.diff)?,
            json: if json_to_stdout { None } else { pending(&args.json)? },
            junit: pending(&args.junit)?,
            csv: pending(&args.csv)?,
            json_to_stdout,
        })
    }

    fn write(self, comparison: &Comparison, diff: Option<&RgbaImage>) -> Result<()> {
        match (self.diff, diff) {
            (Some(file), Some(picture)) => file.write_png(picture)?,
            (Some(file), None) => file.leave_out()?,
            (None, _) => {}
        }
        for (file, text) in [
            (self.json, Comparison::json as fn(&Comparison) -> String),
            (self.junit, Comparison::junit),
            (self.csv, Comparison::csv),
        ] {
            if let Some(file) = file {
                file.write(text(comparison).as_bytes())?;
            }
        }
        match self.json_to_stdout {
            true => output::print(comparison.json().trim_end()),
            false => output::print(comparison.table()),
        }
    }
}

fn parse_png(text: &str) -> Result<PathBuf, String> {
    super::sheet::parse_png_path(text)
}

fn parse_scale(text: &str) -> Result<f64, String> {
    let scale: f64 = text.parse().map_err(|_| format!("{text:?} is not a number"))?;
    match scale > 0.0 && scale <= SCALE_MAX {
        true => Ok(scale),
        false => Err(format!("{scale} is not above 0 and at most {SCALE_MAX}")),
    }
}

/// Sixteen pixels for each of the shot's: enough to see single ones.
const SCALE_MAX: f64 = 4.0;
