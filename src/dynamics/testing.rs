//! Meshes for this module's tests.

use glam::{DVec2, DVec3};

use super::{StepState, System};
pub use crate::math::Random;
use crate::mesh::{Mesh, RawMesh};
use crate::scene::{Fabric, MeasuredFabric};

/// A square sheet, flat in the world at z = 0, of `cells` by `cells` squares with alternating
/// diagonals, its inner nodes moved by up to `jitter` cells.
pub fn sheet(cells: u32, side: f64, jitter: f64) -> Mesh {
    let mut random = Random::new(u64::from(cells));
    let (rows, cell) = (cells + 1, side / f64::from(cells));
    let mut raw = RawMesh::default();
    for node in 0..rows * rows {
        let (i, j) = (node % rows, node / rows);
        let inside = i % cells != 0 && j % cells != 0;
        let moved = if inside { jitter } else { 0.0 };
        let shift = DVec2::new(random.number(), random.number()) * moved;
        let u = (DVec2::new(f64::from(i), f64::from(j)) + shift) * cell;
        raw.positions.push(u.extend(0.0));
        raw.vertices.push((node, u));
    }
    for cell in 0..cells * cells {
        let (i, j) = (cell % cells, cell / cells);
        let [a, b] = [j * rows + i, j * rows + i + 1];
        let [c, d] = [a + rows, b + rows];
        raw.faces.extend(if (i + j) % 2 == 0 {
            [[a, b, d], [a, d, c]]
        } else {
            [[a, b, c], [b, d, c]]
        });
    }
    Mesh::from_raw(&raw, &[]).expect("a sheet is a mesh")
}

/// Two panels of two triangles, sewn along an edge that is longer, and turned, on the second.
pub fn seamed_strip() -> Mesh {
    let positions = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1], [0.2, 0.0], [0.2, 0.1]]
        .map(|[x, y]| DVec3::new(x, y, 0.0))
        .to_vec();
    let first = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]];
    let second = [[1.0, 0.0], [1.08, -0.02], [1.09, 0.1], [1.01, 0.11]];
    let node = [0, 1, 2, 3, 1, 4, 5, 2];
    let vertices = node.into_iter().zip(first.into_iter().chain(second).map(DVec2::from)).collect();
    let faces = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let rest_angles = vec![([1, 2], 0.4)];
    let raw = RawMesh { positions, vertices, faces, rest_angles, ..Default::default() };
    Mesh::from_raw(&raw, &[]).expect("the strip is a mesh")
}

/// A fabric whose stiffness tables are not read: tests freeze stiffnesses of their own.
pub fn fabric(density: f64, damping: f64) -> Fabric {
    Fabric::Measured(MeasuredFabric {
        density,
        stretching: [[0.0; 4]; 6],
        bending: [[0.0; 5]; 3],
        damping,
        strain_limits: None,
    })
}

/// The largest component of f + dE/dx, as a share of the largest of the forces f (N); the potential
/// energy E is differentiated by central differences of `step` (m) to either side.
pub fn gradient_error(system: &System, state: &StepState, forces: &[DVec3], step: f64) -> f64 {
    let scale = forces.iter().map(|f| f.length()).fold(0.0, f64::max);
    let energy = |node: usize, axis: usize, step: f64| {
        let mut moved = state.clone();
        moved.position[node][axis] += step;
        system.potential_energy(&moved)
    };
    let mut largest = 0.0f64;
    for (node, force) in forces.iter().enumerate() {
        for axis in 0..3 {
            let slope = (energy(node, axis, step) - energy(node, axis, -step)) / (2.0 * step);
            let error = (force[axis] + slope).abs() / scale;
            assert!(error.is_finite(), "node {node} with {force} N");
            largest = largest.max(error);
        }
    }
    largest
}
