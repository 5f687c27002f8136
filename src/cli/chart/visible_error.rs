//! `shotsilk chart SHOT --suite visible-error`: what coarsening costs on screen. The shot is
//! simulated adaptive, view-dependent and uniform, and held against a reference run: uniform with
//! the adaptive run's fine edges, twice the steps, every step solved to its end; and once more from
//! a start that differs by a hair, which tells where chaos takes over.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use image::RgbaImage;

use super::super::args::{ShotArgs, Sizing};
use super::super::compare::{page, shaded_difference};
use super::super::failure::Failure;
use super::super::interrupt::Interrupt;
use super::super::log::LogArgs;
use super::super::output::{self, PendingFile, PendingFolder};
use super::super::progress::{Progress, ProgressMode};
use super::super::shot::Shot;
use crate::chart::{EdgeLengths, FrameFigures, Reference, Study, Subject, uniform_edge_length};
use crate::compare::{Judge, RunPair, visible_error_values};
use crate::render::Headless;
use crate::resample::VisibleError;
use crate::run::{Remainder, RunInfo, RunReader, RunWriter, WriteOptions};
use crate::sim::Frame;

/// The reference's edges are as long as the shortest tenth of the adaptive run's.
const EDGE_PERCENTILE: f64 = 0.1;

/// The reference takes this many times the scene's own steps.
const STEP_FACTOR: u32 = 2;

/// Meant to be enough for every step to end by its tolerance instead; steps for which it was not are
/// counted.
const NEWTON_ITERATIONS: u32 = 50;

/// How far the start of the second reference is moved (m).
const PERTURBATION: f64 = 1e-6;

/// What the suite needs.
pub struct Suite<'a> {
    pub shot: &'a ShotArgs,
    /// The folder that runs and charts are written to; runs that are there are used again.
    pub out: &'a Path,
    /// Draws shaded pictures for FLIP.
    pub gpu: Option<Headless>,
}

/// The files beside the runs.
struct Outputs {
    csv: PendingFile,
    json: PendingFile,
    error_svg: PendingFile,
    speed_svg: PendingFile,
    page: PendingFile,
}

/// The runs, and what there is to know about the reference.
struct Runs {
    reference: RunReader,
    perturbed: RunReader,
    /// View, adaptive, uniform.
    subjects: Vec<(&'static str, RunReader)>,
    about: Reference,
}

/// # Errors
/// If the shot is bad, a simulation fails, an output cannot be written, or the user asks to stop.
pub fn run(suite: Suite<'_>, log: LogArgs) -> Result<()> {
    let base = Shot::open(&with(suite.shot, Sizing::Adaptive, None, &[]))?;
    let folder = PendingFolder::create(suite.out)?;
    let outputs = Outputs::create(&folder)?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let runs = runs(&suite, &base, &interrupt, log)?;
    let Suite { mut gpu, .. } = suite;
    let frames: Vec<u32> = (base.frames.first..=base.frames.last).collect();
    let floors = errors(&runs.reference, &runs.perturbed, &frames, &interrupt)?;
    let mut study =
        Study { shot: base.info.shot.clone(), reference: runs.about.clone(), subjects: Vec::new() };
    for (name, run) in &runs.subjects {
        tracing::info!("measuring {name}");
        let frames = figures(&runs.reference, run, &frames, &floors, gpu.as_mut(), &interrupt)?;
        let (cpu_seconds, face_count) = means(run, base.frames.last)?;
        study.subjects.push(Subject { name: (*name).into(), cpu_seconds, face_count, frames });
    }
    outputs.write(&study, worst_page(&runs, &study)?)?;
    output::print(study.table())
}

impl Outputs {
    fn create(folder: &PendingFolder) -> Result<Self> {
        Ok(Self {
            csv: folder.file("visible-error.csv")?,
            json: folder.file("visible-error.json")?,
            error_svg: folder.file("visible-error.svg")?,
            speed_svg: folder.file("speed-error.svg")?,
            page: folder.file("visible-error.png")?,
        })
    }

