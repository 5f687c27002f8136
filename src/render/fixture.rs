//! Small frames and views for tests.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, RawMesh};
use crate::shot::View;
use crate::sim::Frame;

/// A camera that looks at a point, z up.
pub fn look_at(eye: DVec3, target: DVec3, fov_y_deg: f64, resolution: [u32; 2]) -> View {
    let back = (eye - target).normalize();
    let right = DVec3::Z.cross(back).try_normalize().unwrap_or(DVec3::X);
    let up = back.cross(right);
    let half = (0.5 * fov_y_deg).to_radians().tan();
    let half_gate = DVec2::new(half * f64::from(resolution[0]) / f64::from(resolution[1]), half);
    View {
        eye,
        right,
        up,
        back,
        gate_min: -half_gate,
        gate_max: half_gate,
        near: 0.05,
        far: 80.0,
        resolution,
    }
}

/// A camera one metre above the origin that looks down with north up, and sees 1 m x 1 m there.
pub fn overhead(resolution: [u32; 2]) -> View {
    let half_gate = DVec2::splat(0.5);
    View {
        eye: DVec3::Z,
        right: DVec3::X,
        up: DVec3::Y,
        back: DVec3::Z,
        gate_min: -half_gate,
        gate_max: half_gate,
        near: 0.05,
        far: 80.0,
        resolution,
    }
}

/// Flat triangles with material positions equal to x and y.
pub fn flat(triangles: &[[[f64; 3]; 3]]) -> Mesh {
    let points = triangles.iter().flatten().map(|&p| DVec3::from_array(p));
    let raw = RawMesh {
        positions: points.clone().collect(),
        vertices: points.enumerate().map(|(i, p)| (i as u32, p.truncate())).collect(),
        faces: (0..triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
        ..Default::default()
    };
    Mesh::from_raw(&raw, &[]).expect("the triangles are a mesh")
}

/// A square of 1 m at a height, all of one view factor.
pub fn square(height: f64, view_factor: f64) -> Mesh {
    let corner = |x: f64, y: f64| [x, y, height];
    let (a, b, c, d) = (corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5));
    let mut mesh = flat(&[[a, b, c], [a, c, d]]);
    for face in mesh.face_ids() {
        mesh.view_factor[face] = view_factor;
    }
    mesh
}

pub fn frame(garments: impl IntoIterator<Item = Mesh>) -> Frame {
    Frame { garments: garments.into_iter().map(Arc::new).collect(), ..Frame::default() }
}
