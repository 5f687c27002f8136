//! Faces taken back within strain limits.

use glam::DVec3;

use super::testing::{Random, fabric, sheet};
use super::{HandleSpring, StepState, System};
use crate::mesh::Mesh;
use crate::scene::{Fabric, MeasuredFabric};

const LIMITS: [f64; 2] = [0.95, 1.05];
const DT: f64 = 5e-3;

/// A sheet of 1 m whose fabric has strain limits, and the state it is in.
fn limited_sheet(cells: u32) -> (Mesh, System, StepState) {
    let mesh = sheet(cells, 1.0, 0.1);
    let Fabric::Measured(measured) = fabric(0.2, 0.0) else { unreachable!("it is measured") };
    let fabric = Fabric::Measured(MeasuredFabric { strain_limits: Some(LIMITS), ..measured });
    let system = System::new(&[&mesh], &[&fabric]);
    let state = StepState::gathered(&[&mesh]);
    (mesh, system, state)
}

/// Least and largest principal stretch of all faces.
fn extremes(mesh: &Mesh, state: &StepState) -> [f64; 2] {
    let mut moved = mesh.clone();
    state.scatter(&mut [&mut moved]);
    let stretches = moved.face_ids().map(|f| moved.deformation_gradient(f).singular_values());
    stretches.fold([f64::INFINITY, 0.0], |[least, largest], [major, minor]| {
        [least.min(minor), largest.max(major)]
    })
}

fn assert_within_one_percent(mesh: &Mesh, state: &StepState) {
    let [least, largest] = extremes(mesh, state);
    assert!(largest <= 1.01 * LIMITS[1] && least >= 0.99 * LIMITS[0], "{least} to {largest}");
}

/// Moves a few inner nodes by up to `by` (m), out of the plane too.
fn disturb(state: &mut StepState, cells: usize, by: f64) {
    let mut random = Random::new(7);
    for (i, j) in [(3, 3), (4, 7), (8, 5)] {
        let by = DVec3::from_array([(); 3].map(|()| random.number())) * by;
        state.position[j * (cells + 1) + i] += by;
    }
}

#[test]
fn faces_that_snapped_come_back_within_one_percent_of_their_limits() {
    let (mesh, system, mut state) = limited_sheet(12);
    disturb(&mut state, 12, 0.02);
    assert!(extremes(&mesh, &state)[1] > 1.1);
    let beyond = system.keep_within_limits(&mut state, &[], DT);
    assert!(beyond.found > 3 && beyond.left == 0, "{beyond:?}");
    assert_within_one_percent(&mesh, &state);
}

#[test]
fn neither_momentum_nor_angular_momentum_changes() {
    let (_, system, mut state) = limited_sheet(12);
    disturb(&mut state, 12, 0.02);
    let before = state.clone();
    system.keep_within_limits(&mut state, &[], DT);
    // What each node was given, where it was given it: little by little, while nodes moved by
    // millimetres.
    let momenta = |state: &StepState| {
        let nodes = system.masses().iter().zip(&state.velocity).zip(&state.position);
        nodes.fold([DVec3::ZERO; 2], |[sum, turn], ((mass, v), x)| {
            [sum + *v * *mass, turn + x.cross(*v * *mass)]
        })
    };
    let given: f64 = {
        let pairs = system.masses().iter().zip(state.velocity.iter().zip(&before.velocity));
        pairs.map(|(mass, (now, then))| mass * (*now - *then).length()).sum()
    };
    let [sum, turn] = momenta(&state);
    assert!(given > 1e-3, "{given} N s");
    assert!(sum.length() < 1e-12 * given, "{sum} N s of {given}");
    // x is that at the end: off by the ways of millimetres from where the impulses were given.
    assert!(turn.length() < 1e-2 * given, "{turn} N m s of {given}");
}

#[test]
fn the_velocity_is_what_the_way_asks_for() {
    let (_, system, mut state) = limited_sheet(12);
    disturb(&mut state, 12, 0.02);
    let before = state.clone();
    system.keep_within_limits(&mut state, &[], DT);
    for node in 0..state.position.len() {
        let way = state.position[node] - before.position[node];
        assert!((state.velocity[node] * DT - way).length() < 1e-15, "node {node}");
    }
}

#[test]
fn nodes_in_handles_stay_and_the_others_come_to_them() {
    let (mesh, system, mut state) = limited_sheet(12);
    let held = 3 * 13 + 3;
    state.position[held] += DVec3::new(0.004, 0.0, 0.02);
    let target = state.position[held];
    let handle = HandleSpring { node: held, target, stiffness: 1e8 };
    let beyond = system.keep_within_limits(&mut state, &[handle], DT);
    assert!(beyond.found > 0 && beyond.left == 0, "{beyond:?}");
    assert!(state.position[held] == target);
    assert_within_one_percent(&mesh, &state);
}

#[test]
fn what_is_within_its_limits_keeps_its_bits() {
    let (_, system, mut state) = limited_sheet(12);
    state.position.iter_mut().for_each(|x| *x *= 1.058);
    let before = state.clone();
    let beyond = system.keep_within_limits(&mut state, &[], DT);
    assert!(beyond.found == 0);
    assert!(state == before);
}

#[test]
fn a_sheet_that_no_rounds_can_save_ends_finite_and_is_reported() {
    let (_, system, mut state) = limited_sheet(12);
    let corners = [0, 12, 13 * 12, 13 * 13 - 1];
    state.position.iter_mut().for_each(|x| *x *= 3.0);
    let handles =
        corners.map(|node| HandleSpring { node, target: state.position[node], stiffness: 1e8 });
    let beyond = system.keep_within_limits(&mut state, &handles, DT);
    assert!(beyond.left > 0, "{beyond:?}");
    assert!(state.check_finite().is_ok());
}

#[test]
fn a_face_without_extent_is_left_to_its_neighbours() {
    let (_, system, mut state) = limited_sheet(4);
    state.position.fill(DVec3::ZERO);
    let beyond = system.keep_within_limits(&mut state, &[], DT);
    assert!(beyond.left == beyond.found && beyond.found == 32, "{beyond:?}");
    assert!(state.check_finite().is_ok());
}
