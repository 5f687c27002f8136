//! Presses are answered where they happen: a pass of the panels asks only where the pointer is, and
//! whether it is down, at its end. So a quick drag that is over before the next redraw is told in parts;
//! otherwise it would be lost, or be one of whatever it ends on.

use egui::Event;

/// See the module.
#[derive(Default)]
pub struct Presses {
    /// What is left for later passes.
    waiting: Vec<Event>,
    /// Passes in a row in which what was typed had to wait.
    held: u32,
}

/// Whether what is typed has somebody to go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typing {
    Goes,
    /// A text that asks for it is not there yet.
    Waits,
}

/// So many passes what is typed waits at the most.
const HELD_MAX: u32 = 10;

impl Presses {
    /// The events of the next pass, of those that wait and the new ones: a press, the way from it, the
    /// release and the way from there are for passes of their own, and so is what is typed before a
    /// press, after it, or after a key with Ctrl.
    pub fn take(&mut self, events: Vec<Event>, typing: Typing) -> Vec<Event> {
        self.waiting.extend(events);
        let waits = typing == Typing::Waits && self.held < HELD_MAX;
        let mut before = Before { has_command: waits, ..Before::default() };
        let end = self.waiting.iter().position(|event| before.is_for_later(event));
        let end = end.unwrap_or(self.waiting.len());
        let rest = self.waiting.split_off(end);
        self.held = if waits && !rest.is_empty() { self.held + 1 } else { 0 };
        std::mem::replace(&mut self.waiting, rest)
    }

    /// Whether another pass is due at once.
    pub fn has_more(&self) -> bool {
        !self.waiting.is_empty()
    }
}

/// What a pass has got already.
#[derive(Default)]
struct Before {
    has_button: bool,
    /// Since the last press.
    has_moved: bool,
    has_typed: bool,
    /// Which may open a window that takes what is typed then.
    has_command: bool,
}

impl Before {
    /// Whether an event must wait for the next pass; otherwise it is one of this.
    fn is_for_later(&mut self, event: &Event) -> bool {
        match event {
            Event::PointerButton { pressed: true, .. } => {
                let is_later = self.has_typed;
                (self.has_button, self.has_moved) = (true, false);
                is_later
            }
            Event::PointerButton { pressed: false, .. } => {
                self.has_button = true;
                self.has_moved
            }
            Event::PointerMoved(_) => {
                self.has_moved = true;
                self.has_button
            }
            Event::Key { pressed: true, modifiers, .. } if modifiers.command => {
                (self.has_typed, self.has_command) = (true, true);
                self.has_button
            }
            Event::Text(_) | Event::Paste(_) | Event::Key { pressed: true, .. } => {
                self.has_typed = true;
                self.has_button || self.has_command
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use egui::{Modifiers, PointerButton, pos2};

    use super::*;

    fn button(x: f32, pressed: bool) -> Event {
        let (pos, button) = (pos2(x, 0.0), PointerButton::Primary);
        Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
    }

    fn moved(x: f32) -> Event {
        Event::PointerMoved(pos2(x, 0.0))
    }

    fn take(presses: &mut Presses, events: Vec<Event>) -> Vec<Event> {
        presses.take(events, Typing::Goes)
    }

    #[test]
    fn what_is_typed_waits_for_a_text_that_is_about_to_be_there_but_not_for_ever() {
        let mut presses = Presses::default();
        let text = Event::Text("a".to_owned());
        assert_eq!(presses.take(vec![moved(1.0), text.clone()], Typing::Waits), [moved(1.0)]);
        for _ in 1..HELD_MAX {
            assert!(presses.take(Vec::new(), Typing::Waits).is_empty() && presses.has_more());
        }
        let goes = presses.take(Vec::new(), Typing::Waits);
        assert_eq!(goes, vec![text.clone()]);
        assert!(presses.take(vec![text.clone()], Typing::Waits).is_empty());
        assert_eq!(presses.take(Vec::new(), Typing::Goes), [text]);
    }

    #[test]
    fn a_quick_drag_takes_three_passes_and_a_click_one() {
        let mut presses = Presses::default();
        let drag = vec![moved(1.0), button(1.0, true), moved(8.0), moved(9.0), button(9.0, false)];
        assert_eq!(take(&mut presses, drag), [moved(1.0), button(1.0, true)]);
        assert!(presses.has_more());
        assert_eq!(take(&mut presses, Vec::new()), [moved(8.0), moved(9.0)]);
        // The pointer is where it was let go when that is answered.
        assert_eq!(take(&mut presses, vec![moved(7.0)]), [button(9.0, false)]);
        assert_eq!(take(&mut presses, Vec::new()), [moved(7.0)]);
        assert!(!presses.has_more());
        let click = vec![moved(8.0), button(8.0, true), button(8.0, false)];
        assert_eq!(take(&mut presses, click.clone()), click);
        assert!(!presses.has_more() && take(&mut presses, Vec::new()).is_empty());
    }

    #[test]
    fn what_is_typed_before_a_press_is_taken_before_it() {
        let mut presses = Presses::default();
        let text = Event::Text("a".to_owned());
        let typed = take(&mut presses, vec![text.clone(), button(1.0, true)]);
        assert_eq!(typed, vec![text.clone()]);
        let click = [button(1.0, true), button(1.0, false)];
        let rest = vec![button(1.0, false), text.clone()];
        assert_eq!(take(&mut presses, rest), click);
        assert_eq!(take(&mut presses, Vec::new()), [text]);
    }

    #[test]
    fn what_is_typed_after_a_key_that_opens_a_window_is_for_the_window() {
        let key = |key, modifiers| Event::Key {
            key,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        };
        let open = key(egui::Key::O, Modifiers::COMMAND);
        let (a, text) = (key(egui::Key::A, Modifiers::NONE), Event::Text("a".to_owned()));
        let mut presses = Presses::default();
        let typed = vec![open.clone(), open.clone(), a.clone(), text.clone()];
        assert_eq!(take(&mut presses, typed), [open.clone(), open]);
        assert_eq!(take(&mut presses, Vec::new()), [a, text]);
    }

    #[test]
    fn no_event_is_lost_whatever_the_order() {
        let text = Event::Text("a".to_owned());
        let events = [text, button(1.0, false), button(2.0, true), button(3.0, true), moved(4.0)];
        let events: Vec<Event> = events.iter().cycle().take(23).cloned().collect();
        let mut presses = Presses::default();
        let mut taken = take(&mut presses, events.clone());
        for _ in 0..events.len() {
            taken.extend(take(&mut presses, Vec::new()));
        }
        assert_eq!(taken, events);
    }
}
