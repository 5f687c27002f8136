//! Strain limits where they are hardest to keep.

use super::frame_to_frame::assert_follows_from_each_frame;
use super::layers::on_one_another;
use super::*;

const LIMITS: [f64; 2] = [0.9, 1.05];

/// A sheet of 5 kg, upright, held at its two upper corners alone: around them the cloth carries
/// hundreds of newtons a metre, which by itself would stretch it by more than its own length.
fn hanging_from_two_nodes() -> Scene {
    let Fabric::Measured(measured) = fabric() else { unreachable!("the fabric is measured") };
    let heavy = MeasuredFabric { density: 5.0, strain_limits: Some(LIMITS), ..measured };
    let handle = Handle {
        garment: 0,
        nodes: vec![72, 80],
        motion: None,
        start_time: 0.0,
        end_time: f64::INFINITY,
    };
    let mut scene = scene(square(8, |u| DVec3::new(u.x, 0.0, u.y)));
    scene.handles = vec![handle];
    scene.garments[0].fabric = Fabric::Measured(heavy);
    scene.stages.remeshing = false;
    scene
}

#[test]
fn a_loaded_sheet_that_hangs_from_two_nodes_stays_within_one_percent_of_its_limits() {
    for frame in &run(hanging_from_two_nodes(), SizingMode::Adaptive, 25) {
        assert_within_one_percent(frame);
    }
}

fn assert_within_one_percent(frame: &Frame) {
    let [least, largest] = LIMITS;
    for (mesh, face) in frame.garments.iter().flat_map(|m| m.face_ids().map(move |f| (m, f))) {
        let [major, minor] = mesh.deformation_of(mesh.face_vertices(face)).singular_values();
        let is_met = major <= 1.01 * largest && minor >= 0.99 * least;
        assert!(is_met, "{major} and {minor} in face {face:?} of frame {}", frame.number);
    }
}

/// Two remeshed garments with limits that fall onto a stone, one on the other.
fn limited_on_a_stone() -> Scene {
    let mut scene = on_one_another();
    for garment in &mut scene.garments {
        let Fabric::Measured(measured) = &mut garment.fabric else {
            unreachable!("it is measured")
        };
        measured.strain_limits = Some(LIMITS);
    }
    scene
}

#[test]
fn what_contact_and_remeshing_strain_is_within_one_percent_of_its_limits_when_published() {
    for frame in &run(limited_on_a_stone(), SizingMode::Adaptive, 16) {
        assert_within_one_percent(frame);
        assert!(frame.report.warnings.is_empty(), "{:?}", frame.report.warnings);
        assert_eq!(frame.report.intersections, Some(0), "frame {}", frame.number);
    }
}

#[test]
fn limited_cloth_follows_from_each_frame() {
    assert_follows_from_each_frame(limited_on_a_stone(), SizingMode::Adaptive, 8);
}

#[test]
fn without_limits_the_same_load_stretches_the_sheet_far_beyond_them() {
    let mut scene = hanging_from_two_nodes();
    scene.stages.strain_limiting = false;
    let frames = run(scene, SizingMode::Adaptive, 25);
    assert!(frames.last().is_some_and(|f| f.report.largest_stretch > 0.5));
}

#[test]
fn at_the_end_of_a_frame_faces_are_taken_back_and_nothing_is_sped_up() {
    let mut scene = limited_on_a_stone();
    scene.gravity = DVec3::ZERO;
    let settings = SimSettings { sizing: SizingMode::Adaptive };
    let (mut simulation, _) = Simulation::start(Arc::new(scene), settings).unwrap();
    let beyond = |simulation: &Simulation| {
        let cloth = &simulation.cloth;
        cloth.system.count_beyond_limits(&cloth.state.position)
    };
    let middle = simulation.cloth.state.position.len() / 4;
    simulation.cloth.state.position[middle] += DVec3::new(0.02, 0.02, 0.06);
    simulation.cloth.refit();
    assert!(beyond(&simulation) > 0);
    let mut report = FrameReport::default();
    simulation.take_back_within_limits(&mut StageClock::start(), &mut report);
    assert_eq!(beyond(&simulation), 0);
    assert!(simulation.cloth.state.velocity.iter().all(|v| *v == DVec3::ZERO));
    let published = StepState::gathered(&simulation.garments.iter().collect::<Vec<_>>());
    assert!(published == simulation.cloth.state, "garments are where the cloth is");
}
