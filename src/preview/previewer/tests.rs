//! The previewer with its threads, on a small sheet that hangs from two corners.

mod full_length;
pub mod stage;

use std::fs;
use std::time::{Duration, Instant};

use glam::DVec3;
use serde_json::json;

use super::*;
use crate::preview::{FrameStatus, Level, Reach};
use crate::request::Request;
use stage::{LAST, SHOT, Stage, bits, straight, windy};

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
    let mut p = stage.start(false);
    p.until_opened();
    for frame in [2, 6, 10] {
        p.act(Action::GoTo { frame });
        p.act(Action::SetKey);
    }
    p.until("all keys", |p| !p.is_opening() && p.planning.deferred.is_empty());
    let path = p.0.scenery().unwrap().camera.clone().unwrap();
    assert_eq!(path.key_frames(), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0]);
}

#[test]
fn a_failed_opening_leaves_the_edits_and_another_asks_before_they_are_lost() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    p.act(windy(1.0));
    p.until_opened();
    p.act(Action::OpenOwn);
    assert!(p.0.state.unsaved.is_some() && !p.0.is_opening());
    p.act(Action::GiveUpEdits { yes: false });
    assert!(p.0.state.unsaved.is_none() && !p.0.state.version.edits.is_empty());
    p.act(Action::Open { path: stage.folder.path().join("nothing.json") });
    p.act(Action::GiveUpEdits { yes: true });
    p.until_refused();
    assert_eq!(p.0.state.messages.last().unwrap().level, Level::Error);
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[1.0,2.0,0.0]"]);
    assert_eq!(p.0.scenery().unwrap().name, "shot");
}

#[test]
fn without_a_disk_the_memory_budget_holds_and_the_simulation_halts() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 20_000);
    p.until("the halt", |p| !p.state.simulating);
    assert!(p.0.state.messages.last().unwrap().text.contains("do not fit"));
    assert!(p.0.store().used() <= 20_000 || p.0.store().len() == 1);
}

#[test]
fn frames_that_less_memory_has_no_room_for_are_said_to_be_gone() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 64 << 20);
    p.until_done();
    p.0.set_budget(20_000);
    assert!(p.0.state.messages.last().unwrap().text.contains("do not fit"));
    assert!(!p.0.state.simulating && p.statuses().contains('.'));
}

#[test]
fn of_frames_that_are_gone_nothing_is_remembered() {
    let stage = Stage::set();
    let mut p = stage.open_with(Source::Shot(stage.request()), true, None, 20_000);
    for wind in [1.0, 2.0, 3.0, 4.0] {
        p.until("the halt", |p| !p.state.simulating);
        p.act(windy(wind));
        p.act(Action::SetReach { reach: Reach::FromStart });
        p.until_opened();
        let known = p.0.timeline().known_count();
        assert!(known <= p.0.store().len(), "{known}");
        p.act(Action::Simulate { on: true });
    }
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
fn frames_survive_a_restart_and_are_not_computed_again() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let last = bits(&p.frame(LAST));
    p.until("all on disk", |p| {
        p.timeline().keys().iter().flatten().all(|&key| p.store().is_on_disk(key))
    });
    drop(p);
    let mut p = stage.start(true);
    p.until_done();
    assert_eq!(bits(&p.frame(LAST)), last);
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn memory_for_two_frames_is_enough_to_scrub_all() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.until("all on disk", |p| {
        p.timeline().keys().iter().flatten().all(|&key| p.store().is_on_disk(key))
    });
    let budget = 2 * p.0.store().used() / (u64::from(LAST) + 1);
    let _ = p.0.frames.store.set_budget(budget);
    for number in [0, 11, 3, 7, 12, 1] {
        assert_eq!(p.frame(number).number, number);
        assert!(p.0.store().used() <= budget);
    }
    assert_eq!(p.0.simulated(), u64::from(LAST) + 1);
}

#[test]
fn a_bad_value_is_said_and_changes_nothing() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(-1.0) });
    p.until_refused();
    let said = &p.0.state.messages.last().unwrap().text;
    assert!(said.contains("view.nu_out") && said.contains("-1"), "{said}");
    assert!(p.0.state.version.edits.is_empty() && !p.0.state.history.can_undo());
}

#[test]
fn a_file_that_is_no_shot_leaves_what_is_open() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let keys = p.0.timeline().keys();
    p.act(Action::Open { path: stage.folder.path().join("sheet.obj") });
    p.until_refused();
    assert_eq!(p.0.state.messages.last().unwrap().level, Level::Error);
    assert_eq!(p.0.timeline().keys(), keys);
    assert!(matches!(p.0.source(), Source::Shot(request) if request.shot == Some(stage.shot())));
}

