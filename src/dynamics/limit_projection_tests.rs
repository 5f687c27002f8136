//! Faces taken back within strain limits.

use glam::DVec3;

use super::testing::{Random, fabric, sheet};
use super::{HandleSpring, StepForces, StepState, System};
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
    let done = system.take_back_within_limits(&mut state.position, &[], DT);
    assert!(done.found > 3 && done.left == 0, "{done:?}");
    assert_within_one_percent(&mesh, &state);
    assert_eq!(system.count_beyond_limits(&state.position), 0);
}

#[test]
fn one_face_is_taken_back_without_momentum_or_angular_momentum() {
    let (mesh, system, mut state) = limited_sheet(1);
    // Half a sheet is pulled along by a corner that the other half does not have.
    state.position[1] += DVec3::new(0.04, -0.04, 0.01);
    assert!(extremes(&mesh, &state)[1] > 1.06);
    let before = state.position.clone();
    let done = system.take_back_within_limits(&mut state.position, &[], DT);
    assert_eq!((done.found, done.left), (1, 0));
    let moved = before.iter().zip(&state.position).zip(system.masses());
    let given: Vec<(DVec3, DVec3)> = moved.map(|((x, now), m)| (*x, (*now - *x) * *m)).collect();
    let whole: f64 = given.iter().map(|(_, impulse)| impulse.length()).sum();
    let sum: DVec3 = given.iter().map(|(_, impulse)| *impulse).sum();
    let turn: DVec3 = given.iter().map(|(x, impulse)| x.cross(*impulse)).sum();
    assert!(whole > 1e-4, "{whole} kg m");
    assert!(sum.length() < 1e-12 * whole, "{sum} kg m of {whole}");
    assert!(turn.length() < 1e-12 * whole, "{turn} kg m^2 of {whole}");
}

#[test]
fn nodes_in_stiff_handles_stay_and_the_others_come_to_them() {
    let (mesh, system, mut state) = limited_sheet(12);
    let held = 3 * 13 + 3;
    state.position[held] += DVec3::new(0.004, 0.0, 0.02);
    let target = state.position[held];
    let handle = HandleSpring { node: held, target, stiffness: 1e8 };
    let done = system.take_back_within_limits(&mut state.position, &[handle], DT);
    assert!(done.found > 0 && done.left == 0, "{done:?}");
    assert!(state.position[held].distance(target) < 1e-6);
    assert_within_one_percent(&mesh, &state);
}

#[test]
fn what_is_within_its_limits_keeps_its_bits() {
    let (_, system, mut state) = limited_sheet(12);
    state.position.iter_mut().for_each(|x| *x *= 1.058);
    let before = state.clone();
    let done = system.take_back_within_limits(&mut state.position, &[], DT);
    assert!(done.found == 0);
    assert!(state == before);
}

/// Handles at the ends of an edge of the sheet's border, a share of its length too far apart.
fn edge_held_apart(state: &mut StepState, share: f64) -> [HandleSpring; 2] {
    let [a, b] = [4, 5];
    let way = state.position[b] - state.position[a];
    state.position[b] += way * share;
    [a, b].map(|node| HandleSpring { node, target: state.position[node], stiffness: 1e8 })
}

#[test]
fn where_handles_leave_no_way_the_cloth_stays_as_it_was_and_the_rest_is_taken_back() {
    for share in [0.08, 0.3] {
        let (mesh, system, mut state) = limited_sheet(12);
        let handles = edge_held_apart(&mut state, share);
        let far_away = 10 * 13 + 6;
        state.position[far_away] += DVec3::new(0.01, 0.01, 0.02);
        let before = extremes(&mesh, &state)[1];
        let start = state.position.clone();
        let done = system.take_back_within_limits(&mut state.position, &handles, DT);
        assert!(done.left > 0 && done.left < done.found, "{share}: {done:?}");
        assert!(extremes(&mesh, &state)[1] <= before, "{share}");
        let ways = start.iter().zip(&state.position).map(|(a, b)| a.distance(*b));
        assert!(ways.fold(0.0, f64::max) < 0.05, "{share}: no node goes farther than a cell");
        assert!(state.position[far_away] != start[far_away], "{share}");
    }
}

#[test]
fn steps_with_an_edge_that_is_held_apart_hold_their_energy() {
    for share in [0.08, 0.3] {
        let (mesh, mut system, mut state) = limited_sheet(12);
        let handles = edge_held_apart(&mut state, share);
        let forces = StepForces { handles: &handles, ..StepForces::NONE };
        for _ in 0..40 {
            system.step(&mut state, &forces, DT).unwrap();
        }
        let [kinetic, largest] = [system.kinetic_energy(&state), extremes(&mesh, &state)[1]];
        assert!(kinetic < 1e-2, "{share}: {kinetic} J");
        assert!(largest < 1.02 * (1.0 + share).max(1.05), "{share}: {largest}");
    }
}

#[test]
fn a_sheet_that_no_rounds_can_save_stays_as_it_was_and_is_reported() {
    let (_, system, mut state) = limited_sheet(12);
    state.position.iter_mut().for_each(|x| *x *= 3.0);
    let corners = [0, 12, 13 * 12, 13 * 13 - 1];
    let handles =
        corners.map(|node| HandleSpring { node, target: state.position[node], stiffness: 1e8 });
    let before = state.clone();
    let done = system.take_back_within_limits(&mut state.position, &handles, DT);
    assert!(done.found == 288 && done.left > 0, "{done:?}");
    assert!(state == before);
}

#[test]
fn a_face_without_extent_is_left_to_its_neighbours() {
    let (_, system, mut state) = limited_sheet(4);
    state.position.fill(DVec3::ZERO);
    let done = system.take_back_within_limits(&mut state.position, &[], DT);
    assert!(done.left == done.found && done.found == 32, "{done:?}");
    assert!(state.check_finite().is_ok());
}
