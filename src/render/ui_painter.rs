//! Draws what egui says, and with it the pictures that were drawn before: the window's last layer.

use egui::{ClippedPrimitive, TextureId, TexturesDelta};

use super::gpu::{Gpu, RenderError};
use super::target::TargetTexture;

/// Where controls are drawn: any texture view of the painter's format.
#[derive(Clone, Copy)]
pub struct Sheet<'a> {
    pub view: &'a wgpu::TextureView,
    /// Width and height (px).
    pub size: [u32; 2],
    /// Pixels to a point of egui.
    pub scale: f32,
}

/// See the module.
pub struct UiPainter {
    renderer: egui_wgpu::Renderer,
    /// Pictures of egui's that the next paint shows for the last time.
    leaving: Vec<TextureId>,
}

impl UiPainter {
    /// For targets of a format, best one that stores sRGB without converting.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let renderer = egui_wgpu::Renderer::new(&gpu.device, format, options);
        Self { renderer, leaving: Vec::new() }
    }

    /// A name under which egui shows a picture.
    pub fn register(&mut self, gpu: &Gpu, picture: &TargetTexture) -> TextureId {
        let view = picture.window_view();
        self.renderer.register_native_texture(&gpu.device, &view, wgpu::FilterMode::Linear)
    }

    /// Another picture under the same name.
    pub fn replace(&mut self, gpu: &Gpu, id: TextureId, picture: &TargetTexture) {
        let view = picture.window_view();
        let filter = wgpu::FilterMode::Linear;
        self.renderer.update_egui_texture_from_wgpu_texture(&gpu.device, &view, filter, id);
    }

    /// Takes over egui's own pictures, such as letters: every change, whether anything is painted
    /// then or not.
    pub fn take(&mut self, gpu: &Gpu, textures: &mut TexturesDelta) {
        for (&id, deltas) in &textures.set {
            for delta in deltas {
                self.renderer.update_texture(&gpu.device, &gpu.queue, id, delta);
            }
        }
        self.leaving.extend(textures.free.iter().copied());
        textures.clear();
    }

    /// Draws over what the sheet shows, all of it.
    ///
    /// # Errors
    /// If the device reports one.
    pub fn paint(
        &mut self,
        gpu: &Gpu,
        primitives: &[ClippedPrimitive],
        sheet: Sheet<'_>,
    ) -> Result<(), RenderError> {
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: sheet.size,
            pixels_per_point: sheet.scale,
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut commands = self.renderer.update_buffers(
            &gpu.device,
            &gpu.queue,
            &mut encoder,
            primitives,
            &screen,
        );
        {
            let pass = begin(&mut encoder, sheet.view);
            self.renderer.render(&mut pass.forget_lifetime(), primitives, &screen);
        }
        commands.push(encoder.finish());
        gpu.queue.submit(commands);
        self.leaving.drain(..).for_each(|id| self.renderer.free_texture(&id));
        gpu.check()
    }
}

fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("controls"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    })
}
