//! Presses are answered where they happen: a pass of the panels asks only where the pointer is at its
//! end, so what comes after a press waits for the next pass. Otherwise a quick drag of something small
//! would be one of whatever it ends on.

use egui::Event;

/// See the module.
#[derive(Default)]
pub struct Presses {
    /// What is left for later passes.
    waiting: Vec<Event>,
}

impl Presses {
    /// The events of the next pass: those that wait and the new ones, up to a press from which the
    /// pointer has gone on.
    pub fn take(&mut self, events: Vec<Event>) -> Vec<Event> {
        self.waiting.extend(events);
        let is_press = |event: &Event| matches!(event, Event::PointerButton { pressed: true, .. });
        let is_move = |event: &Event| matches!(event, Event::PointerMoved(_));
        let press = self.waiting.iter().position(is_press);
        let later = match press {
            Some(press) if self.waiting[press..].iter().any(is_move) => press + 1,
            _ => self.waiting.len(),
        };
        let rest = self.waiting.split_off(later);
        std::mem::replace(&mut self.waiting, rest)
    }

    /// Whether another pass is due at once.
    pub fn has_more(&self) -> bool {
        !self.waiting.is_empty()
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
    fn a_quick_drag_takes_two_passes_and_a_click_one() {
        let mut presses = Presses::default();
        let drag = vec![moved(1.0), button(1.0, true), moved(9.0), button(9.0, false)];
        assert_eq!(presses.take(drag), [moved(1.0), button(1.0, true)]);
        assert!(presses.has_more());
        assert_eq!(presses.take(vec![moved(8.0)]), [moved(9.0), button(9.0, false), moved(8.0)]);
        assert!(!presses.has_more());
        let click = vec![button(8.0, true), button(8.0, false)];
        assert_eq!(presses.take(click.clone()), click);
        assert!(!presses.has_more() && presses.take(Vec::new()).is_empty());
    }
}
