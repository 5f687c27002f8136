//! The mesh of a reference run: uniform, as fine as the fine parts of the adaptive run.

use crate::math::SymTensor2;
use crate::mesh::{IdVec, Mesh};
use crate::remesh::{NoGuard, RemeshSettings, remesh};
use crate::sim::Frame;

/// Lengths of edges in the flat cloth (m).
#[derive(Clone, Debug, Default)]
pub struct EdgeLengths {
    lengths: Vec<f64>,
}

impl EdgeLengths {
    /// Counts every edge of a frame in, once.
    pub fn add_frame(&mut self, frame: &Frame) {
        frame.garments.iter().for_each(|mesh| self.add(mesh));
    }

    fn add(&mut self, mesh: &Mesh) {
        let length = |corner| {
            let [a, b] = mesh.edge_vertices(corner).map(|v| mesh.material(v));
            a.distance(b)
        };
        self.lengths.extend(mesh.edges().map(length));
    }

    /// The length that a share of the edges does not exceed (m); `None` without edges.
    pub fn percentile(&self, share: f64) -> Option<f64> {
        let mut lengths = self.lengths.clone();
        lengths.sort_by(f64::total_cmp);
        let index = (share * lengths.len() as f64).floor() as usize;
        lengths.get(index).or(lengths.last()).copied()
    }

    /// `None` without edges.
    pub fn mean(&self) -> Option<f64> {
        let count = self.lengths.len();
        (count > 0).then(|| self.lengths.iter().sum::<f64>() / count as f64)
    }
}

/// Attempts to hit a mean edge length: splitting halves edges, so that some means cannot be had.
const ATTEMPTS_MAX: usize = 8;

/// A mean that is off by a smaller share is hit.
const MEAN_TOLERANCE: f64 = 0.01;

/// What to ask of uniform sizing so that the mean edge of the garments comes as near to `mean` as
/// remeshing allows (m), and the mean that this gives.
pub fn uniform_edge_length(garments: &[&Mesh], mean: f64) -> [f64; 2] {
    // The longest edge allowed is longer than the mean.
    let mut asked = 1.4 * mean;
    let mut best = [asked, f64::INFINITY];
    let (mut too_short, mut too_long) = (0.0f64, f64::INFINITY);
    for _ in 0..ATTEMPTS_MAX {
        let found = mean_when_uniform(garments, asked);
        if (found / mean).ln().abs() < (best[1] / mean).ln().abs() {
            best = [asked, found];
        }
        if (found / mean - 1.0).abs() < MEAN_TOLERANCE {
            break;
        }
        if found < mean {
            too_short = too_short.max(asked);
        } else {
            too_long = too_long.min(asked);
        }
        let proportional = asked * mean / found;
        let is_between = proportional > too_short && proportional < too_long;
        asked = if is_between { proportional } else { 0.5 * (too_short + too_long) };
    }
    best
}

fn mean_when_uniform(garments: &[&Mesh], edge_length: f64) -> f64 {
    let mut lengths = EdgeLengths::default();
    for &mesh in garments {
        let mut mesh = mesh.clone();
        let metric = SymTensor2::isotropic(1.0 / (edge_length * edge_length));
        mesh.metric = IdVec::filled(metric, mesh.vertex_count());
        lengths.add(&remesh(mesh, &RemeshSettings::default(), &NoGuard).0);
    }
    lengths.mean().unwrap_or(edge_length)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::mesh::RawMesh;

    /// A square of 1 m in two triangles.
    fn square() -> Mesh {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let raw = RawMesh {
            positions: corners.iter().map(|u| u.extend(0.0)).collect::<Vec<DVec3>>(),
            vertices: (0..).zip(corners).collect(),
            faces: vec![[0, 1, 2], [0, 2, 3]],
            ..RawMesh::default()
        };
        Mesh::from_raw(&raw, &[]).unwrap()
    }

    #[test]
    fn percentile_and_mean_are_of_every_edge_once() {
        let mut lengths = EdgeLengths::default();
        lengths.add(&square());
        let diagonal = 2.0f64.sqrt();
        assert_eq!((lengths.percentile(0.1), lengths.percentile(1.0)), (Some(1.0), Some(diagonal)));
        assert!((lengths.mean().unwrap() - (4.0 + diagonal) / 5.0).abs() < 1e-12);
        assert_eq!(EdgeLengths::default().percentile(0.1), None);
    }

    #[test]
    fn the_mean_is_as_near_as_halving_allows() {
        let mesh = square();
        for wanted in [0.2, 0.07, 0.05] {
            let [asked, found] = uniform_edge_length(&[&mesh], wanted);
            assert!(asked > wanted && asked < 3.0 * wanted, "{asked}");
            assert_eq!(found, mean_when_uniform(&[&mesh], asked));
            // Bisecting both ways around changes the mean by less than sqrt 2.
            assert!((found / wanted).ln().abs() < 0.5 * 2.0f64.ln() + 0.05, "{found} for {wanted}");
        }
    }
}
