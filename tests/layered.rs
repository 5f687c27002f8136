//! The layered outfit among the assets: its garments start free of the figure and of one another,
//! the figure kicks, and the whole can be simulated as coarsely as a view may ask for. That its files
//! are what the generator makes is tested with the own shot's.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use shotsilk::collision::{Obstacles, Shape};
use shotsilk::math::{closest_point_on_triangle, triangles_cross};
use shotsilk::mesh::{FaceId, Mesh};
use shotsilk::scene::{FileSystem, LoadOptions, LoadedShot, Scene, load};
use shotsilk::sim::{Frame, SimSettings, Simulation, SizingMode};
use shotsilk::stability::watch::{crossing_pairs, cut_faces};

/// How far a point of a foot moves at most in a frame (m): a trained kick reaches 9 m/s.
const MOVE_MAX: f64 = 0.36;
/// How high a foot is lifted at least in a kick (m): the hips are at 0.89.
const KICK_HEIGHT: f64 = 0.85;
/// How deep a foot may roll into the ground (m).
const SINK_MAX: f64 = 0.006;
/// As far as the first kick, and as coarse as the mesh can be (m).
const FRAMES: u32 = 40;
const EDGE_LENGTH: f64 = 0.3;
/// Of those sized for the view.
const VIEW_FRAMES: u32 = 10;
/// The shoulders carry the jacket; nothing is pulled further than that.
const STRETCH_MAX: f64 = 0.3;

fn loaded() -> LoadedShot {
    loaded_with(&[])
}

fn loaded_with(sets: &[&str]) -> LoadedShot {
    let sets = sets.iter().map(|set| (*set).to_owned()).collect();
    let shot = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/layered/layered.json");
    load(&LoadOptions { shot, sets, ..LoadOptions::default() }, &FileSystem)
        .expect("the shot loads")
}

fn corners(mesh: &Mesh, face: FaceId) -> [DVec3; 3] {
    mesh.face_nodes(face).map(|node| mesh.position[node])
}

/// A foot's points in the world at a frame.
fn foot_points(scene: &Scene, name: &str, frame: u32) -> Vec<DVec3> {
    let obstacle = scene.obstacles.iter().find(|o| o.name == name).expect("the figure has feet");
    let pose = scene.obstacle_pose(obstacle, f64::from(frame) * scene.frame_time());
    obstacle.surface.positions.iter().map(|p| pose.transform_point(*p)).collect()
}

#[test]
fn the_outfit_loads_without_warnings_and_has_three_garments() {
    let LoadedShot { scene, warnings, .. } = loaded();
    assert_eq!(warnings, Vec::<String>::new());
    let names: Vec<&str> = scene.garments.iter().map(|g| g.name.as_str()).collect();
    assert_eq!(names, ["skirt", "shirt", "jacket"]);
    for garment in &scene.garments {
        assert_eq!(garment.mesh.check(), Ok(()));
        assert!(garment.mesh.vertex_count() > garment.mesh.node_count(), "no seams");
        assert_eq!(garment.view.nu_out, 0.1);
    }
    assert_eq!(scene.last_frame.map(f64::from), Some(scene.viewers[0].frame_range()[1]));
}

#[test]
fn nothing_is_stretched_at_first() {
    for garment in &loaded().scene.garments {
        for face in garment.mesh.face_ids() {
            for stretch in garment.mesh.deformation_gradient(face).singular_values() {
                assert!((stretch - 1.0).abs() < 0.01, "{}: by {stretch}", garment.name);
            }
        }
    }
}

#[test]
fn the_garments_are_free_of_the_figure_and_of_one_another_at_first() {
    let scene = loaded().scene;
    let thickness = scene.contact.thickness;
    let obstacles = Obstacles::new(&scene).moving(&scene, [0.0; 2], scene.step_time());
    for (index, garment) in scene.garments.iter().enumerate() {
        for obstacle in &obstacles {
            for position in garment.mesh.position.iter() {
                let nearest = obstacle.nearest_at_end(*position, 2.0).expect("within two metres");
                assert!(nearest.signed_distance > thickness, "{}: {position}", garment.name);
            }
            for face in garment.mesh.face_ids() {
                let corners = corners(&garment.mesh, face);
                assert!(!obstacle.is_crossed_at_end(corners), "{}: {corners:?}", garment.name);
            }
        }
        for other in &scene.garments[index + 1..] {
            let distance = distance(&garment.mesh, &other.mesh);
            let names = [&garment.name, &other.name];
            assert!(distance > thickness, "{names:?} are {distance} m apart");
        }
    }
}

