//! A garment as triangles: normals per node or face, a colour coordinate per face.

use glam::DVec3;

use crate::mesh::Mesh;

use super::colour::Srgb;
use super::colour_by::ColourBy;
use super::draw_list::{Material, SurfaceBatch, SurfaceVertex};
use super::options::{Edges, PictureOptions, Shading};

/// Front and back of plain garments, which take turns.
const FABRICS: [[Srgb; 2]; 4] = [
    [Srgb([112, 143, 178]), Srgb([158, 150, 138])],
    [Srgb([196, 138, 112]), Srgb([150, 148, 152])],
    [Srgb([132, 162, 126]), Srgb([164, 152, 138])],
    [Srgb([176, 152, 186]), Srgb([150, 150, 140])],
];

/// How much of the light's modelling a colour map bears before it is no longer readable.
const MAPPED_MODELLING: f32 = 0.9;

/// The garment, as number `index` of the frame's.
pub(super) fn batch(
    mesh: &Mesh,
    index: usize,
    origin: DVec3,
    options: &PictureOptions,
) -> SurfaceBatch {
    let node_normals = mesh.node_normals();
    let mut vertices = Vec::with_capacity(3 * mesh.face_count());
    for face in mesh.face_ids() {
        let face_normal = mesh.face_normal(face);
        let value = options.colour_by.value(mesh, face);
        let colour_coordinate = options.colour_by.coordinate(value) as f32;
        for node in mesh.face_nodes(face) {
            let normal = match options.shading {
                Shading::Smooth => smooth_normal(node_normals[node], face_normal),
                Shading::Flat => face_normal,
            };
            vertices.push(SurfaceVertex {
                position: (mesh.position[node] - origin).as_vec3().to_array(),
                normal: normal.as_vec3().to_array(),
                colour_coordinate,
            });
        }
    }
    SurfaceBatch { material: material(index, options), vertices }
}

/// The node's normal, unless the faces around the node cancel or turn their backs on this one.
fn smooth_normal(node_normal: DVec3, face_normal: DVec3) -> DVec3 {
    if node_normal.dot(face_normal) > 0.0 { node_normal } else { face_normal }
}

fn material(index: usize, options: &PictureOptions) -> Material {
    let plain = options.colour_by == ColourBy::Plain;
    Material {
        tint: FABRICS[index % FABRICS.len()],
        table: options.colour_by.table(),
        // Edges that are lines of their own take the dark ones' place.
        wire_strength: match options.edges {
            Edges::Dark => options.wire_strength,
            Edges::ByFrame(_) => 0.0,
        },
        sheen: if plain { 0.35 } else { 0.1 },
        modelling: if plain { 1.0 } else { MAPPED_MODELLING },
    }
}
