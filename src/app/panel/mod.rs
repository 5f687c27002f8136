//! The panels: each a function from what is to what the user wants.

mod bar;
mod camera;
mod costs;
mod export;
mod files;
mod help;
mod legend;
mod messages;
mod parameters;
mod room;
mod timeline;

use egui::Ui;

use super::exports::Exports;
use super::pace::Pace;
use super::preferences::Preferences;
use crate::preview::{Action, Look, PanelName, Previewer};
use crate::render::ColourBy;

pub use room::Room;

/// What panels read.
pub struct Context<'a> {
    pub previewer: &'a Previewer,
    pub exports: &'a Exports,
    pub preferences: &'a Preferences,
    pub pace: &'a Pace,
    /// What colours stand for; `None` while nothing is open.
    pub colour_by: Option<ColourBy>,
    pub room: Room,
}

/// What panels remember of themselves: texts half typed, pages open.
pub struct Panels {
    files: files::FilesPanel,
    save: files::FilesPanel,
    export: export::ExportPanel,
    parameters: parameters::ParametersPanel,
    camera: camera::CameraPanel,
    costs: costs::CostsPanel,
    /// Something had the keyboard at the end of the last pass.
    had_focus: bool,
}

impl Default for Panels {
    fn default() -> Self {
        Self {
            files: files::FilesPanel::of(files::Purpose::Open),
            save: files::FilesPanel::of(files::Purpose::SaveAs),
            export: Default::default(),
            parameters: Default::default(),
            camera: Default::default(),
            costs: Default::default(),
            had_focus: false,
        }
    }
}

impl Panels {
    /// Whether a text that is open, or will be with the next pass, asks for what is typed.
    pub fn awaits_focus(&self, look: &Look) -> bool {
        (look.files_panel && self.files.awaits_focus())
            || (look.save_panel && self.save.awaits_focus())
    }

    /// The panels around the viewports.
    pub fn show(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let look = context.previewer.state().look;
        let room = context.room;
        egui::Panel::top("bar").show(ui, |ui| bar::show(ui, context, actions));
        egui::Panel::bottom("timeline")
            .exact_size(timeline::HEIGHT)
            .show(ui, |ui| timeline::show(ui, context, actions));
        // What a small window made of their sizes does not stay when there is room again.
        let [costs, parameters] = match room.has_both() {
            true => ["costs", "parameters"],
            false => ["low costs", "narrow parameters"],
        };
        if room.shows(PanelName::Costs, &look) {
            egui::Panel::bottom(costs)
                .default_size(130.0)
                .size_range(room.costs_heights())
                .resizable(true)
                .show(ui, |ui| self.costs.show(ui, context, actions));
        }
        if room.shows(PanelName::Parameters, &look) {
            egui::Panel::right(parameters)
                .default_size(300.0)
                .size_range(room.parameters_widths())
                .resizable(true)
                .show(ui, |ui| {
                    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                        self.camera.show(ui, context, actions);
                        self.parameters.show(ui, context, actions);
                    });
                });
        }
    }

    /// What lies over the viewports: messages, help, dialogs.
    pub fn show_over_viewports(
        &mut self,
        ui: &mut Ui,
        context: &Context<'_>,
        actions: &mut Vec<Action>,
    ) {
        let look = context.previewer.state().look;
        self.leave(ui, context, actions);
        legend::show(ui, context);
        messages::show(ui, context, actions);
        if look.help_panel {
            help::show(ui, actions);
        }
        if look.files_panel {
            self.files.show(ui, context, actions);
        } else {
            self.files.rest();
        }
        if look.save_panel {
            self.save.show(ui, context, actions);
        } else {
            self.save.rest();
        }
        if look.export_panel {
            self.export.show(ui, context, actions);
        }
    }
}

impl Panels {
    /// Escape closes what lies on top, unless it is for something else: a menu, or a number being typed.
    fn leave(&mut self, ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let had_focus = std::mem::replace(
            &mut self.had_focus,
            ui.ctx().memory(|memory| memory.focused().is_some()),
        );
        let state = context.previewer.state();
        let is_pressed = ui.input(|input| input.key_pressed(egui::Key::Escape));
        if !is_pressed || state.has_question() || egui::Popup::is_any_open(ui.ctx()) {
            return;
        }
        let is_open = |panel: &PanelName| *state.look.clone().panel_mut(*panel);
        // A name that is asked for is all that can be typed there.
        let top = [PanelName::SaveAs, PanelName::Files].into_iter().find(is_open);
        let rest = [PanelName::Export, PanelName::Help].into_iter().find(is_open);
        if let Some(panel) = top.or(rest.filter(|_| !had_focus)) {
            actions.push(Action::SetPanel { panel, open: false });
        }
    }
}

/// A window over the viewports, to begin with beside where messages stand.
fn floating(ui: &Ui, title: &'static str) -> egui::Window<'static> {
    let views = ui.max_rect();
    egui::Window::new(title)
        .constrain_to(views)
        .default_pos(views.center_top() + egui::vec2(0.0, 8.0))
}