#[test]
fn a_finished_run_can_be_scrubbed_and_not_changed() {
    let stage = Stage::set();
    let mut p = stage.open(Source::Run(stage.finished_run()), true);
    p.until_opened();
    assert_eq!(p.frame(3).number, 3);
    assert_eq!(p.statuses(), "rrrr");
    p.act(windy(1.0));
    assert!(p.0.state.messages.last().unwrap().text.contains("finished run"));
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn of_a_finished_run_a_frame_that_cannot_be_read_is_named_with_the_reason_and_the_others_are_shown()
{
    let stage = Stage::set();
    let run = stage.finished_run();
    fs::write(run.join("frames/000002.sfr"), "no state").unwrap();
    let mut p = stage.open(Source::Run(run), true);
    p.until("word of the frame", |p| {
        p.state.messages.iter().any(|m| m.text.contains("frame 2 of the run cannot be shown"))
    });
    let text = &p.0.state.messages.last().unwrap().text;
    assert!(text.contains("000002.sfr") && text.contains("not a shotsilk state"), "{text}");
    assert!(!text.contains("made again"), "{text}");
    assert_eq!(p.frame(3).number, 3);
    assert_eq!(p.0.simulated(), 0);
}

#[test]
fn a_saved_shot_keeps_its_comments_and_its_frames() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::SetReach { reach: Reach::FromStart });
    p.act(windy(2.5));
    p.until("a clean run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    let (keys, simulated) = (p.0.timeline().keys(), p.0.simulated());
    p.act(Action::Save);
    p.until("the saved shot", |p| !p.is_opening());
    let text = fs::read_to_string(stage.shot()).unwrap();
    assert!(text.contains("// As short as can be.") && text.contains("2.5"), "{text}");
    assert!(!p.0.has_unsaved_edits() && !p.0.is_unsaved("air.velocity"));
    assert_eq!((p.0.timeline().keys(), p.0.simulated()), (keys, simulated));
}

#[test]
fn what_was_done_before_a_shot_was_saved_can_be_undone_and_compared_after() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::KeepAsA);
    let (keys, hash) = (p.0.timeline().keys(), p.0.scenery().unwrap().settings_hash.clone());
    p.act(Action::SetReach { reach: Reach::FromStart });
    p.act(windy(2.5));
    p.until("a clean run", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    p.act(Action::Save);
    p.until_opened();
    let saved = fs::read_to_string(stage.shot()).unwrap();
    // What a run of the saved file would carry.
    let of_file = stage.request().load().unwrap().info.input_hash;
    assert_eq!(p.0.scenery().unwrap().settings_hash, of_file);
    p.act(Action::Undo);
    p.until_opened();
    assert!(p.0.has_unsaved_edits() && p.0.is_unsaved("air.velocity"));
    assert_eq!(p.0.timeline().keys(), keys);
    assert_eq!(p.0.scenery().unwrap().settings_hash, hash);
    assert!(p.0.state.a.is_some());
    // The file is as it was, to the byte.
    p.act(Action::Save);
    p.until_opened();
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), SHOT);
    p.act(Action::Redo);
    p.until_opened();
    p.act(Action::Save);
    p.until_opened();
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), saved);
    assert!(!p.0.has_unsaved_edits());
    // Back to what the file says is back to what was saved.
    p.act(windy(4.0));
    p.until_opened();
    p.act(Action::Reset { path: "air.velocity".into() });
    p.until_opened();
    assert!(!p.0.has_unsaved_edits());
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[2.5,2.0,0.0]"]);
}

#[test]
fn a_saved_shot_that_somebody_else_has_changed_is_not_written_over() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    p.act(windy(2.5));
    p.act(Action::Save);
    p.until_opened();
    let theirs = fs::read_to_string(stage.shot()).unwrap();
    let theirs = theirs.replace("\"nu_out\": 0.2", "\"nu_out\": 0.3");
    fs::write(stage.shot(), &theirs).unwrap();
    p.act(windy(4.0));
    p.until_opened();
    p.act(Action::Save);
    let said = &p.0.state.messages.last().unwrap().text;
    assert!(said.contains("has changed on disk"), "{said}");
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), theirs);
    p.act(Action::DismissMessage { index: p.0.state.messages.len() - 1 });
    // Read again, the change since goes on to hold over what they wrote.
    p.act(Action::Reload);
    p.until_opened();
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[4.0,2.0,0.0]"]);
    assert!(!p.0.state.history.can_undo());
    p.act(Action::Save);
    p.until_opened();
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), theirs.replace("2.5", "4"));
}

#[test]
fn a_shot_saved_elsewhere_finds_its_files() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    p.act(windy(2.5));
    p.until_opened();
    let deep = stage.folder.path().join("deep");
    fs::create_dir(&deep).unwrap();
    let to = deep.join("other.json");
    p.act(Action::SaveAs { path: to.clone(), overwrite: false });
    p.until_opened();
    assert!(matches!(p.0.source(), Source::Shot(request) if request.shot == Some(to.clone())));
    assert_eq!(p.0.scenery().unwrap().name, "other");
}

