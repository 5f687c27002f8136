//! What each pixel of the shot camera shows: a ray through every pixel centre, against cloth and
//! obstacles.
//!
//! Triangles are tested in homogeneous form ([`OG97`](crate::papers::OG97)): with corners a, b, c in
//! camera space and the ray d, d . (b x c), d . (c x a) and d . (a x b) are the barycentric
//! coordinates but for a common factor, also where the triangle crosses the near plane or the eye's
//! own plane. An edge gives the two triangles beside it values that differ in sign alone, so that
//! no ray slips through between them.

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::mesh::FaceId;
use crate::scene::Surface;
use crate::shot::View;
use crate::sim::Frame;

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    pub what: What,
    /// In the triangle as it is in the world.
    pub barycentric: [f64; 3],
    /// Distance from the eye along the view's axis (m).
    pub depth: f64,
}

/// Index of a garment or an obstacle in a frame, and of its triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    Cloth { garment: u32, face: FaceId },
    Obstacle { index: u32, triangle: u32 },
}

/// A picture of what is seen, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    size: [u32; 2],
    pixels: Vec<Option<Sighting>>,
}

impl Raster {
    /// A frame in so many pixels; the view fills them. `surfaces` are the obstacles', in the order
    /// of the frame's poses. The same for any number of threads.
    pub fn new(frame: &Frame, surfaces: &[Arc<Surface>], view: &View, size: [u32; 2]) -> Self {
        let grid = Grid { view, size };
        let triangles = triangles(frame, surfaces, view);
        let bands = in_bands(&triangles, &grid);
        let width = size[0] as usize;
        let mut pixels = vec![None; width * size[1] as usize];
        pixels.par_chunks_mut((width * BAND_ROWS).max(1)).zip(&bands).enumerate().for_each(
            |(band, (pixels, members))| {
                let first_row = band * BAND_ROWS;
                for &(index, ref bounds) in members {
                    let triangle = &triangles[index as usize];
                    for (row, pixels) in (first_row..).zip(pixels.chunks_mut(width)) {
                        if bounds.rows.contains(&row) {
                            triangle.draw(&grid, row, bounds.columns.clone(), pixels);
                        }
                    }
                }
            },
        );
        Self { size, pixels }
    }

    /// Width and height (px).
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    pub fn pixels(&self) -> &[Option<Sighting>] {
        &self.pixels
    }

    /// The pixel which holds a point of the image, in units of this raster; `None` outside.
    pub fn at(&self, point: DVec2) -> Option<Option<Sighting>> {
        let [x, y] = point.floor().to_array();
        let [width, height] = self.size.map(f64::from);
        let is_inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
        is_inside.then(|| self.pixels[y as usize * self.size[0] as usize + x as usize])
    }

    /// Per pixel whether it shows cloth.
    pub fn cloth_mask(&self) -> Vec<bool> {
        let is_cloth =
            |p: &Option<Sighting>| p.is_some_and(|s| matches!(s.what, What::Cloth { .. }));
        self.pixels.iter().map(is_cloth).collect()
    }
}

/// Rows that are drawn together.
const BAND_ROWS: usize = 16;

/// Where the rays go.
pub(super) struct Grid<'a> {
    pub view: &'a View,
    pub size: [u32; 2],
}

impl Grid<'_> {
    /// From the eye through the centre of a pixel to the plane one metre in front, camera space.
    pub fn ray(&self, column: usize, row: usize) -> DVec3 {
        let View { gate_min, gate_max, .. } = *self.view;
        let share = |at: usize, count: u32| (at as f64 + 0.5) / f64::from(count);
        let gate = gate_max - gate_min;
        let x = gate_min.x + gate.x * share(column, self.size[0]);
        let y = gate_max.y - gate.y * share(row, self.size[1]);
        DVec3::new(x, y, -1.0)
    }

    /// A point in front of the near plane, in pixels from the top left corner.
    fn point_in_grid(&self, point_in_camera: DVec3) -> DVec2 {
        let View { gate_min, gate_max, .. } = *self.view;
        let on_gate = point_in_camera.truncate() / -point_in_camera.z;
        let share = (on_gate - gate_min) / (gate_max - gate_min);
        let [width, height] = self.size.map(f64::from);
        DVec2::new(share.x * width, (1.0 - share.y) * height)
    }
}

struct Triangle {
    /// In camera space (m).
    corners: [DVec3; 3],
    what: What,
}

/// The pixels whose centres a triangle may hold.
#[derive(Clone)]
struct PixelBounds {
    columns: Range<usize>,
    rows: Range<usize>,
}

