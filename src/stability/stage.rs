//! What the scenes under stress are made of.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3, Vec3Swizzles};

use crate::mesh::{Mesh, RawMesh};
use crate::scene::{
    Air, Contact, ElasticFabric, Fabric, Handle, Motion, MotionKey, Obstacle, Pose, PoseVelocity,
    Preset, Scene, StageSwitches, Surface,
};
use crate::sim::{SimSettings, SizingMode};
pub use crate::validation::stage::{ball, block, garment, obstacle};

/// The mesh stays as it is given.
pub const FIXED: SimSettings = SimSettings { sizing: SizingMode::Uniform { edge_length: None } };

/// Of every sheet, unless its mesh is the stress (m).
pub const SIDE: f64 = 0.6;
pub const CELL: f64 = 0.03;

/// With contact of every kind, 5 mm thick, in still air, 25 frames of 8 steps a second; without
/// remeshing.
pub fn scene(mesh: Mesh, fabric: ElasticFabric) -> Scene {
    let mut scene = crate::validation::stage::scene(vec![garment(mesh, Fabric::Elastic(fabric))]);
    scene.name = "stress".into();
    scene.air = Air::default();
    scene.contact = Contact::default();
    scene.stages = StageSwitches { remeshing: false, ..StageSwitches::default() };
    scene
}

/// Shirting.
pub fn cotton() -> ElasticFabric {
    Preset::named("cotton").expect("there is such a preset").fabric()
}

/// A grid of squares with alternating diagonals between lines of material coordinates (m), each
/// ascending.
pub fn grid(us: &[f64], vs: &[f64], place: impl Fn(DVec2) -> DVec3) -> Mesh {
    let columns = us.len() as u32;
    let mut raw = RawMesh::default();
    for (row, &v) in vs.iter().enumerate() {
        for (column, &u) in us.iter().enumerate() {
            raw.vertices.push((row as u32 * columns + column as u32, DVec2::new(u, v)));
            raw.positions.push(place(DVec2::new(u, v)));
        }
    }
    for row in 0..vs.len() as u32 - 1 {
        for column in 0..columns - 1 {
            let a = row * columns + column;
            let [b, c, d] = [a + 1, a + columns + 1, a + columns];
            raw.faces.extend(match (row + column) % 2 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            });
        }
    }
    Mesh::from_raw(&raw, &[]).expect("a grid is a mesh")
}

/// From 0 to an end in equal cells of about a length (m).
pub fn lines(end: f64, cell: f64) -> Vec<f64> {
    let count = (end / cell).round().max(1.0);
    (0..=count as u32).map(|k| end * f64::from(k) / count).collect()
}

/// A square of [`SIDE`] around the origin of material space.
pub fn square(cell: f64, place: impl Fn(DVec2) -> DVec3) -> Mesh {
    let centred: Vec<f64> = lines(SIDE, cell).iter().map(|x| x - 0.5 * SIDE).collect();
    grid(&centred, &centred, place)
}

/// A square that hangs from its upper corners in the plane y = 0, its middle in the origin.
pub fn curtain() -> Scene {
    let mesh = square(CELL, |u| DVec3::new(u.x, 0.0, u.y));
    let is_corner = |u: DVec2| u.y > 0.499 * SIDE && u.x.abs() > 0.499 * SIDE;
    let corners = nodes(&mesh, is_corner);
    let mut scene = scene(mesh, cotton());
    scene.handles = vec![held(corners, None)];
    scene
}

/// The nodes of what is asked for by material position.
pub fn nodes(mesh: &Mesh, is_asked: impl Fn(DVec2) -> bool) -> Vec<u32> {
    let chosen = mesh.vertex_ids().filter(|&v| is_asked(mesh.material(v)));
    chosen.filter_map(|v| mesh.node_origin(mesh.node_of(v)).input_index()).collect()
}

/// From the beginning to the end.
pub fn held(nodes: Vec<u32>, motion: Option<usize>) -> Handle {
    Handle { garment: 0, nodes, motion, start_time: 0.0, end_time: f64::INFINITY }
}

/// In a straight line at an even speed, in some time (s), and no farther.
pub fn straight([from, to]: [DVec3; 2], duration: f64) -> Motion {
    let velocity = PoseVelocity { translation: (to - from) / duration, ..PoseVelocity::default() };
    let key = |time: f64, translation: DVec3| MotionKey {
        time,
        pose: Pose { translation, ..Pose::IDENTITY },
        velocity: Some(velocity),
    };
    Motion::from_keys(vec![key(0.0, from), key(duration, to)]).expect("the keys are in order")
}

/// An obstacle on its way.
pub fn moving(surface: Surface, motion: usize) -> Obstacle {
    Obstacle { motion: Some(motion), ..obstacle(surface, Pose::IDENTITY) }
}

/// Where an obstacle stands.
pub fn at(translation: DVec3) -> Pose {
    Pose { translation, ..Pose::IDENTITY }
}

/// Around the z axis: of the circle in the middle of its tube, and of the tube (m).
pub fn torus(radius: f64, tube: f64) -> Surface {
    const AROUND: u32 = 48;
    const ABOUT: u32 = 16;
    let point = |i: u32, j: u32| {
        let [turn, angle] =
            [(i, AROUND), (j, ABOUT)].map(|(k, n)| TAU * f64::from(k) / f64::from(n));
        let section = DVec2::new(radius, 0.0) + DVec2::from_angle(angle) * tube;
        DQuat::from_rotation_z(turn) * section.extend(0.0).xzy()
    };
    let number = |i: u32, j: u32| (i % AROUND) * ABOUT + j % ABOUT;
    let cells = (0..AROUND).flat_map(|i| (0..ABOUT).map(move |j| (i, j)));
    let halves = |(i, j): (u32, u32)| {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let [a, b, c, d] = corners.map(|(i, j)| number(i, j));
        [[a, b, c], [a, c, d]]
    };
    Surface {
        positions: cells.clone().map(|(i, j)| point(i, j)).collect(),
        triangles: cells.flat_map(halves).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume inside, positive if the triangles face outward (m^3).
    fn volume(surface: &Surface) -> f64 {
        let corners = surface.triangles.iter().map(|t| t.map(|v| surface.positions[v as usize]));
        corners.map(|[a, b, c]| a.dot(b.cross(c))).sum::<f64>() / 6.0
    }

    #[test]
    fn balls_and_rings_are_closed_and_face_outward() {
        let ball = ball(0.2);
        assert_eq!(ball.open_edge_count(), 0);
        assert!((volume(&ball) / (TAU * 2.0 / 3.0 * 0.2f64.powi(3)) - 1.0).abs() < 0.03);
        let ring = torus(0.2, 0.05);
        assert_eq!(ring.open_edge_count(), 0);
        let exact = 0.5 * TAU * TAU * 0.2 * 0.05f64.powi(2);
        assert!((volume(&ring) / exact - 1.0).abs() < 0.05, "{}", volume(&ring) / exact);
    }

    #[test]
    fn a_grid_covers_its_rectangle() {
        let mesh = grid(&[0.0, 0.1, 0.4], &lines(0.3, 0.1), |u| u.extend(0.0));
        mesh.check().unwrap();
        assert_eq!((mesh.node_count(), mesh.face_count()), (12, 12));
        assert!((mesh.total_material_area() - 0.12).abs() < 1e-12);
    }
}
