//! The buttons under the timeline, where time stands, and what is being done.

use egui::{Sense, Ui, vec2};

use crate::app::panel::Context;
use crate::app::theme;
use crate::preview::{Action, Direction, FrameStatus, Level, Scenery};

pub fn show(ui: &mut Ui, context: &Context<'_>, scenery: &Scenery, actions: &mut Vec<Action>) {
    let playback = context.previewer.state().playback;
    let play = if playback.playing { "Pause" } else { "Play" };
    let go = |direction| Action::GoToKey { direction };
    for (name, hint, action) in [
        ("|<", "start of the range (Home)", Action::GoToStart),
        ("<K", "camera key before (Up)", go(Direction::Back)),
        ("<", "a frame back (Left)", Action::Step { by: -1 }),
        (play, "Space", Action::PlayOrPause),
        (">", "a frame on (Right)", Action::Step { by: 1 }),
        ("K>", "camera key after (Down)", go(Direction::Forward)),
        (">|", "end of the range (End)", Action::GoToEnd),
    ] {
        /// As wide as the longest name: what is beside it stays where it is (points).
        const WIDTH: f32 = 44.0;
        let width = if name == play { WIDTH } else { 0.0 };
        let button = egui::Button::new(name).min_size(vec2(width, 0.0));
        if ui.add(button).on_hover_text(hint).clicked() {
            actions.push(action);
        }
    }
    if ui.selectable_label(playback.looping, "Loop").on_hover_text("L").clicked() {
        actions.push(Action::SetLooping { on: !playback.looping });
    }
    let frame = playback.current;
    for (name, hint, action) in [
        ("In", "the range begins here (I)", Action::SetIn { frame }),
        ("Out", "the range ends here (O)", Action::SetOut { frame }),
        ("All", "the whole shot plays (Shift P)", Action::ClearRange),
    ] {
        if ui.button(name).on_hover_text(hint).clicked() {
            actions.push(action);
        }
    }
    let [now, first, last] =
        [playback.current, playback.first, playback.last].map(|frame| scenery.shown(frame));
    ui.label(format!("{now}   [{first} - {last}]   {} fps", scenery.fps));
    working(ui, context, scenery);
    legend(ui);
    memory(ui, context);
}

/// Where there is room for it; else the bars' own tooltips say it.
fn legend(ui: &mut Ui) {
    /// With the memory beside it (points).
    const WIDTH: f32 = 400.0;
    if ui.available_width() < WIDTH {
        return;
    }
    ui.separator();
    for (status, name) in [
        (FrameStatus::Ready, "clean"),
        (FrameStatus::Mixed, "mixed"),
        (FrameStatus::Stale, "stale"),
        (FrameStatus::Missing, "missing"),
    ] {
        let (rect, _) = ui.allocate_exact_size(vec2(9.0, 9.0), Sense::hover());
        ui.painter().rect_filled(rect, 1.0, theme::status_colour(status));
        ui.label(egui::RichText::new(name).small().color(theme::FAINT))
            .on_hover_text(theme::status_words(status));
    }
}

/// What is being done.
fn working(ui: &mut Ui, context: &Context<'_>, scenery: &Scenery) {
    /// Kept free, so that what is beside it stays where it is (points).
    const WIDTH: f32 = 120.0;
    /// A frame in work for longer than this says for how long (s).
    const WORTH_SAYING: f64 = 3.0;
    let previewer = context.previewer;
    ui.scope(|ui| {
        ui.set_min_width(WIDTH.min(ui.available_width()));
        if previewer.is_opening() {
            ui.label("reading the shot ...");
        } else if let Some(frame) = previewer.in_work() {
            let mut words = format!("simulating {}", scenery.shown(frame));
            let seconds = previewer.seconds_in_work();
            if seconds > WORTH_SAYING {
                words += &format!(", {seconds:.0} s");
            }
            ui.label(words);
        } else if let Some(frame) = previewer.failed_frame() {
            let words = format!("stopped before {}", scenery.shown(frame));
            ui.colored_label(theme::level_colour(Level::Error), words);
        } else if previewer.is_halted() {
            ui.label("halted");
        }
    });
}

/// Where there is room for it.
fn memory(ui: &mut Ui, context: &Context<'_>) {
    /// (points).
    const WIDTH: f32 = 100.0;
    if ui.available_width() < WIDTH {
        return;
    }
    let store = context.previewer.store();
    let words = format!("{} of {} MB", store.used() >> 20, store.budget() >> 20);
    ui.label(egui::RichText::new(words).small().color(theme::FAINT))
        .on_hover_text("memory that frames take; those beyond it are read from disk");
}
