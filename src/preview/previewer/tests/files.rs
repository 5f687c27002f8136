//! Opening, saving, reading again.

use std::fs;
use std::time::Duration;

use serde_json::json;

use super::super::*;
use super::stage::{LAST, SHOT, Stage, windy};
use crate::preview::{Level, Reach};
use crate::request::Request;

#[test]
fn a_failed_opening_leaves_the_edits_and_another_asks_before_they_are_lost() {
    let stage = Stage::set();
    let mut p = stage.opened();
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
    let mut p = stage.opened();
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
    p.act(Action::DismissAll);
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
    let mut p = stage.opened();
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
    let mut p = stage.opened();
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
    let mut p = stage.opened();
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
fn a_shot_that_somebody_else_has_changed_since_it_was_read_is_not_written_over() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(2.5));
    p.until_opened();
    let theirs = SHOT.replace("\"nu_out\": 0.2", "\"nu_out\": 0.3");
    fs::write(stage.shot(), &theirs).unwrap();
    p.act(Action::Save);
    let said = &p.0.state.messages.last().unwrap().text;
    assert!(said.contains("has changed on disk since it was read"), "{said}");
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), theirs);
    p.act(Action::Reload);
    p.wait_for(|p| !p.is_opening());
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[2.5,2.0,0.0]"]);
    p.act(Action::Save);
    p.until_opened();
    let text = fs::read_to_string(stage.shot()).unwrap();
    assert!(text.contains("2.5") && text.contains("\"nu_out\": 0.3"), "{text}");
}

#[test]
fn what_others_do_to_a_saved_shot_stays_offered_and_changes_nothing_until_it_is_read_again() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(2.5));
    p.act(Action::Save);
    p.until_opened();
    let nu_out = |p: &Previewer| p.scenery().unwrap().view_settings[0].nu_out;
    // Times of files are as fine as the file system has them.
    std::thread::sleep(Duration::from_millis(20));
    let theirs = fs::read_to_string(stage.shot()).unwrap();
    let theirs = theirs.replace("\"nu_out\": 0.2", "\"nu_out\": 0.3");
    fs::write(stage.shot(), &theirs).unwrap();
    p.act(windy(4.0));
    p.until_opened();
    p.until("the change", |p| p.changed_files() == [stage.shot()]);
    // To what was saved, and away from it.
    for action in [Action::Undo, Action::Redo] {
        p.act(action);
        p.until_opened();
        assert_eq!((p.0.changed_files(), nu_out(&p.0)), (&[stage.shot()][..], 0.2));
    }
    let is_read = |p: &Previewer| p.state.messages.iter().any(|m| m.text.contains("read again"));
    p.act(Action::IgnoreChanges);
    p.act(windy(6.0));
    p.until_opened();
    assert!(!is_read(&p.0));
    p.act(Action::Reload);
    p.until_opened();
    assert_eq!((p.0.changed_files().len(), nu_out(&p.0)), (0, 0.3));
}

#[test]
fn what_was_undone_since_a_shot_was_saved_is_undone_when_it_is_read_again() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(0.5) });
    p.act(windy(2.5));
    p.act(Action::Save);
    p.until_opened();
    p.act(Action::Undo);
    p.act(Action::Undo);
    p.until_opened();
    p.act(Action::Reload);
    p.until_opened();
    assert_eq!(p.0.state.version.edits.overrides(), ["view.nu_out=0.2"]);
    // The shot said nothing of the wind.
    let said = &p.0.state.messages.last().unwrap().text;
    assert_eq!(said, "air.velocity is as the file has it, though that was undone");
}

#[test]
fn a_value_refused_before_a_saved_shot_is_read_leaves_it_open() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(2.5));
    p.until_opened();
    let to = stage.folder.path().join("other.json");
    p.act(Action::SaveAs { path: to.clone(), overwrite: false });
    p.act(Action::Set { path: "view.nu_out".into(), value: json!(-5) });
    p.wait_for(|p| !p.is_opening());
    assert!(matches!(p.0.source(), Source::Shot(request) if request.shot == Some(to.clone())));
    assert!(!p.0.has_unsaved_edits());
    assert_eq!(p.0.state.version.edits.overrides(), ["air.velocity=[2.5,2.0,0.0]"]);
    assert!(p.0.state.messages.iter().any(|m| m.text.contains("view.nu_out is -5")));
}

#[test]
fn what_is_saved_is_saved_though_it_cannot_be_planned_just_now() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(windy(2.5));
    p.until_opened();
    let [mesh, away] = ["sheet.obj", "away.obj"].map(|name| stage.folder.path().join(name));
    fs::rename(&mesh, &away).unwrap();
    p.act(Action::Save);
    p.wait_for(|p| !p.is_opening());
    assert!(!p.0.has_unsaved_edits());
    fs::rename(&away, &mesh).unwrap();
    p.act(Action::Undo);
    p.wait_for(|p| !p.is_opening());
    assert!(p.0.has_unsaved_edits() && p.0.state.version.edits.is_empty());
    p.act(Action::Save);
    p.wait_for(|p| !p.is_opening());
    assert_eq!(fs::read_to_string(stage.shot()).unwrap(), SHOT);
}

#[test]
fn settings_are_saved_before_something_else_is_opened_if_that_is_asked_for() {
    let stage = Stage::set();
    let run = stage.finished_run();
    let mut p = stage.opened();
    p.act(windy(2.5));
    p.until_opened();
    p.act(Action::Open { path: run });
    assert!(p.0.state.unsaved.is_some());
    p.act(Action::SaveFirst);
    p.until("the run", |p| matches!(p.source(), Source::Run(_)));
    assert!(fs::read_to_string(stage.shot()).unwrap().contains("2.5"));
    assert!(p.0.state.unsaved.is_none());
}

#[test]
fn why_a_shot_could_not_be_opened_stays_said_when_something_else_is_planned() {
    let stage = Stage::set();
    let mut p = stage.opened();
    p.act(Action::Open { path: stage.folder.path().join("nothing.json") });
    p.until_refused();
    p.act(windy(2.5));
    p.wait_for(|p| !p.is_opening());
    assert!(p.0.opening_failure().is_some_and(|why| why.contains("nothing.json")));
    assert_eq!(p.0.state.messages.len(), 1);
}
