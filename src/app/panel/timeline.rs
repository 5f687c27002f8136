//! Time: the frames at a glance, the camera's keys, the range that plays, and the buttons.

mod transport;

use egui::{Color32, Id, Rect, Response, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

use super::Context;
use crate::app::theme;
use crate::app::viewport::short;
use crate::preview::{Action, FrameStatus, Previewer, Scenery, Timeline};

/// Of the panel (points).
pub const HEIGHT: f32 = 78.0;
const STRIP_HEIGHT: f32 = 26.0;
const KEYS_HEIGHT: f32 = 12.0;

pub fn show(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let previewer = context.previewer;
    let Some(scenery) = previewer.scenery() else { return };
    ui.add_space(4.0);
    let width = ui.available_width();
    let (rect, response) =
        ui.allocate_exact_size(vec2(width, STRIP_HEIGHT + KEYS_HEIGHT), Sense::click_and_drag());
    let scale = Scale { rect: rect.shrink2(vec2(6.0, 0.0)), last: previewer.timeline().last() };
    strip(ui, &scale, previewer);
    keys(ui, &scale, previewer, scenery, actions);
    range(ui, &scale, previewer, actions);
    playhead(ui, &scale, previewer, scenery);
    scrub(&response, &scale, actions);
    tooltip(response, &scale, previewer, scenery);
    ui.horizontal(|ui| transport::show(ui, context, scenery, actions));
}

/// Between frames and places.
struct Scale {
    rect: Rect,
    last: u32,
}

impl Scale {
    /// Of a frame's left edge, and of its right one as the next one's.
    fn x(&self, frame: f32) -> f32 {
        self.rect.left() + self.rect.width() * frame / (self.last + 1) as f32
    }

    fn middle(&self, frame: f64) -> f32 {
        self.x(frame as f32 + 0.5)
    }

    fn frame(&self, x: f32) -> u32 {
        let share = ((x - self.rect.left()) / self.rect.width()).clamp(0.0, 1.0);
        ((share * (self.last + 1) as f32) as u32).min(self.last)
    }

    fn strip(&self) -> Rect {
        Rect::from_min_size(self.rect.min, vec2(self.rect.width(), STRIP_HEIGHT))
    }
}

/// A bar for each run of frames of one status; what is not as a clean run gives it is also lower, so
/// that colour is not all there is to see.
fn strip(ui: &Ui, scale: &Scale, previewer: &Previewer) {
    let timeline = previewer.timeline();
    let painter = ui.painter();
    painter.rect_filled(scale.strip(), 2.0, theme::WELL);
    let mut first = 0;
    while first <= timeline.last() {
        let status = timeline.status(first);
        let next = (first..=timeline.last()).find(|&frame| timeline.status(frame) != status);
        let end = next.unwrap_or(timeline.last() + 1);
        let height = STRIP_HEIGHT
            * match status {
                FrameStatus::Missing => 0.12,
                FrameStatus::Stale => 0.45,
                FrameStatus::Mixed => 0.72,
                FrameStatus::Ready => 1.0,
            };
        let bottom = scale.strip().bottom();
        let bar = Rect::from_min_max(
            pos2(scale.x(first as f32), bottom - height),
            pos2(scale.x(end as f32), bottom),
        );
        painter.rect_filled(bar, 0.0, theme::status_colour(status));
        first = end;
    }
    frame_lines(ui, scale);
}

/// Lines between frames where there is room for them.
fn frame_lines(ui: &Ui, scale: &Scale) {
    let width = scale.rect.width() / (scale.last + 1) as f32;
    if width < 5.0 {
        return;
    }
    let stroke = Stroke::new(1.0, Color32::from_black_alpha(60));
    for frame in 1..=scale.last {
        ui.painter().vline(scale.x(frame as f32), scale.strip().y_range(), stroke);
    }
}

/// Diamonds for keys, a bar where the camera jumps; keys can be dragged.
fn keys(
    ui: &Ui,
    scale: &Scale,
    previewer: &Previewer,
    scenery: &Scenery,
    actions: &mut Vec<Action>,
) {
    let Some(path) = &scenery.camera else { return };
    let y = scale.strip().bottom() + 0.5 * KEYS_HEIGHT;
    for cut in path.cuts() {
        let x = scale.x(cut as f32);
        let band = scale.strip().y_range();
        ui.painter().vline(x, band.min..=band.max + KEYS_HEIGHT, Stroke::new(1.5, theme::CUT));
    }
    let can_move = previewer.plan().is_some();
    for key in path.key_frames().into_iter().filter(|&key| key <= f64::from(scale.last)) {
        let at = pos2(scale.middle(key), y);
        let id = Id::unique(("key", key.to_bits()));
        let sense = if can_move { Sense::click_and_drag() } else { Sense::click() };
        let area = Rect::from_center_size(at, vec2(11.0, KEYS_HEIGHT));
        let response = ui.interact(area, id, sense);
        let dragged = response.dragged().then(|| response.interact_pointer_pos()).flatten();
        let x = dragged.map_or(at.x, |pointer| scale.middle(f64::from(scale.frame(pointer.x))));
        let colour =
            if response.hovered() || response.dragged() { theme::ACCENT } else { theme::KEY };
        diamond(ui, pos2(x, y), colour);
        if response.clicked() {
            actions.push(Action::GoTo { frame: key.round().max(0.0) as u32 });
        }
        if response.drag_stopped() {
            let to = response.interact_pointer_pos().map(|pointer| scale.frame(pointer.x));
            if let Some(to) = to.filter(|&to| f64::from(to) != key) {
                actions.push(Action::MoveKey { from: key, to: f64::from(to) });
            }
        }
    }
}

fn diamond(ui: &Ui, at: egui::Pos2, colour: Color32) {
    let r = 4.5;
    let corners = [vec2(0.0, -r), vec2(r, 0.0), vec2(0.0, r), vec2(-r, 0.0)].map(|d| at + d);
    let shape = egui::Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE);
    ui.painter().add(shape);
}

