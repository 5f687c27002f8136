//! The files' panel.

use super::seat::Seat;
use crate::preview::stage::windy;
use crate::preview::{Action, PanelName, Source};

const FILES: PanelName = PanelName::Files;

fn type_path(seat: &mut Seat, path: &str) {
    seat.text().focus();
    seat.settle();
    seat.text().type_text(path);
    seat.settle();
}

#[test]
fn a_path_that_cannot_be_opened_stays_with_the_reason_beside_it() {
    let mut seat = Seat::take();
    seat.act(Action::SetPanel { panel: FILES, open: true });
    let missing = seat.stage.folder.path().join("nothing.json").display().to_string();
    type_path(&mut seat, &missing);
    seat.press(egui::Key::Enter);
    seat.until_refused();
    assert_eq!(seat.text().value().as_deref(), Some(&*missing));
    let why = seat.previewer().opening_failure().unwrap().to_owned();
    // Beside the path, not only among the messages.
    seat.act(Action::DismissAll);
    assert!(seat.previewer().state().messages.is_empty());
    assert!(why.contains("nothing.json") && seat.says(&why), "{why}");
    // What was open still is.
    assert!(
        matches!(seat.previewer().source(), Source::Shot(of) if of.shot == Some(seat.stage.shot()))
    );
}

#[test]
fn what_is_typed_into_a_window_just_opened_is_a_path_and_no_key() {
    let mut seat = Seat::take();
    seat.act(Action::GoTo { frame: 3 });
    for panel in [FILES, PanelName::SaveAs] {
        seat.act(Action::SetPanel { panel, open: true });
        assert!(seat.text().is_focused());
        // Where nothing is focused keys are none of the shot's either.
        seat.click_at(seat.views().left_bottom() + egui::vec2(20.0, -60.0));
        for key in [egui::Key::K, egui::Key::I, egui::Key::ArrowRight] {
            seat.press(key);
        }
        let playback = seat.previewer().state().playback;
        assert_eq!((playback.current, playback.first), (3, 0));
        assert!(!seat.previewer().has_unsaved_edits());
        seat.press(egui::Key::Escape);
        assert!(!*seat.previewer().state().look.clone().panel_mut(panel));
    }
    seat.press(egui::Key::ArrowRight);
    assert_eq!(seat.current(), 4);
}

#[test]
fn saving_under_the_name_it_has_closes_the_window() {
    let mut seat = Seat::take();
    seat.act(windy(2.0));
    seat.until_planned();
    seat.act(Action::SetPanel { panel: PanelName::SaveAs, open: true });
    seat.press(egui::Key::Enter);
    seat.until_planned();
    assert!(!seat.previewer().has_unsaved_edits());
    assert!(!seat.previewer().state().look.save_panel);
}

#[test]
fn who_could_not_open_a_path_types_another_in_its_place() {
    let mut seat = Seat::take();
    seat.act(Action::SetPanel { panel: FILES, open: true });
    type_path(&mut seat, "nothing.json");
    seat.press(egui::Key::Enter);
    seat.until_refused();
    assert!(seat.text().is_focused());
    seat.text().type_text("x");
    seat.settle();
    assert_eq!(seat.text().value().as_deref(), Some("x"));
}

#[test]
fn what_has_been_opened_closes_the_panel() {
    let mut seat = Seat::take();
    seat.act(Action::SetPanel { panel: FILES, open: true });
    let path = seat.stage.shot().display().to_string();
    type_path(&mut seat, &path);
    seat.press(egui::Key::Enter);
    seat.until("the shot again", |p| !p.is_opening() && !p.state().look.files_panel);
    assert!(seat.previewer().opening_failure().is_none());
}

#[test]
fn what_has_been_saved_is_listed_when_the_panel_is_opened_again() {
    let mut seat = Seat::take();
    seat.act(Action::SetPanel { panel: FILES, open: true });
    let folder = seat.stage.folder.path().display().to_string();
    type_path(&mut seat, &folder);
    seat.press(egui::Key::Enter);
    assert!(seat.says("shot.json") && !seat.says("other.json"));
    seat.act(Action::SetPanel { panel: FILES, open: false });
    seat.act(Action::SetPanel { panel: PanelName::SaveAs, open: true });
    // The shot's own name is there to be changed.
    assert_eq!(seat.text().value().as_deref(), Some("shot.json"));
    seat.type_over("other.json");
    seat.press(egui::Key::Enter);
    seat.until("the saved shot", |p| !p.is_opening() && !p.state().look.files_panel);
    seat.act(Action::SetPanel { panel: FILES, open: true });
    // In the folder, and among what was open before.
    assert_eq!(seat.count_of("other.json"), 2);
}
