//! The camera's panel: keys, cuts and the lens.

use egui::accesskit::Role;

use super::seat::Seat;
use crate::preview::Action;
use crate::shot::CameraPath;

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
fn a_lens_changes_at_a_key_or_for_the_whole_path() {
    let mut seat = Seat::take();
    let lens = |seat: &Seat| [0.0, 8.0].map(|frame| path(seat).lens(frame));
    let before = lens(&seat);
    seat.act(Action::GoTo { frame: 8 });
    assert!(seat.says("at this key"));
    seat.node(Role::SpinButton, "field of view").set_value_accesskit(40.0);
    seat.until_planned();
    let at_key = lens(&seat);
    assert_eq!(at_key[0], before[0]);
    assert_ne!(at_key[1], before[1]);
    seat.act(Action::GoTo { frame: 2 });
    assert!(seat.says("whole path"));
    seat.node(Role::SpinButton, "field of view").set_value_accesskit(30.0);
    seat.until_planned();
    let whole = lens(&seat);
    assert_ne!(whole[0], before[0]);
    assert_eq!(whole[0], whole[1]);
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