/// Between two garments that do not cross (m): of corners and faces; 0 where they cross.
fn distance(a: &Mesh, b: &Mesh) -> f64 {
    let mut least = f64::INFINITY;
    for a in a.face_ids().map(|face| corners(a, face)) {
        for b in b.face_ids().map(|face| corners(b, face)) {
            if triangles_cross(a, b) {
                return 0.0;
            }
            let of = |p: DVec3, face| closest_point_on_triangle(p, face).point.distance(p);
            least = a.iter().map(|p| of(*p, b)).fold(least, f64::min);
            least = b.iter().map(|p| of(*p, a)).fold(least, f64::min);
        }
    }
    least
}

#[test]
fn the_figure_kicks_with_either_foot_and_never_through_the_ground() {
    let scene = loaded().scene;
    let last = scene.last_frame.expect("the shot says where it ends");
    for name in ["left foot", "right foot"] {
        let frames: Vec<Vec<DVec3>> = (0..=last).map(|f| foot_points(&scene, name, f)).collect();
        let highest = |points: &Vec<DVec3>| points.iter().map(|p| p.z).fold(0.0, f64::max);
        let lift = frames.iter().map(highest).fold(0.0, f64::max);
        assert!(lift > KICK_HEIGHT, "the {name} is lifted {lift} m");
        for (frame, pair) in frames.windows(2).enumerate() {
            for (a, b) in pair[0].iter().zip(&pair[1]) {
                let step = a.distance(*b);
                assert!(step < MOVE_MAX, "the {name} leaps {step} m at {frame}");
                assert!(a.z > -SINK_MAX, "the {name} is at {} m at {frame}", a.z);
            }
        }
    }
}

#[test]
fn as_coarse_as_it_is_sewn_the_outfit_moves_without_passing_through_itself() {
    let scene = Arc::new(loaded().scene);
    let settings = SimSettings { sizing: SizingMode::Uniform { edge_length: Some(EDGE_LENGTH) } };
    let (mut simulation, _) = Simulation::start(scene, settings).expect("it starts");
    for number in 1..=FRAMES {
        let report = simulation.advance().expect("it can be simulated").report.clone();
        assert_eq!(report.intersections, Some(0), "frame {number}");
        assert_eq!(report.trapped_nodes, 0, "frame {number}");
        assert!(report.largest_stretch < STRETCH_MAX, "frame {number}: {}", report.largest_stretch);
    }
}

/// With the coarseness of the shot, and with ten times that of what nobody sees.
#[test]
fn sized_for_the_view_the_outfit_passes_through_neither_itself_nor_the_figure() {
    for nu_out in ["0.1", "0.01"] {
        let scene = Arc::new(loaded_with(&[&format!("view.nu_out={nu_out}")]).scene);
        assert_eq!(scene.garments[0].view.nu_out.to_string(), nu_out);
        let shapes: Vec<Shape> = scene.obstacles.iter().map(|o| Shape::new(&o.surface)).collect();
        let settings = SimSettings { sizing: SizingMode::View };
        let (mut simulation, first) = Simulation::start(scene, settings).expect("it starts");
        assert_passes_through_nothing(&first, &shapes);
        for _ in 0..VIEW_FRAMES {
            let frame = simulation.advance().expect("it can be simulated");
            assert_passes_through_nothing(&frame, &shapes);
        }
    }
}

/// As judges say that know nothing of contact, and as the frame itself says.
#[track_caller]
fn assert_passes_through_nothing(frame: &Frame, shapes: &[Shape]) {
    let (report, number) = (&frame.report, frame.number);
    assert_eq!(crossing_pairs(&frame.garments), 0, "frame {number}");
    assert_eq!(cut_faces(frame, shapes), 0, "frame {number}");
    assert_eq!(report.intersections, Some(0), "frame {number}");
    assert_eq!(report.trapped_nodes, 0, "frame {number}");
    let passing = report.warnings.iter().find(|w| w.contains("pass") || w.contains("cut"));
    assert_eq!(passing, None, "frame {number}");
}
