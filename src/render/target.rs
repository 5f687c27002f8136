//! Where pictures are drawn: formats, sample count, and the attachments that go with a size.

use super::gpu::Gpu;

/// What pipelines draw to: the hardware encodes linear light as sRGB.
pub const TARGET_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// The same bytes read without decoding, as a window toolkit that thinks in sRGB wants them.
pub const WINDOW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Every adapter has 4; the software one has no other.
pub(super) const SAMPLE_COUNT: u32 = 4;

/// A texture view to draw to.
#[derive(Clone, Copy)]
pub struct Target<'a> {
    /// Of [`TARGET_FORMAT`], a render attachment.
    pub colour: &'a wgpu::TextureView,
    /// Width and height (px).
    pub size: [u32; 2],
}

/// A texture that pictures are drawn to and read from.
pub struct TargetTexture {
    pub(super) texture: wgpu::Texture,
    colour: wgpu::TextureView,
    size: [u32; 2],
}

impl TargetTexture {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: extent(size),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TARGET_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[WINDOW_FORMAT],
        });
        let colour = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, colour, size }
    }

    pub fn target(&self) -> Target<'_> {
        Target { colour: &self.colour, size: self.size }
    }

    /// Width and height (px).
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// To be painted in sRGB as it is stored, of [`WINDOW_FORMAT`].
    pub(super) fn painted_view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(WINDOW_FORMAT),
            usage: Some(wgpu::TextureUsages::RENDER_ATTACHMENT),
            ..Default::default()
        })
    }

    /// The picture as a window toolkit wants it, [`WINDOW_FORMAT`].
    pub fn window_view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(WINDOW_FORMAT),
            usage: Some(wgpu::TextureUsages::TEXTURE_BINDING),
            ..Default::default()
        })
    }
}

/// Multisampled colour and depth for targets of one size.
pub(super) struct Attachments {
    pub colour: wgpu::TextureView,
    pub depth: wgpu::TextureView,
    pub size: [u32; 2],
}

impl Attachments {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let attachment = |label, format| {
            let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: extent(size),
                mip_level_count: 1,
                sample_count: SAMPLE_COUNT,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self {
            colour: attachment("multisampled colour", TARGET_FORMAT),
            depth: attachment("multisampled depth", DEPTH_FORMAT),
            size,
        }
    }
}

pub(super) fn extent([width, height]: [u32; 2]) -> wgpu::Extent3d {
    wgpu::Extent3d { width, height, depth_or_array_layers: 1 }
}
