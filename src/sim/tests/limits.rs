//! Strain limits where they are hardest to keep.

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
        let mesh = &frame.garments[0];
        for face in mesh.face_ids() {
            let [major, minor] = mesh.deformation_of(mesh.face_vertices(face)).singular_values();
            let [least, largest] = LIMITS;
            let is_met = major <= 1.01 * largest && minor >= 0.99 * least;
            assert!(is_met, "{major} and {minor} in face {face:?} of frame {}", frame.number);
        }
    }
}

#[test]
fn without_limits_the_same_load_stretches_the_sheet_far_beyond_them() {
    let mut scene = hanging_from_two_nodes();
    scene.stages.strain_limiting = false;
    let frames = run(scene, SizingMode::Adaptive, 25);
    assert!(frames.last().is_some_and(|f| f.report.largest_stretch > 0.5));
}
