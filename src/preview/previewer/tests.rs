//! The previewer with its threads, on a small sheet that hangs from two corners.

mod files;
mod full_length;
mod making;
mod memory;
mod runs;
pub mod stage;
mod time;

use glam::DVec3;
use serde_json::json;

use super::*;
use crate::preview::{FrameStatus, Reach};
use stage::{LAST, Stage, bits, straight, windy};

#[test]
fn a_moved_camera_key_has_only_the_frames_computed_again_that_can_see_it_with_the_bits_of_a_fresh_run()
 {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    assert_eq!(p.0.simulated(), u64::from(LAST) + 1);
    let before = p.0.timeline().keys();
    p.act(Action::GoTo { frame: 8 });
    p.act(Action::MoveCamera {
        eye: DVec3::new(0.5, -3.0, 0.4),
        target: DVec3::new(0.5, 0.0, 0.2),
    });
    p.act(Action::SetKey);
    p.until_done();
    // The stretch from the cut at 4 moves from frame 5 on, which a window of 2 frames sees from 4 on:
    // what is 2 ahead weighs nothing.
    let kept = p.0.timeline().keys().iter().zip(&before).take_while(|(a, b)| a == b).count();
    assert_eq!(kept, 4);
    assert_eq!(p.0.simulated(), u64::from(LAST) + 1 + u64::from(LAST) + 1 - 4);
    assert_eq!(p.statuses(), "r".repeat(LAST as usize + 1));
    let plan = p.0.plan().unwrap().clone();
    assert_eq!(bits(&p.frame(LAST)), bits(&straight(&plan)));
    // Taken back, nothing is computed at all.
    let so_far = p.0.simulated();
    p.act(Action::Undo);
    p.until("the old frames", |p| !p.is_opening() && p.timeline().keys() == before);
    assert_eq!(p.0.simulated(), so_far);
}

#[test]
fn a_setting_changed_here_leaves_what_was_before_and_marks_what_comes_as_mixed() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let before = bits(&p.frame(LAST));
    p.act(Action::GoTo { frame: 6 });
    p.act(windy(3.0));
    p.until("the frames after it", |p| {
        !p.is_opening() && (7..=LAST).all(|n| p.timeline().status(n) == FrameStatus::Mixed)
    });
    assert_eq!(p.statuses(), "sssssssmmmmmm");
    assert_ne!(bits(&p.frame(LAST)), before);
    let (six, seven) = (p.0.timeline().slot(6).unwrap(), p.0.timeline().slot(7).unwrap());
    assert_ne!(six.settings_hash, seven.settings_hash);
    assert!(!p.0.timeline().is_clean(0, LAST));
    // A clean run of the same settings is another.
    p.act(Action::ReRun);
    p.until("a clean run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    let plan = p.0.plan().unwrap().clone();
    assert_eq!(bits(&p.frame(LAST)), bits(&straight(&plan)));
    // Undone twice, the first frames are back without a step.
    let so_far = p.0.simulated();
    p.act(Action::Undo);
    p.act(Action::Undo);
    p.until("the first run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_eq!((p.0.simulated(), bits(&p.frame(LAST))), (so_far, before));
}

#[test]
fn undo_gives_the_frames_before_the_anchor_back_as_well() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let first = bits(&p.frame(3));
    p.act(Action::GoTo { frame: 6 });
    p.act(windy(3.0));
    p.until("the frames after it", |p| {
        !p.is_opening() && (7..=LAST).all(|n| p.timeline().status(n) == FrameStatus::Mixed)
    });
    let mixed = p.0.timeline().keys();
    p.act(Action::ReRun);
    p.until("a clean run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_ne!(bits(&p.frame(3)), first);
    let simulated = p.0.simulated();
    p.act(Action::Undo);
    p.until("the mixed frames", |p| !p.is_opening() && p.timeline().keys() == mixed);
    assert_eq!(p.statuses(), "sssssssmmmmmm");
    assert_eq!((bits(&p.frame(3)), p.0.simulated()), (first, simulated));
    let hashes = [6, 7].map(|n| p.0.timeline().slot(n).unwrap().settings_hash.clone());
    assert_ne!(hashes[0], hashes[1]);
}

#[test]
fn keys_set_faster_than_plans_are_made_are_all_set() {
    let stage = Stage::set();
    let mut p = stage.opened();
    for frame in [2, 6, 10] {
        p.act(Action::GoTo { frame });
        p.act(Action::SetKey);
    }
    p.until("all keys", |p| !p.is_opening() && p.planning.deferred.is_empty());
    let path = p.0.scenery().unwrap().camera.clone().unwrap();
    assert_eq!(path.key_frames(), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0]);
}

