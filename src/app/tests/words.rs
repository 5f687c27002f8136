//! Help, and what the program says on its own.

use egui::Key;

use super::seat::Seat;
use crate::app::keys::SHORTCUTS;

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
