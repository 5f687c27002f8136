//! A window's surface: what is drawn to it is seen.

use image::RgbaImage;

use super::canvas::Readback;
use super::gpu::{AdapterChoice, Gpu, RenderError};
use super::target::extent;
use super::ui_painter::{Sheet, UiPainter};

/// See the module.
pub struct WindowSurface {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
}

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presented {
    Shown,
    /// The window cannot be seen now, or has just changed: to be tried again when it is redrawn.
    NotNow,
}

impl WindowSurface {
    /// A device that can draw to a window of a size (px), and the window's surface.
    ///
    /// # Errors
    /// If there is no adapter for the window, or it cannot draw.
    pub fn open(
        choice: &AdapterChoice,
        window: impl Into<wgpu::SurfaceTarget<'static>>,
        size: [u32; 2],
    ) -> Result<(Gpu, Self), RenderError> {
        pollster::block_on(Self::find(choice, window.into(), size))
    }

    async fn find(
        choice: &AdapterChoice,
        window: wgpu::SurfaceTarget<'static>,
        [width, height]: [u32; 2],
    ) -> Result<(Gpu, Self), RenderError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(window).map_err(|error| RenderError::NoDevice {
            adapter: "window".to_owned(),
            reason: error.to_string(),
        })?;
        let (gpu, adapter) = Gpu::for_surface(choice, &instance, &surface).await?;
        let config = surface.get_default_config(&adapter, width.max(1), height.max(1));
        let mut config = config.ok_or_else(|| RenderError::NoDevice {
            adapter: gpu.adapter_name().to_owned(),
            reason: "it cannot draw to this window".to_owned(),
        })?;
        let formats = surface.get_capabilities(&adapter).formats;
        // Controls are mixed in sRGB as it is stored.
        if let Some(&format) = formats.iter().find(|format| is_plain(**format)) {
            config.format = format;
        }
        config.present_mode = wgpu::PresentMode::AutoVsync;
        config.desired_maximum_frame_latency = 1;
        surface.configure(&gpu.device, &config);
        Ok((gpu, Self { surface, config }))
    }

    /// Draws controls as the surface wants them.
    pub fn painter(&self, gpu: &Gpu) -> UiPainter {
        UiPainter::new(gpu, self.config.format)
    }

    /// Width and height (px).
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// The window has another size (px). One without pixels changes nothing.
    pub fn resize(&mut self, gpu: &Gpu, [width, height]: [u32; 2]) {
        if width > 0 && height > 0 && [width, height] != self.size() {
            [self.config.width, self.config.height] = [width, height];
            self.surface.configure(&gpu.device, &self.config);
        }
    }

    /// What `paint` would show, as an image.
    ///
    /// # Errors
    /// What `paint` or the device reports.
    pub fn capture(
        &self,
        gpu: &Gpu,
        scale: f32,
        paint: impl FnOnce(Sheet<'_>) -> Result<(), RenderError>,
    ) -> Result<RgbaImage, RenderError> {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("capture"),
            size: extent(self.size()),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.config.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        paint(Sheet { view: &view, size: self.size(), scale })?;
        let mut image = Readback::new(gpu, self.size()).read(gpu, &texture)?;
        if is_blue_first(self.config.format) {
            image.pixels_mut().for_each(|pixel| pixel.0.swap(0, 2));
        }
        Ok(image)
    }

    /// Lets `paint` draw and shows what it has drawn.
    ///
    /// # Errors
    /// What `paint` or the device reports.
    pub fn present(
        &mut self,
        gpu: &Gpu,
        scale: f32,
        paint: impl FnOnce(Sheet<'_>) -> Result<(), RenderError>,
    ) -> Result<Presented, RenderError> {
        use wgpu::CurrentSurfaceTexture as Current;
        let texture = match self.surface.get_current_texture() {
            Current::Success(texture) | Current::Suboptimal(texture) => texture,
            Current::Outdated | Current::Lost => {
                self.surface.configure(&gpu.device, &self.config);
                gpu.check()?;
                return Ok(Presented::NotNow);
            }
            Current::Timeout | Current::Occluded => return Ok(Presented::NotNow),
            Current::Validation => {
                gpu.check()?;
                return Ok(Presented::NotNow);
            }
        };
        let view = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        paint(Sheet { view: &view, size: self.size(), scale })?;
        gpu.queue.present(texture);
        Ok(Presented::Shown)
    }
}

fn is_blue_first(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat::{Bgra8Unorm, Bgra8UnormSrgb};
    matches!(format, Bgra8Unorm | Bgra8UnormSrgb)
}

fn is_plain(format: wgpu::TextureFormat) -> bool {
    matches!(format, wgpu::TextureFormat::Bgra8Unorm | wgpu::TextureFormat::Rgba8Unorm)
}
