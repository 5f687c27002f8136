//! How fine each part of a garment must be, whoever looks ([`NSO12`](crate::papers::NSO12)).

mod base;
mod blend;
mod compression;
mod curvature;
mod obstacle;
mod velocity;

pub use base::base_metric;
pub use blend::faces_to_vertices;
pub use compression::compression_metric;
pub use curvature::{curvature_metric, hinge_curvature_metric, second_fundamental_form};
pub use obstacle::{Plane, obstacle_metric};
pub use velocity::velocity_metric;

#[cfg(test)]
pub(crate) mod tests {
    use glam::{DVec2, DVec3};

    use crate::mesh::{Mesh, RawMesh};

    /// A grid of `columns` by `rows` squares of side `spacing` (m), each cut along a diagonal;
    /// `place` takes material positions to the world.
    pub fn sheet(columns: u32, rows: u32, spacing: f64, place: impl Fn(DVec2) -> DVec3) -> Mesh {
        let width = columns + 1;
        let material: Vec<DVec2> = (0..(rows + 1) * width)
            .map(|i| DVec2::new(f64::from(i % width), f64::from(i / width)) * spacing)
            .collect();
        let square = |i: u32| {
            let a = i / columns * width + i % columns;
            [[a, a + 1, a + width + 1], [a, a + width + 1, a + width]]
        };
        let raw = RawMesh {
            positions: material.iter().map(|&u| place(u)).collect(),
            vertices: material.iter().zip(0..).map(|(&u, node)| (node, u)).collect(),
            faces: (0..rows * columns).flat_map(square).collect(),
            ..RawMesh::default()
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    pub fn flat(u: DVec2) -> DVec3 {
        u.extend(0.0)
    }

    /// Bent around the y axis; the material x axis runs around it.
    pub fn around_cylinder(radius: f64) -> impl Fn(DVec2) -> DVec3 {
        move |u| {
            let angle = u.x / radius;
            DVec3::new(radius * angle.sin(), u.y, -radius * angle.cos())
        }
    }
}
