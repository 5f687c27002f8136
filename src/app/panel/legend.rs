//! What the colours stand for, in the viewports' corner.

use egui::{Align2, Ui, vec2};

use super::Context;
use crate::app::theme;

pub fn show(ui: &Ui, context: &Context<'_>) {
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
