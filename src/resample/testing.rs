//! Flat sheets and simple cameras for tests.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, RawMesh};
use crate::shot::View;
use crate::sim::Frame;

/// A square of 1 m in the plane z = 0 from the origin, of so many columns and rows; material
/// positions are x and y.
pub fn sheet(columns: u32, rows: u32) -> Mesh {
    let at = |i: u32, n: u32| f64::from(i) / f64::from(n);
    let points: Vec<DVec2> = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| DVec2::new(at(i, columns), at(j, rows))))
        .collect();
    let index = |i: u32, j: u32| j * (columns + 1) + i;
    let quad = |i: u32, j: u32| {
        let [a, b] = [index(i, j), index(i + 1, j)];
        let [c, d] = [index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let raw = RawMesh {
        positions: points.iter().map(|p| p.extend(0.0)).collect(),
        vertices: (0..).zip(points.iter().copied()).collect(),
        faces: (0..rows).flat_map(|j| (0..columns).flat_map(move |i| quad(i, j))).collect(),
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("the sheet is a mesh")
}

/// The mesh with its nodes elsewhere in the world.
pub fn moved(mesh: &Mesh, place: impl Fn(DVec3) -> DVec3) -> Mesh {
    let mut mesh = mesh.clone();
    for node in mesh.node_ids() {
        mesh.position[node] = place(mesh.position[node]);
    }
    mesh
}

/// Twice as long in x.
pub fn stretched(mesh: &Mesh) -> Mesh {
    moved(mesh, |p| DVec3::new(2.0 * p.x, p.y, p.z))
}

pub fn frame(garments: impl IntoIterator<Item = Mesh>) -> Frame {
    Frame { garments: garments.into_iter().map(Arc::new).collect(), ..Frame::default() }
}

/// A camera two metres above the middle of the sheet that looks down, x to the right, and sees
/// 2 m x 2 m there.
pub fn overhead(resolution: [u32; 2]) -> View {
    View {
        eye: DVec3::new(0.5, 0.5, 2.0),
        right: DVec3::X,
        up: DVec3::Y,
        back: DVec3::Z,
        gate_min: DVec2::splat(-0.5),
        gate_max: DVec2::splat(0.5),
        near: 0.05,
        far: 20.0,
        resolution,
    }
}
