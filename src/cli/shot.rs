//! From the arguments to a shot that can be simulated.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};

use super::args::{FrameRange, ShotArgs};
use super::failure::Failure;
use super::interrupt::Interrupt;
use crate::own_shot::own_shot;
use crate::run::{InputHasher, RUN_FORMAT, RunInfo, cpu_features};
use crate::scene::{
    EmbeddedFiles, FileSource, FileSystem, LoadOptions, LoadedShot, Scene, Surface, load,
};
use crate::sim::{Frame, SimSettings, Simulation};

/// A loaded shot and which of its frames are wanted.
pub struct Shot {
    pub scene: Arc<Scene>,
    pub settings: SimSettings,
    pub frames: FrameRange,
    pub info: RunInfo,
}

impl Shot {
    /// # Errors
    /// If the shot cannot be loaded, or does not say where it ends.
    pub fn open(args: &ShotArgs) -> Result<Self> {
        let (path, source) = shot_and_source(args)?;
        let options = LoadOptions {
            shot: path.clone(),
            camera: args.camera.clone(),
            sets: args.sets.clone(),
            fps: args.fps,
        };
        let loaded = load(&options, source.as_ref()).map_err(Failure::from)?;
        for warning in &loaded.warnings {
            tracing::warn!("{warning}");
        }
        let frames = frames(args, &loaded.scene)
            .with_context(|| format!("cannot simulate {:?}", path.display()))?;
        let settings = SimSettings { sizing: args.sizing_mode()? };
        let info = run_info(&loaded, args, settings);
        Ok(Self { scene: Arc::new(loaded.scene), settings, frames, info })
    }

    pub fn surfaces(&self) -> Vec<Arc<Surface>> {
        self.scene.obstacles.iter().map(|o| o.surface.clone()).collect()
    }

    /// Simulates from frame 0, or the one after `start`, to the last wanted one and hands each to
    /// `visit`.
    ///
    /// # Errors
    /// If the simulation fails, `visit` does, or the user asks to stop: after the step in work, whose
    /// frame is dropped.
    pub fn simulate(
        &self,
        start: Option<&Frame>,
        interrupt: &Interrupt,
        mut visit: impl FnMut(Frame) -> Result<()>,
    ) -> Result<()> {
        let (scene, settings) = (self.scene.clone(), self.settings);
        let goes_on = || interrupt.requested().is_none();
        let mut simulation = match start {
            Some(frame) => Simulation::from_frame(scene, settings, frame).map_err(Failure::from)?,
            None => {
                let started = Simulation::start_while(scene, settings, &goes_on);
                let started = started.map_err(Failure::from)?;
                let (simulation, frame) = started.ok_or_else(|| interrupted(interrupt))?;
                log_warnings(&frame);
                visit(frame)?;
                simulation
            }
        };
        for _ in start.map_or(0, |frame| frame.number)..self.frames.last {
            let frame = simulation.advance_while(&goes_on).map_err(Failure::from)?;
            let frame = frame.ok_or_else(|| interrupted(interrupt))?;
            log_warnings(&frame);
            visit(frame)?;
        }
        Ok(())
    }
}

/// Once somebody has asked to stop.
fn interrupted(interrupt: &Interrupt) -> Failure {
    Failure::Interrupted(interrupt.requested().expect("the simulation ends early when asked to"))
}

/// The shot asked for, or the program's own, and where its files are.
fn shot_and_source(args: &ShotArgs) -> Result<(PathBuf, Box<dyn FileSource>)> {
    match &args.shot {
        Some(path) if path.is_dir() => {
            let why = format!("{:?} is a folder, but a shot is a file", path.display());
            Err(Failure::Usage(why).into())
        }
        Some(path) => Ok((path.clone(), Box::new(FileSystem))),
        None => {
            let (path, files) = own_shot();
            Ok((path, Box::new(OwnShotFiles(files))))
        }
    }
}

fn log_warnings(frame: &Frame) {
    for warning in &frame.report.warnings {
        tracing::warn!("frame {}: {warning}", frame.number);
    }
}

/// The files of the own shot; what else the command line names, such as a camera, is a real file.
struct OwnShotFiles(EmbeddedFiles);

impl FileSource for OwnShotFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        if self.0.is_file(path) { self.0.read(path) } else { FileSystem.read(path) }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.0.is_file(path) || FileSystem.is_file(path)
    }
}

/// The frames asked for; without a wish those of the scene; where it runs on, those of its camera.
fn frames(args: &ShotArgs, scene: &Scene) -> Result<FrameRange> {
    if let Some(frames) = args.frames {
        return Ok(frames);
    }
    let camera_last = scene.viewers.first().map(|path| path.frame_range()[1].round() as u32);
    let last = match (scene.last_frame, camera_last) {
        (Some(scene), Some(camera)) if camera > 0 => scene.min(camera),
        (Some(last), _) => last,
        (None, Some(last)) if last > 0 => last,
        (None, _) => {
            let why = "neither shot nor camera says how many frames there are: use --frames";
            return Err(Failure::Usage(why.into()).into());
        }
    };
    Ok(FrameRange { first: 0, last })
}

fn run_info(loaded: &LoadedShot, args: &ShotArgs, settings: SimSettings) -> RunInfo {
    let sizing = serde_json::to_value(settings.sizing).expect("sizing is plain data");
    let mut recorded = loaded.resolved.clone();
    recorded["sizing_mode"] = sizing;
    let mut hasher = InputHasher::new(&recorded);
    for file in &loaded.files_read {
        hasher.add_file(file.sha256.as_bytes());
    }
    RunInfo {
        shotsilk_run: RUN_FORMAT,
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        shot: loaded.scene.name.clone(),
        sizing_mode: args.sizing().name().to_owned(),
        fps: loaded.scene.fps,
        first_frame: loaded.scene.first_frame,
        garments: loaded.scene.garments.iter().map(|g| g.name.clone()).collect(),
        obstacles: loaded.scene.obstacles.iter().map(|o| o.name.clone()).collect(),
        input_hash: hasher.finish(),
        cpu_features: cpu_features(),
        adapter: None,
        settings: recorded,
    }
}

/// Uses so many threads wherever work is shared out.
///
/// # Errors
/// If the threads cannot be started.
pub fn set_threads(threads: Option<u16>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build_global()
        .context("cannot start the threads")
}
