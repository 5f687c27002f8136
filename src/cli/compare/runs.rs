//! Two runs, as the shot camera sees them.

use anyhow::{Context, Result};
use image::RgbaImage;

use super::{CompareArgs, RunsArgs};
use crate::cli::failure::Failure;
use crate::cli::interrupt::Interrupt;
use crate::cli::log::LogArgs;
use crate::cli::progress::{Progress, ProgressMode};
use crate::compare::{
    Comparison, FlipMap, Item, Judged, Kind, Metric, RunPair, Tolerance, common_frames, error_page,
    visible_error_values,
};
use crate::render::{ColourBy, Headless, PictureOptions};
use crate::resample::ClothMap;
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
    let mut floor_pair = floor
        .as_ref()
        .map(|f| RunPair::new(&a, f, args.runs.scale))
        .transpose()
        .map_err(Failure::from)?;
    warn_of_differences(&pair, &a, &b)?;
    let frames = frames(&args.runs, &a, &b, floor.as_ref())?;
    let is_shaded = args.runs.shaded || tolerance.is_some_and(|t| t.flip.is_some());
    let mut gpu =
        is_shaded.then(|| Headless::new(&args.runs.adapter)).transpose().map_err(Failure::from)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let mut progress = Progress::new(frames.len() as u64, ProgressMode::detect(log));
    let mut items = Vec::new();
    let mut worst: Option<(f64, u32)> = None;
    for &number in &frames {
        if let Some(signal) = interrupt.requested() {
            return Err(Failure::Interrupted(signal).into());
        }
        let error = pair.measure(number).map_err(Failure::from)?.error;
        let floor = match &mut floor_pair {
            Some(pair) => Some(pair.measure(number).map_err(Failure::from)?.error),
            None => None,
        };
        let judged = Judged { error, floor };
        let mut item = item(judged, i64::from(number) + a.info().first_frame);
        if let (Some(gpu), Some(maps)) = (&mut gpu, pair.last_maps()) {
            item.values.push((Metric::Flip, Some(shaded_difference(gpu, &pair, maps, number)?)));
            item.values.sort_by_key(|(metric, _)| *metric);
        }
        if worst.is_none_or(|(most, _)| error.displacement.rms > most) {
            worst = Some((error.displacement.rms, number));
        }
        if let Some([reference, _]) = pair.last_maps() {
            progress.frame(reference.frame(), a.info().first_frame);
        }
        items.push(item);
    }
    progress.finish();
    let [a, b] = [&args.a, &args.b].map(|path| path.display().to_string());
    let page = match worst.filter(|_| args.diff.is_some()) {
        Some((_, number)) => page(&mut pair, number)?,
        None => None,
    };
    Ok((Comparison { a, b, kind: Kind::Runs, tolerance, items }, page))
}

fn item(judged: Judged, shown: i64) -> Item {
    Item {
        name: shown.to_string(),
        values: visible_error_values(&judged.error),
        fault: None,
        floor_rms_px: judged.floor.map(|floor| floor.displacement.rms),
        is_chaos: judged.is_chaos(),
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

/// The frames asked for, which all runs must hold; without a wish those that they have in common.
fn frames(
    args: &RunsArgs,
    a: &RunReader,
    b: &RunReader,
    floor: Option<&RunReader>,
) -> Result<Vec<u32>> {
    let runs: Vec<&RunReader> = [a, b].into_iter().chain(floor).collect();
    let common = common_frames(&runs);
    if let Some(range) = args.frames {
        for run in runs {
            for number in [range.first, range.last] {
                run.frame(number).map_err(Failure::from)?;
            }
        }
        return Ok(common.into_iter().filter(|&frame| range.contains(frame)).collect());
    }
    if common.is_empty() {
        return Err(Failure::BadInput("the runs have no frame in common".into()).into());
    }
    let left_out = runs.iter().map(|run| run.frames().len() - common.len()).max().unwrap_or(0);
    if left_out > 0 {
        tracing::warn!("{left_out} frames are not in all runs and are left out");
    }
    Ok(common)
}