#[test]
fn another_file_is_written_over_only_after_a_word_about_it() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    let to = stage.folder.path().join("other.json");
    fs::write(&to, "mine").unwrap();
    let save = Action::SaveAs { path: to.clone(), overwrite: false };
    for (yes, text) in [(false, "mine"), (true, SHOT)] {
        p.act(save.clone());
        let asked = p.0.state.overwriting.clone().unwrap();
        assert!(asked.what.contains("other.json"), "{}", asked.what);
        assert_eq!(fs::read_to_string(&to).unwrap(), "mine");
        p.act(Action::WriteOver { yes });
        p.until_opened();
        assert!(p.0.state.overwriting.is_none());
        assert_eq!(fs::read_to_string(&to).unwrap(), text);
    }
    // What is open is no other file.
    p.act(save);
    assert!(p.0.state.overwriting.is_none());
}

#[test]
fn the_programs_own_shot_is_saved_as_a_copy_with_its_files() {
    let stage = Stage::set();
    let own = Request { shot: None, ..stage.request() };
    let mut p = stage.open(Source::Shot(own), false);
    p.until_opened();
    p.act(windy(2.5));
    p.until_opened();
    let keys = p.0.timeline().wanted_keys().collect::<Vec<_>>();
    let to = stage.folder.path().join("mine/shot.json");
    fs::create_dir(to.parent().unwrap()).unwrap();
    p.act(Action::SaveAs { path: to.clone(), overwrite: false });
    p.until_opened();
    assert!(matches!(p.0.source(), Source::Shot(request) if request.shot == Some(to.clone())));
    // The same shot elsewhere has the same frames.
    assert_eq!(p.0.timeline().wanted_keys().collect::<Vec<_>>(), keys);
}

#[test]
fn a_changed_file_is_noticed_and_read_again_when_asked() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    let hash = p.0.scenery().unwrap().settings_hash.clone();
    // Times of files are as fine as the file system has them.
    std::thread::sleep(Duration::from_millis(20));
    fs::write(stage.shot(), SHOT.replace("\"nu_out\": 0.2", "\"nu_out\": 0.3")).unwrap();
    p.until("the change", |p| p.changed_files() == [stage.shot()]);
    p.act(Action::Reload);
    p.until_opened();
    assert_ne!(p.0.scenery().unwrap().settings_hash, hash);
    assert!(p.0.changed_files().is_empty());
}

#[test]
fn playing_keeps_the_rate_and_drops_frames_rather_than_time() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::GoTo { frame: 0 });
    p.act(Action::SetLooping { on: false });
    p.act(Action::Play);
    assert_eq!(p.0.tick(10.0), Some(10.0 + 1.0 / 24.0));
    p.0.tick(10.0 + 5.5 / 24.0);
    assert_eq!(p.0.state.playback.current, 5);
    assert_eq!(p.0.tick(10.0 + 13.5 / 24.0), None);
    assert_eq!((p.0.state.playback.current, p.0.state.playback.playing), (LAST, false));
    p.act(Action::SetLooping { on: true });
    p.act(Action::SetIn { frame: 3 });
    p.act(Action::SetOut { frame: 5 });
    p.act(Action::Play);
    p.0.tick(20.0);
    assert_eq!(p.0.state.playback.current, 3);
    for (passed, frame) in [(2.5, 5), (3.2, 3), (4.2, 4), (7.9, 4), (300.2, 3)] {
        p.0.tick(20.0 + passed / 24.0);
        assert_eq!(p.0.state.playback.current, frame, "after {passed} frames");
    }
}

#[test]
fn playing_waits_for_frames_that_are_not_there_yet() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until("some frames", |p| p.timeline().slot(4).is_some());
    p.act(Action::Simulate { on: false });
    p.act(Action::GoTo { frame: 0 });
    p.act(Action::Play);
    p.0.tick(0.0);
    p.0.tick(100.0);
    let current = p.0.state.playback.current;
    assert!(current >= 4 && p.0.state.playback.playing);
    if current < LAST {
        assert_eq!(p.0.timeline().status(current + 1), FrameStatus::Missing);
    }
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
    let differ: Vec<&str> = p.0.differences().iter().map(|found| &*found.path).collect();
    assert_eq!(differ, ["air.velocity", "view.anticipation_frames"]);
    p.act(Action::SwapAAndB);
    p.until("the change of places", |p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_eq!(bits(&p.frame(10)), a);
    p.until("both", |p| p.shown_of_a().is_some());
    assert_eq!(bits(p.0.shown_of_a().unwrap()), b);
}

