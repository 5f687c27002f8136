//! The mildest setting of every stress holds, and a scene that does not is found out.

use super::*;

use glam::DVec3;

use crate::scene::StageSwitches;

#[track_caller]
fn record(name: &str, value: usize) -> Record {
    let all = stresses();
    let stress = all.iter().find(|s| s.name == name).expect("there is such a stress");
    stress.run(stress.values[value], &mut || true).expect("it is wanted")
}

/// Whole, neither made of nothing nor too fast, and nothing passes.
#[track_caller]
fn assert_sound(record: &Record) {
    assert_eq!(record.frames_done, record.frames_asked, "{record:?}");
    assert_ne!(record.verdict(), Verdict::Failed, "{:?} {record:?}", record.flaws());
    assert_eq!([record.crossings, record.cuts, record.trapped], [0; 3], "{record:?}");
    // Where the mesh changes, so does the elastic energy; the verdict bounds what comes of it.
    assert!(record.kick.is_some() || record.energy_gain < 0.05, "{record:?}");
    assert!(record.speed_share < 1.0 && record.faces >= 100, "{record:?}");
}

#[track_caller]
fn assert_mild_is_sound(name: &str) {
    assert_sound(&record(name, 0));
}

#[test]
fn a_sheet_drapes_at_short_steps_and_at_long_ones_that_are_iterated() {
    assert_mild_is_sound("step");
    assert_sound(&record("step, iterated", 4));
}

#[test]
fn a_sheet_drapes_whatever_it_weighs() {
    for name in ["lighter", "heavier"] {
        assert_mild_is_sound(name);
        assert_sound(&record(name, 3));
    }
}

#[test]
fn a_sheet_lands_however_stiff_it_is() {
    assert_mild_is_sound("stiffness");
    assert_sound(&record("stiffness", 3));
}

#[test]
fn a_flag_stands_a_breeze() {
    assert_mild_is_sound("wind");
}

#[test]
fn a_hanging_sheet_stands_obstacles_that_come_slowly_fast_or_from_both_sides() {
    assert_mild_is_sound("obstacle speed");
    assert_sound(&record("obstacle speed", 4));
    assert_mild_is_sound("pinch");
}

#[test]
fn a_sheet_goes_through_a_wide_ring() {
    assert_mild_is_sound("ring");
}

#[test]
fn a_few_folds_can_be_pressed_together() {
    assert_mild_is_sound("folds");
}

#[test]
fn meshes_that_are_fine_in_places_or_have_slivers_drape() {
    assert_mild_is_sound("grading");
    assert_sound(&record("slivers", 4));
    assert_sound(&record("slivers, remeshed", 4));
}

#[test]
fn slow_cameras_and_rare_cuts_are_survived() {
    assert_mild_is_sound("whip pan");
    assert_mild_is_sound("cuts");
    assert_mild_is_sound("m = 0, T = 0");
}

#[test]
fn no_two_stresses_have_the_same_name_and_all_grow_to_one_side() {
    let all = stresses();
    for (k, stress) in all.iter().enumerate() {
        assert!(all[..k].iter().all(|other| other.name != stress.name), "{}", stress.name);
        let ways = stress.values.windows(2).map(|pair| pair[1] > pair[0]);
        let ways: Vec<bool> = ways.collect();
        assert!(ways.len() >= 3 && ways.iter().all(|way| *way == ways[0]), "{}", stress.name);
    }
}

/// Of a scene that is simulated as it is.
fn record_of(trial: fn(f64) -> Trial) -> Record {
    let label = |_| "planted".to_owned();
    let stress = Stress { name: "planted", about: "", values: &[1.0], label, trial };
    stress.run(1.0, &mut || true).expect("it is wanted")
}

fn draped() -> Trial {
    drape::of_mesh(stage::square(0.06, drape::placed))
}

#[track_caller]
fn assert_fails_by(record: &Record, text: &str) {
    assert_eq!(record.verdict(), Verdict::Failed, "{record:?}");
    assert!(record.flaws()[0].text.contains(text), "{:?}", record.flaws());
}

#[test]
fn cloth_that_goes_through_a_ball_is_found() {
    let record = record_of(|_| {
        let mut trial = draped();
        let stages = StageSwitches { collision: false, proximity: false, ..trial.scene.stages };
        (trial.scene.stages, trial.frames) = (stages, 6);
        trial
    });
    assert_fails_by(&record, "cut");
}

#[test]
fn cloth_that_goes_through_cloth_is_found() {
    let record = record_of(|_| {
        let mut trial = draped();
        trial.scene.stages.self_contact = false;
        trial.scene.obstacles.clear();
        let mesh = &mut trial.scene.garments[0].mesh;
        // The outer third is folded over and falls back through the rest.
        for vertex in mesh.vertex_ids() {
            let (node, u) = (mesh.node_of(vertex), mesh.material(vertex));
            let over = (u.x - 0.1).max(0.0);
            mesh.position[node] =
                DVec3::new(u.x - 2.0 * over, u.y, if over > 0.0 { 0.01 } else { 0.0 });
            mesh.velocity[node] = if over > 0.0 { DVec3::NEG_Z } else { DVec3::ZERO };
        }
        Trial { fall_min: 0.0, frames: 1, ..trial }
    });
    assert!(record.crossings > 0, "{record:?}");
    assert_fails_by(&record, "");
}

#[test]
fn cloth_that_hangs_on_nothing_is_found() {
    let record = record_of(|_| {
        let mut trial = draped();
        trial.scene.gravity *= 0.01;
        trial
    });
    assert_fails_by(&record, "fell");
}

#[test]
fn a_state_that_is_not_finite_is_found() {
    let record = record_of(|_| {
        let mut trial = draped();
        let mesh = &mut trial.scene.garments[0].mesh;
        for node in mesh.node_ids() {
            mesh.velocity[node] = DVec3::NAN;
        }
        trial
    });
    assert_fails_by(&record, "finite");
}

#[test]
fn a_crash_is_found_and_ends_nothing_else() {
    assert_fails_by(&record_of(|_| panic!("planted")), "crash: planted");
}

#[test]
fn what_is_not_wanted_any_more_ends_without_a_record() {
    let stress = step::linearised();
    let mut asked = 0;
    let record = stress.run(stress.values[0], &mut || {
        asked += 1;
        asked < 3
    });
    assert_eq!((record, asked), (None, 3));
}
