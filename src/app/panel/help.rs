//! Keys and pointer, listed.

use egui::Ui;

use super::floating;
use crate::app::keys::SHORTCUTS;
use crate::preview::{Action, PanelName};

/// What the pointer does, and where.
const POINTER: [(&str, &str); 9] = [
    ("drag in the witness", "orbit"),
    ("Shift drag, middle drag", "pan"),
    ("wheel", "nearer, farther"),
    ("right drag, with W A S D Q E", "look around, and fly"),
    ("the same in the shot, unlocked (C)", "moves the shot camera and sets a key"),
    ("drag the camera's eye in the witness, unlocked", "moves the shot camera and sets a key"),
    ("drag on the timeline", "scrub"),
    ("drag a diamond under it", "move a camera key"),
    ("drop a file or a run folder", "open it"),
];

pub fn show(ui: &Ui, actions: &mut Vec<Action>) {
    let mut open = true;
    floating(ui, "Help").open(&mut open).vscroll(true).default_height(460.0).show(ui.ctx(), |ui| {
        egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
            for shortcut in &SHORTCUTS {
                ui.strong(shortcut.name);
                ui.label(shortcut.does);
                ui.end_row();
            }
            for (how, does) in POINTER {
                ui.strong(how);
                ui.label(does);
                ui.end_row();
            }
        });
    });
    if !open {
        actions.push(Action::SetPanel { panel: PanelName::Help, open: false });
    }
}