#[test]
fn the_adaptive_run_counts_costs_and_keeps_no_frames() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    let (used, simulated) = (p.0.store().used(), p.0.simulated());
    p.act(Action::MeasureAdaptive { on: true });
    p.until("all costs", |p| {
        p.rival_costs().len() == LAST as usize + 1 && p.rival_costs().iter().all(Option::is_some)
    });
    assert_eq!((p.0.store().used(), p.0.simulated()), (used, simulated));
}

#[test]
fn the_adaptive_run_and_its_costs_end_where_a_finished_run_is_opened() {
    let stage = Stage::set();
    let run = stage.finished_run();
    let mut p = stage.start(false);
    p.until_opened();
    p.act(Action::MeasureAdaptive { on: true });
    p.until("a cost", |p| p.rival_costs().iter().any(Option::is_some));
    p.act(Action::Open { path: run });
    p.until_opened();
    assert!(matches!(p.0.source(), Source::Run(_)));
    assert_eq!(p.0.rival(), (false, false));
    assert!(p.0.rival_costs().is_empty());
    p.act(Action::MeasureAdaptive { on: true });
    assert_eq!(p.0.rival(), (false, false));
}

#[test]
fn after_a_step_that_failed_the_simulation_goes_on_with_the_next_settings() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::GoTo { frame: 4 });
    p.act(Action::Set { path: "gravity".into(), value: json!([0.0, 0.0, -1e300]) });
    p.wait_for(|p| p.failed_frame() == Some(5));
    let said = p.0.state.messages.last().unwrap().text.clone();
    assert!(
        said.starts_with("frame 5 cannot be simulated with these settings: the step"),
        "{said}"
    );
    assert!(p.0.state.simulating && !p.0.is_working());
    // It is not tried again until somebody asks.
    p.act(Action::GoTo { frame: 0 });
    assert!(!p.0.is_working());
    p.act(Action::Simulate { on: true });
    p.wait_for(|p| p.failed_frame() == Some(5));
    p.act(Action::Undo);
    p.wait_for(|p| !p.is_opening() && p.timeline().is_clean(0, LAST));
    assert_eq!(p.0.failed_frame(), None);
    p.act(windy(3.0));
    p.until("frames of other settings", |p| {
        !p.is_opening() && p.timeline().status(LAST) == FrameStatus::Ready
    });
}

#[test]
fn what_a_frame_cost_is_known_when_the_shot_is_opened_again() {
    let stage = Stage::set();
    let run = stage.finished_run();
    let mut p = stage.start(true);
    p.until_done();
    p.act(Action::Open { path: run });
    p.until_opened();
    p.act(Action::Open { path: stage.shot() });
    p.until("the frames again", |p| !p.is_opening() && p.timeline().slot(3).is_some());
    let costs = |p: &Previewer| (0..4).all(|f| p.timeline().slot(f).unwrap().cost.is_some());
    assert!(costs(&p.0));
}

#[test]
fn the_same_warning_of_many_frames_is_said_once() {
    let stage = Stage::set();
    let mut p = stage.start(false);
    p.until_opened();
    for (shown, warning) in
        [(3, "3 crossings"), (4, "12 crossings"), (4, "thin"), (5, "1 crossings")]
    {
        p.0.warn_of_frame(shown, warning);
    }
    let said: Vec<&str> = p.0.state.messages.iter().map(|m| &*m.text).collect();
    assert_eq!(said, ["frame 4: thin", "frame 5: 1 crossings (and 2 frames before it likewise)"]);
    p.act(Action::DismissMessage { index: 1 });
    p.0.warn_of_frame(6, "2 crossings");
    assert_eq!(p.0.state.messages.last().unwrap().text, "frame 6: 2 crossings");
}

#[test]
fn frames_that_a_run_lacks_are_named_when_it_is_opened() {
    for (lacks, words) in [
        (vec![1], "frame 1 is missing in the run"),
        (vec![1, 2], "2 frames are missing in the run, the first is 1"),
    ] {
        let stage = Stage::set();
        let run = stage.finished_run();
        for number in &lacks {
            fs::remove_file(run.join(format!("frames/{number:06}.sfr"))).unwrap();
        }
        let mut p = stage.open(Source::Run(run), false);
        p.until_opened();
        assert_eq!(p.0.state.messages.last().unwrap().text, words);
        assert_eq!(p.0.timeline().status(1), FrameStatus::Missing);
    }
}

#[test]
fn dropped_while_it_works_it_ends_at_once() {
    let stage = Stage::set();
    let mut p = stage.start(true);
    p.until("a frame", |p| p.timeline().slot(1).is_some());
    let began = Instant::now();
    drop(p);
    assert!(began.elapsed() < Duration::from_millis(500));
}
