use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::*;
use crate::mesh::RawMesh;
use crate::scene::{
    Air, Contact, Dynamics, Garment, Handle, IsotropicSheet, MeasuredFabric, Obstacle,
    SizingSettings, StageSwitches, Surface, ViewSettings,
};
use crate::shot::{CameraKey, CameraPath, Lens, Track};

mod frame_to_frame;
mod layers;
mod limits;
mod tangles;

/// A one metre sheet of two by two cells in the plane z = 0.5.
fn sheet() -> Mesh {
    square(2, |u| (u - 0.5).extend(0.5))
}

fn fabric() -> Fabric {
    Fabric::Measured(MeasuredFabric {
        density: 0.2,
        stretching: [[100.0, 20.0, 100.0, 40.0]; 6],
        bending: [[2e-5; 5]; 3],
        damping: 0.0,
        strain_limits: None,
    })
}

/// A square sheet of 1 m in cells along both sides, placed by a function of the material position.
pub(super) fn square(cells: u32, place: impl Fn(DVec2) -> DVec3) -> Mesh {
    let rows = cells + 1;
    let mut raw = RawMesh::default();
    for node in 0..rows * rows {
        let u = DVec2::new(f64::from(node % rows), f64::from(node / rows)) / f64::from(cells);
        raw.vertices.push((node, u));
        raw.positions.push(place(u));
    }
    for cell in 0..cells * cells {
        let [a, b] = [0, 1].map(|k| cell / cells * rows + cell % cells + k);
        raw.faces.extend([[a, b, b + rows], [a, b + rows, a + rows]]);
    }
    Mesh::from_raw(&raw, &[]).unwrap()
}

/// An octahedron of radius 0.2 around the origin.
fn stone() -> Surface {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let positions = axes.iter().flat_map(|&a| [a * 0.2, a * -0.2]).collect();
    let triangles = (0..8u32)
        .map(|octant| {
            let [x, y, z] = [octant & 1, 2 + (octant >> 1 & 1), 4 + (octant >> 2 & 1)];
            let is_odd = octant.count_ones() % 2 == 1;
            if is_odd { [x, z, y] } else { [x, y, z] }
        })
        .collect();
    Surface { positions, triangles }
}

pub(super) fn scene(mesh: Mesh) -> Scene {
    Scene {
        name: "test".into(),
        fps: 25.0,
        steps_per_frame: 4,
        last_frame: None,
        first_frame: 0,
        gravity: DVec3::NEG_Z * 9.81,
        air: Air { density: 0.0, ..Air::default() },
        contact: Contact::default(),
        dynamics: Dynamics::default(),
        handle_stiffness: 1e6,
        start_perturbation: 0.0,
        stages: StageSwitches::default(),
        garments: vec![Garment {
            name: "sheet".into(),
            mesh,
            fabric: fabric(),
            sizing: SizingSettings { edge_length_min: 0.03, ..SizingSettings::default() },
            view: ViewSettings::default(),
            two_sided: true,
            contact_thickness: None,
        }],
        obstacles: Vec::new(),
        motions: Vec::new(),
        handles: Vec::new(),
        viewers: Vec::new(),
    }
}

fn on_a_stone() -> Scene {
    let obstacle = Obstacle {
        name: "stone".into(),
        surface: Arc::new(stone()),
        deformation: None,
        placement: Pose { translation: DVec3::Z * 0.28, ..Pose::IDENTITY },
        motion: None,
    };
    Scene { obstacles: vec![obstacle], ..scene(sheet()) }
}

fn watched(scene: Scene, keys: &[(f64, DVec3, bool)]) -> Scene {
    let key = |&(frame, target, cut): &(f64, DVec3, bool)| CameraKey {
        frame,
        eye: DVec3::new(0.0, -3.0, 0.6),
        target,
        up: DVec3::Z,
        lens: Lens::FieldOfView { fov_y: 0.6 },
        cut,
    };
    let path = CameraPath {
        name: "shot".into(),
        resolution: [1280, 720],
        pixel_aspect: 1.0,
        near: 0.05,
        far: 50.0,
        track: Track::Keys(keys.iter().map(key).collect()),
    };
    Scene { viewers: vec![path], ..scene }
}

pub(super) fn run(scene: Scene, sizing: SizingMode, frames: u32) -> Vec<Frame> {
    let (mut simulation, first) =
        Simulation::start(Arc::new(scene), SimSettings { sizing }).unwrap();
    let mut all = vec![first];
    all.extend((0..frames).map(|_| simulation.advance().unwrap()));
    all
}

fn mean_height(frame: &Frame) -> f64 {
    let mesh = &frame.garments[0];
    let areas = mesh.node_areas();
    let moment: f64 = areas.enumerate().map(|(n, a)| a * mesh.position[n].z).sum();
    moment / mesh.total_material_area()
}