#[test]
fn a_setting_changed_from_the_start_makes_everything_anew() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::SetReach { reach: Reach::FromStart });
    p.act(Action::GoTo { frame: 6 });
    p.act(windy(3.0));
    p.until("a clean run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_eq!(p.0.simulated(), 2 * (u64::from(LAST) + 1));
}

#[test]
fn a_bad_value_is_said_and_changes_nothing() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(-1.0) });
    p.until_refused();
    let said = &p.0.state.messages.last().unwrap().text;
    assert!(said.contains("view.nu_out") && said.contains("-1"), "{said}");
    assert!(p.0.state.version.edits.is_empty() && !p.0.state.history.can_undo());
}

#[test]
fn a_and_b_are_shown_together_and_change_places() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let a = bits(&p.frame(10));
    p.act(Action::KeepAsA);
    p.act(Action::SetReach { reach: Reach::FromStart });
    p.act(Action::Set { path: "view.anticipation_frames".into(), value: json!(5) });
    p.until_opened();
    let looks_ahead =
        [p.0.state.a.as_ref().unwrap().anticipation, p.0.scenery().unwrap().anticipation()];
    assert_eq!(looks_ahead, [2.0, 5.0]);
    p.act(windy(4.0));
    p.until("b", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    p.act(Action::Compare { wipe: Some(0.5) });
    p.until("both", |p| p.shown_of_a().is_some());
    assert_eq!(bits(p.0.shown_of_a().unwrap()), a);
    let b = bits(&p.frame(10));
    assert_ne!(a, b);
    let differ: Vec<&str> = p.0.differences().iter().map(|found| &*found.name).collect();
    assert_eq!(differ, ["Time and air: Wind", "Look ahead"]);
    p.act(Action::SwapAAndB);
    p.until("the change of places", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_eq!(bits(&p.frame(10)), a);
    p.until("both", |p| p.shown_of_a().is_some());
    assert_eq!(bits(p.0.shown_of_a().unwrap()), b);
}

#[test]
fn a_refused_value_takes_no_other_change_along() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(1.0));
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(0.3) });
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(-5) });
    p.wait_for(|p| !p.is_opening());
    let edits = |p: &Previewer| p.state.version.edits.overrides();
    assert_eq!(edits(&p.0), ["air.velocity=[1.0,2.0,0.0]", "view.nu_out=0.3"]);
    // Why is still to be read.
    assert!(p.0.state.messages.last().is_some_and(|m| m.text.contains("view.nu_out is -5")));
    p.act(Action::Undo);
    p.wait_for(|p| !p.is_opening());
    assert_eq!(edits(&p.0), ["air.velocity=[1.0,2.0,0.0]"]);
    p.act(Action::Undo);
    p.until_opened();
    assert!(edits(&p.0).is_empty() && !p.0.state.history.can_undo());
}

#[test]
fn an_undo_that_cannot_be_planned_can_be_tried_again() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(1.0));
    p.until_opened();
    let [mesh, away] = ["sheet.obj", "away.obj"].map(|name| stage.folder.path().join(name));
    std::fs::rename(&mesh, &away).unwrap();
    for action in [Action::Undo, Action::Undo, Action::Undo] {
        p.act(action);
        p.wait_for(|p| !p.is_opening());
        assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[1.0,2.0,0.0]"]);
    }
    std::fs::rename(&away, &mesh).unwrap();
    p.act(Action::Undo);
    p.wait_for(|p| !p.is_opening());
    assert!(p.0.state.version.edits.is_empty() && p.0.state.history.can_redo());
    assert!(p.0.state.messages.is_empty(), "{:?}", p.0.state.messages);
}

#[test]
fn what_is_changed_while_something_else_is_opened_is_changed_there_and_goes_on_from_none_of_its_frames()
 {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let other = stage.folder.path().join("other.json");
    std::fs::write(&other, stage::SHOT.replace("0.05", "0.06")).unwrap();
    p.act(Action::GoTo { frame: 6 });
    p.act(Action::Open { path: other });
    p.act(windy(2.0));
    p.act(Action::Undo);
    p.act(windy(3.0));
    p.until("the other shot", |p| !p.is_opening() && p.planning.deferred.is_empty());
    assert_eq!(p.0.scenery().unwrap().name, "other");
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[3.0,2.0,0.0]"]);
    assert_eq!(p.0.state.version.anchor, None);
}
