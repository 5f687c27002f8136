//! Small windows, large text, and what must not jump.

use egui::Rect;
use egui::accesskit::Role;

use super::seat::{Seat, Setting};
use crate::preview::stage::windy;
use crate::preview::{Action, FrameStatus, PanelName, Reach};

/// What a window of 1280 x 720 pixels has at twice the size of text (points).
const LARGE_TEXT: [f32; 2] = [640.0, 360.0];

fn share_of_views(seat: &Seat, [width, height]: [f32; 2]) -> f32 {
    seat.views().area() / (width * height)
}

#[test]
fn views_keep_half_of_a_window_at_every_size_of_text_with_either_panel() {
    for percent in [75, 100, 125, 150, 200] {
        let size = [1280.0, 720.0].map(|pixels: f32| pixels * 100.0 / percent as f32);
        let mut seat = Seat::take_with(Setting { size, ..Setting::default() });
        let with_settings = share_of_views(&seat, size);
        assert!(with_settings >= 0.5, "{percent} %: {with_settings}");
        seat.act(Action::SetPanel { panel: PanelName::Parameters, open: false });
        let with_costs = share_of_views(&seat, size);
        assert!(with_costs >= 0.5, "{percent} %: {with_costs}");
    }
}

#[test]
fn where_there_is_room_for_one_panel_one_gives_way_to_the_other() {
    let mut seat = Seat::take_with(Setting { size: LARGE_TEXT, ..Setting::default() });
    assert!(seat.says("Reset all") && !seat.says("stages"));
    seat.click("Costs");
    assert!(!seat.says("Reset all") && seat.says("stages"));
    // Content that is too high would be pushed out at the top.
    let quantities = seat.node(Role::Button, "stages").rect();
    assert!(quantities.top() >= seat.views().bottom(), "{quantities:?}");
    seat.click("Settings");
    assert!(seat.says("Reset all") && !seat.says("stages"));
    seat.click("Settings");
    assert!(!seat.says("Reset all") && !seat.says("stages"));
}

#[test]
fn in_a_narrow_window_everything_of_the_bar_is_in_menus() {
    let mut seat = Seat::take_with(Setting { size: LARGE_TEXT, ..Setting::default() });
    for (menu, inside) in
        [("File", "Export"), ("Show", "Witness"), ("Run", "Re-run"), ("Edit", "Keep as A")]
    {
        assert!(!seat.is_offered(inside));
        seat.click(menu);
        assert!(seat.is_offered(inside), "{inside} is not in {menu}");
        seat.press(egui::Key::Escape);
    }
    seat.click("Edit");
    seat.click("Keep as A");
    assert!(seat.previewer().state().a.is_some());
}

#[test]
fn settings_fit_into_a_narrow_panel() {
    let mut seat = Seat::take_with(Setting { size: LARGE_TEXT, ..Setting::default() });
    seat.unfold("Time and air");
    // Content that is too wide is pushed out to the left.
    let title = seat.node(Role::Label, "Settings").rect();
    assert!(title.left() >= seat.views().right() + 4.0, "{title:?}");
}

#[test]
fn nothing_in_the_bar_jumps_when_there_is_an_a_or_another_reach() {
    let mut seat = Seat::take_simulated();
    let names = ["File", "Re-run", "Undo", "Keep as A", "A | B", "Swap", "Settings", "Help"];
    let places = |seat: &Seat| names.map(|name| seat.node(Role::Button, name).rect());
    let before = places(&seat);
    let is_on_one_line = |a: &Rect| (a.center().y - before[0].center().y).abs() < 1.0;
    assert!(before.iter().all(is_on_one_line), "{before:?}");
    assert!(!seat.is_offered("A | B") && !seat.is_offered("Swap"));
    let views = seat.views();
    seat.click("Keep as A");
    assert!(seat.is_offered("A | B") && seat.is_offered("Swap"));
    seat.act(Action::SetReach { reach: Reach::FromStart });
    seat.click("A | B");
    assert_eq!((places(&seat), seat.views()), (before, views));
    seat.act(Action::SetReach { reach: Reach::FromHere });
    seat.act(Action::GoTo { frame: 6 });
    assert!(!seat.says("MIXED"));
    seat.act(windy(3.0));
    seat.until("a mixed frame", |p| p.timeline().status(7) == FrameStatus::Mixed);
    assert!(is_on_one_line(&seat.node(Role::Label, "MIXED").rect()));
    assert_eq!((places(&seat), seat.views()), (before, views));
}