#[test]
fn a_free_sheet_falls_as_backward_euler_says() {
    let frames = run(scene(sheet()), SizingMode::Adaptive, 5);
    let (h, steps) = (0.01, 20.0);
    let expected = 0.5 - 9.81 * h * h * steps * (steps + 1.0) / 2.0;
    assert!((mean_height(&frames[5]) - expected).abs() < 1e-9);
    assert!(frames[5].report.largest_stretch < 1e-9);
}

#[test]
fn the_stretch_of_all_but_a_share_leaves_out_the_most_stretched() {
    // The right half is pulled to 1.5 times its length, the left to 1.2 times.
    let pulled = |u: DVec2| DVec3::new(1.2 * u.x + 0.3 * (u.x - 0.5).max(0.0), u.y, 0.0);
    let mut scene = scene(square(4, pulled));
    scene.stages.remeshing = false;
    scene.stages.dynamics = false;
    let frame = run(scene, SizingMode::Adaptive, 0).remove(0);
    for (share, stretch) in [(0.0, 0.5), (0.4, 0.5), (0.6, 0.2), (1.0, 0.2)] {
        let found = frame.stretch_of_all_but(share);
        assert!((found - stretch).abs() < 1e-12, "{share}: {found}");
    }
    assert!((frame.report.largest_stretch - 0.5).abs() < 1e-12);
}

#[test]
fn every_edge_is_valid_after_every_frame() {
    for frame in run(on_a_stone(), SizingMode::Adaptive, 12) {
        let mesh = &frame.garments[0];
        mesh.check().unwrap();
        let longest = mesh.edges().map(|c| mesh.metric_length_squared(c)).fold(0.0, f64::max);
        assert!(
            longest <= crate::remesh::VALID_LENGTH_SQUARED,
            "frame {}: {longest}",
            frame.number
        );
    }
}

#[test]
fn cloth_that_falls_on_an_obstacle_stays_outside_and_refines() {
    let frames = run(on_a_stone(), SizingMode::Adaptive, 20);
    let last = &frames[20];
    let shape = crate::collision::Shape::new(&stone());
    for &x in last.garments[0].position.iter() {
        let depth = shape.nearest(x - DVec3::Z * 0.28, 0.1).map_or(0.0, |n| -n.signed_distance);
        assert!(depth < 1e-3, "{depth} m deep");
    }
    assert!(last.face_count() > 2 * frames[0].face_count());
    assert_eq!(last.report.trapped_nodes, 0);
}

#[test]
fn the_same_scene_gives_the_same_bits() {
    let twice = [0, 1].map(|_| run(on_a_stone(), SizingMode::Adaptive, 8));
    for (a, b) in twice[0].iter().zip(&twice[1]) {
        assert_eq!(a.garments, b.garments);
    }
}

#[test]
fn a_garment_at_ease_is_not_moved_before_the_first_frame() {
    let frames = run(scene(sheet()), SizingMode::Adaptive, 0);
    assert!(frames[0].garments[0].position.iter().all(|x| (x.z - 0.5).abs() < 1e-12));
    assert_eq!(frames[0].report.steps_taken, 0);
}

#[test]
fn a_garment_that_is_too_small_for_its_nodes_is_relaxed_before_the_first_frame() {
    let mut tight = sheet();
    for x in tight.position.iter_mut() {
        *x *= DVec3::new(1.3, 1.3, 1.0);
    }
    let calm = Scene { gravity: DVec3::ZERO, ..scene(tight) };
    let frames = run(calm, SizingMode::Adaptive, 1);
    assert!(frames[0].report.largest_stretch < 0.05, "{}", frames[0].report.largest_stretch);
    let extent = |f: &Frame| f.garments[0].position.iter().map(|x| x.length()).fold(0.0, f64::max);
    assert!((extent(&frames[0]) - extent(&frames[1])).abs() < 0.01, "the first frame jumps");
}

#[test]
fn a_perturbed_start_moves_every_node_by_that_much_and_each_its_own_way() {
    let [still, moved] = [0.0, 1e-6].map(|start_perturbation| {
        let perturbed = Scene { start_perturbation, ..scene(sheet()) };
        run(perturbed, SizingMode::Adaptive, 0).remove(0)
    });
    let positions = |f: &Frame| f.garments[0].position.clone().into_vec();
    let shifts: Vec<DVec3> =
        positions(&still).iter().zip(positions(&moved)).map(|(&a, b)| b - a).collect();
    assert!(shifts.iter().all(|s| (s.length() - 1e-6).abs() < 1e-12));
    let mean = shifts.iter().sum::<DVec3>() / shifts.len() as f64;
    assert!(mean.length() < 0.5e-6, "{mean}");
}

#[test]
fn nobody_looking_is_as_good_as_adaptive() {
    let a = run(on_a_stone(), SizingMode::Adaptive, 4);
    let b = run(on_a_stone(), SizingMode::View, 4);
    assert_eq!(a[4].garments, b[4].garments);
}

