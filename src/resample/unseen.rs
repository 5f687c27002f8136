//! What is wrong where the camera does not look.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::cloth_map::ClothMap;
use super::displacement::{Pair, pixel_size};
use super::raster::{Grid, Raster, Sighting, What, plane_depth};
use super::spread::Spread;
use crate::mesh::{FaceId, Mesh};
use crate::shot::View;

/// Points of the cloth that are looked at: their spacing is the side of a square of this share of
/// the garment's area.
const SAMPLE_AREA: f64 = 1.0 / 10_000.0;

/// Parts that a face's edge is divided into, at most.
const PARTS_MAX: u32 = 64;

/// Shorter distances are none (m): coordinates of metres round by some 1e-16 m, those of kilometres by
/// some 1e-13 m.
const DISTANCE_MIN: f64 = 1e-12;

/// Cloth that the reference does not show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unseen {
    /// Share of the cloth's material area.
    pub area_share: f64,
    /// Distance in the world between its points in the two runs (m), by material area.
    pub displacement: Spread,
}

struct Sample {
    /// Material area that it stands for (m^2).
    area: f64,
    /// `None` if the reference shows it.
    displacement: Option<f64>,
}

impl Unseen {
    /// `raster` is the reference's picture. A point is seen if it lies in the frame and no deeper
    /// than what its pixel shows, but for the width of a pixel.
    pub fn new(raster: &Raster, pair: Pair<'_>, view: &View) -> Self {
        let mut samples: Vec<Sample> = Vec::new();
        for (garment, locator) in pair.reference.locators().iter().enumerate() {
            let mesh = locator.mesh();
            let spacing = (mesh.total_material_area() * SAMPLE_AREA).sqrt();
            let faces: Vec<FaceId> = mesh.face_ids().collect();
            samples.par_extend(
                faces.par_iter().flat_map_iter(|&face| {
                    face_samples(raster, pair, view, (garment, face), spacing)
                }),
            );
        }
        let total: f64 = samples.iter().map(|s| s.area).sum();
        let hidden = || samples.iter().filter_map(|s| Some((s.displacement?, s.area)));
        let area: f64 = hidden().map(|(_, area)| area).sum();
        let area_share = if total > 0.0 { area / total } else { 0.0 };
        Self { area_share, displacement: Spread::weighted(hidden()) }
    }
}

fn face_samples<'a>(
    raster: &'a Raster,
    pair: Pair<'a>,
    view: &'a View,
    (garment, face): (usize, FaceId),
    spacing: f64,
) -> impl Iterator<Item = Sample> + 'a {
    let mesh = pair.reference.locators()[garment].mesh();
    let corners = mesh.face_positions(face);
    let parts = parts(mesh, face, spacing);
    let area = mesh.material_area(face) / f64::from(parts * parts);
    centres(parts).map(move |barycentric| {
        let point = (0..3).map(|k| corners[k] * barycentric[k]).sum();
        let is_seen = is_seen(raster, view, (garment, face), corners, point);
        let displacement = (!is_seen).then(|| {
            displacement(pair, pair.reference.cloth_point(garment, face, barycentric), point)
        });
        Sample { area, displacement }
    })
}

fn displacement(pair: Pair<'_>, at: super::ClothPoint, point_in_world: DVec3) -> f64 {
    let other: &ClothMap = pair.other;
    let distance = other.point_in_world(at).distance(point_in_world);
    if distance < DISTANCE_MIN { 0.0 } else { distance }
}

/// How many parts each edge of a face is divided into so that none is longer than the spacing.
fn parts(mesh: &Mesh, face: FaceId, spacing: f64) -> u32 {
    let [a, b, c] = mesh.face_material(face);
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    ((longest / spacing).ceil() as u32).clamp(1, PARTS_MAX)
}

/// Barycentric coordinates of the middles of the n^2 equal parts of a triangle.
fn centres(n: u32) -> impl Iterator<Item = [f64; 3]> {
    let at = move |i: u32, j: u32, third: f64| {
        let [u, v] = [i, j].map(|k| (f64::from(k) + third) / f64::from(n));
        [1.0 - u - v, u, v]
    };
    (0..n).flat_map(move |i| {
        let upright = (0..n - i).map(move |j| at(i, j, 1.0 / 3.0));
        let inverted = (0..(n - i).saturating_sub(1)).map(move |j| at(i, j, 2.0 / 3.0));
        upright.chain(inverted)
    })
}

/// Whether the picture shows a point of a garment's face.
fn is_seen(
    raster: &Raster,
    view: &View,
    (garment, face): (usize, FaceId),
    corners: [DVec3; 3],
    point: DVec3,
) -> bool {
    let Some(in_image) = view.point_in_image(point) else { return false };
    let in_raster: DVec2 = in_image / pixel_size(view, raster);
    let Some(shown) = raster.at(in_raster) else { return false };
    // A pixel at the cloth's border may show what is behind it.
    let Some(Sighting { what, depth, .. }) = shown else { return true };
    if what == (What::Cloth { garment: garment as u32, face }) {
        return true;
    }
    let [column, row] = in_raster.to_array().map(|x| x as usize);
    let ray = Grid { view, size: raster.size() }.ray(column, row);
    let corners = corners.map(|p| view.point_in_camera(p));
    let own = plane_depth(ray, corners).unwrap_or(-view.point_in_camera(point).z);
    let pixel_width = (view.gate_max.x - view.gate_min.x) / f64::from(raster.size()[0]);
    own <= depth * (1.0 + pixel_width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_triangle_are_so_many_and_balance_in_its_middle() {
        for n in [1, 2, 5] {
            let all: Vec<[f64; 3]> = centres(n).collect();
            assert_eq!(all.len(), (n * n) as usize);
            for k in 0..3 {
                let mean = all.iter().map(|b| b[k]).sum::<f64>() / all.len() as f64;
                assert!((mean - 1.0 / 3.0).abs() < 1e-12);
                assert!(all.iter().all(|b| b[k] > 0.0));
            }
        }
    }
}
