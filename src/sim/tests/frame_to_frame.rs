//! A frame's bits depend on the published frame before it only.

use super::*;

/// All that a frame holds but its timings. Debug output tells every number from every other, and
/// 0 from -0.
pub(super) fn bits(frame: &Frame) -> String {
    let mut untimed = frame.clone();
    untimed.report.stages = StageSeconds::default();
    untimed.report.cpu_seconds = 0.0;
    format!("{untimed:?}")
}

/// Goes on from every frame of a run for a frame.
pub(super) fn assert_follows_from_each_frame(scene: Scene, sizing: SizingMode, frames: u32) {
    let straight = run(scene.clone(), sizing, frames);
    let scene = Arc::new(scene);
    for pair in straight.windows(2) {
        let mut simulation =
            Simulation::from_frame(scene.clone(), SimSettings { sizing }, &pair[0]).unwrap();
        let next = simulation.advance().unwrap();
        assert!(bits(&next) == bits(&pair[1]), "frame {} is another one", pair[1].number);
    }
}

/// Holds the middle of one side from 0.1 s on.
fn caught_in_mid_air(scene: Scene) -> Scene {
    let handle =
        Handle { garment: 0, nodes: vec![1, 7], motion: None, start_time: 0.1, end_time: 0.3 };
    Scene { handles: vec![handle], ..scene }
}

#[test]
fn with_contacts_and_remeshing() {
    assert_follows_from_each_frame(on_a_stone(), SizingMode::Adaptive, 14);
}

#[test]
fn with_contacts_on_a_fixed_mesh() {
    let sizing = SizingMode::Uniform { edge_length: Some(0.08) };
    assert_follows_from_each_frame(on_a_stone(), sizing, 10);
}

#[test]
fn with_a_camera_that_cuts() {
    let away = DVec3::new(0.0, -9.0, 0.6);
    let shot = watched(on_a_stone(), &[(0.0, away, false), (7.0, DVec3::Z * 0.3, true)]);
    assert_follows_from_each_frame(shot, SizingMode::View, 9);
}

#[test]
fn with_handles_that_take_hold_and_let_go_between_frames() {
    let shot = caught_in_mid_air(on_a_stone());
    let frames = run(shot.clone(), SizingMode::Adaptive, 4);
    let anchors = |frame: &Frame| frame.handle_anchors[0].iter().flatten().count();
    assert_eq!((anchors(&frames[1]), anchors(&frames[4])), (0, 2));
    assert_follows_from_each_frame(shot, SizingMode::Adaptive, 10);
}

#[test]
fn with_two_garments_and_overlapping_obstacles() {
    let mut shot = on_a_stone();
    let mut second = shot.garments[0].clone();
    for x in second.mesh.position.iter_mut() {
        *x += DVec3::new(0.15, 0.1, 0.2);
    }
    shot.garments.push(second);
    let mut beside = shot.obstacles[0].clone();
    beside.placement.translation += DVec3::X * 0.1;
    shot.obstacles.push(beside);
    assert_follows_from_each_frame(shot, SizingMode::Adaptive, 8);
}

#[test]
fn the_frame_of_another_scene_is_refused() {
    let frame = run(on_a_stone(), SizingMode::Adaptive, 0).remove(0);
    let settings = SimSettings { sizing: SizingMode::Adaptive };
    for (other, thing) in [
        (scene(sheet()), "1 obstacles, the scene has 0"),
        (caught_in_mid_air(on_a_stone()), "0 handles"),
    ] {
        let error = Simulation::from_frame(Arc::new(other), settings, &frame).err().unwrap();
        assert!(error.to_string().contains(thing), "{error}");
    }
}
