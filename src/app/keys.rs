//! The keyboard: one table for what keys do and for the help that lists them.

use egui::{Event, InputState, Key, Modifiers};

use crate::preview::{Action, ColourMode, Direction, Layout, Overlay, PanelName, Previewer};

/// A key, when it counts, and what it does.
pub struct Shortcut {
    pub modifiers: Modifiers,
    pub key: Key,
    /// As the help shows it.
    pub name: &'static str,
    pub does: &'static str,
    action: Asked,
}

const PLAIN: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const COMMAND: Modifiers = Modifiers::COMMAND;

const fn shortcut(
    modifiers: Modifiers,
    key: Key,
    name: &'static str,
    does: &'static str,
    action: Asked,
) -> Shortcut {
    Shortcut { modifiers, key, name, does, action }
}

/// In the order of the help. Those with more modifiers come before those with fewer of one key.
pub const SHORTCUTS: [Shortcut; 34] = [
    shortcut(COMMAND, Key::O, "Ctrl O", "open", |_| Action::SetPanel {
        panel: PanelName::Files,
        open: true,
    }),
    shortcut(COMMAND.plus(SHIFT), Key::S, "Ctrl Shift S", "save as", |_| Action::SetPanel {
        panel: PanelName::SaveAs,
        open: true,
    }),
    shortcut(COMMAND, Key::S, "Ctrl S", "save the shot", |_| Action::Save),
    shortcut(COMMAND, Key::Q, "Ctrl Q", "quit", |_| Action::Quit),
    shortcut(PLAIN, Key::Space, "Space", "play or pause", |_| Action::PlayOrPause),
    shortcut(SHIFT, Key::ArrowLeft, "Shift Left", "ten frames back", |_| Action::Step { by: -10 }),
    shortcut(SHIFT, Key::ArrowRight, "Shift Right", "ten frames on", |_| Action::Step { by: 10 }),
    shortcut(PLAIN, Key::ArrowLeft, "Left", "a frame back", |_| Action::Step { by: -1 }),
    shortcut(PLAIN, Key::ArrowRight, "Right", "a frame on", |_| Action::Step { by: 1 }),
    shortcut(PLAIN, Key::Home, "Home", "start of the range", |_| Action::GoToStart),
    shortcut(PLAIN, Key::End, "End", "end of the range", |_| Action::GoToEnd),
    shortcut(PLAIN, Key::ArrowUp, "Up", "camera key before", |_| Action::GoToKey {
        direction: Direction::Back,
    }),
    shortcut(PLAIN, Key::ArrowDown, "Down", "camera key after", |_| Action::GoToKey {
        direction: Direction::Forward,
    }),
    shortcut(PLAIN, Key::I, "I", "range begins here", |p| Action::SetIn { frame: now(p) }),
    shortcut(PLAIN, Key::O, "O", "range ends here", |p| Action::SetOut { frame: now(p) }),
    shortcut(SHIFT, Key::P, "Shift P", "whole shot plays", |_| Action::ClearRange),
    shortcut(PLAIN, Key::L, "L", "loop", |p| Action::SetLooping {
        on: !p.state().playback.looping,
    }),
    shortcut(PLAIN, Key::Num1, "1", "both views", |_| Action::SetLayout { layout: Layout::Both }),
    shortcut(PLAIN, Key::Num2, "2", "shot camera alone", |_| Action::SetLayout {
        layout: Layout::Shot,
    }),
    shortcut(PLAIN, Key::Num3, "3", "witness alone", |_| Action::SetLayout {
        layout: Layout::Witness,
    }),
    shortcut(PLAIN, Key::V, "V", "next colour mode", |p| Action::SetColour {
        colour: next_colour(p.state().look.colour),
    }),
    shortcut(PLAIN, Key::W, "W", "wireframe", |p| Action::SetOverlay {
        overlay: Overlay::Wireframe,
        on: !p.state().look.wireframe,
    }),
    shortcut(PLAIN, Key::N, "N", "intersections", |p| Action::SetOverlay {
        overlay: Overlay::Intersections,
        on: !p.state().look.intersections,
    }),
    shortcut(PLAIN, Key::F, "F", "witness frames the cloth", |_| Action::FrameCloth),
    shortcut(PLAIN, Key::G, "G", "witness finds its place", |_| Action::ResetWitness),
    shortcut(PLAIN, Key::C, "C", "unlock the shot camera", |p| Action::UnlockCamera {
        on: !p.state().camera_unlocked,
    }),
    shortcut(PLAIN, Key::K, "K", "set a camera key", |_| Action::SetKey),
    shortcut(PLAIN, Key::Delete, "Delete", "delete the camera key here", |p| Action::DeleteKey {
        frame: f64::from(now(p)),
    }),
    shortcut(PLAIN, Key::S, "S", "simulate or halt", |p| Action::Simulate {
        on: p.would_simulate(),
    }),
    shortcut(PLAIN, Key::R, "R", "re-run from the start", |_| Action::ReRun),
    shortcut(COMMAND.plus(SHIFT), Key::Z, "Ctrl Shift Z", "redo", |_| Action::Redo),
    shortcut(COMMAND, Key::Y, "Ctrl Y", "redo, too", |_| Action::Redo),
    shortcut(COMMAND, Key::Z, "Ctrl Z", "undo", |_| Action::Undo),
    shortcut(PLAIN, Key::F1, "F1", "this help", |p| Action::SetPanel {
        panel: PanelName::Help,
        open: !p.state().look.help_panel,
    }),
];

/// What a key asks for: of the program as it is when its turn comes.
pub type Asked = fn(&Previewer) -> Action;

/// What the keys pressed ask for, in their order. None while a text is being typed.
pub fn pressed(input: &mut InputState) -> Vec<Asked> {
    let mut asked = Vec::new();
    input.events.retain(|event| {
        let Event::Key { key, pressed: true, modifiers, .. } = event else { return true };
        let is_it = |shortcut: &&Shortcut| {
            shortcut.key == *key && modifiers.matches_logically(shortcut.modifiers)
        };
        let found = SHORTCUTS.iter().find(is_it);
        asked.extend(found.map(|shortcut| shortcut.action));
        found.is_none()
    });
    asked
}

fn now(previewer: &Previewer) -> u32 {
    previewer.state().playback.current
}

fn next_colour(colour: ColourMode) -> ColourMode {
    let place = ColourMode::ALL.iter().position(|&c| c == colour).unwrap_or(0);
    ColourMode::ALL[(place + 1) % ColourMode::ALL.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_is_given_twice_and_more_modifiers_come_first() {
        for (i, a) in SHORTCUTS.iter().enumerate() {
            for b in &SHORTCUTS[i + 1..] {
                assert!((a.key, a.modifiers) != (b.key, b.modifiers), "{} twice", a.name);
                let is_shadowed = a.key == b.key && b.modifiers.matches_logically(a.modifiers);
                assert!(!is_shadowed, "{} takes the key from {}", a.name, b.name);
            }
        }
    }
}
