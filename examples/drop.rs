//! Writes the scene by which programs are compared: a sheet dropped on a sphere, as a regular grid
//! that is not remeshed.
//!
//! `cargo run --release --example drop -- FOLDER MATERIAL`, then
//! `shotsilk simulate FOLDER/drop-70.json --out RUN`. MATERIAL is a material file, named as it is to
//! be found from FOLDER.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs, io};

use glam::DVec3;

/// Cells along a side: 9,800 and 39,762 triangles.
const CELLS: [u32; 2] = [70, 141];
/// Of the sheet (m).
const SIDE: f64 = 1.0;
/// Of the sheet above the sphere's centre (m).
const HEIGHT: f64 = 0.3;
/// Of the sphere (m).
const RADIUS: f64 = 0.25;
/// Quarterings of an icosahedron's faces: 5,120 faces.
const QUARTERINGS: u32 = 4;

fn main() -> io::Result<()> {
    let mut arguments = env::args().skip(1);
    let (Some(folder), Some(material)) = (arguments.next(), arguments.next()) else {
        return Err(io::Error::other("usage: drop FOLDER MATERIAL"));
    };
    let folder = Path::new(&folder);
    fs::create_dir_all(folder)?;
    fs::write(folder.join("sphere.obj"), sphere())?;
    for cells in CELLS {
        fs::write(folder.join(format!("sheet-{cells}.obj")), sheet(cells))?;
        fs::write(folder.join(format!("drop-{cells}.json")), shot(cells, &material))?;
    }
    Ok(())
}

fn shot(cells: u32, material: &str) -> String {
    let material = serde_json::Value::from(material);
    format!(
        r#"{{
    "shotsilk": 1,
    "fps": 25,
    "steps_per_frame": 8,
    "frames": 50,
    "disable": ["remeshing"],
    "contact": {{"thickness": 0.005, "friction_cloth": 0.6, "friction_obstacle": 0.3}},
    "garments": [{{"name": "sheet", "mesh": "sheet-{cells}.obj", "fabric": "knit"}}],
    "fabrics": {{"knit": {{"file": {material}}}}},
    "obstacles": [{{"name": "sphere", "mesh": "sphere.obj"}}],
    "camera": {{
        "resolution": [960, 540], "fov_y_deg": 35,
        "keys": [{{"frame": 0, "eye": [1.4, -1.6, 0.7], "target": [0, 0, -0.05]}}]
    }}
}}
"#
    )
}

/// A square, its cells cut along alternating diagonals.
fn sheet(cells: u32) -> String {
    let mut text = String::new();
    let along = |k: u32| SIDE * (f64::from(k) / f64::from(cells) - 0.5);
    for row in 0..=cells {
        for column in 0..=cells {
            let (x, y) = (along(column), along(row));
            writeln!(text, "v {x} {y} {HEIGHT}\nvt {x} {y}").expect("a string takes it");
        }
    }
    let node = |row: u32, column: u32| row * (cells + 1) + column + 1;
    for row in 0..cells {
        for column in 0..cells {
            let [a, b] = [node(row, column), node(row, column + 1)];
            let [d, c] = [node(row + 1, column), node(row + 1, column + 1)];
            let halves = match (row + column) % 2 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            };
            for [p, q, r] in halves {
                writeln!(text, "f {p}/{p} {q}/{q} {r}/{r}").expect("a string takes it");
            }
        }
    }
    text
}

/// An icosahedron, quartered and blown up.
fn sphere() -> String {
    let (mut points, mut faces) = icosahedron();
    for _ in 0..QUARTERINGS {
        let mut middles = std::collections::HashMap::new();
        let mut quartered = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]: [usize; 2]| {
                *middles.entry([p.min(q), p.max(q)]).or_insert_with(|| {
                    points.push((points[p] + points[q]).normalize());
                    points.len() - 1
                })
            });
            quartered.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = quartered;
    }
    let mut text = String::new();
    for p in points {
        let p = p * RADIUS;
        writeln!(text, "v {} {} {}", p.x, p.y, p.z).expect("a string takes it");
    }
    for [a, b, c] in faces {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("a string takes it");
    }
    text
}

/// Three golden rectangles crossed, and the 20 triples of their corners that lie an edge apart.
fn icosahedron() -> (Vec<DVec3>, Vec<[usize; 3]>) {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let corners = signs.map(|[s, t]| {
        let corner = DVec3::new(0.0, s, t * golden);
        [corner, DVec3::new(corner.z, 0.0, s), DVec3::new(s, corner.z, 0.0)]
    });
    let raw: Vec<DVec3> = corners.into_iter().flatten().collect();
    let is_edge = |a: usize, b: usize| (raw[a].distance(raw[b]) - 2.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for a in 0..raw.len() {
        for b in a + 1..raw.len() {
            for c in b + 1..raw.len() {
                if is_edge(a, b) && is_edge(b, c) && is_edge(c, a) {
                    let normal = (raw[b] - raw[a]).cross(raw[c] - raw[a]);
                    let is_outward = normal.dot(raw[a]) > 0.0;
                    faces.push(if is_outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    (raw.iter().map(|p| p.normalize()).collect(), faces)
}
