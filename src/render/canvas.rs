//! Pictures in memory: drawn to, and read back.

use image::RgbaImage;

use super::gpu::{Gpu, RenderError};
use super::target::{Target, TargetTexture};

/// A picture that can be drawn to and read.
pub struct Canvas {
    texture: TargetTexture,
    readback: Readback,
}

impl Canvas {
    /// Of a size (px).
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self { texture: TargetTexture::new(gpu, size), readback: Readback::new(gpu, size) }
    }

    pub fn target(&self) -> Target<'_> {
        self.texture.target()
    }

    /// Width and height (px).
    pub fn size(&self) -> [u32; 2] {
        self.texture.size()
    }

    /// Controls are drawn to it as to a window of that size.
    pub fn sheet_view(&self) -> wgpu::TextureView {
        self.texture.painted_view()
    }

    /// The pixels.
    ///
    /// # Errors
    /// If the device reports one.
    pub fn read(&self, gpu: &Gpu) -> Result<RgbaImage, RenderError> {
        self.readback.read(gpu, &self.texture.texture)
    }
}

/// The memory that a texture is read through.
pub(super) struct Readback {
    buffer: wgpu::Buffer,
    row_bytes: u32,
    size: [u32; 2],
}

impl Readback {
    /// For textures of a size (px).
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let row_bytes = (4 * size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(row_bytes) * u64::from(size[1]),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, row_bytes, size }
    }

    /// The bytes of a texture of four bytes a pixel, as they stand.
    pub fn read(&self, gpu: &Gpu, texture: &wgpu::Texture) -> Result<RgbaImage, RenderError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        gpu.queue.submit([encoder.finish()]);
        // A failure to map shows in the range below.
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.wait()?;
        let pixels = self.unpadded()?;
        self.buffer.unmap();
        let [width, height] = self.size;
        Ok(RgbaImage::from_raw(width, height, pixels).expect("four bytes for each pixel"))
    }

    /// The mapped rows without what aligns them.
    fn unpadded(&self) -> Result<Vec<u8>, RenderError> {
        let mapped =
            self.buffer.get_mapped_range(..).map_err(|e| RenderError::Device(e.to_string()))?;
        let used = 4 * self.size[0] as usize;
        Ok(mapped
            .chunks_exact(self.row_bytes as usize)
            .flat_map(|row| row[..used].to_vec())
            .collect())
    }
}
