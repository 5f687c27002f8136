//! The reference scenes, where they are at hand.

use std::path::{Path, PathBuf};

use shotsilk::collision::Shape;
use shotsilk::mesh::Mesh;
use shotsilk::run::RunReader;
use shotsilk::sim::Frame;

use super::program;

/// Squared length in its metric up to which an edge is short enough, with room for rounding.
const VALID_LENGTH_SQUARED: f64 = 1.0 + 1e-9;

/// How deep a node may be in the sphere (m).
const DEPTH_MAX: f64 = 1e-3;

/// How near cloth that lies on the sphere is to it (m): the scene's thickness of contact, twice.
const NEAR: f64 = 1e-2;

/// The sphere's own radius, and more than the scene is wide in its space.
const FAR: f64 = 1e3;

fn scene(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/arcsim/conf");
    let path = folder.join(name);
    if path.is_file() {
        return Some(path.canonicalize().expect("the scene has a path"));
    }
    eprintln!("skipped: the reference scene {} is not there", path.display());
    None
}

/// Simulates a scene, if it is there, and hands over the run.
fn simulated(name: &str, arguments: &str, visit: impl FnOnce(&RunReader)) {
    let Some(path) = scene(name) else { return };
    let folder = tempfile::tempdir().unwrap();
    let line = format!("simulate {} --out run {arguments}", path.display());
    program::run(folder.path(), &line).succeeds();
    visit(&RunReader::open(&folder.path().join("run")).unwrap());
}

fn longest_in_metric(mesh: &Mesh) -> f64 {
    mesh.edges().map(|edge| mesh.metric_length_squared(edge)).fold(0.0, f64::max)
}

/// The least distance of a node from the first obstacle (m), negative inside.
fn least_distance(shape: &Shape, frame: &Frame) -> f64 {
    let pose = frame.obstacle_poses[0];
    let nodes = frame.garments.iter().flat_map(|m| m.node_ids().map(|n| m.position[n]));
    let distance = |point| {
        let nearest = shape.nearest(pose.inverse().transform_point(point), FAR);
        pose.scale * nearest.expect("nothing is that far").signed_distance
    };
    nodes.map(distance).fold(f64::INFINITY, f64::min)
}

#[test]
fn on_the_sphere_every_edge_is_short_enough_and_no_node_inside() {
    simulated("sphere.json", "--sizing adaptive --frames 30", |run| {
        assert_eq!(run.frames().len(), 31);
        let shape = Shape::new(&run.obstacles()[0]);
        let mut nearest = f64::INFINITY;
        for &number in run.frames() {
            let frame = run.frame(number).unwrap();
            let mesh = &frame.garments[0];
            assert_eq!(mesh.check(), Ok(()), "frame {number}");
            let longest = longest_in_metric(mesh);
            assert!(longest <= VALID_LENGTH_SQUARED, "frame {number}: {longest}");
            let distance = least_distance(&shape, &frame);
            assert!(distance > -DEPTH_MAX, "frame {number}: {distance} m");
            nearest = nearest.min(distance);
        }
        assert!(nearest < NEAR, "the cloth never came to the sphere: {nearest} m");
        let faces = |frame| run.frame(frame).unwrap().face_count();
        assert!(faces(30) > 2 * faces(0), "{} and {}", faces(0), faces(30));
    });
}

#[test]
fn the_square_the_flag_and_the_annotated_sphere_run() {
    for name in ["square.json", "flag.json", "sphere-annotated.json"] {
        simulated(name, "--frames 2", |run| {
            assert_eq!(run.frames(), [0, 1, 2]);
            for number in 0..=2 {
                let frame = run.frame(number).unwrap();
                assert_eq!(frame.garments[0].check(), Ok(()), "{name}, frame {number}");
            }
        });
    }
}

#[test]
fn the_dress_runs_on_its_dancer() {
    simulated("dress-blue.json", "--frames 2", |run| {
        assert_eq!((run.frames(), run.obstacles().len()), (&[0, 1, 2][..], 16));
        let frame = run.frame(2).unwrap();
        assert_eq!(frame.garments[0].check(), Ok(()));
        // Relaxed and refined before the first frame.
        assert!(run.frame(0).unwrap().face_count() > 112);
    });
}

#[test]
fn a_scene_is_drawn_with_a_camera_from_the_command_line() {
    let Some(path) = scene("flag.json") else { return };
    let camera = path.with_file_name("../../cameras/flag.camera.json");
    let folder = tempfile::tempdir().unwrap();
    let scene = path.display();
    program::run(folder.path(), &format!("sheet {scene} --out a.png --frames 1"))
        .fails(2, &["the shot \"flag\" has no camera"]);
    let camera = camera.display();
    let line = format!("sheet {scene} --camera {camera} --out a.png --frames 1 --every 1");
    program::run(folder.path(), &line).succeeds();
    assert!(image::open(folder.path().join("a.png")).is_ok());
}