fn triangles(frame: &Frame, surfaces: &[Arc<Surface>], view: &View) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for (garment, mesh) in (0..).zip(&frame.garments) {
        triangles.extend(mesh.face_ids().map(|face| Triangle {
            corners: mesh.face_positions(face).map(|p| view.point_in_camera(p)),
            what: What::Cloth { garment, face },
        }));
    }
    for (index, (surface, &pose)) in (0..).zip(surfaces.iter().zip(&frame.obstacle_poses)) {
        let in_camera = |&p: &DVec3| view.point_in_camera(pose.transform_point(p));
        let own = frame.points_of_obstacle(index as usize, surface);
        let points: Vec<DVec3> = own.iter().map(in_camera).collect();
        triangles.extend((0..).zip(&surface.triangles).map(|(triangle, corners)| Triangle {
            corners: corners.map(|v| points[v as usize]),
            what: What::Obstacle { index, triangle },
        }));
    }
    triangles
}

/// Per band of rows the triangles that reach into it.
fn in_bands(triangles: &[Triangle], grid: &Grid<'_>) -> Vec<Vec<(u32, PixelBounds)>> {
    let mut bands = vec![Vec::new(); (grid.size[1] as usize).div_ceil(BAND_ROWS)];
    for (index, triangle) in (0..).zip(triangles) {
        let Some(bounds) = triangle.bounds(grid) else { continue };
        let last_row = bounds.rows.end - 1;
        for band in &mut bands[bounds.rows.start / BAND_ROWS..=last_row / BAND_ROWS] {
            band.push((index, bounds.clone()));
        }
    }
    bands
}

impl Triangle {
    /// `None` if no pixel centre can be in it: it is outside the frame, not in front of the near
    /// plane, or not finite.
    fn bounds(&self, grid: &Grid<'_>) -> Option<PixelBounds> {
        let points = self.in_front(grid.view.near);
        let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for point in points {
            let point = grid.point_in_grid(point);
            if !point.is_finite() {
                return None;
            }
            (min, max) = (min.min(point), max.max(point));
        }
        // One pixel wider on each side than rounding needs.
        let range = |min: f64, max: f64, count: u32| {
            let count = f64::from(count);
            let (start, end) = ((min - 1.0).max(0.0), (max + 1.0).min(count));
            (start < end).then(|| start.floor() as usize..end.ceil() as usize)
        };
        Some(PixelBounds {
            columns: range(min.x, max.x, grid.size[0])?,
            rows: range(min.y, max.y, grid.size[1])?,
        })
    }

    /// The corners of the part in front of the near plane.
    fn in_front(&self, near: f64) -> impl Iterator<Item = DVec3> {
        let height = move |p: DVec3| -p.z - near;
        (0..3).flat_map(move |k| {
            let [a, b] = [self.corners[k], self.corners[(k + 1) % 3]];
            let (ha, hb) = (height(a), height(b));
            let crossing = ((ha > 0.0) != (hb > 0.0)).then(|| a.lerp(b, ha / (ha - hb)));
            [(ha > 0.0).then_some(a), crossing].into_iter().flatten()
        })
    }

    fn draw(
        &self,
        grid: &Grid<'_>,
        row: usize,
        columns: Range<usize>,
        pixels: &mut [Option<Sighting>],
    ) {
        let [a, b, c] = self.corners;
        let normals = [b.cross(c), c.cross(a), a.cross(b)];
        for column in columns {
            let ray = grid.ray(column, row);
            let Some(barycentric) = barycentric(ray, normals) else { continue };
            let depth = -(0..3).map(|k| self.corners[k].z * barycentric[k]).sum::<f64>();
            let is_between = depth >= grid.view.near && depth <= grid.view.far;
            let pixel = &mut pixels[column];
            if is_between && pixel.is_none_or(|seen| depth < seen.depth) {
                *pixel = Some(Sighting { what: self.what, barycentric, depth });
            }
        }
    }
}

/// Where a ray meets a triangle, from whichever side; `None` if it misses, or runs within it.
fn barycentric(ray: DVec3, normals: [DVec3; 3]) -> Option<[f64; 3]> {
    let volumes = normals.map(|n| ray.dot(n));
    let is_inside = volumes.iter().all(|&v| v >= 0.0) || volumes.iter().all(|&v| v <= 0.0);
    let sum: f64 = volumes.iter().sum();
    (is_inside && sum != 0.0).then(|| volumes.map(|v| v / sum))
}

/// How far from the eye a ray meets the plane of a triangle, along the view's axis (m); `None` if
/// it runs along the plane.
pub(super) fn plane_depth(ray: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let normal = (b - a).cross(c - a);
    let depth = normal.dot(a) / normal.dot(ray);
    depth.is_finite().then_some(depth)
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;
