//! Help, and what the program says on its own.

use egui::Key;
use serde_json::json;

use super::seat::Seat;
use crate::app::keys::SHORTCUTS;
use crate::preview::Action;
use crate::preview::stage::windy;

#[test]
fn the_help_lists_every_key_and_goes_when_it_is_closed() {
    let mut seat = Seat::take();
    assert!(!seat.says("redo"));
    seat.press(Key::F1);
    for shortcut in &SHORTCUTS {
        assert!(seat.says(shortcut.does), "{}", shortcut.name);
    }
    seat.click("Close window");
    assert!(!seat.previewer().state().look.help_panel && !seat.says("redo"));
}

#[test]
fn notes_go_by_themselves_and_errors_stay_until_they_are_dismissed() {
    let mut seat = Seat::take();
    seat.act(Action::KeepAsA);
    seat.act(Action::Open { path: seat.stage.folder.path().join("nothing.json") });
    seat.until_refused();
    let (note, error) = ("kept as A", "nothing.json");
    assert!(seat.mentions(note) && seat.mentions(error));
    seat.pass(20.0);
    assert!(!seat.mentions(note) && seat.mentions(error));
    seat.pass(1000.0);
    assert!(seat.mentions(error));
    seat.click("x");
    assert!(!seat.mentions(error));
}

#[test]
fn all_messages_are_dismissed_at_once() {
    let mut seat = Seat::take();
    for name in ["one.json", "other.json"] {
        seat.act(Action::Open { path: seat.stage.folder.path().join(name) });
        seat.until_refused();
    }
    assert!(seat.mentions("one.json") && seat.mentions("other.json"));
    seat.click("dismiss all");
    assert!(seat.previewer().state().messages.is_empty());
}

#[test]
fn a_setting_that_cannot_be_is_named_and_what_was_said_goes_with_the_next_that_can() {
    let mut seat = Seat::take();
    seat.act(Action::Set { path: "view.nu_out".into(), value: json!(-5) });
    seat.until_answered();
    assert!(seat.mentions("view.nu_out is -5, but must be") && !seat.mentions("--set"));
    seat.act(windy(2.0));
    seat.until_answered();
    assert!(!seat.mentions("view.nu_out is -5, but must be"));
}

#[test]
fn while_a_question_is_open_keys_do_nothing_else() {
    let mut seat = Seat::take();
    seat.act(windy(2.0));
    seat.until_planned();
    seat.act(Action::OpenOwn);
    assert!(seat.is_offered("Give them up"));
    seat.press(Key::ArrowRight);
    assert_eq!(seat.current(), 0);
    seat.press(Key::Escape);
    assert!(!seat.is_offered("Give them up") && seat.previewer().has_unsaved_edits());
    seat.press(Key::ArrowRight);
    assert_eq!(seat.current(), 1);
}