/// What does not play is dimmed; its ends can be dragged.
fn range(ui: &Ui, scale: &Scale, previewer: &Previewer, actions: &mut Vec<Action>) {
    let playback = previewer.state().playback;
    let strip = scale.strip();
    let dim = Color32::from_black_alpha(150);
    let (left, right) = (scale.x(playback.first as f32), scale.x(playback.last as f32 + 1.0));
    let before = Rect::from_min_max(strip.min, pos2(left, strip.bottom()));
    let after = Rect::from_min_max(pos2(right, strip.top()), strip.max);
    ui.painter().rect_filled(before, 0.0, dim);
    ui.painter().rect_filled(after, 0.0, dim);
    for (name, x) in [("in", left), ("out", right)] {
        let area = Rect::from_center_size(pos2(x, strip.top() + 5.0), vec2(9.0, 12.0));
        let response = ui.interact(area, Id::unique(("range", name)), Sense::drag());
        let response = response.on_hover_cursor(egui::CursorIcon::ResizeHorizontal);
        ui.painter().rect_filled(area.shrink2(vec2(2.5, 0.0)), 1.0, theme::TEXT);
        if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let frame = scale.frame(at.x);
            actions.push(match name {
                "in" => Action::SetIn { frame },
                _ => Action::SetOut { frame },
            });
        }
    }
}

fn playhead(ui: &Ui, scale: &Scale, previewer: &Previewer, scenery: &Scenery) {
    let current = previewer.state().playback.current;
    let strip = scale.strip();
    let width = (scale.rect.width() / (scale.last + 1) as f32).max(2.0);
    let cell =
        Rect::from_min_size(pos2(scale.x(current as f32), strip.top()), vec2(width, STRIP_HEIGHT));
    ui.painter().rect_stroke(cell, 0.0, Stroke::new(2.0, theme::ACCENT), StrokeKind::Middle);
    let x = scale.middle(f64::from(current));
    let label = scenery.shown(current).to_string();
    let align = if x > scale.rect.center().x {
        egui::Align2::RIGHT_CENTER
    } else {
        egui::Align2::LEFT_CENTER
    };
    let shift = if x > scale.rect.center().x { -0.5 * width - 3.0 } else { 0.5 * width + 3.0 };
    let font = egui::FontId::monospace(12.0);
    let at = pos2(x + shift, strip.center().y);
    for offset in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        ui.painter().text(at + offset, align, &label, font.clone(), Color32::BLACK);
    }
    ui.painter().text(at, align, label, font, theme::ACCENT);
}

fn scrub(response: &Response, scale: &Scale, actions: &mut Vec<Action>) {
    let pointer = response.interact_pointer_pos();
    if let Some(at) = pointer.filter(|_| response.dragged() || response.clicked()) {
        if response.drag_started() {
            actions.push(Action::Pause);
        }
        actions.push(Action::GoTo { frame: scale.frame(at.x) });
    }
}

fn tooltip(response: Response, scale: &Scale, previewer: &Previewer, scenery: &Scenery) {
    let Some(at) = response.hover_pos() else { return };
    let frame = scale.frame(at.x);
    let words = about(previewer.timeline(), frame, scenery);
    response.on_hover_text_at_pointer(words);
}

fn about(timeline: &Timeline, frame: u32, scenery: &Scenery) -> String {
    let status = theme::status_words(timeline.status(frame));
    let mut words = format!("frame {}: {status}", scenery.shown(frame));
    if let Some(slot) = timeline.slot(frame) {
        words += &format!("\nsettings {}", short(&slot.settings_hash));
        if let Some(cost) = slot.cost {
            words += &format!("\n{} faces, {:.3} s", cost.faces, cost.wall);
            words += &format!("\nlargest stretch {:.1} %", 100.0 * cost.largest_stretch);
            if let Some(count) = cost.intersections {
                words += &format!("\nintersections {count}");
            }
        }
    }
    words
}
