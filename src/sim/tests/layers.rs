//! Two garments that fall onto a stone, one on the other.

use super::frame_to_frame::{assert_follows_from_each_frame, bits};
use super::*;
use crate::collision::crossings;

const FRAMES: u32 = 14;

/// The upper sheet lies across the lower one, 2 cm above.
pub fn on_one_another() -> Scene {
    let mut scene = on_a_stone();
    let mut upper = scene.garments[0].clone();
    for x in upper.mesh.position.iter_mut() {
        *x = DVec3::new(0.8 * (x.x - x.y), 0.8 * (x.x + x.y), x.z + 0.02);
    }
    upper.mesh = scaled_at_rest(&upper.mesh);
    scene.garments.push(upper);
    scene
}

/// The same mesh with the flat cloth as large as it is in the world.
fn scaled_at_rest(mesh: &Mesh) -> Mesh {
    let mut parts = mesh.to_parts();
    parts.material.iter_mut().for_each(|u| *u *= 0.8 * 2f64.sqrt());
    Mesh::from_parts(parts).unwrap()
}

#[test]
fn garments_on_one_another_do_not_pass_through_each_other() {
    let through = |scene: Scene, frames| {
        let frames = run(scene, SizingMode::Adaptive, frames);
        let counts = frames.iter().map(|f| f.report.intersections.unwrap_or_default());
        (counts.sum::<usize>(), frames)
    };
    let (count, frames) = through(on_one_another(), 25);
    assert_eq!(count, 0);
    let last = frames.last().unwrap();
    assert!(last.report.warnings.is_empty(), "{:?}", last.report.warnings);
    let height = |garment: usize| {
        let mesh = &last.garments[garment];
        mesh.position.iter().map(|x| x.z).fold(f64::NEG_INFINITY, f64::max)
    };
    let thickness = on_one_another().contact.thickness;
    let apart = height(1) - height(0);
    assert!((0.3 * thickness..2.0 * thickness).contains(&apart), "{apart} m at the top");
    let mut without = on_one_another();
    without.stages.self_contact = false;
    let frames = run(without, SizingMode::Adaptive, 25);
    let passing = |frame: &Frame| {
        let garments: Vec<Mesh> = frame.garments.iter().map(|g| (**g).clone()).collect();
        let positions = StepState::gathered(&garments.iter().collect::<Vec<_>>()).position;
        crossings(&FaceTree::new(&positions, &global_faces(&garments)), &positions).len()
    };
    let count: usize = frames.iter().map(passing).sum();
    assert!(count > 20, "{count}: they pass through if nothing holds them");
}

#[test]
fn a_trial_step_shows_the_next_step_and_changes_nothing_of_what_follows() {
    let start = |steps: u32| {
        let mut scene = on_one_another();
        scene.steps_per_frame = steps;
        scene.stages.remeshing = false;
        Simulation::start(Arc::new(scene), SimSettings { sizing: SizingMode::Adaptive }).unwrap().0
    };
    let [mut plain, mut asked] = [0, 1].map(|_| start(4));
    for _ in 0..FRAMES {
        asked.trial_step().unwrap();
        assert!(bits(&plain.advance().unwrap()) == bits(&asked.advance().unwrap()));
    }
    // Nothing touches in the first step of all, and the step is the frame.
    let mut single = start(1);
    let trial = single.trial_step().unwrap();
    let frame = single.advance().unwrap();
    let garments: Vec<&Mesh> = frame.garments.iter().map(|g| &**g).collect();
    let next = StepState::gathered(&garments);
    assert_eq!(trial.end.position, next.position);
    assert!(trial.start.position != trial.end.position);
}

#[test]
fn layers_follow_from_each_frame() {
    assert_follows_from_each_frame(on_one_another(), SizingMode::Adaptive, FRAMES);
}

#[test]
fn layers_have_the_same_bits_for_any_number_of_threads() {
    let by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let frames = pool.install(|| run(on_one_another(), SizingMode::Adaptive, FRAMES));
        frames.iter().map(bits).collect::<Vec<_>>()
    };
    let one = by(1);
    assert!(by(2) == one && by(7) == one);
}
