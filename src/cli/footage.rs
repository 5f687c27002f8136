//! Frames to draw: from a run folder, or from a shot which is simulated into a temporary one first.

use std::sync::Arc;

use anyhow::{Context, Result};
use tempfile::TempDir;

use super::args::ShotArgs;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::progress::{Progress, ProgressMode};
use super::shot::Shot;
use crate::request::FrameRange;
use crate::run::{RunInfo, RunReader, RunWriter, WriteOptions};
use crate::scene::{FileSystem, Surface, ViewSettings, load_camera, recorded_viewers};
use crate::sheet::chosen_frames;
use crate::shot::CameraPath;
use crate::sim::Frame;

/// A run that can be drawn.
pub struct Footage {
    reader: RunReader,
    camera: CameraPath,
    frames: Vec<u32>,
    /// Removes the temporary run with the footage.
    _spool: Option<TempDir>,
}

impl Footage {
    /// Every `every`-th of the frames asked for.
    ///
    /// # Errors
    /// If shot or run cannot be read or have no camera, or the simulation fails or is interrupted.
    pub fn open(args: &ShotArgs, every: u32, interrupt: &Interrupt, log: LogArgs) -> Result<Self> {
        match &args.shot {
            Some(path) if path.is_dir() => {
                let reader = RunReader::open(path).map_err(Failure::from)?;
                Self::of_run(reader, args, every)
            }
            _ => Self::of_shot(args, every, interrupt, log),
        }
    }

    fn of_run(reader: RunReader, args: &ShotArgs, every: u32) -> Result<Self> {
        if args.changes_the_simulation() {
            let why = "a run is simulated already: \
                --set, --sizing and --edge-length have no effect on it";
            return Err(Failure::Usage(why.into()).into());
        }
        let held = reader.frames();
        let range =
            args.frames.or_else(|| Some(FrameRange { first: *held.first()?, last: *held.last()? }));
        let wanted = range.map_or(Vec::new(), |r| chosen_frames(r.first..=r.last, every));
        let frames: Vec<u32> = wanted.into_iter().filter(|f| held.contains(f)).collect();
        if frames.is_empty() {
            let (path, asked) = (reader.dir().display(), args.frames);
            let why = match asked {
                Some(r) => {
                    format!("the run {path:?} holds none of the frames {}..{}", r.first, r.last)
                }
                None => format!("the run {path:?} holds no frames"),
            };
            return Err(Failure::Usage(why).into());
        }
        let camera = match &args.camera {
            Some(path) => {
                let fps = args.fps.is_none().then_some(reader.info().fps);
                load_camera(path, fps, &FileSystem).map_err(Failure::from)?
            }
            None => {
                let viewers = recorded_viewers(&reader.info().settings).map_err(Failure::from)?;
                shot_camera(viewers, reader.info())?
            }
        };
        Ok(Self { reader, camera, frames, _spool: None })
    }

    fn of_shot(args: &ShotArgs, every: u32, interrupt: &Interrupt, log: LogArgs) -> Result<Self> {
        let shot = Shot::open(args)?;
        // Before the simulation, which takes its time.
        let camera = shot_camera(shot.scene.viewers.clone(), &shot.info)?;
        let frames = chosen_frames(shot.frames.first..=shot.frames.last, every);
        let spool = tempfile::tempdir().context("cannot create a folder for temporary frames")?;
        let folder = spool.path().join("run");
        let mut writer =
            RunWriter::create(&folder, &shot.info, &shot.surfaces(), WriteOptions::default())
                .map_err(Failure::from)?;
        let mut progress =
            Progress::new(u64::from(shot.frames.last) + 1, ProgressMode::detect(log));
        shot.simulate(None, interrupt, |frame| {
            if frames.contains(&frame.number) {
                writer.write(&frame).map_err(Failure::from)?;
            }
            progress.frame(&frame, shot.info.first_frame);
            Ok(())
        })
        .with_context(|| format!("cannot simulate the shot {:?}", shot.info.shot))?;
        progress.finish();
        writer.finish().map_err(Failure::from)?;
        let reader = RunReader::open(&folder).map_err(Failure::from)?;
        Ok(Self { reader, camera, frames, _spool: Some(spool) })
    }

    pub fn info(&self) -> &RunInfo {
        self.reader.info()
    }

    /// In order; at least one.
    pub fn frames(&self) -> &[u32] {
        &self.frames
    }

    pub fn surfaces(&self) -> Vec<Arc<Surface>> {
        self.reader.obstacles()
    }

    /// # Errors
    /// If the frame's state cannot be read.
    pub fn frame(&self, number: u32) -> Result<Frame> {
        Ok(self.reader.frame(number).map_err(Failure::from)?)
    }

    /// The shot camera.
    pub fn camera(&self) -> &CameraPath {
        &self.camera
    }

    /// The view settings of the garments, as recorded.
    pub fn view_settings(&self) -> Vec<ViewSettings> {
        let garments = self.info().settings["garments"].as_array();
        let view = |g: &serde_json::Value| serde_json::from_value(g["view"].clone()).ok();
        garments.into_iter().flatten().filter_map(view).collect()
    }
}

/// The first of the viewers.
fn shot_camera(viewers: Vec<CameraPath>, info: &RunInfo) -> Result<CameraPath> {
    viewers.into_iter().next().ok_or_else(|| {
        let why = format!("the shot {:?} has no camera: name one with --camera", info.shot);
        Failure::Usage(why).into()
    })
}
