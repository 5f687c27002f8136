//! Two runs of one shot, frame by frame.

use std::collections::BTreeMap;
use std::sync::Arc;

use thiserror::Error;

use super::report::Fault;
use crate::resample::{ClothMap, ClothMismatch, Measured, Pair, Shown};
use crate::run::{RunError, RunReader};
use crate::scene::{LoadError, Surface, recorded_viewers};
use crate::shot::{CameraPath, View};

/// Why two runs cannot be compared.
#[derive(Debug, Error)]
pub enum RunsError {
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Camera(#[from] LoadError),
    #[error("the run \"{path}\" has no camera: nothing of it is seen")]
    NoCamera { path: String },
    #[error(
        "\"{b}\" has {b_fps} frames a second, \"{a}\" has {a_fps}: their frames are of different times"
    )]
    Fps { a: String, a_fps: f64, b: String, b_fps: f64 },
    #[error(
        "\"{b}\" has the garments {b_names:?}, \"{a}\" has {a_names:?}: they are not of one shot"
    )]
    Garments { a: String, a_names: Vec<String>, b: String, b_names: Vec<String> },
    #[error("frame {frame} of \"{b}\" is of other cloth than that of \"{a}\": {source}")]
    Cloth { a: String, b: String, frame: u32, source: ClothMismatch },
}

/// A reference run and what is held against it.
#[derive(Debug)]
pub struct RunPair<'a> {
    reference: &'a RunReader,
    other: &'a RunReader,
    camera: CameraPath,
    surfaces: Vec<Arc<Surface>>,
    /// Pixels looked at for each pixel of the shot's width and height.
    scale: f64,
    /// The last frame of both that was looked at: it comes before the next.
    last: Option<(u32, [ClothMap; 2])>,
}

impl<'a> RunPair<'a> {
    /// The camera is the reference's.
    ///
    /// # Errors
    /// If the runs are not of one shot, or the reference has no camera.
    pub fn new(
        reference: &'a RunReader,
        other: &'a RunReader,
        scale: f64,
    ) -> Result<Self, RunsError> {
        let (a, b) = (reference.info(), other.info());
        let [a_path, b_path] = [reference, other].map(name);
        if a.fps != b.fps {
            return Err(RunsError::Fps { a: a_path, a_fps: a.fps, b: b_path, b_fps: b.fps });
        }
        if a.garments != b.garments {
            let (a_names, b_names) = (a.garments.clone(), b.garments.clone());
            return Err(RunsError::Garments { a: a_path, a_names, b: b_path, b_names });
        }
        let camera = recorded_viewers(&a.settings)?.into_iter().next();
        let camera = camera.ok_or(RunsError::NoCamera { path: a_path })?;
        let surfaces = reference.obstacles();
        Ok(Self { reference, other, camera, surfaces, scale, last: None })
    }

    /// True if both were made for the same shot camera.
    ///
    /// # Errors
    /// If the other's settings cannot be read.
    pub fn has_one_camera(&self) -> Result<bool, RunsError> {
        let others = recorded_viewers(&self.other.info().settings)?;
        Ok(others.first() == Some(&self.camera))
    }

    /// What the shot camera sees at a frame.
    pub fn view(&self, frame: u32) -> View {
        self.camera.view(f64::from(frame))
    }

    pub fn surfaces(&self) -> &[Arc<Surface>] {
        &self.surfaces
    }

    /// How many pixels of a view are looked at.
    pub fn size(&self, view: &View) -> [u32; 2] {
        view.resolution.map(|px| ((f64::from(px) * self.scale).round() as u32).max(1))
    }

    /// The error at a frame; quickest if frames are asked for in order.
    ///
    /// # Errors
    /// If a frame cannot be read or is of other cloth.
    pub fn measure(&mut self, frame: u32) -> Result<Measured, RunsError> {
        let before = match self.last.take() {
            Some((number, maps)) if number + 1 == frame => Some(maps),
            _ => self.frame_before(frame)?,
        };
        let maps = self.maps(frame)?;
        let view = self.view(frame);
        let shown = Shown {
            now: pair(&maps),
            before: before.as_ref().map(pair),
            surfaces: &self.surfaces,
            view: &view,
            size: self.size(&view),
        };
        let measured = shown.measure().map_err(|source| {
            let [a, b] = [self.reference, self.other].map(name);
            RunsError::Cloth { a, b, frame, source }
        })?;
        self.last = Some((frame, maps));
        Ok(measured)
    }

    /// The maps of the last frame that was measured: the reference's and the other's.
    pub fn last_maps(&self) -> Option<&[ClothMap; 2]> {
        self.last.as_ref().map(|(_, maps)| maps)
    }

    fn frame_before(&self, frame: u32) -> Result<Option<[ClothMap; 2]>, RunsError> {
        let Some(before) = frame.checked_sub(1) else { return Ok(None) };
        let is_held = |run: &RunReader| run.frames().binary_search(&before).is_ok();
        let are_held = is_held(self.reference) && is_held(self.other);
        are_held.then(|| self.maps(before)).transpose()
    }

    fn maps(&self, frame: u32) -> Result<[ClothMap; 2], RunsError> {
        let map = |run: &RunReader| run.frame(frame).map(ClothMap::new);
        Ok([map(self.reference)?, map(self.other)?])
    }
}

fn pair([reference, other]: &[ClothMap; 2]) -> Pair<'_> {
    Pair { reference, other }
}

fn name(run: &RunReader) -> String {
    run.dir().display().to_string()
}

/// The frames that either run holds, in order, with what keeps one from being compared.
pub fn frames_of_either(a: &RunReader, b: &RunReader) -> BTreeMap<u32, Option<Fault>> {
    let mut frames: BTreeMap<u32, Option<Fault>> =
        a.frames().iter().map(|&number| (number, Some(Fault::OnlyInA))).collect();
    for &number in b.frames() {
        let fault = if frames.contains_key(&number) { None } else { Some(Fault::OnlyInB) };
        frames.insert(number, fault);
    }
    frames
}
