//! The camera's panel: keys, cuts and the lens.

use egui::accesskit::Role;

use super::seat::{Seat, Setting};
use crate::preview::Action;
use crate::preview::stage::SHOT;
use crate::shot::{CameraPath, Lens};

fn path(seat: &Seat) -> CameraPath {
    (**seat.previewer().scenery().unwrap().camera.as_ref().unwrap()).clone()
}

#[test]
fn a_key_is_added_made_a_cut_and_deleted() {
    let mut seat = Seat::take();
    seat.act(Action::GoTo { frame: 6 });
    assert!(!seat.is_offered("Delete key") && !seat.is_offered("Set key"));
    seat.click("Add key");
    seat.until_planned();
    assert_eq!(path(&seat).key_frames(), [0.0, 4.0, 6.0, 8.0, 12.0]);
    assert!(seat.says("keys: 0, 4 cut, 6, 8, 12"));
    assert!(seat.is_offered("Set key") && !seat.is_offered("Add key"));
    seat.tick("cut");
    seat.until_planned();
    assert_eq!(path(&seat).cuts().len(), 2);
    assert!(seat.says("keys: 0, 4 cut, 6 cut, 8, 12"));
    seat.tick("cut");
    seat.until_planned();
    assert_eq!(path(&seat).cuts().len(), 1);
    seat.click("Delete key");
    seat.until_planned();
    assert_eq!(path(&seat).key_frames(), [0.0, 4.0, 8.0, 12.0]);
}

#[test]
fn a_camera_that_is_as_the_file_has_it_again_is_no_change() {
    let mut seat = Seat::take();
    seat.act(Action::GoTo { frame: 6 });
    for name in ["Add key", "Delete key"] {
        seat.click(name);
        seat.until_planned();
    }
    assert!(!seat.previewer().has_unsaved_edits());
    assert!(seat.is_offered("Undo"));
}

#[test]
fn a_lens_changes_for_the_whole_path_or_at_a_frame_which_gets_a_key() {
    let mut seat = Seat::take();
    let lens = |seat: &Seat| [0.0, 6.0, 8.0].map(|frame| path(seat).lens(frame));
    let set = |seat: &mut Seat, degrees| {
        seat.node(Role::SpinButton, "field of view").set_value_accesskit(degrees);
        seat.until_planned();
    };
    let before = lens(&seat);
    seat.act(Action::GoTo { frame: 8 });
    set(&mut seat, 40.0);
    let whole = lens(&seat);
    assert!(whole[0] != before[0] && whole == [whole[0]; 3]);
    seat.click("at this frame");
    set(&mut seat, 30.0);
    let at_key = lens(&seat);
    assert_eq!(at_key[0], whole[0]);
    assert_ne!(at_key[2], whole[2]);
    // Between keys the lens that is in force there is shown, not that of a key.
    seat.act(Action::GoTo { frame: 6 });
    let shown = |seat: &Seat| seat.node(Role::SpinButton, "field of view").value().unwrap();
    let Lens::FieldOfView { fov_y } = at_key[1] else { panic!("{at_key:?}") };
    assert_eq!(shown(&seat), format!("{:.1} deg", fov_y.to_degrees()));
    set(&mut seat, 50.0);
    assert_eq!(path(&seat).key_frames(), [0.0, 4.0, 6.0, 8.0, 12.0]);
    assert_eq!([0, 2].map(|at| lens(&seat)[at]), [at_key[0], at_key[2]]);
    assert_eq!(shown(&seat), "50.0 deg");
    seat.click("whole path");
    set(&mut seat, 25.0);
    let again = lens(&seat);
    assert_eq!(again, [again[0]; 3]);
}

#[test]
fn a_lens_beyond_the_fields_range_stays_until_somebody_changes_it() {
    let shot = SHOT.replace("\"fov_y_deg\": 20", "\"fov_y_deg\": 0.5");
    assert_ne!(shot, SHOT);
    let mut seat = Seat::take_with(Setting { shot, ..Setting::default() });
    for frame in [0, 2, 4] {
        seat.act(Action::GoTo { frame });
        seat.until_planned();
    }
    assert!(!seat.is_offered("Undo") && !seat.previewer().has_unsaved_edits());
    let shown = seat.node(Role::SpinButton, "field of view").value();
    assert_eq!(shown.as_deref(), Some("0.5 deg"));
}

#[test]
fn the_camera_is_unlocked_for_drags() {
    let mut seat = Seat::take();
    seat.tick("unlocked");
    assert!(seat.previewer().state().camera_unlocked);
    seat.press(egui::Key::C);
    assert!(!seat.previewer().state().camera_unlocked);
}

#[test]
fn a_click_without_a_way_in_the_unlocked_view_moves_nothing() {
    let mut seat = Seat::take();
    seat.press(egui::Key::C);
    seat.act(Action::GoTo { frame: 8 });
    let before = path(&seat);
    for share in [0.1, 0.25, 0.4] {
        let views = seat.views();
        seat.click_at(views.min + views.size() * egui::vec2(share, 0.5));
        seat.settle();
    }
    assert!(path(&seat) == before);
    assert!(!seat.is_offered("Undo"));
}
