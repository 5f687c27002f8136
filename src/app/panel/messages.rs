//! What went wrong or needs a word, and files that have changed on disk.

use egui::{Align2, RichText, Ui, vec2};

use super::Context;
use crate::app::export::ExportState;
use crate::app::theme;
use crate::preview::Action;

/// Messages shown at a time; the others wait behind them.
const SHOWN: usize = 5;

pub fn show(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    changed_files(ui, context, actions);
    unsaved(ui, context, actions);
    overwriting(ui, context, actions);
    export(ui, context, actions);
    legend(ui, context);
    let messages = &context.previewer.state().messages;
    if messages.is_empty() {
        return;
    }
    let area = egui::Area::new(egui::Id::unique("messages"))
        .anchor(Align2::LEFT_TOP, vec2(10.0, 10.0) + ui.max_rect().min.to_vec2());
    area.show(ui.ctx(), |ui| {
        for (index, message) in messages.iter().enumerate().rev().take(SHOWN) {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(460.0);
                ui.horizontal(|ui| {
                    if ui.small_button("x").on_hover_text("dismiss").clicked() {
                        actions.push(Action::DismissMessage { index });
                    }
                    let text =
                        RichText::new(&message.text).color(theme::level_colour(message.level));
                    ui.add(egui::Label::new(text).wrap());
                });
            });
        }
    });
}

fn changed_files(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let changed = context.previewer.changed_files();
    let Some(first) = changed.first() else { return };
    dialog(ui, "Changed on disk").show(ui.ctx(), |ui| {
        let others = changed.len() - 1;
        let more = if others > 0 { format!(" and {others} more") } else { String::new() };
        ui.label(format!("{}{more}", first.display()));
        ui.horizontal(|ui| {
            if ui.button("Reload").clicked() {
                actions.push(Action::Reload);
            }
            if ui.button("Not now").clicked() {
                actions.push(Action::IgnoreChanges);
            }
        });
    });
}

/// Before changed settings are lost.
fn unsaved(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    if context.previewer.state().unsaved.is_none() {
        return;
    }
    dialog(ui, "Changed settings").show(ui.ctx(), |ui| {
        ui.label("The changed settings are not saved.");
        ui.horizontal(|ui| {
            if ui.button("Save first").clicked() {
                actions.extend([Action::GiveUpEdits { yes: false }, Action::Save]);
            }
            if ui.button("Give them up").clicked() {
                actions.push(Action::GiveUpEdits { yes: true });
            }
            if ui.button("Go back").clicked() {
                actions.push(Action::GiveUpEdits { yes: false });
            }
        });
    });
}

/// Before files are written over.
fn overwriting(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let Some(asked) = &context.previewer.state().overwriting else { return };
    dialog(ui, "Write over?").show(ui.ctx(), |ui| {
        ui.label(&asked.what);
        ui.horizontal(|ui| {
            for (name, yes) in [("Write over", true), ("Go back", false)] {
                if ui.button(name).clicked() {
                    actions.push(Action::WriteOver { yes });
                }
            }
        });
    });
}

fn export(ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let Some(progress) = context.exports.progress() else { return };
    if progress.state != ExportState::Running {
        return;
    }
    dialog(ui, "Exporting").show(ui.ctx(), |ui| {
        let share = progress.done as f32 / progress.total.max(1) as f32;
        let text = format!("{} of {}", progress.done, progress.total);
        ui.add(egui::ProgressBar::new(share).desired_width(260.0).text(text));
        if ui.button("Cancel").clicked() {
            actions.push(Action::CancelExport);
        }
    });
}

/// A small window over the viewports.
fn dialog(ui: &Ui, title: &'static str) -> egui::Window<'static> {
    egui::Window::new(title).constrain_to(ui.max_rect()).collapsible(false).resizable(false)
}

/// What the colours stand for, in the viewports' corner.
fn legend(ui: &Ui, context: &Context<'_>) {
    let Some(colour_by) = context.colour_by.filter(|_| context.previewer.state().look.legend)
    else {
        return;
    };
    let Some(table) = colour_by.table() else { return };
    let rect = ui.max_rect();
    let width = 200.0f32.min(0.4 * rect.width());
    let corner = rect.right_top() + vec2(-width - 34.0, 12.0);
    let plate = egui::Rect::from_min_size(corner, vec2(width + 24.0, 44.0));
    let painter = ui.painter();
    painter.rect_filled(plate, 4.0, egui::Color32::from_black_alpha(150));
    let font = egui::FontId::proportional(11.0);
    let title = plate.center_top() + vec2(0.0, 3.0);
    painter.text(title, Align2::CENTER_TOP, colour_by.title(), font.clone(), theme::TEXT);
    let strip = egui::Rect::from_min_size(corner + vec2(12.0, 18.0), vec2(width, 9.0));
    for column in 0..64 {
        let share = column as f32 / 64.0;
        let [r, g, b] = table.colour(f64::from(share)).0;
        let x = strip.left() + share * strip.width();
        let cell = egui::Rect::from_min_max(
            egui::pos2(x, strip.top()),
            egui::pos2(x + strip.width() / 64.0 + 0.5, strip.bottom()),
        );
        painter.rect_filled(cell, 0.0, egui::Color32::from_rgb(r, g, b));
    }
    let mut free_from = f32::NEG_INFINITY;
    for tick in colour_by.ticks() {
        let at = egui::pos2(strip.left() + tick.coordinate as f32 * strip.width(), strip.bottom());
        let label = painter.layout_no_wrap(tick.label, font.clone(), theme::TEXT);
        let ends = [plate.left() + 2.0, plate.right() - label.size().x - 2.0];
        let left = (at.x - 0.5 * label.size().x).min(ends[1]).max(ends[0]);
        // Those that would write over one another are left out.
        if left >= free_from {
            free_from = left + label.size().x + 4.0;
            painter.galley(egui::pos2(left, at.y), label, theme::TEXT);
        }
    }
}
