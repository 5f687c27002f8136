//! Draws a list as a view sees it. Pipelines, buffers and attachments live as long as this.

use bytemuck::Zeroable;
use glam::DMat4;

use crate::shot::View;

use super::buffer::{GrowingBuffer, Storage};
use super::draw_list::{DrawList, FillVertex, Line, Material, SurfaceVertex};
use super::gpu::{Gpu, RenderError};
use super::passes::Passes;
use super::target::{Attachments, Target};
use super::uniforms::{MaterialUniforms, SceneUniforms};

/// Distance of materials in their buffer (bytes): what every adapter can address.
const MATERIAL_STRIDE: usize = 256;
/// Sizes of targets remembered: shot and witness, and a spare for a window being resized.
const ATTACHMENTS_KEPT: usize = 3;

/// See the module.
pub struct Renderer {
    passes: Passes,
    scene: wgpu::Buffer,
    scene_group: wgpu::BindGroup,
    materials: GrowingBuffer,
    material_group: Option<wgpu::BindGroup>,
    vertices: GrowingBuffer,
    fills: GrowingBuffer,
    lines: GrowingBuffer,
    attachments: Vec<Attachments>,
}

impl Renderer {
    pub fn new(gpu: &Gpu) -> Self {
        let passes = Passes::new(gpu);
        let scene = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scene"),
            size: size_of::<SceneUniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let scene_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &passes.scene_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: scene.as_entire_binding() },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&passes.colour_tables),
                },
            ],
        });
        Self {
            passes,
            scene,
            scene_group,
            materials: GrowingBuffer::new("materials", wgpu::BufferUsages::UNIFORM),
            material_group: None,
            vertices: GrowingBuffer::new("surface vertices", wgpu::BufferUsages::VERTEX),
            fills: GrowingBuffer::new("fills", wgpu::BufferUsages::VERTEX),
            lines: GrowingBuffer::new("lines", wgpu::BufferUsages::VERTEX),
            attachments: Vec::new(),
        }
    }

    /// Draws and submits. The view fills the target, whatever the view's own resolution.
    ///
    /// # Errors
    /// If the target's size is impossible, or the device reports an error.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        draw: &DrawList,
        view: &View,
        target: Target<'_>,
    ) -> Result<(), RenderError> {
        gpu.check_size(target.size)?;
        self.upload(gpu, draw, view, target.size);
        self.keep_attachments(gpu, target.size);
        let attachments = self.attachments.last().expect("kept just now");
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = begin(&mut encoder, attachments, target);
            self.record(&mut pass, draw);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()
    }

    fn record(&self, pass: &mut wgpu::RenderPass<'_>, draw: &DrawList) {
        pass.set_bind_group(0, &self.scene_group, &[]);
        pass.set_pipeline(&self.passes.background);
        pass.draw(0..3, 0..1);

        if let (Some(vertices), Some(group)) = (self.vertices.slice(), &self.material_group) {
            pass.set_pipeline(&self.passes.surface);
            pass.set_vertex_buffer(0, vertices);
            let mut first = 0;
            for (index, batch) in draw.surfaces.iter().enumerate() {
                let end = first + batch.vertices.len() as u32;
                pass.set_bind_group(1, group, &[(index * MATERIAL_STRIDE) as u32]);
                pass.draw(first..end, 0..1);
                first = end;
            }
        }
        if let Some(fills) = self.fills.slice() {
            let count = draw.fills.len() as u32;
            pass.set_vertex_buffer(0, fills);
            pass.set_pipeline(&self.passes.hidden_fill);
            pass.draw(0..count, 0..1);
            pass.set_pipeline(&self.passes.fill);
            pass.draw(0..count, 0..1);
        }
        if let Some(lines) = self.lines.slice() {
            let ground_count = draw.ground_lines.len() as u32;
            let count = ground_count + draw.overlay_lines.len() as u32;
            pass.set_vertex_buffer(0, lines);
            pass.set_pipeline(&self.passes.line);
            pass.draw(0..6, 0..ground_count);
            pass.set_pipeline(&self.passes.hidden_line);
            pass.draw(0..6, ground_count..count);
            pass.set_pipeline(&self.passes.line);
            pass.draw(0..6, ground_count..count);
        }
    }

    fn upload(&mut self, gpu: &Gpu, draw: &DrawList, view: &View, size: [u32; 2]) {
        let scene = scene_uniforms(draw, view, size);
        gpu.queue.write_buffer(&self.scene, 0, bytemuck::bytes_of(&scene));

        let mut materials = vec![0u8; draw.surfaces.len() * MATERIAL_STRIDE];
        for (slot, batch) in materials.chunks_exact_mut(MATERIAL_STRIDE).zip(&draw.surfaces) {
            let uniforms = material_uniforms(&batch.material);
            slot[..size_of::<MaterialUniforms>()].copy_from_slice(bytemuck::bytes_of(&uniforms));
        }
        if self.materials.write(gpu, &[&materials]) == Storage::New {
            self.material_group = self.materials.buffer.as_ref().map(|b| self.bind(gpu, b));
        }
        let vertices: Vec<&[SurfaceVertex]> =
            draw.surfaces.iter().map(|batch| batch.vertices.as_slice()).collect();
        self.vertices.write(gpu, &vertices);
        let fills: [&[FillVertex]; 1] = [&draw.fills];
        self.fills.write(gpu, &fills);
        let lines: [&[Line]; 2] = [&draw.ground_lines, &draw.overlay_lines];
        self.lines.write(gpu, &lines);
    }

    fn bind(&self, gpu: &Gpu, materials: &wgpu::Buffer) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout: &self.passes.material_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: materials,
                    offset: 0,
                    size: std::num::NonZeroU64::new(size_of::<MaterialUniforms>() as u64),
                }),
            }],
        })
    }

    /// Puts attachments of this size last, made anew unless they are among the kept ones.
    fn keep_attachments(&mut self, gpu: &Gpu, size: [u32; 2]) {
        let found = self.attachments.iter().position(|a| a.size == size);
        let wanted = match found {
            Some(index) => self.attachments.remove(index),
            None => Attachments::new(gpu, size),
        };
        if self.attachments.len() == ATTACHMENTS_KEPT {
            self.attachments.remove(0);
        }
        self.attachments.push(wanted);
    }
}

fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    attachments: &Attachments,
    target: Target<'_>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("picture"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &attachments.colour,
            depth_slice: None,
            resolve_target: Some(target.colour),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                store: wgpu::StoreOp::Discard,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &attachments.depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn scene_uniforms(draw: &DrawList, view: &View, [width, height]: [u32; 2]) -> SceneUniforms {
    // Multiplied in 64 bits: the large translations cancel before they are rounded.
    let clip_from_local = view.clip_from_world() * DMat4::from_translation(draw.origin);
    SceneUniforms {
        clip_from_local: clip_from_local.as_mat4().to_cols_array_2d(),
        eye_in_local: draw.point_in_local(view.eye).to_array(),
        wire_half_width_px: 0.5 * draw.wire_width_px,
        background_top: draw.background.top.linear().to_array(),
        width_px: width as f32,
        background_bottom: draw.background.bottom.linear().to_array(),
        height_px: height as f32,
    }
}

fn material_uniforms(material: &Material) -> MaterialUniforms {
    let [front, back] = material.tint;
    MaterialUniforms {
        front_tint: front.linear().to_array(),
        table_share: if material.table.is_some() { 1.0 } else { 0.0 },
        back_tint: back.linear().to_array(),
        table_row: material.table.map_or(0, |table| table.row() as u32),
        wire_strength: material.wire_strength,
        sheen: material.sheen,
        modelling: material.modelling,
        ..Zeroable::zeroed()
    }
}
