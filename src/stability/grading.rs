//! A round sheet that is finer and finer in its middle.

use std::f64::consts::TAU;

use glam::DVec2;

use super::drape;
use super::stress::{Stress, Trial};
use crate::mesh::{Mesh, RawMesh};

/// (m).
const RADIUS: f64 = 0.3;

/// Nodes in a ring, and how much larger each ring is than the one inside.
const AROUND: u32 = 20;
const GROWTH: f64 = 1.3;

pub fn stress() -> Stress {
    Stress {
        name: "grading",
        about: "round sheet dropped on a ball; coarsest edge over finest",
        values: &[3.0, 10.0, 100.0, 1000.0, 10000.0],
        label: |ratio| format!("1:{ratio}"),
        trial,
    }
}

fn trial(ratio: f64) -> Trial {
    drape::of_mesh(disc(ratio))
}

/// Rings of nodes around one in the middle; edges grow with the distance from it.
fn disc(ratio: f64) -> Mesh {
    let count = (ratio.ln() / GROWTH.ln()).ceil().max(1.0) as u32;
    let mut points = vec![DVec2::ZERO];
    for ring in 0..=count {
        let radius = RADIUS * ratio.powf(f64::from(ring) / f64::from(count) - 1.0);
        // Rings stand in each other's gaps.
        let turned = 0.5 * f64::from(ring % 2);
        let angle = |k: u32| TAU * (f64::from(k) + turned) / f64::from(AROUND);
        points.extend((0..AROUND).map(|k| DVec2::from_angle(angle(k)) * radius));
    }
    let node = |ring: u32, k: u32| 1 + ring * AROUND + k % AROUND;
    let mut faces: Vec<[u32; 3]> = (0..AROUND).map(|k| [0, node(0, k), node(0, k + 1)]).collect();
    for ring in 0..count {
        // The outer ring is half a place ahead of an even one, and half a place behind an odd one.
        let ahead = ring % 2;
        for k in 0..AROUND {
            let [a, b] = [node(ring, k), node(ring, k + 1)];
            let [c, d] = [node(ring + 1, k + ahead), node(ring + 1, k + ahead + AROUND - 1)];
            faces.extend([[a, c, b], [a, d, c]]);
        }
    }
    let raw = RawMesh {
        positions: points.iter().map(|&u| drape::placed(u)).collect(),
        vertices: (0..).zip(points).collect(),
        faces,
        ..RawMesh::default()
    };
    Mesh::from_raw(&raw, &[]).expect("a disc is a mesh")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::aspect_ratio;

    #[test]
    fn edges_of_a_disc_are_graded_as_asked_and_its_triangles_of_good_shape() {
        for ratio in stress().values {
            let mesh = disc(*ratio);
            mesh.check().unwrap();
            let length = |[a, b]: [DVec2; 2]| a.distance(b);
            let edges =
                mesh.edges().map(|c| length(mesh.edge_vertices(c).map(|v| mesh.material(v))));
            let (least, most) =
                edges.fold((f64::INFINITY, 0.0f64), |(l, m), e| (l.min(e), m.max(e)));
            assert!((most / least / ratio).ln().abs() < 0.7, "{ratio}: {}", most / least);
            let worst = mesh.face_ids().map(|f| aspect_ratio(mesh.face_material(f)));
            assert!(worst.fold(1.0, f64::min) > 0.5);
        }
    }
}
