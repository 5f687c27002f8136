//! A small scene for pictures: a skirt with a seam on a ball, a flag beside it, made of sines.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};
use shotsilk::mesh::{Mesh, RawMesh};
use shotsilk::scene::{Pose, Surface};
use shotsilk::sim::Frame;

/// What a picture needs of a frame, in the world (m).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    garments: Vec<Garment>,
    obstacles: Vec<Obstacle>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Garment {
    positions: Vec<DVec3>,
    vertices: Vec<(u32, DVec2)>,
    faces: Vec<[u32; 3]>,
    view_factor: Vec<f64>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Obstacle {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl State {
    pub fn frame(&self) -> Frame {
        Frame {
            garments: self.garments.iter().map(|g| Arc::new(g.mesh())).collect(),
            obstacle_poses: vec![Pose::IDENTITY; self.obstacles.len()],
            ..Frame::default()
        }
    }

    pub fn surfaces(&self) -> Vec<Arc<Surface>> {
        let surface = |o: &Obstacle| Surface {
            positions: o.positions.clone(),
            triangles: o.triangles.clone(),
        };
        self.obstacles.iter().map(|o| Arc::new(surface(o))).collect()
    }

    pub fn is_close_to(&self, other: &Self) -> bool {
        let points = |s: &Self| -> Vec<DVec3> {
            s.garments.iter().flat_map(|g| g.positions.clone()).collect()
        };
        let (a, b) = (points(self), points(other));
        a.len() == b.len() && a.iter().zip(&b).all(|(p, q)| p.distance(*q) < 1e-3)
    }
}

impl Garment {
    fn mesh(&self) -> Mesh {
        let raw = RawMesh {
            positions: self.positions.clone(),
            vertices: self.vertices.clone(),
            faces: self.faces.clone(),
            ..Default::default()
        };
        let mut mesh = Mesh::from_raw(&raw, &[]).expect("the state's garments are meshes");
        let faces: Vec<_> = mesh.face_ids().collect();
        for (face, &nu) in faces.into_iter().zip(&self.view_factor) {
            mesh.view_factor[face] = nu;
        }
        mesh
    }
}

/// The scene.
pub fn wavy() -> State {
    State { garments: vec![skirt(), flag()], obstacles: vec![ball(), floor()] }
}

/// A tenth of a millimetre is enough for a picture, and keeps the file small.
fn rounded(p: DVec3) -> DVec3 {
    (p * 1e4).round() / 1e4
}

/// Two triangles for each cell of a grid of vertices, `columns` x `rows` cells.
fn cells(columns: u32, rows: u32) -> Vec<[u32; 3]> {
    let at = |i: u32, j: u32| j * (columns + 1) + i;
    let mut faces = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            // Alternating diagonals have no grain.
            if (i + j) % 2 == 0 {
                faces.extend([[a, b, c], [a, c, d]]);
            } else {
                faces.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    faces
}

/// Round, with folds that deepen downwards; its first and last column meet in a seam.
fn skirt() -> Garment {
    const COLUMNS: u32 = 72;
    const ROWS: u32 = 18;
    let mut garment = Garment { faces: cells(COLUMNS, ROWS), ..Default::default() };
    for j in 0..=ROWS {
        let down = 1.0 - f64::from(j) / f64::from(ROWS);
        for i in 0..COLUMNS {
            let angle = TAU * f64::from(i) / f64::from(COLUMNS);
            let fold = 0.10 * down * down * (9.0 * angle + 0.8 * (2.0 * angle).sin()).sin();
            let radius = 0.20 + 0.34 * (0.5 * PI * down).sin() + fold;
            let height = 1.22 - 0.85 * down.powf(1.3) + 0.12 * fold;
            let p = DVec3::new(radius * angle.cos() - 0.35, radius * angle.sin(), height);
            garment.positions.push(rounded(p));
        }
        for i in 0..=COLUMNS {
            let u = DVec2::new(f64::from(i) * 0.042, f64::from(j) * 0.055);
            garment.vertices.push((j * COLUMNS + i % COLUMNS, u));
        }
    }
    garment.view_factor = view_factors(&garment);
    garment
}

/// Hung from its left edge, blown along x.
fn flag() -> Garment {
    const COLUMNS: u32 = 26;
    const ROWS: u32 = 18;
    let mut garment = Garment { faces: cells(COLUMNS, ROWS), ..Default::default() };
    for j in 0..=ROWS {
        for i in 0..=COLUMNS {
            let (u, v) = (f64::from(i) * 0.04, f64::from(j) * 0.04);
            let wave = 0.10 * u * (7.0 * u - 2.5 * v).sin();
            let p = DVec3::new(0.45 + 0.92 * u, wave + 0.2 * u, 0.6 + v - 0.22 * u * u);
            garment.positions.push(rounded(p));
            garment.vertices.push((j * (COLUMNS + 1) + i, DVec2::new(u, v)));
        }
    }
    garment.view_factor = view_factors(&garment);
    garment
}

/// Much like a simulation's: 1 in front, less on the far side, least at the right.
fn view_factors(garment: &Garment) -> Vec<f64> {
    let nu = |face: &[u32; 3]| {
        let middle: DVec3 =
            face.iter().map(|&v| garment.positions[garment.vertices[v as usize].0 as usize]).sum();
        let middle = middle / 3.0;
        let aside = ((middle.x - 0.75) / 0.55).clamp(0.0, 1.0);
        let behind = ((middle.y - 0.05) / 0.25).clamp(0.0, 1.0);
        let nu = 10f64.powf(-2.0 * aside) * 5f64.powf(-behind);
        (nu.max(0.01) * 1e4).round() / 1e4
    };
    garment.faces.iter().map(nu).collect()
}

fn ball() -> Obstacle {
    const COLUMNS: u32 = 40;
    const ROWS: u32 = 20;
    let mut ball = Obstacle::default();
    for j in 0..=ROWS {
        let polar = PI * f64::from(j) / f64::from(ROWS);
        for i in 0..COLUMNS {
            let angle = TAU * f64::from(i) / f64::from(COLUMNS);
            let out = polar.sin();
            let p = DVec3::new(out * angle.cos(), out * angle.sin(), -polar.cos());
            ball.positions.push(rounded(0.24 * p + DVec3::new(-0.35, 0.0, 1.24)));
        }
    }
    for j in 0..ROWS {
        for i in 0..COLUMNS {
            let at = |i: u32, j: u32| j * COLUMNS + i % COLUMNS;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            ball.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    ball
}

/// A low slab under the skirt.
fn floor() -> Obstacle {
    let corner = |i: usize| {
        let pick = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
        DVec3::new(-0.35 + 0.42 * pick(1), 0.42 * pick(2), 0.03 + 0.03 * pick(4))
    };
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Obstacle {
        positions: (0..8).map(corner).collect(),
        triangles: sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}
