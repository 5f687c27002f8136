//! The pictures of an export: a frame as the chosen view sees it, with what is burnt in.

use std::sync::Arc;

use anyhow::{Context, Result, anyhow};
use image::{Rgba, RgbaImage, imageops};

use super::burn_in::{PAPER, Strip, strip_height, with_strip};
use super::{BurnIn, ExportKind, ExportView, Task};
use crate::render::{
    Bounds, CameraTrail, Headless, PictureOptions, ShotCamera, WITNESS_FOV_Y, gate_aspect,
    size_of_width,
};
use crate::run::RunInfo;
use crate::scene::Surface;
use crate::shot::{CameraPath, Lens, View};
use crate::sim::Frame;

/// Draws the frames of a task.
pub(super) struct Pictures<'a> {
    task: Task<'a>,
    gpu: Headless,
    camera: Option<Camera>,
    surfaces: Vec<Arc<Surface>>,
    info: RunInfo,
    /// Of one view's picture (px).
    size: [u32; 2],
}

/// The shot camera, and its way as the witness sees it.
struct Camera {
    path: CameraPath,
    trail: CameraTrail,
}

/// Between the two pictures of a pair (px): even, as video wants it.
const PAIR_GAP: u32 = 8;
/// A path is drawn up to this frame: an hour and more, and as many lines as are quickly drawn.
const TRAIL_LAST_MAX: f64 = 100_000.0;

impl<'a> Pictures<'a> {
    /// # Errors
    /// If there is no such adapter, or the shot's camera is asked for and cannot be used.
    pub fn new(task: Task<'a>) -> Result<Self> {
        let camera = task.supply.camera().map(Camera::of);
        let (camera, shape) = match (&task.request.what, &task.request.view) {
            (ExportKind::Sheet { .. }, _) | (_, ExportView::Shot | ExportView::Both(_)) => {
                let camera = camera.ok_or_else(no_camera)??;
                let view = camera.path.view(0.0);
                (Some(camera), view)
            }
            // It shows the shot camera, if there is one that can be shown.
            (_, ExportView::Witness(view)) => (camera.and_then(Result::ok), *view),
        };
        let size = size_of_width(&shape, task.request.width);
        let size = match task.request.what {
            ExportKind::Video { .. } => size.map(even),
            _ => size,
        };
        let gpu = Headless::new(task.adapter)?;
        let (surfaces, info) = (task.supply.surfaces(), task.supply.info());
        Ok(Self { task, gpu, camera, surfaces, info, size })
    }

    pub fn info(&self) -> &RunInfo {
        &self.info
    }

    /// Of one view's picture (px).
    pub fn size_of_view(&self) -> [u32; 2] {
        self.size
    }

    /// Of the pictures that [`Pictures::picture`] gives (px).
    pub fn size(&self) -> [u32; 2] {
        let [one, height] = self.size;
        let width = match self.task.request.view {
            ExportView::Both(_) => 2 * one + PAIR_GAP,
            ExportView::Shot | ExportView::Witness(_) => one,
        };
        let strip = match self.task.request.burn_in {
            BurnIn::None => 0,
            BurnIn::Strip => strip_height(width),
        };
        [width, height + strip]
    }

    /// # Errors
    /// If the supply has no such frame, named as the shot counts.
    pub fn frame(&self, number: u32) -> Result<Arc<Frame>> {
        self.task.frame(&self.info, number)
    }

    /// What was asked for, burnt-in strip included.
    ///
    /// # Errors
    /// If the frame is missing or the device fails.
    pub fn picture(&mut self, number: u32) -> Result<RgbaImage> {
        let frame = self.frame(number)?;
        let picture = match &self.task.request.view {
            ExportView::Shot => self.shot(&frame)?,
            ExportView::Witness(view) => self.witness(&frame, view)?,
            ExportView::Both(view) => {
                side_by_side(&self.shot(&frame)?, &self.witness(&frame, view)?)
            }
        };
        match self.task.request.burn_in {
            BurnIn::None => Ok(picture),
            BurnIn::Strip => Ok(with_strip(&picture, &self.strip(number)?)),
        }
    }

    /// # Errors
    /// If there is no shot camera or the device fails.
    pub fn shot(&mut self, frame: &Frame) -> Result<RgbaImage> {
        let camera = self.camera.as_ref().ok_or_else(no_camera)?;
        let view = camera.path.view(f64::from(frame.number));
        // The ground is the witness's: the shot shows what is in the scene.
        let options = PictureOptions { ground_height: None, ..self.options() };
        Ok(self.gpu.picture(frame, &self.surfaces, &view, &options)?)
    }