#[test]
fn cloth_out_of_frame_is_coarse_and_fine_again_in_the_frame_of_the_cut() {
    let away = DVec3::new(0.0, -9.0, 0.6);
    let shot = watched(on_a_stone(), &[(0.0, away, false), (14.0, DVec3::Z * 0.3, true)]);
    let view = run(shot, SizingMode::View, 16);
    let adaptive = run(on_a_stone(), SizingMode::Adaptive, 16);
    assert!(view[8].face_count() * 5 < adaptive[8].face_count(), "{}", view[8].face_count());
    assert!(view[8].report.view_factor_mean < 0.02);
    assert!(view[14].report.view_factor_mean > 0.99);
    // The folds of what was flat out of frame form in the frames that follow.
    assert!(view[14].face_count() * 2 > view[16].face_count());
    for pair in view[9..=14].windows(2) {
        assert!(pair[0].report.view_factor_mean < pair[1].report.view_factor_mean + 1e-12);
    }
}

#[test]
fn a_uniform_mesh_has_the_edge_length_asked_for_and_never_changes() {
    let frames = run(on_a_stone(), SizingMode::Uniform { edge_length: Some(0.1) }, 6);
    let mesh = &frames[0].garments[0];
    let longest = mesh
        .edges()
        .map(|c| {
            let [i, j] = mesh.edge_vertices(c);
            mesh.material(i).distance(mesh.material(j))
        })
        .fold(0.0, f64::max);
    assert!(longest <= 0.1 + 1e-9 && longest > 0.05);
    assert!(frames.iter().all(|f| f.face_count() == mesh.face_count()));
}

#[test]
fn a_scene_without_remeshing_keeps_its_own_mesh() {
    let mut fixed = on_a_stone();
    fixed.stages.remeshing = false;
    for sizing in [SizingMode::Uniform { edge_length: None }, SizingMode::Adaptive] {
        assert_eq!(run(fixed.clone(), sizing, 2)[2].face_count(), 8);
    }
}

#[test]
fn a_step_that_turns_non_finite_is_halved_reported_and_given_up() {
    let wild = Scene { gravity: DVec3::Z * f64::MAX, ..scene(sheet()) };
    let settings = SimSettings { sizing: SizingMode::Adaptive };
    let (mut simulation, _) = Simulation::start(Arc::new(wild), settings).unwrap();
    let error = simulation.advance().unwrap_err().to_string();
    assert!(error.contains("frame 1") && error.contains("halvings"), "{error}");
    assert!(simulation.cloth.state.position.iter().all(|x| x.is_finite()));
}

#[test]
fn it_asks_before_every_step_whether_to_go_on() {
    let settings = SimSettings { sizing: SizingMode::Adaptive };
    let scene = Arc::new(scene(sheet()));
    let left = std::cell::Cell::new(0i64);
    let goes_on = || left.replace(left.get() - 1) > 0;
    assert!(Simulation::start_while(scene.clone(), settings, &goes_on).unwrap().is_none());

    let (mut simulation, _) = Simulation::start(scene.clone(), settings).unwrap();
    left.set(i64::from(scene.steps_per_frame));
    let all = simulation.advance_while(&goes_on).unwrap();
    assert_eq!(all.map(|frame| frame.number), Some(1));
    let before = simulation.cloth.state.position.clone();
    left.set(i64::from(scene.steps_per_frame) - 1);
    assert!(simulation.advance_while(&goes_on).unwrap().is_none());
    assert!(left.get() == -1, "asked once more after it was told to stop");
    assert_ne!(simulation.cloth.state.position, before);
    assert_eq!(simulation.frame, 1);
}

#[test]
fn a_handle_holds_its_nodes_until_it_lets_go() {
    let handle =
        Handle { garment: 0, nodes: vec![0, 2], motion: None, start_time: 0.0, end_time: 0.2 };
    let held = Scene { handles: vec![handle], ..scene(sheet()) };
    let frames = run(held, SizingMode::Adaptive, 8);
    let corner = |f: &Frame| {
        let mesh = &f.garments[0];
        let node = mesh.node_ids().find(|&n| mesh.node_origin(n).input_index() == Some(0));
        mesh.position[node.unwrap()]
    };
    let start = DVec3::new(-0.5, -0.5, 0.5);
    assert!(corner(&frames[4]).distance(start) < 1e-3);
    assert!(corner(&frames[8]).z < 0.45);
}

#[test]
fn a_garment_that_bends_by_another_model_than_asked_is_named_once() {
    let mut shot = scene(sheet());
    shot.stages.dynamics = false;
    // Beyond what can be loaded: no moments balance it.
    let sheet = IsotropicSheet {
        density: 0.2,
        membrane_stiffness: 100.0,
        poisson_ratio: 1.5,
        bending_rigidity: 2e-5,
    };
    shot.garments[0].fabric = Fabric::Elastic(sheet.fabric());
    let frames = run(shot, SizingMode::Adaptive, 1);
    let named = |frame: &Frame| {
        let warnings = &frame.report.warnings;
        warnings.iter().filter(|w| w.contains("\"sheet\" bends by mid-edge normals")).count()
    };
    assert_eq!(named(&frames[0]), 1, "{:?}", frames[0].report.warnings);
    assert_eq!(named(&run(scene(self::sheet()), SizingMode::Adaptive, 0)[0]), 0);
}
