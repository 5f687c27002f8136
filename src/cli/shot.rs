//! From the arguments to a shot that can be simulated.

use std::sync::Arc;

use anyhow::{Context, Result};
use rayon::ThreadPoolBuilder;

use super::args::ShotArgs;
use super::failure::Failure;
use super::interrupt::Interrupt;
use crate::preview::give_way;
use crate::request::{FrameRange, Request, RequestError, Requested};
use crate::run::RunInfo;
use crate::scene::{Scene, Surface};
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
        let requested = args.request()?.load().map_err(Failure::from)?;
        for warning in &requested.warnings {
            tracing::warn!("{warning}");
        }
        let Requested { scene, settings, frames, info, .. } = requested;
        Ok(Self { scene, settings, frames, info })
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

fn log_warnings(frame: &Frame) {
    for warning in &frame.report.warnings {
        tracing::warn!("frame {}: {warning}", frame.number);
    }
}

impl ShotArgs {
    /// What is to be simulated.
    ///
    /// # Errors
    /// As [`ShotArgs::sizing_mode`].
    pub fn request(&self) -> Result<Request, Failure> {
        Ok(Request {
            shot: self.shot.clone(),
            text: None,
            camera: self.camera.clone(),
            sets: self.sets.clone(),
            fps: self.fps,
            frames: self.frames,
            sizing: self.sizing_mode()?,
        })
    }
}

/// The command line has its own words for what can be done about it.
impl From<RequestError> for Failure {
    fn from(error: RequestError) -> Self {
        match error {
            RequestError::Load(error) => error.into(),
            error @ RequestError::Folder { .. } => Failure::Usage(error.to_string()),
            error @ RequestError::Endless { .. } => {
                Failure::Usage(format!("{error}: use --frames"))
            }
        }
    }
}

/// Uses so many threads wherever work is shared out.
///
/// # Errors
/// If the threads cannot be started.
pub fn set_threads(threads: Option<u16>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    start_threads(ThreadPoolBuilder::new().num_threads(usize::from(threads)))
}

/// The same, with threads that give way to the one that answers the user.
///
/// # Errors
/// As [`set_threads`].
pub fn set_yielding_threads(threads: Option<u16>) -> Result<()> {
    let count = threads.map_or(0, usize::from);
    start_threads(ThreadPoolBuilder::new().num_threads(count).start_handler(|_| give_way()))
}

fn start_threads(pool: ThreadPoolBuilder) -> Result<()> {
    pool.build_global().context("cannot start the threads")
}