    /// # Errors
    /// If the device fails.
    pub fn witness(&mut self, frame: &Frame, witness: &View) -> Result<RgbaImage> {
        let witness = seen_in_shape(*witness, self.size);
        // A pair needs one legend, and the shot's picture has it.
        let options = match self.task.request.view {
            ExportView::Both(_) => PictureOptions { legend_px: None, ..self.options() },
            ExportView::Shot | ExportView::Witness(_) => self.options(),
        };
        let Some(camera) = &self.camera else {
            return Ok(self.gpu.picture(frame, &self.surfaces, &witness, &options)?);
        };
        let at = f64::from(frame.number);
        let view = camera.path.view(at);
        let ghost = self.task.request.ghost_frames.map(|later| camera.path.view(at + later));
        let camera = ShotCamera {
            view: &view,
            trail: &camera.trail,
            frustum_depth: ShotCamera::frustum_depth_past(&view, Bounds::of_cloth(frame)),
            ghost: ghost.as_ref(),
        };
        Ok(self.gpu.witness_picture(frame, &self.surfaces, &witness, &camera, &options)?)
    }

    fn options(&self) -> PictureOptions {
        let wanted = self.task.request.options.clone();
        let legend_px = match self.task.request.what {
            // The page has one.
            ExportKind::Sheet { .. } => None,
            _ => wanted.legend_px,
        };
        PictureOptions { size: Some(self.size), legend_px, ..wanted }
    }

    fn strip(&self, number: u32) -> Result<Strip> {
        Ok(Strip {
            shot: self.info.shot.clone(),
            view: match self.task.request.view {
                ExportView::Shot => "shot camera",
                ExportView::Witness(_) => "witness",
                ExportView::Both(_) => "shot camera | witness",
            },
            frame: i64::from(number) + self.info.first_frame,
            lens: match (&self.task.request.view, &self.camera) {
                (ExportView::Shot | ExportView::Both(_), Some(camera)) => {
                    camera.path.lens(f64::from(number))
                }
                _ => Lens::FieldOfView { fov_y: WITNESS_FOV_Y },
            },
            settings_hash: self.task.settings_hash(&self.info, number)?,
        })
    }
}

impl Camera {
    /// # Errors
    /// If it cannot be used.
    fn of(path: CameraPath) -> Result<Self> {
        path.check().context("the shot's camera cannot be used")?;
        let [_, last] = path.frame_range();
        let trail = CameraTrail::of(&path, last.clamp(0.0, TRAIL_LAST_MAX) as u32);
        Ok(Self { path, trail })
    }
}

fn no_camera() -> anyhow::Error {
    anyhow!("the shot has no camera to export through: the witness's view can be exported")
}

impl Task<'_> {
    /// # Errors
    /// If the supply has no such frame, named as the shot counts.
    pub(super) fn frame(self, info: &RunInfo, number: u32) -> Result<Arc<Frame>> {
        self.supply.frame(number).map_err(|why| missing(info, number, &why))
    }

    /// # Errors
    /// As [`Task::frame`].
    pub(super) fn settings_hash(self, info: &RunInfo, number: u32) -> Result<String> {
        self.supply.settings_hash(number).map_err(|why| missing(info, number, &why))
    }
}

fn missing(info: &RunInfo, number: u32, why: &str) -> anyhow::Error {
    anyhow!("frame {} cannot be exported: {why}", i64::from(number) + info.first_frame)
}

/// The even number that is nearest, from below; at least 2.
fn even(length: u32) -> u32 {
    (length & !1).max(2)
}

/// The view with its gate made wider or higher about its middle, so that it has the shape of a picture
/// of a size (px) and nothing is lost.
pub fn seen_in_shape(view: View, size: [u32; 2]) -> View {
    let [width, height] = size.map(|px| f64::from(px.max(1)));
    let growth = width / height / gate_aspect(&view);
    let mut half = 0.5 * (view.gate_max - view.gate_min);
    match growth >= 1.0 {
        true => half.x *= growth,
        false => half.y /= growth,
    }
    let centre = 0.5 * (view.gate_max + view.gate_min);
    View { gate_min: centre - half, gate_max: centre + half, resolution: size, ..view }
}

/// Two pictures of one height on one page.
fn side_by_side(left: &RgbaImage, right: &RgbaImage) -> RgbaImage {
    let width = left.width() + PAIR_GAP + right.width();
    let height = left.height().max(right.height());
    let mut page = RgbaImage::from_pixel(width, height, Rgba(PAPER.with_alpha(255)));
    imageops::replace(&mut page, left, 0, 0);
    imageops::replace(&mut page, right, i64::from(left.width() + PAIR_GAP), 0);
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::fixture::overhead;

    #[test]
    fn a_view_in_another_shape_loses_nothing_and_is_not_distorted() {
        let view = overhead([200, 200]);
        for size in [[200, 200], [400, 200], [100, 300]] {
            let wide = seen_in_shape(view, size);
            assert!(wide.gate_min.cmple(view.gate_min).all());
            assert!(wide.gate_max.cmpge(view.gate_max).all());
            let aspect = f64::from(size[0]) / f64::from(size[1]);
            assert!((gate_aspect(&wide) - aspect).abs() < 1e-12);
        }
        assert_eq!(seen_in_shape(view, [200, 200]), view);
    }
}
