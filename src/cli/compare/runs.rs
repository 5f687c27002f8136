//! Two runs, as the shot camera sees them.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use image::RgbaImage;

use super::{CompareArgs, RunsArgs};
use crate::cli::failure::Failure;
use crate::cli::interrupt::Interrupt;
use crate::cli::log::LogArgs;
use crate::cli::progress::{Progress, ProgressMode};
use crate::compare::{
    Comparison, Fault, FlipMap, Item, Judge, Judged, Kind, Metric, RunPair, Tolerance, Value,
    error_page, frames_of_either, visible_error_values,
};
use crate::render::{ColourBy, Headless, PictureOptions};
use crate::resample::{ClothMap, VisibleError};
use crate::run::RunReader;

/// The comparison, and a page of the worst frame.
pub fn compare(
    args: &CompareArgs,
    tolerance: Option<Tolerance>,
    log: LogArgs,
) -> Result<(Comparison, Option<RgbaImage>)> {
    let open = |path| RunReader::open(path).map_err(Failure::from);
    let (a, b) = (open(&args.a)?, open(&args.b)?);
    let floor = args.runs.floor.as_deref().map(open).transpose()?;
    let mut pair = RunPair::new(&a, &b, args.runs.scale).map_err(Failure::from)?;
    warn_of_differences(&pair, &a, &b)?;
    let frames = frames(&args.runs, &a, &b)?;
    let mut floor =
        floor.as_ref().map(|run| Floor::new(&a, run, &args.runs, &frames)).transpose()?;
    let is_shaded = args.runs.shaded || tolerance.is_some_and(|t| t.flip.is_some());
    let mut gpu =
        is_shaded.then(|| Headless::new(&args.runs.adapter)).transpose().map_err(Failure::from)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let mut progress = Progress::new(frames.len() as u64, ProgressMode::detect(log));
    let mut judge = Judge::new(tolerance);
    let mut items = Vec::new();
    let mut worst: Option<(f64, u32)> = None;
    for (&number, &fault) in &frames {
        if let Some(signal) = interrupt.requested() {
            return Err(Failure::Interrupted(signal).into());
        }
        let name = (i64::from(number) + a.info().first_frame).to_string();
        if fault.is_some() {
            items.push(Item { name, fault, ..Item::default() });
            continue;
        }
        let error = pair.measure(number).map_err(Failure::from)?.error;
        let floor = floor.as_mut().map(|floor| floor.error(number)).transpose()?.flatten();
        let mut values = visible_error_values(&error);
        if let (Some(gpu), Some(maps)) = (&mut gpu, pair.last_maps()) {
            values.push((Metric::Flip, Some(shaded_difference(gpu, &pair, maps, number)?)));
            values.sort_by_key(|(metric, _)| *metric);
        }
        items.push(item(name, judge.judged(error, floor, &values), values));
        if worst.is_none_or(|(most, _)| error.displacement.rms > most) {
            worst = Some((error.displacement.rms, number));
        }
        if let Some([reference, _]) = pair.last_maps() {
            progress.frame(reference.frame(), a.info().first_frame);
        }
    }
    progress.finish();
    let [a, b] = [&args.a, &args.b].map(|path| path.display().to_string());
    let page = match worst.filter(|_| args.diff.is_some()) {
        Some((_, number)) => page(&mut pair, number)?,
        None => None,
    };
    Ok((Comparison { a, b, kind: Kind::Runs, tolerance, items }, page))
}

fn item(name: String, judged: Judged, values: Vec<Value>) -> Item {
    let Judged { floor, is_chaos, .. } = judged;
    let floor_rms_px = floor.map(|floor| floor.displacement.rms);
    Item { name, values, fault: None, floor_rms_px, is_chaos }
}

/// The reference and a run that started a hair apart.
struct Floor<'a> {
    pair: RunPair<'a>,
    run: &'a RunReader,
}

impl<'a> Floor<'a> {
    fn new(a: &'a RunReader, run: &'a RunReader, args: &RunsArgs, frames: &Frames) -> Result<Self> {
        let pair = RunPair::new(a, run, args.scale).map_err(Failure::from)?;
        let floor = Self { pair, run };
        let is_missing =
            |&(&number, fault): &(&u32, &Option<Fault>)| fault.is_none() && !floor.has(number);
        let missing = frames.iter().filter(is_missing).count();
        if missing > 0 {
            let run = run.dir().display().to_string();
            tracing::warn!(
                "{run:?} lacks {missing} frames: they have no floor, and are judged unless chaos \
                 comes before them"
            );
        }
        Ok(floor)
    }

    fn has(&self, number: u32) -> bool {
        self.run.frames().binary_search(&number).is_ok()
    }

    /// `None` at a frame that the run lacks.
    fn error(&mut self, number: u32) -> Result<Option<VisibleError>> {
        if !self.has(number) {
            return Ok(None);
        }
        Ok(Some(self.pair.measure(number).map_err(Failure::from)?.error))
    }
}

/// The error as colour, beside both runs.
///
/// # Errors
/// If the frame cannot be read.
pub fn page(pair: &mut RunPair<'_>, number: u32) -> Result<Option<RgbaImage>> {
    let measured = pair.measure(number).map_err(Failure::from)?;
    let view = pair.view(number);
    Ok(pair.last_maps().map(|maps| {
        error_page(&measured, maps.each_ref().map(ClothMap::frame), pair.surfaces(), &view)
    }))
}

/// Mean FLIP of the two frames in plain colours, in as many pixels as are looked at.
///
/// # Errors
/// If the adapter fails.
pub fn shaded_difference(
    gpu: &mut Headless,
    pair: &RunPair<'_>,
    maps: &[ClothMap; 2],
    number: u32,
) -> Result<f64> {
    let view = pair.view(number);
    let options = PictureOptions {
        size: Some(pair.size(&view)),
        colour_by: ColourBy::Plain,
        wire_strength: 0.0,
        ..PictureOptions::default()
    };
    let mut picture = |map: &ClothMap| {
        gpu.picture(map.frame(), pair.surfaces(), &view, &options).map_err(Failure::from)
    };
    let [reference, other] = maps;
    Ok(FlipMap::new(&picture(reference)?, &picture(other)?).mean())
}

fn warn_of_differences(pair: &RunPair<'_>, a: &RunReader, b: &RunReader) -> Result<()> {
    let [a_dir, b_dir] = [a, b].map(|run| run.dir().display().to_string());
    if !pair.has_one_camera().map_err(Failure::from)? {
        tracing::warn!("{b_dir:?} was made for another camera: both are seen by that of {a_dir:?}");
    }
    if a.info().shot != b.info().shot {
        let [a, b] = [&a.info().shot, &b.info().shot];
        tracing::warn!("{b_dir:?} is of the shot {b:?}, {a_dir:?} of {a:?}");
    }
    Ok(())
}

/// The frames to look at, and what keeps one from being compared.
type Frames = BTreeMap<u32, Option<Fault>>;

/// The frames asked for, each of which a run must hold; without a wish those of either.
fn frames(args: &RunsArgs, a: &RunReader, b: &RunReader) -> Result<Frames> {
    let mut frames = frames_of_either(a, b);
    if let Some(range) = args.frames {
        for number in range.first..=range.last {
            if !frames.contains_key(&number) {
                a.frame(number).map_err(Failure::from)?;
            }
        }
        frames.retain(|&number, _| range.contains(number));
    } else if frames.values().all(Option::is_some) {
        return Err(Failure::BadInput("the runs have no frame in common".into()).into());
    }
    Ok(frames)
}
