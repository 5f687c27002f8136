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
mod tests {
    use proptest::prelude::*;

    use super::super::testing::{frame, moved, overhead, sheet};
    use super::*;
    use crate::scene::Pose;

    const SIZE: [u32; 2] = [64, 48];

    fn cloth_count(raster: &Raster) -> usize {
        raster.cloth_mask().iter().filter(|&&c| c).count()
    }

    #[test]
    fn a_square_covers_its_share_of_the_picture_without_holes_or_seams() {
        for columns in [1, 3, 17] {
            let view = overhead(SIZE);
            let raster = Raster::new(&frame([sheet(columns, 5)]), &[], &view, SIZE);
            // Half the width and half the height.
            assert_eq!(cloth_count(&raster), 32 * 24);
        }
    }

    #[test]
    fn what_a_pixel_shows_is_the_point_on_its_ray() {
        let view = overhead(SIZE);
        let mesh = moved(&sheet(4, 4), |p| DVec3::new(p.x, p.y, 0.4 * p.x * p.y));
        let raster = Raster::new(&frame([mesh.clone()]), &[], &view, SIZE);
        assert!(cloth_count(&raster) > 500);
        for (index, seen) in raster.pixels().iter().enumerate() {
            let Some(Sighting { what: What::Cloth { face, .. }, barycentric, depth }) = *seen
            else {
                continue;
            };
            let corners = mesh.face_positions(face);
            let point: DVec3 = (0..3).map(|k| corners[k] * barycentric[k]).sum();
            let centre = DVec2::new((index % 64) as f64 + 0.5, (index / 64) as f64 + 0.5);
            assert!(view.point_in_image(point).unwrap().distance(centre) < 1e-9);
            assert!((depth - (view.eye - point).dot(view.back)).abs() < 1e-12);
        }
    }

    #[test]
    fn an_obstacle_in_front_hides_and_one_behind_does_not() {
        let view = overhead(SIZE);
        let plate = |z: f64| {
            let corner = |x: f64, y: f64| DVec3::new(x, y, z);
            Arc::new(Surface {
                positions: vec![corner(-9.0, -9.0), corner(0.5, -9.0), corner(0.5, 9.0)],
                triangles: vec![[0, 1, 2]],
            })
        };
        for (z, expected) in [(-0.5, 32 * 24), (0.5, 16 * 24)] {
            let mut frame = frame([sheet(2, 2)]);
            frame.obstacle_poses = vec![Pose::IDENTITY];
            let raster = Raster::new(&frame, &[plate(z)], &view, SIZE);
            assert_eq!(cloth_count(&raster), expected);
        }
    }

    #[test]
    fn cloth_through_the_near_plane_is_seen_up_to_it() {
        // A floor one metre below a level camera, from far behind it to far in front: only what is
        // beyond the near plane shows, in the lower half of the picture.
        let floor = moved(&sheet(1, 1), |p| DVec3::new(40.0 * p.x - 20.0, 40.0 * p.y - 20.0, -1.0));
        let level = View {
            eye: DVec3::ZERO,
            right: DVec3::X,
            up: DVec3::Z,
            back: -DVec3::Y,
            near: 4.0,
            ..overhead([40, 40])
        };
        let raster = Raster::new(&frame([floor]), &[], &level, [40, 40]);
        let mask = raster.cloth_mask();
        let rows: Vec<usize> =
            (0..40).filter(|row| mask[row * 40..(row + 1) * 40].iter().any(|&c| c)).collect();
        // Row r looks down by (r + 0.5 - 20) / 40: depth 4 to 20 are slopes 1/4 to 1/20.
        assert_eq!(rows, (22..30).collect::<Vec<_>>());
        assert!(raster.pixels().iter().flatten().all(|s| s.depth >= 4.0 && s.depth <= 20.0));
    }

    #[test]
    fn cloth_out_of_frame_or_not_finite_draws_nothing() {
        let view = overhead(SIZE);
        for place in [
            (|p| p + 50.0 * DVec3::X) as fn(DVec3) -> DVec3,
            |p| p + 5.0 * DVec3::Z,
            |p| p * f64::NAN,
        ] {
            let raster = Raster::new(&frame([moved(&sheet(2, 2), place)]), &[], &view, SIZE);
            assert_eq!(cloth_count(&raster), 0);
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_picture() {
        let view = overhead([160, 90]);
        let mesh = moved(&sheet(20, 20), |p| DVec3::new(p.x, p.y, (9.0 * p.x).sin() * 0.2));
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Raster::new(&frame([mesh.clone()]), &[], &view, [160, 90]))
        };
        assert_eq!(with(1), with(7));
    }

    proptest! {
        #[test]
        fn edges_between_two_triangles_let_no_ray_through(
            shift in [-0.3..0.3, -0.3..0.3, -0.5..0.5], turn in 0.0..3.0,
        ) {
            // A sheet that fills the frame, turned so that its edges run anywhere.
            let place = |p: DVec3| {
                let flat = DVec2::from_angle(turn).rotate(p.truncate() - 0.5) * 9.0;
                flat.extend(0.0) + DVec3::new(0.5, 0.5, 0.0) + DVec3::from_array(shift)
            };
            let raster =
                Raster::new(&frame([moved(&sheet(13, 11), place)]), &[], &overhead(SIZE), SIZE);
            prop_assert_eq!(cloth_count(&raster), 64 * 48);
        }
    }
}
