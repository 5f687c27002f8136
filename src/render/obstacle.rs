//! An obstacle as triangles: matte, smooth where it is smooth and creased where it has edges.

use glam::DVec3;

use crate::scene::{Pose, Surface};

use super::colour::Srgb;
use super::draw_list::{Material, SurfaceBatch, SurfaceVertex};

/// A tailor's dummy: warm grey, which no colour map contains, and darker than the background.
const MATTE: Material = Material {
    tint: [Srgb([186, 176, 167]), Srgb([140, 132, 126])],
    table: None,
    wire_strength: 0.0,
    sheen: 0.1,
    modelling: 1.0,
};

/// Faces that meet at more than this angle do not share their shading: cosine of 50 degrees.
const CREASE_COS: f64 = 0.642_787_6;

/// The surface, its points in its own space, where its pose puts it. Triangles that name no point are
/// left out.
pub(super) fn batch(
    surface: &Surface,
    points: &[DVec3],
    pose: Pose,
    origin: DVec3,
) -> SurfaceBatch {
    let points: Vec<DVec3> = points.iter().map(|&p| pose.transform_point(p) - origin).collect();
    let known = |t: &&[u32; 3]| t.iter().all(|&i| (i as usize) < points.len());
    let triangles: Vec<[usize; 3]> =
        surface.triangles.iter().filter(known).map(|t| t.map(|i| i as usize)).collect();
    let normals = corner_normals(&points, &triangles);
    let mut vertices = Vec::with_capacity(3 * triangles.len());
    for (corners, normals) in triangles.iter().zip(&normals) {
        for (&corner, normal) in corners.iter().zip(normals) {
            vertices.push(SurfaceVertex {
                position: points[corner].as_vec3().to_array(),
                normal: normal.as_vec3().to_array(),
                colour_coordinate: 0.0,
            });
        }
    }
    SurfaceBatch { material: MATTE, vertices }
}

/// Per corner the mean normal of the faces around its point, weighted by area, without those
/// beyond a crease.
fn corner_normals(points: &[DVec3], triangles: &[[usize; 3]]) -> Vec<[DVec3; 3]> {
    let area_vectors: Vec<DVec3> = triangles
        .iter()
        .map(|&[a, b, c]| (points[b] - points[a]).cross(points[c] - points[a]))
        .collect();
    let units: Vec<DVec3> = area_vectors.iter().map(|n| n.normalize_or_zero()).collect();
    let around = Incidence::new(points.len(), triangles);
    let corner = |face: usize, point: usize| {
        let sum: DVec3 = around
            .faces(point)
            .iter()
            .filter(|&&other| units[other].dot(units[face]) >= CREASE_COS)
            .map(|&other| area_vectors[other])
            .sum();
        sum.try_normalize().unwrap_or(units[face])
    };
    triangles.iter().enumerate().map(|(f, t)| t.map(|point| corner(f, point))).collect()
}

/// The faces around each point, in one array.
struct Incidence {
    starts: Vec<usize>,
    faces: Vec<usize>,
}

impl Incidence {
    fn new(point_count: usize, triangles: &[[usize; 3]]) -> Self {
        let mut starts = vec![0; point_count + 1];
        for &point in triangles.iter().flatten() {
            starts[point + 1] += 1;
        }
        for i in 0..point_count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut faces = vec![0; 3 * triangles.len()];
        for (face, corners) in triangles.iter().enumerate() {
            for &point in corners {
                faces[next[point]] = face;
                next[point] += 1;
            }
        }
        Self { starts, faces }
    }

    fn faces(&self, point: usize) -> &[usize] {
        &self.faces[self.starts[point]..self.starts[point + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_do_not_run_over_a_sharp_edge() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        // Two faces that meet at the x axis in a right angle.
        let normals = corner_normals(&points, &[[0, 1, 2], [1, 0, 3]]);
        assert!(normals[0].iter().all(|n| n.distance(DVec3::Z) < 1e-12), "{normals:?}");
        let lifted = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(0.0, -1.0, 0.2)];
        let smooth = corner_normals(&lifted, &[[0, 1, 2], [1, 0, 3]]);
        assert!(smooth[0][0].distance(DVec3::Z) > 1e-3, "{smooth:?}");
    }
}
