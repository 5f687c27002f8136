//! Pictures without a window: the same renderer, a texture of our own, and readback.

use std::sync::Arc;

use glam::DVec3;
use image::RgbaImage;

use crate::scene::Surface;
use crate::shot::View;
use crate::sim::Frame;

use super::camera_glyph::ShotCamera;
use super::canvas::Canvas;
use super::crossings::Crossings;
use super::draw_list::DrawList;
use super::gpu::{AdapterChoice, Gpu, RenderError};
use super::legend;
use super::options::{CrossingMarks, Edges, PictureOptions};
use super::renderer::Renderer;

/// What a frame shows to an eye, the mesh's edges and marked crossings included; the shot camera's
/// view decides the colours of edges.
fn list_with_marks(
    frame: &Frame,
    surfaces: &[Arc<Surface>],
    shot: &View,
    eye: DVec3,
    options: &PictureOptions,
) -> DrawList {
    let mut list = DrawList::new(frame, surfaces, options);
    if let Edges::ByFrame(settings) = &options.edges {
        list.push_frame_edges(&frame.garments, settings, shot, eye, options.wire_width_px);
    }
    if options.crossings == CrossingMarks::Magenta {
        list.push_crossings(&Crossings::of(frame, surfaces), &frame.garments, eye);
    }
    list
}

/// Draws frames to images.
pub struct Headless {
    gpu: Gpu,
    renderer: Renderer,
    picture: Option<Canvas>,
}

impl Headless {
    /// # Errors
    /// If there is no such adapter, or it cannot draw.
    pub fn new(choice: &AdapterChoice) -> Result<Self, RenderError> {
        let gpu = Gpu::new(choice)?;
        let renderer = Renderer::new(&gpu);
        gpu.check()?;
        Ok(Self { gpu, renderer, picture: None })
    }

    /// As the driver calls itself.
    pub fn adapter_name(&self) -> &str {
        self.gpu.adapter_name()
    }

    /// A frame as a view sees it. `surfaces` are the obstacles', in the scene's order.
    ///
    /// # Errors
    /// If the size is impossible, or the device reports an error.
    pub fn picture(
        &mut self,
        frame: &Frame,
        surfaces: &[Arc<Surface>],
        view: &View,
        options: &PictureOptions,
    ) -> Result<RgbaImage, RenderError> {
        let list = list_with_marks(frame, surfaces, view, view.eye, options);
        self.finished_picture(&list, view, options)
    }

    /// A frame as the witness sees it, the shot camera with it.
    ///
    /// # Errors
    /// As [`Headless::picture`].
    pub fn witness_picture(
        &mut self,
        frame: &Frame,
        surfaces: &[Arc<Surface>],
        witness: &View,
        camera: &ShotCamera<'_>,
        options: &PictureOptions,
    ) -> Result<RgbaImage, RenderError> {
        let mut list = list_with_marks(frame, surfaces, camera.view, witness.eye, options);
        list.push_shot_camera(camera, witness.eye);
        self.finished_picture(&list, witness, options)
    }

    fn finished_picture(
        &mut self,
        list: &DrawList,
        view: &View,
        options: &PictureOptions,
    ) -> Result<RgbaImage, RenderError> {
        let mut image = self.draw(list, view, options.size.unwrap_or(view.resolution))?;
        if let Some(text_px) = options.legend_px {
            legend::draw_in_corner(&mut image, options.colour_by, text_px);
        }
        Ok(image)
    }

    /// A list as a view sees it, in an image of a size (px).
    ///
    /// # Errors
    /// As [`Headless::picture`].
    pub fn draw(
        &mut self,
        list: &DrawList,
        view: &View,
        size: [u32; 2],
    ) -> Result<RgbaImage, RenderError> {
        self.gpu.check_size(size)?;
        let readable = match self.picture.take() {
            Some(readable) if readable.size() == size => readable,
            _ => Canvas::new(&self.gpu, size),
        };
        let readable = self.picture.insert(readable);
        self.renderer.draw(&self.gpu, list, view, readable.target())?;
        readable.read(&self.gpu)
    }
}
