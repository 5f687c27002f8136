//! Exports, and the question before they write over something.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use egui::accesskit::Role;
use glam::DVec3;

use super::seat::{Seat, Setting};
use crate::preview::stage::{LAST, PATIENCE};
use crate::preview::{Action, Export, ExportKind, PanelName, Viewport};

fn still(to: &Path) -> Action {
    let export = Export {
        kind: ExportKind::Still,
        viewport: Viewport::Shot,
        width: 64,
        burn_in: false,
        to: to.to_owned(),
        overwrite: false,
    };
    Action::Export { export }
}

fn sheet(viewport: Viewport, width: u32, to: &Path) -> Action {
    let Action::Export { export } = still(to) else { unreachable!() };
    Action::Export { export: Export { kind: ExportKind::Sheet, viewport, width, ..export } }
}

/// With a witness, whose place nobody has looked for where nothing is drawn.
fn seat_with_witness() -> Seat {
    let mut seat = Seat::take_simulated();
    seat.act(Action::SetWitness { eye: DVec3::new(2.0, -2.0, 1.0), target: DVec3::ZERO });
    seat
}

fn wait(seat: &mut Seat) {
    let began = Instant::now();
    while seat.is_exporting() {
        seat.settle();
        assert!(began.elapsed() < PATIENCE, "the export does not end");
    }
}

#[test]
fn a_file_is_written_over_only_when_the_user_says_so() {
    let mut seat = Seat::take_simulated();
    let to: PathBuf = seat.stage.folder.path().join("still.png");
    fs::write(&to, "another").unwrap();
    for (answer, is_picture) in [("Go back", false), ("Write over", true)] {
        assert!(!seat.mentions("still.png"));
        seat.act(still(&to));
        assert!(seat.mentions("still.png") && !seat.is_exporting());
        seat.click(answer);
        wait(&mut seat);
        assert_eq!(image::open(&to).is_ok(), is_picture, "{answer}");
    }
    assert!(!seat.is_offered("Write over"));
}

#[test]
fn what_is_written_over_is_what_was_asked_for_wherever_time_has_gone_since() {
    let mut seat = Seat::take_simulated();
    let [first, last, to] =
        ["first.png", "last.png", "to.png"].map(|name| seat.stage.folder.path().join(name));
    seat.act(Action::GoTo { frame: LAST });
    seat.act(still(&last));
    wait(&mut seat);
    seat.act(Action::GoTo { frame: 0 });
    seat.act(still(&first));
    wait(&mut seat);
    fs::write(&to, "another").unwrap();
    seat.act(still(&to));
    seat.act(Action::GoTo { frame: LAST });
    seat.click("Write over");
    wait(&mut seat);
    let picture = |path: &Path| image::open(path).unwrap().into_rgba8();
    assert!(picture(&to) == picture(&first) && picture(&first) != picture(&last));
}

#[test]
fn what_is_exported_is_chosen_and_named_after_the_shot() {
    let mut seat = Seat::take();
    seat.act(Action::SetPanel { panel: PanelName::Export, open: true });
    for (kind, name) in [
        ("Still", "shot.0.png"),
        ("Contact sheet", "shot.sheet.png"),
        ("PNG sequence", "shot.frames"),
        ("Video", "shot.mp4"),
        ("Run folder", "shot.run"),
    ] {
        seat.node(Role::RadioButton, kind).click();
        seat.settle();
        assert_eq!(seat.text().value().as_deref(), Some(name), "{kind}");
    }
}

#[test]
fn who_asks_for_one_view_on_a_contact_sheet_is_told_that_it_shows_both() {
    let mut seat = seat_with_witness();
    let to = seat.stage.folder.path().join("sheet.png");
    let words = "a contact sheet shows both views";
    for (viewport, is_told) in [(Viewport::Both, false), (Viewport::Shot, true)] {
        let told = |seat: &Seat| {
            seat.previewer().state().messages.iter().filter(|m| m.text == words).count()
        };
        let before = told(&seat);
        seat.act(sheet(viewport, 32, &to));
        assert_eq!(told(&seat) - before, usize::from(is_told), "{viewport:?}");
        wait(&mut seat);
        fs::remove_file(&to).unwrap();
    }
}

#[test]
fn views_on_a_contact_sheet_are_as_wide_as_was_asked_for() {
    let mut seat = seat_with_witness();
    let to = seat.stage.folder.path().join("sheet.png");
    seat.act(sheet(Viewport::Both, 640, &to));
    wait(&mut seat);
    let (width, _) = image::image_dimensions(&to).unwrap();
    assert!(width > 2 * 640, "{width}");
    let unwritten = seat.stage.folder.path().join("huge.png");
    seat.act(sheet(Viewport::Both, 8_000, &unwritten));
    wait(&mut seat);
    let messages = &seat.previewer().state().messages;
    assert!(messages.iter().any(|m| m.text.contains("400 million are possible")), "{messages:?}");
    assert!(!unwritten.exists());
}

#[test]
fn every_kind_is_exported_by_its_button_to_what_is_typed() {
    // Where the bar's own button of that name is in a menu.
    let size = [640.0, 360.0];
    let mut seat = Seat::take_with(Setting { simulating: true, size, ..Setting::default() });
    seat.until("all frames", |p| p.timeline().is_clean(0, LAST) && !p.is_working());
    seat.act(Action::SetWitness { eye: DVec3::new(2.0, -2.0, 1.0), target: DVec3::ZERO });
    seat.act(Action::SetPanel { panel: PanelName::Export, open: true });
    for (kind, name, made) in [
        ("Still", "a.png", "a.png"),
        ("Contact sheet", "b.png", "b.png"),
        ("PNG sequence", "c", "c/0012.shot.png"),
        ("Run folder", "d", "d/frames/000012.sfr"),
    ] {
        let folder = seat.stage.folder.path().join("new");
        let to = folder.join(name);
        seat.node(Role::RadioButton, kind).click_accesskit();
        seat.settle();
        seat.type_over(&to.display().to_string());
        seat.node(Role::Button, "Export").click_accesskit();
        seat.settle();
        wait(&mut seat);
        let messages = &seat.previewer().state().messages;
        assert!(folder.join(made).exists(), "{kind}: {messages:?}");
    }
}
