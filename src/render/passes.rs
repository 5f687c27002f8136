//! The pipelines: background, surfaces, and marks and lines in front of and behind surfaces.

use super::colour_table::{COLOURS_PER_TABLE, ColourTable};
use super::draw_list::{FillVertex, Line, SurfaceVertex};
use super::gpu::Gpu;
use super::target::{DEPTH_FORMAT, SAMPLE_COUNT, TARGET_FORMAT, extent};
use super::uniforms::{
    BACKGROUND_WGSL, FILL_WGSL, LINES_WGSL, MaterialUniforms, SURFACE_WGSL, SceneUniforms,
};

const SURFACE_ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32];
const FILL_ATTRIBUTES: [wgpu::VertexAttribute; 2] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4];
const LINE_ATTRIBUTES: [wgpu::VertexAttribute; 5] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4, 4 => Float32];

/// Everything about drawing that no picture changes.
pub(super) struct Passes {
    pub background: wgpu::RenderPipeline,
    pub surface: wgpu::RenderPipeline,
    pub fill: wgpu::RenderPipeline,
    pub hidden_fill: wgpu::RenderPipeline,
    pub line: wgpu::RenderPipeline,
    pub hidden_line: wgpu::RenderPipeline,
    pub scene_layout: wgpu::BindGroupLayout,
    pub material_layout: wgpu::BindGroupLayout,
    pub colour_tables: wgpu::TextureView,
}

/// What tells one pipeline from another.
struct Pass<'a> {
    label: &'a str,
    module: &'a wgpu::ShaderModule,
    layout: &'a wgpu::PipelineLayout,
    entry_points: [&'a str; 2],
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    depth_compare: wgpu::CompareFunction,
    depth_write: bool,
    blend: Option<wgpu::BlendState>,
}

impl Passes {
    pub fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let scene_layout = scene_layout(device);
        let material_layout = material_layout(device);
        let layout = |label, groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(label),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let scene_only = layout("scene", &[Some(&scene_layout)]);
        let with_material = layout("surface", &[Some(&scene_layout), Some(&material_layout)]);
        let module = |label, source: &'static str| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            })
        };
        let lines_module = module("lines.wgsl", LINES_WGSL);
        let fill_module = module("fill.wgsl", FILL_WGSL);
        let blended = |label, source, entry_points, buffer, depth_compare| {
            let pass = Pass {
                label,
                module: source,
                layout: &scene_only,
                entry_points,
                buffers: &[Some(buffer)],
                depth_compare,
                depth_write: false,
                blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            };
            pipeline(device, &pass)
        };
        let line_pass = |label, fragment, depth_compare| {
            blended(label, &lines_module, ["vs_line", fragment], line_buffer(), depth_compare)
        };
        let fill_pass = |label, fragment, depth_compare| {
            blended(label, &fill_module, ["vs_fill", fragment], fill_buffer(), depth_compare)
        };
        let background = Pass {
            label: "background",
            module: &module("background.wgsl", BACKGROUND_WGSL),
            layout: &scene_only,
            entry_points: ["vs_background", "fs_background"],
            buffers: &[],
            depth_compare: wgpu::CompareFunction::Always,
            depth_write: false,
            blend: None,
        };
        let surface = Pass {
            label: "surface",
            module: &module("surface.wgsl", SURFACE_WGSL),
            layout: &with_material,
            entry_points: ["vs_surface", "fs_surface"],
            buffers: &[Some(surface_buffer())],
            depth_compare: wgpu::CompareFunction::Less,
            depth_write: true,
            blend: None,
        };
        Self {
            background: pipeline(device, &background),
            surface: pipeline(device, &surface),
            fill: fill_pass("fills", "fs_fill", wgpu::CompareFunction::LessEqual),
            hidden_fill: fill_pass(
                "hidden fills",
                "fs_hidden_fill",
                wgpu::CompareFunction::Greater,
            ),
            line: line_pass("lines", "fs_line", wgpu::CompareFunction::LessEqual),
            hidden_line: line_pass(
                "hidden lines",
                "fs_hidden_line",
                wgpu::CompareFunction::Greater,
            ),
            colour_tables: colour_tables(gpu),
            scene_layout,
            material_layout,
        }
    }
}

fn pipeline(device: &wgpu::Device, pass: &Pass<'_>) -> wgpu::RenderPipeline {
    let [vertex, fragment] = pass.entry_points;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.label),
        layout: Some(pass.layout),
        vertex: wgpu::VertexState {
            module: pass.module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: pass.buffers,
        },
        // Both sides of cloth are seen, so nothing is culled.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(pass.depth_write),
            depth_compare: Some(pass.depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: SAMPLE_COUNT, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: pass.module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: TARGET_FORMAT,
                blend: pass.blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn surface_buffer() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<SurfaceVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &SURFACE_ATTRIBUTES,
    }
}

fn fill_buffer() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<FillVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &FILL_ATTRIBUTES,
    }
}

fn line_buffer() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Line>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &LINE_ATTRIBUTES,
    }
}

fn scene_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene"),
        entries: &[
            uniform_entry(size_of::<SceneUniforms>(), false),
            wgpu::BindGroupLayoutEntry {
                binding: 1,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            },
        ],
    })
}

fn material_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("material"),
        entries: &[uniform_entry(size_of::<MaterialUniforms>(), true)],
    })
}

fn uniform_entry(size: usize, has_dynamic_offset: bool) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset,
            min_binding_size: std::num::NonZeroU64::new(size as u64),
        },
        count: None,
    }
}

/// A row for each table. The hardware decodes sRGB when the shader reads.
fn colour_tables(gpu: &Gpu) -> wgpu::TextureView {
    let size = [COLOURS_PER_TABLE as u32, ColourTable::ALL.len() as u32];
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("colour tables"),
        size: extent(size),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let texels: Vec<[u8; 4]> = ColourTable::ALL
        .iter()
        .flat_map(|table| table.colours().iter().map(|colour| colour.with_alpha(255)))
        .collect();
    gpu.queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * size[0]),
            rows_per_image: None,
        },
        texture.size(),
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
