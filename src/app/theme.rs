//! Colours and sizes of the window, in one place.

use egui::{Color32, Context, FontId, Stroke, TextStyle, Visuals};

use crate::preview::{FrameStatus, Level};

/// Behind everything: neutral, so that it does not tint what is judged by eye.
pub const PANEL: Color32 = Color32::from_rgb(38, 39, 42);
pub const WELL: Color32 = Color32::from_rgb(26, 27, 29);
pub const TEXT: Color32 = Color32::from_rgb(222, 223, 226);
pub const FAINT: Color32 = Color32::from_rgb(146, 149, 156);
/// What is now: the playhead, the selected.
pub const ACCENT: Color32 = Color32::from_rgb(255, 176, 74);
pub const KEY: Color32 = Color32::from_rgb(120, 190, 255);
pub const CUT: Color32 = Color32::from_rgb(255, 140, 70);

/// The colour of a frame on the timeline; apart in lightness as well as in hue.
pub fn status_colour(status: FrameStatus) -> Color32 {
    match status {
        FrameStatus::Missing => Color32::from_rgb(52, 54, 58),
        FrameStatus::Stale => Color32::from_rgb(112, 92, 74),
        FrameStatus::Mixed => Color32::from_rgb(214, 170, 78),
        FrameStatus::Ready => Color32::from_rgb(96, 186, 150),
    }
}

/// What the status means, for legends and tooltips.
pub fn status_words(status: FrameStatus) -> &'static str {
    match status {
        FrameStatus::Missing => "not simulated yet",
        FrameStatus::Stale => "made with other settings, or to be made again",
        FrameStatus::Mixed => "these settings, begun from a frame of others",
        FrameStatus::Ready => "as a clean run gives it",
    }
}

pub fn level_colour(level: Level) -> Color32 {
    match level {
        Level::Note => Color32::from_rgb(120, 190, 255),
        Level::Warning => Color32::from_rgb(240, 190, 90),
        Level::Error => Color32::from_rgb(255, 110, 100),
    }
}

/// Of what explains (points): the toolkit's own is too small to be read in passing.
const SMALL_TEXT: f32 = 11.0;

/// Gives a context the looks of the program.
pub fn dress(context: &Context) {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = PANEL;
    visuals.window_fill = PANEL;
    visuals.extreme_bg_color = WELL;
    visuals.override_text_color = Some(TEXT);
    visuals.selection.bg_fill = Color32::from_rgb(110, 78, 36);
    visuals.selection.stroke = Stroke::new(1.0, ACCENT);
    context.set_visuals(visuals);
    context.all_styles_mut(|style| {
        style.text_styles.insert(TextStyle::Small, FontId::proportional(SMALL_TEXT));
        // A drag that misses a slider would mark its name.
        style.interaction.selectable_labels = false;
    });
}
