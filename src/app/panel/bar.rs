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
        ui.spacing_mut().item_spacing.x = 5.0;
        match context.room.is_narrow() {
            true => menus(ui, context, &mut wish),
            false => groups(ui, context, &mut wish),
        }
        ui.separator();
        panels(ui, context, &mut wish);
        badge(ui, context);
    });
}

fn groups(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    MenuButton::new("File").ui(ui, |ui| files(ui, context, wish));
    writing(ui, context, wish);
    ui.separator();
    layouts(ui, context, wish);
    colours(ui, context, wish);
    lasting_menu("Show").ui(ui, |ui| overlays(ui, context, wish));
    ui.separator();
    if context.previewer.scenery().is_some() {
        simulation(ui, context, wish);
        ui.separator();
    }
    versions(ui, context, wish);
}

/// The same where there is no room for it on one line.
fn menus(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    MenuButton::new("File").ui(ui, |ui| {
        writing(ui, context, wish);
        ui.separator();
        files(ui, context, wish);
    });
    lasting_menu("Show").ui(ui, |ui| {
        layouts(ui, context, wish);
        ui.separator();
        overlays(ui, context, wish);
    });
    colours(ui, context, wish);
    MenuButton::new("Run").ui(ui, |ui| simulation(ui, context, wish));
    MenuButton::new("Edit").ui(ui, |ui| versions(ui, context, wish));
}

/// A menu in which several things can be switched.
fn lasting_menu(name: &'static str) -> MenuButton<'static> {
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    MenuButton::new(name).config(stays)
}

fn files(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let open = |panel| Action::SetPanel { panel, open: true };
    let (is_open, is_shot) =
        (context.previewer.scenery().is_some(), context.previewer.plan().is_some());
    for (name, hint, is_possible, action) in [
        (
            "Open ...",
            "a shot, an ARCSim scene or a run folder (Ctrl O)",
            true,
            open(PanelName::Files),
        ),
        (
            "Save as ...",
            "the shot under another name (Ctrl Shift S)",
            is_shot,
            open(PanelName::SaveAs),
        ),
        ("Own shot", "the shot that comes with the program", true, Action::OpenOwn),
        (
            "Reload",
            "all files are read again; changed settings go on to hold",
            is_open,
            Action::Reload,
        ),
        ("Quit", "Ctrl Q", true, Action::Quit),
    ] {
        if ui.add_enabled(is_possible, Button::new(name)).on_hover_text(hint).clicked() {
            wish(action);
        }
    }
}

fn writing(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let save = ui.add_enabled(context.previewer.has_unsaved_edits(), Button::new("Save"));
    if save.on_hover_text("the changed settings into the shot's file (Ctrl S)").clicked() {
        wish(Action::Save);
    }
    let export = ui.add_enabled(context.previewer.scenery().is_some(), Button::new("Export"));
    if export.on_hover_text("stills, sheets, pictures, video, a run").clicked() {
        wish(Action::SetPanel { panel: PanelName::Export, open: true });
    }
}

fn layouts(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
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
}

fn colours(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let now = context.previewer.state().look.colour;
    let chosen = egui::ComboBox::from_id_salt("colour").selected_text(now.label());
    let list = chosen.show_ui(ui, |ui| {
        for colour in ColourMode::ALL {
            if ui.selectable_label(now == colour, colour.label()).clicked() {
                wish(Action::SetColour { colour });
            }
        }
    });
    list.response.on_hover_text("what the colour of the cloth shows (V)");
}

fn overlays(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let look = context.previewer.state().look;
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
        if previewer.scenery().is_some() {
            ui.label(RichText::new("finished run").color(theme::FAINT));
        }
        return;
    }
    let on = previewer.state().simulating;
    let hint = "simulate frames that are missing (S)";
    if ui.selectable_label(on, "Simulate").on_hover_text(hint).clicked() {
        wish(Action::Simulate { on: previewer.would_simulate() });
    }
    let hint = "everything from the start with these settings (R)";
    if ui.button("Re-run").on_hover_text(hint).clicked() {
        wish(Action::ReRun);
    }
    reach(ui, previewer.state().reach, wish);
}

/// From where a changed setting holds.
fn reach(ui: &mut Ui, now: Reach, wish: &mut impl FnMut(Action)) {
    /// As wide as the longer of its two names (points): what is beside it stays where it is.
    const WIDTH: f32 = 115.5;
    const NAMES: [(Reach, &str); 2] =
        [(Reach::FromHere, "from here"), (Reach::FromStart, "from the start")];
    let name = NAMES.iter().find(|(reach, _)| *reach == now).map_or("", |(_, name)| name);
    let chosen = egui::ComboBox::from_id_salt("reach").selected_text(name).width(WIDTH);
    let list = chosen.show_ui(ui, |ui| {
        for (reach, name) in NAMES {
            if ui.selectable_label(now == reach, name).clicked() {
                wish(Action::SetReach { reach });
            }
        }
    });
    list.response.on_hover_text(
        "whether a changed setting holds from the current frame on or from the start; camera edits \
         always reach just the frames that can see them",
    );
}

/// Whether what is there is what a clean run gives. Its place is kept free for it.
fn badge(ui: &mut Ui, context: &Context<'_>) {
    let timeline = context.previewer.timeline();
    let has = |wanted| (0..timeline.len() as u32).any(|frame| timeline.status(frame) == wanted);
    let badge = RichText::new("MIXED").color(theme::status_colour(FrameStatus::Mixed)).strong();
    let is_mixed = has(FrameStatus::Mixed) || has(FrameStatus::Stale);
    ui.add_visible(is_mixed, egui::Label::new(badge))
        .on_hover_text("frames were made with different settings: Re-run for a clean run");
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
    let keep = ui.add_enabled(context.previewer.scenery().is_some(), Button::new("Keep as A"));
    if keep.on_hover_text(hint).clicked() {
        wish(Action::KeepAsA);
    }
    // Without an A they are there and cannot be used, so that nothing jumps when there is one.
    let hint = match &state.a {
        Some(a) => format!("A: settings {}", short(&a.settings_hash)),
        None => "nothing is kept as A yet".to_owned(),
    };
    let is_wiping = state.wipe.is_some();
    let compare = ui.add_enabled(state.a.is_some(), Button::selectable(is_wiping, "A | B"));
    if compare.on_hover_text(&hint).on_disabled_hover_text(&hint).clicked() {
        wish(Action::Compare { wipe: (!is_wiping).then_some(0.5) });
    }
    let swap = ui.add_enabled(state.a.is_some(), Button::new("Swap"));
    if swap.on_hover_text("A comes into force").on_disabled_hover_text(&hint).clicked() {
        wish(Action::SwapAAndB);
    }
}

fn panels(ui: &mut Ui, context: &Context<'_>, wish: &mut impl FnMut(Action)) {
    let look = context.previewer.state().look;
    for (panel, name) in [
        (PanelName::Parameters, "Settings"),
        (PanelName::Costs, "Costs"),
        (PanelName::Help, "Help"),
    ] {
        let is_shown = context.room.shows(panel, &look);
        if ui.selectable_label(is_shown, name).clicked() {
            wish(Action::SetPanel { panel, open: !is_shown });
            if let Some(other) = context.room.yields_to(panel).filter(|_| !is_shown) {
                wish(Action::SetPanel { panel: other, open: false });
            }
        }
    }
}
