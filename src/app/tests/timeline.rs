//! The timeline's buttons and keys.

use egui::Key;

use super::seat::Seat;
use crate::preview::Playback;
use crate::preview::stage::LAST;

fn playback(seat: &Seat) -> Playback {
    seat.previewer().state().playback
}

#[test]
fn buttons_step_and_go_to_ends_and_keys() {
    let mut seat = Seat::take_simulated();
    for (button, frame) in
        [(">", 1), (">", 2), ("<", 1), ("K>", 4), ("K>", 8), ("<K", 4), (">|", LAST), ("|<", 0)]
    {
        seat.click(button);
        assert_eq!(seat.current(), frame, "after {button}");
        assert!(seat.previewer().shown().is_some_and(|shown| shown.number == frame));
    }
}

#[test]
fn the_range_begins_and_ends_where_it_is_told_to() {
    let mut seat = Seat::take();
    let range = |seat: &Seat| (playback(seat).first, playback(seat).last);
    seat.click("K>");
    seat.click("In");
    seat.click("K>");
    seat.click("Out");
    assert_eq!(range(&seat), (4, 8));
    assert!(seat.mentions("8   [4 - 8]   24 fps"));
    seat.click("|<");
    assert_eq!(seat.current(), 4);
    seat.click("All");
    assert_eq!(range(&seat), (0, LAST));
}

#[test]
fn loop_and_play_say_what_they_do() {
    let mut seat = Seat::take_simulated();
    assert!(playback(&seat).looping);
    seat.click("Loop");
    assert!(!playback(&seat).looping);
    seat.click("Play");
    seat.until("the end", |p| p.state().playback.current == LAST && !p.state().playback.playing);
    assert!(seat.is_offered("Play") && !seat.is_offered("Pause"));
}

#[test]
fn keys_do_the_same() {
    let mut seat = Seat::take();
    for (key, frame) in
        [(Key::ArrowRight, 1), (Key::ArrowDown, 4), (Key::ArrowLeft, 3), (Key::End, LAST)]
    {
        seat.press(key);
        assert_eq!(seat.current(), frame, "after {key:?}");
    }
    seat.press(Key::O);
    seat.press(Key::Home);
    seat.press(Key::L);
    let Playback { current, looping, last, .. } = playback(&seat);
    assert_eq!((current, looping, last), (0, false, LAST));
}

#[test]
fn keys_of_one_pass_are_done_in_their_order() {
    let mut seat = Seat::take();
    seat.press_all(&[Key::ArrowRight, Key::ArrowRight, Key::I, Key::ArrowRight, Key::O]);
    let Playback { current, first, last, .. } = playback(&seat);
    assert_eq!((first, last, current), (2, 3, 3));
}
