//! The shot that comes with the program can be simulated, moves as a body does, and is what its
//! generator makes.

use std::fs;
use std::path::Path;

use glam::DVec3;
use shotsilk::collision::Obstacles;
use shotsilk::own_shot::own_shot;
use shotsilk::scene::{LoadOptions, LoadedShot, Scene, load};

#[path = "../examples/make_assets/mod.rs"]
mod make_assets;

/// (bytes): the program carries them all.
const SIZE_MAX: u64 = 1_500_000;
/// How far a point of the figure moves at most in a frame, and how much that changes to the next
/// frame (m): a foot swings with 4 m/s, and is set down without a jolt.
const MOVE_MAX: f64 = 0.17;
const CHANGE_MAX: f64 = 0.06;
/// How deep a foot may roll into the ground (m).
const SINK_MAX: f64 = 0.006;
/// Numbers in the generated files are rounded to 1e-5 or 1e-6; the last digit may differ between
/// systems.
const LAST_DIGIT: f64 = 1.01e-5;

fn loaded() -> LoadedShot {
    let (shot, files) = own_shot();
    load(&LoadOptions { shot, ..LoadOptions::default() }, &files).expect("the shot loads")
}

fn last_frame(scene: &Scene) -> u32 {
    scene.last_frame.expect("the shot says where it ends")
}

/// The figure's points in the world at a frame.
fn figure_points(scene: &Scene, frame: u32) -> Vec<DVec3> {
    let time = f64::from(frame) * scene.frame_time();
    let points = scene.obstacles.iter().flat_map(|obstacle| {
        let pose = scene.obstacle_pose(obstacle, time);
        obstacle.surface.positions.iter().map(move |p| pose.transform_point(*p))
    });
    points.collect()
}

#[test]
fn the_shot_loads_without_warnings_and_has_what_it_is_meant_to_show() {
    let LoadedShot { scene, warnings, .. } = loaded();
    assert_eq!(warnings, Vec::<String>::new());
    assert_eq!(scene.name, "own-shot");
    let [skirt] = &scene.garments[..] else { panic!("one garment") };
    assert_eq!(skirt.mesh.check(), Ok(()));
    assert!(skirt.mesh.vertex_count() > skirt.mesh.node_count(), "the skirt has no seams");
    assert!(!skirt.two_sided);
    assert_eq!(scene.obstacles.len(), 13);
    let camera = &scene.viewers[0];
    assert_eq!(camera.cuts().len(), 1);
    assert_eq!(camera.frame_range()[1], f64::from(last_frame(&scene)));
}

#[test]
fn the_skirt_hangs_free_of_the_figure_at_first_and_is_hardly_stretched() {
    let scene = loaded().scene;
    let skirt = &scene.garments[0].mesh;

    let thickness = scene.contact.thickness;
    for obstacle in Obstacles::new(&scene).moving(&scene, [0.0; 2], scene.step_time()) {
        for position in skirt.position.iter() {
            let nearest = obstacle.nearest_at_end(*position, 1.0).expect("within a metre");
            assert!(nearest.signed_distance > thickness, "{position} is in contact");
        }
        for face in skirt.face_ids() {
            let corners = skirt.face_nodes(face).map(|node| skirt.position[node]);
            assert!(!obstacle.is_crossed_at_end(corners), "{corners:?} crosses the figure");
        }
    }
    for face in skirt.face_ids() {
        for stretch in skirt.deformation_gradient(face).singular_values() {
            assert!((stretch - 1.0).abs() < 0.01, "a face is stretched by {stretch}");
        }
    }
}

#[test]
fn the_handle_holds_the_waistband_and_nothing_else() {
    let scene = loaded().scene;
    let [handle] = &scene.handles[..] else { panic!("one handle") };
    let skirt = &scene.garments[0].mesh;
    let top = skirt.position.iter().map(|p| p.z).fold(0.0, f64::max);
    let in_band = |z: f64| top - z < 0.02;
    let held = |index: u32| handle.nodes.contains(&index);
    for node in skirt.node_ids() {
        let index = skirt.node_origin(node).input_index().expect("nothing is remeshed yet");
        assert_eq!(held(index), in_band(skirt.position[node].z), "node {index}");
    }
}

#[test]
fn the_figure_moves_smoothly_and_walks_on_the_ground() {
    let scene = loaded().scene;
    let frames: Vec<Vec<DVec3>> =
        (0..=last_frame(&scene)).map(|frame| figure_points(&scene, frame)).collect();
    for (frame, three) in frames.windows(3).enumerate() {
        for ((a, b), c) in three[0].iter().zip(&three[1]).zip(&three[2]) {
            let step = a.distance(*b);
            assert!(step < MOVE_MAX, "a point leaps {step} m at {frame}");
            let change = (*a - 2.0 * *b + *c).length();
            assert!(change < CHANGE_MAX, "a point jerks by {change} m at {frame}");
        }
        let lowest = three[0].iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        assert!(lowest.abs() < SINK_MAX, "the lowest foot is at {lowest} m at {frame}");
    }
    let centre = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
    let way = centre(&frames[frames.len() - 1]).distance(centre(&frames[0]));
    assert!((1.5..3.0).contains(&way), "the figure walks {way} m");
}

/// The files of all shots in the folder of assets; only this one's are carried.
#[test]
fn the_files_are_what_the_generator_makes_and_small() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut size = fs::metadata(folder.join("own-shot/shot.json")).unwrap().len();
    for (name, made) in make_assets::files() {
        let committed = fs::read_to_string(folder.join(&name)).unwrap();
        if name.starts_with("own-shot/") {
            size += committed.len() as u64;
        }
        let (mut left, mut right) = (committed.split_whitespace(), made.split_whitespace());
        loop {
            let pair = (left.next(), right.next());
            match pair {
                (None, None) => break,
                (Some(a), Some(b)) if same(a, b) => {}
                _ => panic!("{name}: {pair:?}: run cargo run --example make_assets"),
            }
        }
    }
    assert!(size < SIZE_MAX, "the shot has {size} bytes");
}

fn same(a: &str, b: &str) -> bool {
    match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() < LAST_DIGIT,
        _ => a == b,
    }
}
