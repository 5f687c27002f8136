//! States as Wavefront OBJ, for other programs: Z up, metres, as in the simulation.
//!
//! Numbers are in the shortest form that reads back to the same bits. Everything counts from 1.

use std::fmt::Write;

use glam::DVec3;

use crate::mesh::{Id, Mesh};
use crate::scene::{Pose, Surface};

/// A garment: `v` per node, `vt` (m, flat cloth) per vertex, `f node/vertex`.
pub(super) fn cloth_obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in &mesh.position {
        line(&mut text, format_args!("v {} {} {}", p.x, p.y, p.z));
    }
    for vertex in mesh.vertex_ids() {
        let u = mesh.material(vertex);
        line(&mut text, format_args!("vt {} {}", u.x, u.y));
    }
    for face in mesh.face_ids() {
        let [a, b, c] = mesh
            .face_vertices(face)
            .map(|v| format!("{}/{}", mesh.node_of(v).index() + 1, v.index() + 1));
        line(&mut text, format_args!("f {a} {b} {c}"));
    }
    text
}

/// An obstacle where it is at a frame, its points in its own space.
pub(super) fn obstacle_obj(
    surface: &Surface,
    points: &[DVec3],
    world_from_obstacle: Pose,
) -> String {
    let mut text = String::new();
    for &point in points {
        let p = world_from_obstacle.transform_point(point);
        line(&mut text, format_args!("v {} {} {}", p.x, p.y, p.z));
    }
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|point| u64::from(point) + 1);
        line(&mut text, format_args!("f {a} {b} {c}"));
    }
    text
}

fn line(text: &mut String, arguments: std::fmt::Arguments) {
    writeln!(text, "{arguments}").expect("writing to a string does not fail");
}
