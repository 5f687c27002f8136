//! Pictures of what a raster holds, and of the error on it: for reports, without a graphics
//! adapter.

use std::sync::Arc;

use glam::DVec3;
use image::{Rgba, RgbaImage};

use super::picture::side_by_side;
use super::report::short;
use crate::mesh::{IdVec, NodeId};
use crate::render::{Align, ColourTable, Face, LogRange, Srgb, draw_text};
use crate::resample::{Measured, Raster, Sighting, What};
use crate::scene::Surface;
use crate::shot::View;
use crate::sim::Frame;

/// Displacements between which the colour tells (px); beyond, it stays as at the end.
const ERROR_RANGE: LogRange = LogRange { start: 0.1, end: 10.0 };
const ERROR_TICKS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];

const CLOTH: Srgb = Srgb([214, 216, 222]);
const OBSTACLE: Srgb = Srgb([150, 146, 142]);
const BACKGROUND: Srgb = Srgb([240, 241, 244]);
const INK: Srgb = Srgb([44, 46, 52]);

/// Brightness of a surface that is seen edge on; 1 where it faces the eye.
const EDGE_ON: f64 = 0.4;

/// The same where the colour has a meaning, which darkness would hide.
const EDGE_ON_COLOURED: f64 = 0.85;

/// The reference, the other run, and the reference coloured by how far the other's cloth is from
/// it on the image.
pub fn error_page(
    measured: &Measured,
    [reference, other]: [&Frame; 2],
    surfaces: &[Arc<Surface>],
    view: &View,
) -> RgbaImage {
    let size = measured.raster.size();
    let plain =
        |raster: &Raster, frame| shaded(raster, (frame, surfaces), view, EDGE_ON, |_| CLOTH);
    let others = Raster::new(other, surfaces, view, size);
    let error_colour = |pixel: usize| {
        let shift = measured.displacement.shift[pixel].map_or(0.0, |s| s.length());
        ColourTable::EdgeSize.colour(ERROR_RANGE.coordinate(shift))
    };
    let mut error =
        shaded(&measured.raster, (reference, surfaces), view, EDGE_ON_COLOURED, error_colour);
    draw_legend(&mut error);
    side_by_side(&[&plain(&measured.raster, reference), &plain(&others, other), &error])
}

/// Lit from the eye; `edge_on` is the least brightness of cloth, `cloth` its colour by the index of
/// its pixel.
fn shaded(
    raster: &Raster,
    (frame, surfaces): (&Frame, &[Arc<Surface>]),
    view: &View,
    edge_on: f64,
    cloth: impl Fn(usize) -> Srgb,
) -> RgbaImage {
    let normals: Vec<IdVec<NodeId, DVec3>> =
        frame.garments.iter().map(|mesh| mesh.node_normals()).collect();
    let pixel = |index: usize| {
        let Some(seen) = raster.pixels()[index] else { return BACKGROUND };
        let (colour, normal, least) = match seen.what {
            What::Cloth { garment, face } => {
                let nodes = frame.garments[garment as usize].face_nodes(face);
                let corners = nodes.map(|n| normals[garment as usize][n]);
                (cloth(index), weighted(corners, seen), edge_on)
            }
            What::Obstacle { index, triangle } => {
                let surface = &surfaces[index as usize];
                let points = frame.points_of_obstacle(index as usize, surface);
                let [a, b, c] = surface.triangles[triangle as usize].map(|v| points[v as usize]);
                let pose = frame.obstacle_poses[index as usize];
                (OBSTACLE, pose.transform_vector((b - a).cross(c - a)), EDGE_ON)
            }
        };
        let facing = normal.normalize_or_zero().dot(view.back).abs();
        dimmed(colour, least + (1.0 - least) * facing)
    };
    let [width, height] = raster.size();
    RgbaImage::from_fn(width, height, |x, y| Rgba(pixel((y * width + x) as usize).with_alpha(255)))
}

fn weighted(corners: [DVec3; 3], seen: Sighting) -> DVec3 {
    (0..3).map(|k| corners[k] * seen.barycentric[k]).sum()
}

fn dimmed(colour: Srgb, brightness: f64) -> Srgb {
    Srgb(colour.0.map(|channel| (f64::from(channel) * brightness).round() as u8))
}

/// What the colours mean, in the upper left corner.
fn draw_legend(image: &mut RgbaImage) {
    let text_px = (image.height() as f32 / 32.0).clamp(10.0, 24.0);
    let (left, top) = (text_px, text_px * 1.8);
    let (length, height) = ((14.0 * text_px) as u32, text_px as u32);
    if image.width() < length + 4 * text_px as u32 {
        return;
    }
    let title = "displacement (px)";
    draw_text(image, (Face::Sans, text_px), (left, text_px * 1.4), Align::Left, INK, title);
    for x in 0..length {
        let colour = ColourTable::EdgeSize.colour(f64::from(x) / f64::from(length - 1));
        for y in 0..height {
            image.put_pixel(left as u32 + x, top as u32 + y, Rgba(colour.with_alpha(255)));
        }
    }
    for value in ERROR_TICKS {
        let x = left + ERROR_RANGE.coordinate(value) as f32 * length as f32;
        let place = (x, top + 2.1 * text_px);
        let label = short(value);
        let label = label.trim_end_matches('0').trim_end_matches('.');
        draw_text(image, (Face::Sans, text_px), place, Align::Centre, INK, label);
    }
}
