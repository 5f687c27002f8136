//! OBJ and motion files as text. Hundredths of a millimetre are enough for both.

use std::fmt::Write;

use shotsilk::mesh::RawMesh;
use shotsilk::scene::{Pose, Surface};

/// An obstacle's OBJ.
pub fn surface(surface: &Surface) -> String {
    let mut text = String::from("# Made by examples/make_assets.rs\n");
    for p in &surface.positions {
        writeln!(text, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z).expect(TO_MEMORY);
    }
    for [a, b, c] in &surface.triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect(TO_MEMORY);
    }
    text
}

/// A garment's OBJ: nodes, flat vertices, faces of both.
pub fn cloth(mesh: &RawMesh) -> String {
    let mut text = String::from("# Made by examples/make_assets.rs\n");
    for p in &mesh.positions {
        writeln!(text, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z).expect(TO_MEMORY);
    }
    for (_, flat) in &mesh.vertices {
        writeln!(text, "vt {:.5} {:.5}", flat.x, flat.y).expect(TO_MEMORY);
    }
    for face in &mesh.faces {
        let corner = |v: u32| format!("{}/{}", mesh.vertices[v as usize].0 + 1, v + 1);
        let [a, b, c] = face.map(corner);
        writeln!(text, "f {a} {b} {c}").expect(TO_MEMORY);
    }
    text
}

/// A motion file: of each body all positions, then all orientations (w x y z).
pub fn motions(bodies: &[Vec<Pose>]) -> String {
    let mut text = format!("NumFrames: {}\n", bodies.first().map_or(0, Vec::len));
    for (body, poses) in bodies.iter().enumerate() {
        writeln!(text, "body[{body}] position").expect(TO_MEMORY);
        for p in poses.iter().map(|pose| pose.translation) {
            writeln!(text, "{:.5} {:.5} {:.5}", p.x, p.y, p.z).expect(TO_MEMORY);
        }
        writeln!(text, "body[{body}] orientation").expect(TO_MEMORY);
        for q in poses.iter().map(|pose| pose.rotation) {
            // A quaternion and its negative are the same turn: one of them is written.
            let q = if q.w < 0.0 { -q } else { q };
            writeln!(text, "{:.6} {:.6} {:.6} {:.6}", q.w, q.x, q.y, q.z).expect(TO_MEMORY);
        }
    }
    text
}

const TO_MEMORY: &str = "writing to memory does not fail";
