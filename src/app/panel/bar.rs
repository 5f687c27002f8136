//! The bar on top: files, views, colours, the simulation, undo, comparison.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, DragValue, PopupCloseBehavior, RichText, Ui};

use super::Context;
use crate::app::theme;
use crate::app::viewport::short;
use crate::preview::{Action, ColourMode, FrameStatus, Layout, Overlay, PanelName, Reach};

pub fn show(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let mut wish = |action| actions.push(action);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        files(ui, context, &mut wish);
        ui.separator();
        views(ui, context, &mut wish);
        ui.separator();
        simulation(ui, context, &mut wish);
        ui.separator();
        versions(ui, context, &mut wish);
        ui.separator();
        panels(ui, context, &mut wish);
    });
}

fn files(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let open = |panel| Action::SetPanel { panel, open: true };
    if ui.button("Open").on_hover_text("a shot, an ARCSim scene or a run folder (Ctrl O)").clicked()
    {
        wish(open(PanelName::Files));
    }
    let has_edits = !context.previewer.state().version.edits.is_empty();
    let save = ui.add_enabled(has_edits, Button::new("Save"));
    if save.on_hover_text("the changed settings into the shot's file (Ctrl S)").clicked() {
        wish(Action::Save);
    }
    if ui.button("Export").on_hover_text("stills, sheets, pictures, video, a run").clicked() {
        wish(open(PanelName::Export));
    }
}

fn views(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let look = context.previewer.state().look;
    for (layout, name, hint) in [
        (Layout::Both, "Both", "shot camera and witness (1)"),
        (Layout::Shot, "Shot", "the shot camera alone (2)"),
        (Layout::Witness, "Witness", "the witness alone (3)"),
    ] {
        if ui.selectable_label(look.layout == layout, name).on_hover_text(hint).clicked() {
            wish(Action::SetLayout { layout });
        }
    }
    egui::ComboBox::from_id_salt("colour").selected_text(look.colour.label()).show_ui(ui, |ui| {
        for colour in ColourMode::ALL {
            if ui.selectable_label(look.colour == colour, colour.label()).clicked() {
                wish(Action::SetColour { colour });
            }
        }
    });
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    MenuButton::new("Show").config(stays).ui(ui, |ui| {
        for (overlay, on, name) in [
            (Overlay::Wireframe, look.wireframe, "wireframe"),
            (Overlay::Legend, look.legend, "legend"),
            (Overlay::Intersections, look.intersections, "intersections"),
            (Overlay::SafeAreas, look.safe_areas, "safe areas"),
            (Overlay::Ghost, look.ghost, "frustum at the end of the look-ahead"),
            (Overlay::Ground, look.ground, "ground"),
        ] {
            let mut now = on;
            if ui.checkbox(&mut now, name).changed() {
                wish(Action::SetOverlay { overlay, on: now });
            }
        }
        ui.separator();
        preferences(ui, context, wish);
    });
}

/// Size of text and controls, and memory for frames.
fn preferences(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    ui.horizontal(|ui| {
        ui.label("text size");
        for percent in [75, 100, 125, 150, 200] {
            let scale = percent as f32 / 100.0;
            let is_now = (context.preferences.scale - scale).abs() < 1e-3;
            if ui.selectable_label(is_now, format!("{percent} %")).clicked() {
                wish(Action::SetScale { scale });
            }
        }
    });
    let mut megabytes = context.previewer.store().budget() >> 20;
    let field = DragValue::new(&mut megabytes).range(64..=65536).prefix("memory ").suffix(" MB");
    let hint = "for frames; those beyond it are read from disk";
    if ui.add(field.update_while_editing(false)).on_hover_text(hint).changed() {
        wish(Action::SetMemory { megabytes });
    }
}

fn simulation(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let previewer = context.previewer;
    if previewer.plan().is_none() {
        let words = if previewer.scenery().is_some() { "finished run" } else { "" };
        ui.label(RichText::new(words).color(theme::FAINT));
        return;
    }
    let on = previewer.state().simulating;
    let hint = "simulate frames that are missing (S)";
    if ui.selectable_label(on, "Simulate").on_hover_text(hint).clicked() {
        wish(Action::Simulate { on: !on });
    }
    let hint = "everything from the start with these settings (R)";
    if ui.button("Re-run").on_hover_text(hint).clicked() {
        wish(Action::ReRun);
    }
    let reach = previewer.state().reach;
    let (name, other) = match reach {
        Reach::FromHere => ("changes from here", Reach::FromStart),
        Reach::FromStart => ("changes from the start", Reach::FromHere),
    };
    let hint = "whether a changed setting holds from the current frame on or from the start; camera \
                edits always reach just the frames that can see them";
    if ui.button(name).on_hover_text(hint).clicked() {
        wish(Action::SetReach { reach: other });
    }
    badge(ui, context);
}

/// Whether what is there is what a clean run gives.
fn badge(ui: &mut Ui, context: &Context<'_>) {
    let timeline = context.previewer.timeline();
    let has = |wanted| (0..timeline.len() as u32).any(|frame| timeline.status(frame) == wanted);
    if has(FrameStatus::Mixed) || has(FrameStatus::Stale) {
        let badge = RichText::new("MIXED").color(theme::status_colour(FrameStatus::Mixed)).strong();
        ui.label(badge)
            .on_hover_text("frames were made with different settings: Re-run for a clean run");
    }
}

fn versions(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let state = context.previewer.state();
    let undo = ui.add_enabled(state.history.can_undo(), Button::new("Undo"));
    if undo.on_hover_text("Ctrl Z").clicked() {
        wish(Action::Undo);
    }
    let redo = ui.add_enabled(state.history.can_redo(), Button::new("Redo"));
    if redo.on_hover_text("Ctrl Shift Z").clicked() {
        wish(Action::Redo);
    }
    let hint = "remember frames and settings as A, to compare what comes with";
    if ui.button("Keep as A").on_hover_text(hint).clicked() {
        wish(Action::KeepAsA);
    }
    let Some(a) = &state.a else { return };
    let is_wiping = state.wipe.is_some();
    let hint = format!("A: settings {}", short(&a.settings_hash));
    if ui.selectable_label(is_wiping, "A | B").on_hover_text(hint).clicked() {
        wish(Action::Compare { wipe: (!is_wiping).then_some(0.5) });
    }
    if ui.button("Swap").on_hover_text("A comes into force").clicked() {
        wish(Action::SwapAAndB);
    }
}

fn panels(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let look = context.previewer.state().look;
    for (panel, open, name) in [
        (PanelName::Parameters, look.parameters_panel, "Settings"),
        (PanelName::Costs, look.cost_panel, "Costs"),
        (PanelName::Help, look.help_panel, "Help"),
    ] {
        if ui.selectable_label(open, name).clicked() {
            wish(Action::SetPanel { panel, open: !open });
        }
    }
}
