//! What to draw, as plain data: surfaces, marks on them and lines, relative to an origin.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::scene::Surface;
use crate::sim::Frame;

use super::bounds::Bounds;
use super::colour::Srgb;
use super::colour_table::ColourTable;
use super::options::{Background, PictureOptions};
use super::{cloth, ground, obstacle};

/// A picture's content, whoever looks at it.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawList {
    /// Where the local space of the vertices has its origin, in the world (m): near the cloth, so
    /// that 32 bits are precise there.
    pub origin: DVec3,
    pub surfaces: Vec<SurfaceBatch>,
    /// Translucent triangles, three corners each, that shine through surfaces.
    pub fills: Vec<FillVertex>,
    /// Lines that surfaces hide.
    pub ground_lines: Vec<Line>,
    /// Lines that shine faintly through surfaces.
    pub overlay_lines: Vec<Line>,
    pub background: Background,
    pub wire_width_px: f32,
}

/// Triangles that share a material; three vertices each.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceBatch {
    pub material: Material,
    pub vertices: Vec<SurfaceVertex>,
}

/// How a surface takes light and colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Colours of front and back where no table is shown.
    pub tint: [Srgb; 2],
    pub table: Option<ColourTable>,
    /// How dark the mesh's edges are, 0..1.
    pub wire_strength: f32,
    /// Brightening towards grazing angles, 0..1.
    pub sheen: f32,
    /// How much of the light's modelling is kept, 0..1.
    pub modelling: f32,
}

/// A corner of a triangle as the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SurfaceVertex {
    /// Relative to the draw list's origin (m).
    pub position: [f32; 3],
    /// Unit, on the front side.
    pub normal: [f32; 3],
    /// 0..1 along the material's table.
    pub colour_coordinate: f32,
}

/// A corner of a translucent triangle as the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FillVertex {
    /// Relative to the draw list's origin (m).
    pub position: [f32; 3],
    /// sRGB and opacity.
    pub colour: [u8; 4],
}

/// A line of constant width on the image, as the shader reads it; without length it is a dot.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Line {
    /// Relative to the draw list's origin (m).
    pub start: [f32; 3],
    pub end: [f32; 3],
    /// sRGB and opacity.
    pub start_colour: [u8; 4],
    pub end_colour: [u8; 4],
    pub width_px: f32,
}

impl DrawList {
    /// The frame's garments, its obstacles and the ground. `surfaces` are the obstacles', in the
    /// order of the frame's poses; those without a pose are not drawn.
    pub fn new(frame: &Frame, surfaces: &[Arc<Surface>], options: &PictureOptions) -> Self {
        let cloth_bounds = Bounds::of_cloth(frame);
        let origin = cloth_bounds.centre();
        let mut list = Self {
            origin,
            surfaces: Vec::new(),
            fills: Vec::new(),
            ground_lines: Vec::new(),
            overlay_lines: Vec::new(),
            background: options.background,
            wire_width_px: options.wire_width_px,
        };
        for (index, mesh) in frame.garments.iter().enumerate() {
            list.surfaces.push(cloth::batch(mesh, index, origin, options));
        }
        for (index, (surface, pose)) in surfaces.iter().zip(&frame.obstacle_poses).enumerate() {
            let points = frame.points_of_obstacle(index, surface);
            list.surfaces.push(obstacle::batch(surface, points, *pose, origin));
        }
        if let Some(height) = options.ground_height {
            list.ground_lines = ground::lines(height, cloth_bounds, origin);
        }
        list
    }

    /// A point of the world in the list's local space.
    pub fn point_in_local(&self, point_in_world: DVec3) -> Vec3 {
        (point_in_world - self.origin).as_vec3()
    }

    /// A line between two points of the world, that shines through surfaces.
    pub fn push_line(&mut self, start: DVec3, end: DVec3, colour: [u8; 4], width_px: f32) {
        let line = Line {
            start: self.point_in_local(start).to_array(),
            end: self.point_in_local(end).to_array(),
            start_colour: colour,
            end_colour: colour,
            width_px,
        };
        self.overlay_lines.push(line);
    }
}
