//! A pleated curtain, whose tape is slowly drawn together. Across, it is a wave whose slope is a sine
//! of the way along the cloth: much like a strip that buckles, and never stretched. The tape is held
//! along all of the wave, so that no fold has a choice of where to be.

use std::f64::consts::PI;

use glam::DVec2;
use shotsilk::mesh::RawMesh;
use shotsilk::scene::Pose;

/// Of the flat cloth (m).
const SIZE: DVec2 = DVec2::new(0.8, 0.9);
/// Of the tape (m).
const HEIGHT: f64 = 1.8;
/// Of cloth from a crest of the wave to the next trough (m).
const PLEAT: f64 = 0.2;
/// Fields of the input mesh along the tape, and from it to the hem.
const COLUMNS: u32 = 16;
const ROWS: u32 = 12;
/// The steepest slope of the wave at first and at last (rad).
const SLOPES: [f64; 2] = [0.7, 1.05];
/// When the tape begins to be drawn together and when that ends (s).
const DRAWN: [f64; 2] = [0.25, 1.75];
/// Straight pieces of a pleat in which the wave is measured.
const PIECES: u32 = 400;

/// Samples of the motion a second, and the last one: the last frame's, 48 at 24 frames a second.
const SAMPLE_RATE: f64 = 10.0;
const LAST_SAMPLE: u32 = 20;

/// The curtain at first; row by row from the top, from left to right.
pub fn curtain() -> RawMesh {
    let mut mesh = RawMesh::default();
    for row in 0..=ROWS {
        let below = SIZE.y * f64::from(row) / f64::from(ROWS);
        for column in 0..=COLUMNS {
            let along = along_tape(column);
            let place = wave(along, SLOPES[0]);
            mesh.vertices.push((mesh.positions.len() as u32, DVec2::new(along, SIZE.y - below)));
            mesh.positions.push(place.extend(HEIGHT - below));
        }
    }
    let node = |row: u32, column: u32| row * (COLUMNS + 1) + column;
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let [a, b] = [node(row + 1, column), node(row + 1, column + 1)];
            let [d, c] = [node(row, column), node(row, column + 1)];
            mesh.faces.extend(match (row + column) % 2 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            });
        }
    }
    mesh
}

/// Where the tape's nodes are, each at all samples.
pub fn tape() -> Vec<Vec<Pose>> {
    let node = |column: u32| {
        let at = |sample: u32| {
            let place = wave(along_tape(column), slope(f64::from(sample) / SAMPLE_RATE));
            Pose { translation: place.extend(HEIGHT), ..Pose::default() }
        };
        (0..=LAST_SAMPLE).map(at).collect()
    };
    (0..=COLUMNS).map(node).collect()
}

/// A column's place in the flat cloth (m), from the middle.
fn along_tape(column: u32) -> f64 {
    SIZE.x * (f64::from(column) / f64::from(COLUMNS) - 0.5)
}

/// The wave's steepest slope at a time (rad): it begins and ends gently.
fn slope(time: f64) -> f64 {
    let share = ((time - DRAWN[0]) / (DRAWN[1] - DRAWN[0])).clamp(0.0, 1.0);
    SLOPES[0] + (SLOPES[1] - SLOPES[0]) * share * share * (3.0 - 2.0 * share)
}

/// Seen from above, the point of the cloth so far from its middle (m): x along the curtain, y to and
/// fro.
fn wave(along: f64, slope: f64) -> DVec2 {
    let integral = |end: f64| -> DVec2 {
        let pieces = (f64::from(PIECES) * end.abs() / PLEAT).ceil().max(1.0) as u32;
        let piece = end / f64::from(pieces);
        let middle = |k: u32| (f64::from(k) + 0.5) * piece;
        let direction = |s: f64| DVec2::from_angle(slope * (PI * s / PLEAT).sin());
        (0..pieces).map(|k| direction(middle(k)) * piece).sum()
    };
    integral(along) - DVec2::Y * 0.5 * integral(PLEAT).y
}