    fn write(self, study: &Study, page: Option<RgbaImage>) -> Result<()> {
        let drawn = |svg: std::result::Result<String, Box<dyn std::error::Error>>| {
            svg.map_err(|error| anyhow!("cannot draw the chart: {error}"))
        };
        self.csv.write(study.csv().as_bytes())?;
        self.json.write(study.json().as_bytes())?;
        self.error_svg.write(drawn(study.error_svg())?.as_bytes())?;
        self.speed_svg.write(drawn(study.speed_svg())?.as_bytes())?;
        match page {
            Some(page) => self.page.write_png(&page),
            None => self.page.leave_out(),
        }
    }
}

/// The shot with another sizing and further overrides.
fn with(shot: &ShotArgs, sizing: Sizing, edge_length: Option<f64>, sets: &[String]) -> ShotArgs {
    let sets = shot.sets.iter().chain(sets).cloned().collect();
    ShotArgs { sizing: Some(sizing), edge_length, sets, ..shot.clone() }
}

/// Simulates what is not there yet, the cheap runs first.
fn runs(suite: &Suite<'_>, base: &Shot, interrupt: &Interrupt, log: LogArgs) -> Result<Runs> {
    let simulated = |name: &str, args: &ShotArgs| -> Result<RunReader> {
        let shot = Shot::open(args)?;
        simulated(&shot, &suite.out.join(name), interrupt, log)
    };
    let adaptive = simulated("adaptive", &with(suite.shot, Sizing::Adaptive, None, &[]))?;
    let view = simulated("view", &with(suite.shot, Sizing::View, None, &[]))?;
    let edge_length_wanted = fine_edge_length(&adaptive, base.frames.last)?;
    let garments: Vec<_> = base.scene.garments.iter().map(|g| &g.mesh).collect();
    let [asked, edge_length_mean] = uniform_edge_length(&garments, edge_length_wanted);
    let steps_per_frame = STEP_FACTOR * base.scene.steps_per_frame;
    let mut sets = vec![
        format!("steps_per_frame={steps_per_frame}"),
        format!("dynamics.iterations={NEWTON_ITERATIONS}"),
    ];
    let reference = simulated("reference", &with(suite.shot, Sizing::Uniform, Some(asked), &sets))?;
    let uniform = simulated("uniform", &with(suite.shot, Sizing::Uniform, Some(asked), &[]))?;
    sets.push(format!("start_perturbation={PERTURBATION}"));
    let perturbed = simulated("perturbed", &with(suite.shot, Sizing::Uniform, Some(asked), &sets))?;
    let (cpu_seconds, face_count) = means(&reference, base.frames.last)?;
    let unconverged_steps = unconverged_steps(&reference, base.frames.last)?
        + unconverged_steps(&perturbed, base.frames.last)?;
    if unconverged_steps > 0 {
        tracing::warn!(
            "{unconverged_steps} steps of the references used up their {NEWTON_ITERATIONS} Newton \
             iterations: they are less exact than they are meant to be"
        );
    }
    let about = Reference {
        edge_length_wanted,
        edge_length_mean,
        steps_per_frame,
        newton_iterations: NEWTON_ITERATIONS,
        unconverged_steps,
        perturbation: PERTURBATION,
        face_count: face_count.round() as usize,
        cpu_seconds,
    };
    let subjects = vec![("view", view), ("adaptive", adaptive), ("uniform", uniform)];
    Ok(Runs { reference, perturbed, subjects, about })
}

/// The run in a folder, begun or gone on with if it is not there or not whole.
fn simulated(shot: &Shot, folder: &Path, interrupt: &Interrupt, log: LogArgs) -> Result<RunReader> {
    let Some((mut writer, start)) = begun(shot, folder)? else {
        tracing::info!("using the run {:?}", folder.display());
        return Ok(RunReader::open(folder).map_err(Failure::from)?);
    };
    tracing::info!("simulating {:?}", folder.display());
    let done = start.as_ref().map_or(0, |frame| u64::from(frame.number) + 1);
    let frame_count = u64::from(shot.frames.last) + 1 - done;
    let mut progress = Progress::new(frame_count, ProgressMode::detect(log));
    let result = shot.simulate(start.as_ref(), interrupt, |frame| {
        writer.write(&frame).map_err(Failure::from)?;
        progress.frame(&frame, shot.info.first_frame);
        Ok(())
    });
    progress.finish();
    result.with_context(|| format!("cannot simulate {:?}", folder.display()))?;
    writer.finish().map_err(Failure::from)?;
    Ok(RunReader::open(folder).map_err(Failure::from)?)
}

/// What writes the run, and the frame to go on from if there is one; `None` if the run is whole.
/// A run of another shot is replaced.
fn begun(shot: &Shot, folder: &Path) -> Result<Option<(RunWriter, Option<Frame>)>> {
    let (info, surfaces) = (&shot.info, shot.surfaces());
    let options = WriteOptions { overwrite: true, ..WriteOptions::default() };
    if !holds(folder, info) {
        let writer = RunWriter::create(folder, info, &surfaces, options).map_err(Failure::from)?;
        return Ok(Some((writer, None)));
    }
    let wanted = 0..=shot.frames.last;
    let run = RunWriter::resume(folder, info, &surfaces, wanted, options).map_err(Failure::from)?;
    Ok(match run.remainder {
        Remainder::All => Some((run.writer, None)),
        Remainder::After(frame) => Some((run.writer, Some(*frame))),
        Remainder::Nothing => None,
    })
}

/// Whether a folder holds a run of these very settings by this very program.
fn holds(folder: &Path, wanted: &RunInfo) -> bool {
    RunReader::open(folder).is_ok_and(|run| {
        let found = run.info();
        found.input_hash == wanted.input_hash
            && found.program_version == wanted.program_version
            && found.cpu_features == wanted.cpu_features
    })
}

/// Of the frames up to the last.
fn fine_edge_length(adaptive: &RunReader, last: u32) -> Result<f64> {
    let mut lengths = EdgeLengths::default();
    for &number in adaptive.frames().iter().filter(|&&number| number <= last) {
        lengths.add_frame(&adaptive.frame(number).map_err(Failure::from)?);
    }
    lengths.percentile(EDGE_PERCENTILE).context("the adaptive run has no edges")
}

/// CPU seconds and faces, over the frames after the first up to the last.
fn means(run: &RunReader, last: u32) -> Result<(f64, f64)> {
    let (mut cpu_seconds, mut faces, mut count) = (0.0, 0.0, 0.0f64);
    for &number in run.frames().iter().filter(|&number| (1..=last).contains(number)) {
        let frame = run.frame(number).map_err(Failure::from)?;
        cpu_seconds += frame.report.cpu_seconds;
        faces += frame.face_count() as f64;
        count += 1.0;
    }
    Ok((cpu_seconds / count.max(1.0), faces / count.max(1.0)))
}

/// Over the frames up to the last.
fn unconverged_steps(run: &RunReader, last: u32) -> Result<u64> {
    let mut count = 0;
    for &number in run.frames().iter().filter(|&&number| number <= last) {
        count += run.frame(number).map_err(Failure::from)?.report.counts.unconverged_steps;
    }
    Ok(count)
}

fn stop_if_asked(interrupt: &Interrupt) -> Result<()> {
    match interrupt.requested() {
        Some(signal) => Err(Failure::Interrupted(signal).into()),
        None => Ok(()),
    }
}

fn errors(
    reference: &RunReader,
    other: &RunReader,
    frames: &[u32],
    interrupt: &Interrupt,
) -> Result<Vec<VisibleError>> {
    let mut pair = RunPair::new(reference, other, 1.0).map_err(Failure::from)?;
    let mut error = |&frame: &u32| {
        stop_if_asked(interrupt)?;
        Ok(pair.measure(frame).map_err(Failure::from)?.error)
    };
    frames.iter().map(&mut error).collect()
}

fn figures(
    reference: &RunReader,
    other: &RunReader,
    frames: &[u32],
    floors: &[VisibleError],
    mut gpu: Option<&mut Headless>,
    interrupt: &Interrupt,
) -> Result<Vec<FrameFigures>> {
    let mut pair = RunPair::new(reference, other, 1.0).map_err(Failure::from)?;
    let mut judge = Judge::default();
    let mut all = Vec::new();
    for (&number, &floor) in frames.iter().zip(floors) {
        stop_if_asked(interrupt)?;
        let error = pair.measure(number).map_err(Failure::from)?.error;
        let flip = match (&mut gpu, pair.last_maps()) {
            (Some(gpu), Some(maps)) => Some(shaded_difference(gpu, &pair, maps, number)?),
            _ => None,
        };
        let frame = i64::from(number) + reference.info().first_frame;
        let judged = judge.judged(error, Some(floor), &visible_error_values(&error));
        all.push(FrameFigures { frame, judged, flip });
    }
    Ok(all)
}

/// The frame at which the view-dependent run is farthest off, of those that are judged.
fn worst_page(runs: &Runs, study: &Study) -> Result<Option<RgbaImage>> {
    let (Some((_, run)), Some(subject)) = (runs.subjects.first(), study.subjects.first()) else {
        return Ok(None);
    };
    let worst = subject.judged_frames().max_by(|a, b| a.rms_px().total_cmp(&b.rms_px()));
    let Some(worst) = worst else { return Ok(None) };
    let mut pair = RunPair::new(&runs.reference, run, 1.0).map_err(Failure::from)?;
    let number = worst.frame - runs.reference.info().first_frame;
    page(&mut pair, u32::try_from(number)?)
}
