//! A flared skirt of six gores. The gores are cut flat; sewn together they make an elliptic cone,
//! which is developable, so that nothing is stretched at first.

use glam::{DVec2, DVec3};
use shotsilk::mesh::RawMesh;
use shotsilk::scene::Pose;

const GORE_COUNT: usize = 6;
/// Strips across a gore, and rows from waist to hem, of the input mesh.
const STRIPS: usize = 6;
const ROWS: usize = 3;
/// Height of the waistband in the pelvis (m).
const WAIST_HEIGHT: f64 = 0.12;
/// Half the width and half the depth of the waist (m).
const WAIST_HALF: DVec2 = DVec2::new(0.129, 0.099);
/// Half the width of the cone for a metre of height below its tip.
const FLARE: f64 = 0.50;
/// Of waistband and hem below the cone's tip (m).
const WAIST_DEPTH: f64 = WAIST_HALF.x / FLARE;
const HEM_DEPTH: f64 = WAIST_DEPTH + 0.52;
/// Between the gores as they lie on the cutting table (m).
const GORE_SPACING: f64 = 0.6;
/// Straight pieces in which the width of a strip is measured.
const PIECES: usize = 64;

/// The skirt around a pelvis. The first nodes are those of the waistband.
pub fn skirt(pelvis: Pose) -> RawMesh {
    let columns = GORE_COUNT * STRIPS;
    let depth = |row: usize| WAIST_DEPTH + (HEM_DEPTH - WAIST_DEPTH) * row as f64 / ROWS as f64;
    let mut mesh = RawMesh::default();
    for row in 0..=ROWS {
        let tip = DVec3::Z * (WAIST_HEIGHT + WAIST_DEPTH);
        let node = |column: usize| tip + ray(turns(column)) * depth(row);
        mesh.positions.extend((0..columns).map(|c| pelvis.transform_point(node(c))));
    }
    for gore in 0..GORE_COUNT {
        let first = mesh.vertices.len();
        for row in 0..=ROWS {
            for strip in 0..=STRIPS {
                let column = gore * STRIPS + strip;
                let node = row * columns + column % columns;
                mesh.vertices.push((node as u32, flat(gore, strip, depth(row))));
            }
        }
        mesh.faces.extend(gore_faces(first));
    }
    mesh
}

fn turns(column: usize) -> f64 {
    std::f64::consts::TAU * column as f64 / (GORE_COUNT * STRIPS) as f64
}

/// From the tip down to a metre below it.
fn ray(turn: f64) -> DVec3 {
    let (sin, cos) = turn.sin_cos();
    DVec3::new(FLARE * cos, FLARE * WAIST_HALF.y / WAIST_HALF.x * sin, -1.0)
}

/// A vertex as it lies on the cutting table: as far from the tip as on the cone, the gore's middle
/// straight down.
fn flat(gore: usize, strip: usize, depth: f64) -> DVec2 {
    let column = gore * STRIPS;
    let opening = angle_on_cone(column, column + STRIPS);
    let angle = angle_on_cone(column, column + strip) - 0.5 * opening;
    let from_tip = depth * ray(turns(column + strip)).length();
    let place = DVec2::new(gore as f64 * GORE_SPACING, 0.0);
    place + from_tip * DVec2::new(angle.sin(), -angle.cos())
}

/// The angle at the tip from one column to another, measured on the cone: flattening keeps it.
fn angle_on_cone(from: usize, to: usize) -> f64 {
    let at = |k: usize| {
        let share = k as f64 / PIECES as f64;
        ray(turns(from) + share * (turns(to) - turns(from)))
    };
    (0..PIECES).map(|k| at(k).angle_between(at(k + 1))).sum()
}

/// Two triangles a field, their diagonals mirrored about the gore's middle; counter-clockwise on
/// the cutting table and seen from outside.
fn gore_faces(first: usize) -> Vec<[u32; 3]> {
    let vertex = |row: usize, strip: usize| (first + row * (STRIPS + 1) + strip) as u32;
    let mut faces = Vec::new();
    for row in 0..ROWS {
        for strip in 0..STRIPS {
            let [a, b] = [vertex(row + 1, strip), vertex(row + 1, strip + 1)];
            let [d, c] = [vertex(row, strip), vertex(row, strip + 1)];
            faces.extend(match strip < STRIPS / 2 {
                true => [[a, b, c], [a, c, d]],
                false => [[a, b, d], [b, c, d]],
            });
        }
    }
    faces
}
