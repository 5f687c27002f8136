//! A strip in more and more folds, pressed together by a plate.

use glam::{DVec2, DVec3};

use super::stage::{self, moving, straight};
use super::stress::{Stress, Trial};

/// (m).
const LENGTH: f64 = 0.64;
const WIDTH: f64 = 0.2;
const CELL: f64 = 0.01;

/// From a layer to the next, at first and when pressed, in thicknesses.
const LOOSE: f64 = 3.0;
const PRESSED: f64 = 1.2;

/// Of floor and plate (m).
const HALF: DVec3 = DVec3::new(0.5, 0.3, 0.05);

/// (s).
const DURATION: f64 = 0.4;
/// Frames after the plate has stopped.
const REST: u32 = 10;

/// Cloth that is given in motion begins in the folds it is given in (m/s).
const NUDGE: DVec3 = DVec3::new(0.0, 0.0, -1e-3);

pub fn stress() -> Stress {
    Stress {
        name: "folds",
        about: "strip in a stack of layers, pressed together by a plate; number of layers",
        values: &[2.0, 4.0, 8.0, 16.0, 32.0],
        label: |layers| format!("{layers} layers"),
        trial,
    }
}

fn trial(layers: f64) -> Trial {
    let length = LENGTH / layers;
    // Folds lie on lines of the mesh.
    let cell = length / (length / CELL).round();
    let mut scene = stage::scene(
        stage::grid(&stage::lines(LENGTH, cell), &stage::lines(WIDTH, CELL), |u| u.extend(0.0)),
        stage::cotton(),
    );
    let rise = LOOSE * scene.contact.thickness;
    let mesh = &mut scene.garments[0].mesh;
    for vertex in mesh.vertex_ids() {
        let node = mesh.node_of(vertex);
        mesh.position[node] = folded(mesh.material(vertex), length, rise);
        mesh.velocity[node] = NUDGE;
    }
    let floor = DVec3::NEG_Z * (HALF.z + rise);
    let plate = |top: f64| DVec3::Z * (top + HALF.z);
    let open = (layers + 1.0) * rise;
    let closed = PRESSED * layers * scene.contact.thickness - rise;
    scene.motions = vec![straight([plate(open), plate(closed)], DURATION)];
    let block = || stage::block(HALF);
    scene.obstacles = vec![stage::obstacle(block(), stage::at(floor)), moving(block(), 0)];
    Trial::driven(scene, stage::FIXED, [(open - closed) / DURATION, DURATION], REST)
}

/// To and fro, always upwards: as long as it is flat.
fn folded(u: DVec2, length: f64, rise: f64) -> DVec3 {
    let share = u.x / length;
    let layer = share.floor();
    let along = if layer as i64 % 2 == 0 { share - layer } else { 1.0 - (share - layer) };
    let run = (length * length - rise * rise).max(0.0).sqrt();
    DVec3::new((along - 0.5) * run, u.y - 0.5 * WIDTH, share * rise)
}
