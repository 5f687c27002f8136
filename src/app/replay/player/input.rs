//! Inputs as a user would give them, a pass at a time: a press and its release are two.

use anyhow::{Result, bail};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2};

use crate::app::script::Button;

/// Moves of the pointer that make up a drag.
const MOVES: u32 = 8;

/// At a place (points).
pub(super) fn click([x, y]: [f32; 2]) -> Vec<Vec<Event>> {
    let at = pos2(x, y);
    vec![
        vec![Event::PointerMoved(at)],
        vec![button(at, PointerButton::Primary, true)],
        vec![button(at, PointerButton::Primary, false)],
    ]
}

/// From place to place (points).
pub(super) fn drag(from: [f32; 2], to: [f32; 2], with: Button) -> Vec<Vec<Event>> {
    let which = match with {
        Button::Primary => PointerButton::Primary,
        Button::Secondary => PointerButton::Secondary,
        Button::Middle => PointerButton::Middle,
    };
    let (from, to) = (pos2(from[0], from[1]), pos2(to[0], to[1]));
    let on_the_way = |k: u32| vec![Event::PointerMoved(from.lerp(to, k as f32 / MOVES as f32))];
    let mut inputs = vec![vec![Event::PointerMoved(from)], vec![button(from, which, true)]];
    inputs.extend((1..=MOVES).map(on_the_way));
    inputs.push(vec![button(to, which, false)]);
    inputs
}

/// A key by egui's name, after `Ctrl+`, `Shift+` and `Alt+` as they are held.
///
/// # Errors
/// If egui has no key of that name.
pub(super) fn press(name: &str) -> Result<Vec<Vec<Event>>> {
    let mut modifiers = Modifiers::NONE;
    let mut rest = name;
    while let Some((held, key)) = rest.split_once('+') {
        modifiers |= match held {
            "Ctrl" => Modifiers::CTRL | Modifiers::COMMAND,
            "Shift" => Modifiers::SHIFT,
            "Alt" => Modifiers::ALT,
            _ => break,
        };
        rest = key;
    }
    let Some(key) = Key::from_name(rest) else { bail!("{name:?} is no key") };
    let event = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
    Ok(vec![vec![event(true)], vec![event(false)]])
}

fn button(pos: Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}
