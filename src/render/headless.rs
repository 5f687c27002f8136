//! Pictures without a window: the same renderer, a texture of our own, and readback.

use std::sync::Arc;

use glam::DVec3;
use image::RgbaImage;

use crate::scene::Surface;
use crate::shot::View;
use crate::sim::Frame;

use super::camera_glyph::ShotCamera;
use super::draw_list::DrawList;
use super::gpu::{AdapterChoice, Gpu, RenderError};
use super::legend;
use super::options::{Edges, PictureOptions};
use super::renderer::Renderer;
use super::target::TargetTexture;

/// What a frame shows to an eye, the mesh's edges included; the shot camera's view decides their
/// colours.
fn list_with_edges(
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
    list
}

/// Draws frames to images.
pub struct Headless {
    gpu: Gpu,
    renderer: Renderer,
    picture: Option<Readable>,
}

/// A target and the memory it is read through.
struct Readable {
    target: TargetTexture,
    buffer: wgpu::Buffer,
    row_bytes: u32,
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
        let list = list_with_edges(frame, surfaces, view, view.eye, options);
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
        let mut list = list_with_edges(frame, surfaces, camera.view, witness.eye, options);
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
            Some(readable) if readable.target.size() == size => readable,
            _ => Readable::new(&self.gpu, size),
        };
        let readable = self.picture.insert(readable);
        self.renderer.draw(&self.gpu, list, view, readable.target.target())?;
        readable.read(&self.gpu)
    }
}

impl Readable {
    fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let row_bytes = (4 * size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(row_bytes) * u64::from(size[1]),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { target: TargetTexture::new(gpu, size), buffer, row_bytes }
    }

    fn read(&self, gpu: &Gpu) -> Result<RgbaImage, RenderError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.target.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            self.target.texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        // A failure to map shows in the range below.
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| RenderError::Device(e.to_string()))?;
        gpu.check()?;
        let pixels = self.unpadded()?;
        self.buffer.unmap();
        let [width, height] = self.target.size();
        Ok(RgbaImage::from_raw(width, height, pixels).expect("four bytes for each pixel"))
    }

    /// The mapped rows without what aligns them.
    fn unpadded(&self) -> Result<Vec<u8>, RenderError> {
        let mapped =
            self.buffer.get_mapped_range(..).map_err(|e| RenderError::Device(e.to_string()))?;
        let used = 4 * self.target.size()[0] as usize;
        Ok(mapped
            .chunks_exact(self.row_bytes as usize)
            .flat_map(|row| row[..used].to_vec())
            .collect())
    }
}
