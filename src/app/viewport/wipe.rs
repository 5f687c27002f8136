//! The line between A and B, which can be dragged, and what is on its two sides.

use egui::text::LayoutJob;
use egui::{Color32, FontId, Rect, Sense, Stroke, TextFormat, Ui, pos2, vec2};

use super::{Eye, short};
use crate::app::theme;
use crate::preview::{Action, Difference, Layout, Previewer};

/// To each side of the line it can be grabbed (points).
const GRAB: f32 = 6.0;
/// Settings that differ and are listed.
const LISTED_MAX: usize = 6;
/// Between the line and what is written beside it (points).
const GAP: f32 = 8.0;

/// `share` of the picture's width is A's. The notes are written once, whatever the number of views.
pub fn show(
    ui: &Ui,
    eye: Eye,
    rect: Rect,
    share: f64,
    previewer: &Previewer,
    actions: &mut Vec<Action>,
) {
    let x = rect.left() + rect.width() * share as f32;
    let line = Rect::from_min_max(pos2(x - GRAB, rect.top()), pos2(x + GRAB, rect.bottom()));
    let id = ui.scope_id().with(("wipe", rect.left() as i32));
    let response =
        ui.interact(line, id, Sense::drag()).on_hover_cursor(egui::CursorIcon::ResizeColumn);
    ui.painter().vline(x, rect.y_range(), Stroke::new(1.5, theme::ACCENT));
    let a = previewer.state().a.as_ref().map_or("", |a| &a.settings_hash);
    let b = previewer.scenery().map_or("", |scenery| &scenery.settings_hash);
    let found = previewer.differences();
    let is_noted = eye == Eye::Shot || previewer.state().look.layout == Layout::Witness;
    for (side, name, hash) in [(0, "A", [a, b]), (1, "B", [b, a])].into_iter().filter(|_| is_noted)
    {
        note(ui, rect, x, side, words(name, hash, side, found));
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        let wipe = f64::from((at.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
        actions.push(Action::Compare { wipe: Some(wipe) });
    }
}

/// Which side it is, by what settings, and its values of those that differ.
fn words(name: &str, [hash, other]: [&str; 2], side: usize, found: &[Difference]) -> Vec<String> {
    let is_same = hash == other;
    let mut lines = vec![format!("{name}   {}", short(hash))];
    if found.is_empty() {
        let words = if is_same { "the same settings" } else { "the same settings, other files" };
        lines.push(words.to_owned());
    }
    let listed = found.iter().take(LISTED_MAX);
    lines.extend(listed.map(|found| format!("{} {}", found.name, found.values[side])));
    if found.len() > LISTED_MAX {
        lines.push(format!("and {} more", found.len() - LISTED_MAX));
    }
    lines
}

/// Beside the line, on a plate of its own; not beyond the picture.
fn note(ui: &Ui, rect: Rect, x: f32, side: usize, lines: Vec<String>) {
    let mut job = LayoutJob::default();
    for (number, line) in lines.iter().enumerate() {
        let colour = if number == 0 { theme::ACCENT } else { theme::TEXT };
        let format = TextFormat::simple(FontId::proportional(12.0), colour);
        let end = if number + 1 < lines.len() { "\n" } else { "" };
        job.append(&format!("{}{end}", line.trim_end()), 0.0, format);
    }
    let painter = ui.painter().with_clip_rect(match side {
        0 => Rect::from_min_max(rect.min, pos2(x, rect.bottom())),
        _ => Rect::from_min_max(pos2(x, rect.top()), rect.max),
    });
    let text = painter.layout_job(job);
    let beside = if side == 0 { x - GAP - text.size().x } else { x + GAP };
    let left = beside.max(rect.left() + GAP);
    // The legend is at the top.
    let at = pos2(left, rect.bottom() - GAP - text.size().y);
    let plate = Rect::from_min_size(at, text.size()).expand2(vec2(4.0, 2.0));
    painter.rect_filled(plate, 3.0, Color32::from_black_alpha(150));
    painter.galley(at, text, theme::TEXT);
}
