//! The curtain among the assets: it is whole at first, its tape never pulls it apart, and nothing in
//! it is ever fast. That its files are what the generator makes is tested with the own shot's.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use shotsilk::mesh::Id;
use shotsilk::scene::{FileSystem, LoadOptions, LoadedShot, Scene, load};
use shotsilk::sim::{SimSettings, Simulation, SizingMode};

/// How fast the cloth is as a whole (m/s): the ends of the tape come in with up to 0.07 m/s.
const SPEED_MAX: f64 = 0.1;
/// (m): coarse, so that the test is quick.
const EDGE_LENGTH: f64 = 0.06;

fn loaded() -> LoadedShot {
    let shot = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/curtain/curtain.json");
    load(&LoadOptions { shot, ..LoadOptions::default() }, &FileSystem).expect("the shot loads")
}

/// The nodes of the tape at a time, from left to right.
fn tape(scene: &Scene, time: f64) -> Vec<DVec3> {
    let motions = scene.handles.iter().map(|h| h.motion.expect("every handle moves"));
    motions.map(|motion| scene.motions[motion].pose(time).translation).collect()
}

#[test]
fn the_curtain_loads_without_warnings_and_is_hardly_stretched() {
    let LoadedShot { scene, warnings, .. } = loaded();
    assert_eq!(warnings, Vec::<String>::new());
    let mesh = &scene.garments[0].mesh;
    assert_eq!(mesh.check(), Ok(()));
    for face in mesh.face_ids() {
        for stretch in mesh.deformation_gradient(face).singular_values() {
            assert!((stretch - 1.0).abs() < 0.02, "a face is stretched by {stretch}");
        }
    }
    let last = scene.last_frame.map(f64::from);
    assert_eq!(last, Some(scene.viewers[0].frame_range()[1]));
}

#[test]
fn the_tape_begins_at_the_upper_edge_and_never_stretches_it() {
    let scene = loaded().scene;
    let mesh = &scene.garments[0].mesh;
    let node = |k: usize| scene.handles[k].nodes[0];
    for (k, place) in tape(&scene, 0.0).into_iter().enumerate() {
        let held = mesh.position[Id::from_index(node(k) as usize)];
        assert!(held.distance(place) < 2e-5, "node {k} is at {held}, not {place}");
    }
    let between = mesh.material(Id::from_index(node(1) as usize)).x
        - mesh.material(Id::from_index(node(0) as usize)).x;
    for frame in 0..=scene.last_frame.expect("it ends") {
        for pair in tape(&scene, f64::from(frame) * scene.frame_time()).windows(2) {
            let distance = pair[0].distance(pair[1]);
            assert!(distance < between, "frame {frame}: {distance} m for {between} m of cloth");
        }
    }
}

#[test]
fn the_cloth_is_never_fast() {
    let scene = Arc::new(loaded().scene);
    let settings = SimSettings { sizing: SizingMode::Uniform { edge_length: Some(EDGE_LENGTH) } };
    let (mut simulation, _) = Simulation::start(scene.clone(), settings).expect("it starts");
    let garment = &scene.garments[0];
    let mass = garment.mesh.total_material_area() * garment.fabric.density();
    for number in 1..=scene.last_frame.expect("it ends") {
        let frame = simulation.advance().expect("it can be simulated");
        let speed = (2.0 * frame.report.kinetic_energy / mass).sqrt();
        assert!(speed < SPEED_MAX, "frame {number}: {speed} m/s");
    }
}
