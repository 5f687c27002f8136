//! What went wrong or needs a word, files that have changed on disk, an export under way, and questions.

use egui::{Align2, RichText, Ui, vec2};

use super::Context;
use crate::app::export::ExportState;
use crate::app::theme;
use crate::preview::{Action, Level, Source};

/// Messages shown at a time; the others wait behind them.
const SHOWN: usize = 5;
/// Room for the views' captions (points).
const ABOVE_CAPTIONS: f32 = 28.0;

/// Of their texts (points).
const WIDTH_MAX: f32 = 460.0;

pub fn show(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let area = egui::Area::new(egui::Id::unique("messages"))
        // What is opened stands elsewhere; what was moved over them must not hide them.
        .order(egui::Order::Foreground)
        .pivot(Align2::LEFT_BOTTOM)
        .constrain_to(ui.max_rect())
        .fixed_pos(ui.max_rect().left_bottom() + vec2(10.0, -ABOVE_CAPTIONS));
    area.show(ui.ctx(), |ui| {
        said(ui, context, actions);
        changed_files(ui, context, actions);
        export(ui, context, actions);
    });
    unsaved(ui, context, actions);
    overwriting(ui, context, actions);
}

/// The newest last.
fn said(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let messages = &context.previewer.state().messages;
    let hidden = messages.len().saturating_sub(SHOWN);
    if messages.len() > 1 {
        let name = match hidden {
            0 => "dismiss all".to_owned(),
            more => format!("dismiss all ({more} more)"),
        };
        if ui.small_button(name).clicked() {
            actions.push(Action::DismissAll);
        }
    }
    for message in messages.iter().skip(hidden) {
        card(ui, |ui| {
            if ui.small_button("x").on_hover_text("dismiss").clicked() {
                actions.push(Action::DismissMessage { text: message.text.clone() });
            }
            let text = RichText::new(&message.text).color(theme::level_colour(message.level));
            ui.add(egui::Label::new(text).wrap().selectable(true));
        });
    }
}

/// Something with a word in it, on one line if it fits.
fn card(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    egui::Frame::popup(ui.style()).show(ui, |ui| {
        ui.set_max_width(WIDTH_MAX);
        ui.horizontal(content);
    });
}

fn changed_files(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let changed = context.previewer.changed_files();
    let Some(first) = changed.first() else { return };
    card(ui, |ui| {
        let others = changed.len() - 1;
        let more = if others > 0 { format!(" and {others} more") } else { String::new() };
        let name = first.file_name().unwrap_or(first.as_os_str()).to_string_lossy();
        let words = format!("{name}{more} changed on disk");
        let text = RichText::new(words).color(theme::level_colour(Level::Warning));
        ui.label(text).on_hover_text(first.display().to_string());
        if ui.button("Reload").clicked() {
            actions.push(Action::Reload);
        }
        if ui.button("Not now").clicked() {
            actions.push(Action::IgnoreChanges);
        }
    });
}

fn export(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let Some(progress) = context.exports.progress() else { return };
    if progress.state != ExportState::Running {
        return;
    }
    card(ui, |ui| {
        ui.label("exporting");
        let share = progress.done as f32 / progress.total.max(1) as f32;
        let text = format!("{} of {}", progress.done, progress.total);
        ui.add(egui::ProgressBar::new(share).desired_width(200.0).text(text));
        if ui.button("Cancel").clicked() {
            actions.push(Action::CancelExport);
        }
    });
}

/// Before changed settings are lost.
fn unsaved(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let previewer = context.previewer;
    let Some(next) = &previewer.state().unsaved else { return };
    let name = previewer.scenery().map_or("the shot", |scenery| &scenery.name);
    let what = match next {
        Action::Quit => "Quitting",
        _ => "Opening something else",
    };
    let words = format!("{what} gives up the changed settings of {name}, which are not saved.");
    let can_save = matches!(previewer.source(), Source::Shot(request) if request.shot.is_some());
    let is_left = question(ui, "unsaved", &words, |ui| {
        let save = ui.add_enabled(can_save, egui::Button::new("Save first"));
        if save.on_disabled_hover_text("Save as first, under a name").clicked() {
            actions.push(Action::SaveFirst);
        }
        if ui.button("Give them up").clicked() {
            actions.push(Action::GiveUpEdits { yes: true });
        }
        ui.button("Go back").clicked()
    });
    if is_left {
        actions.push(Action::GiveUpEdits { yes: false });
    }
}

/// Before files are written over.
fn overwriting(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let Some(asked) = &context.previewer.state().overwriting else { return };
    let is_left = question(ui, "overwriting", &asked.what, |ui| {
        if ui.button("Write over").clicked() {
            actions.push(Action::WriteOver { yes: true });
        }
        ui.button("Go back").clicked()
    });
    if is_left {
        actions.push(Action::WriteOver { yes: false });
    }
}

/// In the middle, before anything else can be done. True if the user goes back: by the button, by Escape
/// or by a click elsewhere.
fn question(
    ui: &Ui,
    name: &'static str,
    words: &str,
    answers: impl FnOnce(&mut Ui) -> bool,
) -> bool {
    let shown = egui::Modal::new(egui::Id::unique(name)).show(ui.ctx(), |ui| {
        ui.set_max_width(WIDTH_MAX);
        ui.label(words);
        ui.add_space(6.0);
        ui.horizontal(answers).inner
    });
    shown.inner || shown.should_close()
}
