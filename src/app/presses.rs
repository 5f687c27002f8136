//! Presses are answered where they happen: a pass of the panels asks only where the pointer is, and
//! whether it is down, at its end. So a quick drag that is over before the next redraw is told in parts;
//! otherwise it would be lost, or be one of whatever it ends on.

use egui::Event;

/// See the module.
#[derive(Default)]
pub struct Presses {
    /// What is left for later passes.
    waiting: Vec<Event>,
}

impl Presses {
    /// The events of the next pass, of those that wait and the new ones: a press, the way from it, the
    /// release and the way from there are for passes of their own, and so is what is typed before a
    /// press, after it, or after a key with Ctrl.
    pub fn take(&mut self, events: Vec<Event>) -> Vec<Event> {
        self.waiting.extend(events);
        let mut before = Before::default();
        let end = self.waiting.iter().position(|event| before.is_for_later(event));
        let end = end.unwrap_or(self.waiting.len());
        let rest = self.waiting.split_off(end);
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

    #[test]
    fn a_quick_drag_takes_three_passes_and_a_click_one() {
        let mut presses = Presses::default();
        let drag = vec![moved(1.0), button(1.0, true), moved(8.0), moved(9.0), button(9.0, false)];
        assert_eq!(presses.take(drag), [moved(1.0), button(1.0, true)]);
        assert!(presses.has_more());
        assert_eq!(presses.take(Vec::new()), [moved(8.0), moved(9.0)]);
        // The pointer is where it was let go when that is answered.
        assert_eq!(presses.take(vec![moved(7.0)]), [button(9.0, false)]);
        assert_eq!(presses.take(Vec::new()), [moved(7.0)]);
        assert!(!presses.has_more());
        let click = vec![moved(8.0), button(8.0, true), button(8.0, false)];
        assert_eq!(presses.take(click.clone()), click);
        assert!(!presses.has_more() && presses.take(Vec::new()).is_empty());
    }

    #[test]
    fn what_is_typed_before_a_press_is_taken_before_it() {
        let mut presses = Presses::default();
        let text = Event::Text("a".to_owned());
        let typed = presses.take(vec![text.clone(), button(1.0, true)]);
        assert_eq!(typed, vec![text.clone()]);
        let click = [button(1.0, true), button(1.0, false)];
        let rest = vec![button(1.0, false), text.clone()];
        assert_eq!(presses.take(rest), click);
        assert_eq!(presses.take(Vec::new()), [text]);
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
        assert_eq!(presses.take(typed), [open.clone(), open]);
        assert_eq!(presses.take(Vec::new()), [a, text]);
    }

    #[test]
    fn no_event_is_lost_whatever_the_order() {
        let text = Event::Text("a".to_owned());
        let events = [text, button(1.0, false), button(2.0, true), button(3.0, true), moved(4.0)];
        let events: Vec<Event> = events.iter().cycle().take(23).cloned().collect();
        let mut presses = Presses::default();
        let mut taken = presses.take(events.clone());
        for _ in 0..events.len() {
            taken.extend(presses.take(Vec::new()));
        }
        assert_eq!(taken, events);
    }
}
