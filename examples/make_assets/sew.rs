//! From panels in place around the body to a garment: each panel is unfolded onto the cutting table,
//! and where panels meet they are sewn.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};
use shotsilk::mesh::RawMesh;

/// A grid of points in space, row by row, which can be unfolded: between any two neighbouring
/// columns, or any two neighbouring rows, it is flat.
pub struct Panel {
    pub rows: Vec<Vec<DVec3>>,
}

/// Points nearer than this are one (m).
const SAME: f64 = 1e-7;
/// Between the panels as they lie on the cutting table (m).
const SPACING: f64 = 2.0;

impl Panel {
    /// The other side's panel; its rows run the other way, so that the outside stays outside.
    pub fn mirrored(&self) -> Self {
        let mirror = |row: &Vec<DVec3>| row.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
        Self { rows: self.rows.iter().rev().map(mirror).collect() }
    }

    fn points(&self) -> Vec<DVec3> {
        self.rows.concat()
    }

    /// Seen from outside, rows lead up and columns to the left.
    fn faces(&self) -> Vec<[usize; 3]> {
        let columns = self.rows[0].len();
        let mut faces = Vec::new();
        for row in 0..self.rows.len() - 1 {
            for column in 0..columns - 1 {
                let [a, b] = [row * columns + column, row * columns + column + 1];
                let [d, c] = [a + columns, b + columns];
                faces.extend(match (row + column) % 2 {
                    0 => [[a, d, c], [a, c, b]],
                    _ => [[a, d, b], [d, c, b]],
                });
            }
        }
        faces
    }
}

/// The garment of all panels.
pub fn sewn(panels: &[Panel]) -> RawMesh {
    let mut mesh = RawMesh::default();
    for (index, panel) in panels.iter().enumerate() {
        let (points, faces) = (panel.points(), panel.faces());
        let first = mesh.vertices.len();
        let place = DVec2::new(SPACING * index as f64, 0.0);
        for (point, flat) in points.iter().zip(unfolded(&points, &faces)) {
            let node = node_at(&mut mesh.positions, *point);
            mesh.vertices.push((node as u32, place + flat));
        }
        mesh.faces.extend(faces.iter().map(|face| face.map(|corner| (first + corner) as u32)));
    }
    mesh
}

/// The node at a point: one that is there, or a new one.
fn node_at(positions: &mut Vec<DVec3>, point: DVec3) -> usize {
    let there = positions.iter().position(|p| p.distance(point) < SAME);
    there.unwrap_or_else(|| {
        positions.push(point);
        positions.len() - 1
    })
}

/// The points as they lie flat: face after face is laid beside one that lies already, with its own
/// edge lengths. The first face's first edge points up.
fn unfolded(points: &[DVec3], faces: &[[usize; 3]]) -> Vec<DVec2> {
    let mut flat: Vec<Option<DVec2>> = vec![None; points.len()];
    let [a, b, _] = faces[0];
    flat[a] = Some(DVec2::ZERO);
    flat[b] = Some(DVec2::Y * points[a].distance(points[b]));
    let mut waiting: VecDeque<[usize; 3]> = faces.iter().copied().collect();
    // Each round of the queue lays at least one face of a panel in one piece.
    for _ in 0..faces.len() * faces.len() {
        let Some([a, b, c]) = waiting.pop_front() else { break };
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        let laid = turns.into_iter().find_map(|[a, b, c]| Some((flat[a]?, flat[b]?, [a, b, c])));
        match laid {
            None => waiting.push_back([a, b, c]),
            Some((from, to, [a, b, c])) => {
                let corner = third(from, to, [a, b, c].map(|k| points[k]));
                flat[c].get_or_insert(corner);
            }
        }
    }
    flat.into_iter().map(|point| point.expect("the panel is in one piece")).collect()
}

/// The third corner of a face, to the left of the way between the other two.
fn third(from: DVec2, to: DVec2, [a, b, c]: [DVec3; 3]) -> DVec2 {
    let along = (b - a).normalize();
    let reach = c - a;
    let off = reach.reject_from(along).length();
    let way = (to - from).normalize();
    from + way * reach.dot(along) + way.perp() * off
}
