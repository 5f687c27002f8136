//! What to export, of which view, how large and where to.

use std::path::PathBuf;

use egui::{DragValue, RichText, ScrollArea, TextEdit, Ui};

use super::{Context, floating};
use crate::app::theme;
use crate::preview::{Action, Export, ExportKind, PanelName, Viewport};

/// See the module.
pub struct ExportPanel {
    kind: ExportKind,
    viewport: Viewport,
    width: u32,
    /// On a contact sheet, where many stand side by side.
    sheet_width: u32,
    burn_in: bool,
    /// `None` until somebody types: then it follows the kind.
    to: Option<String>,
}

impl Default for ExportPanel {
    fn default() -> Self {
        Self {
            kind: ExportKind::Still,
            viewport: Viewport::Shot,
            width: 1280,
            sheet_width: 320,
            burn_in: true,
            to: None,
        }
    }
}

/// Of the window's title, with what is around it (points).
const TITLE_HEIGHT: f32 = 60.0;

const KINDS: [(ExportKind, &str, &str); 5] = [
    (ExportKind::Still, "Still", "this frame as PNG"),
    (ExportKind::Sheet, "Contact sheet", "frames of the range, both views, on one page"),
    (ExportKind::Sequence, "PNG sequence", "a picture a frame of the range, into a folder"),
    (ExportKind::Video, "Video", "the range as a film; needs ffmpeg"),
    (ExportKind::Run, "Run folder", "for render, sheet, compare and the pipeline"),
];

impl ExportPanel {
    pub fn show(&mut self, ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let mut open = true;
        // Of the views' height, with a title above it.
        let height = (ui.max_rect().height() - TITLE_HEIGHT).max(TITLE_HEIGHT);
        floating(ui, "Export").open(&mut open).resizable(false).show(ui.ctx(), |ui| {
            ScrollArea::vertical().max_height(height).show(ui, |ui| {
                self.kinds(ui);
                ui.separator();
                self.how(ui);
                self.where_to(ui, context, actions);
            });
        });
        if !open {
            actions.push(Action::SetPanel { panel: PanelName::Export, open: false });
        }
    }

    fn kinds(&mut self, ui: &mut Ui) {
        for (kind, name, hint) in KINDS {
            if ui.radio_value(&mut self.kind, kind, name).on_hover_text(hint).changed() {
                // A name for one kind is none for another.
                self.to = None;
            }
        }
    }

    fn where_to(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let mut to = self.to.clone().unwrap_or_else(|| self.usual_name(context));
        let label = ui.label("to");
        let field = ui.add(TextEdit::singleline(&mut to).desired_width(320.0));
        if field.labelled_by(label.id).changed() {
            self.to = Some(to.clone());
        }
        let is_ready = context.previewer.scenery().is_some()
            && !context.exports.is_running()
            && !to.trim().is_empty();
        if ui.add_enabled(is_ready, egui::Button::new("Export")).clicked() {
            actions.push(Action::Export { export: self.export(to.trim()) });
        }
        let words = "a still may be of any frame; all else is of clean (green) frames";
        ui.label(RichText::new(words).small().color(theme::FAINT));
    }

    fn export(&self, to: &str) -> Export {
        let (kind, to, burn_in) = (self.kind, PathBuf::from(to), self.burn_in);
        let (viewport, width) = match kind {
            ExportKind::Sheet => (Viewport::Both, self.sheet_width),
            _ => (self.viewport, self.width),
        };
        Export { kind, viewport, width, burn_in, to, overwrite: false }
    }

    fn how(&mut self, ui: &mut Ui) {
        if matches!(self.kind, ExportKind::Run) {
            return;
        }
        if self.kind != ExportKind::Sheet {
            ui.horizontal(|ui| {
                for (viewport, name) in [
                    (Viewport::Shot, "shot camera"),
                    (Viewport::Witness, "witness"),
                    (Viewport::Both, "both"),
                ] {
                    ui.radio_value(&mut self.viewport, viewport, name);
                }
            });
            ui.checkbox(&mut self.burn_in, "strip with shot, frame, lens and settings");
        }
        ui.horizontal(|ui| {
            let label = ui.label("width of one view");
            let width = match self.kind {
                ExportKind::Sheet => &mut self.sheet_width,
                _ => &mut self.width,
            };
            let field = DragValue::new(width).range(64..=8192).suffix(" px");
            ui.add(field).labelled_by(label.id);
        });
    }

    fn usual_name(&self, context: &Context<'_>) -> String {
        let previewer = context.previewer;
        let Some(scenery) = previewer.scenery() else { return String::new() };
        let name = &scenery.name;
        match self.kind {
            ExportKind::Still => {
                format!("{name}.{}.png", scenery.shown(previewer.state().playback.current))
            }
            ExportKind::Sheet => format!("{name}.sheet.png"),
            ExportKind::Sequence => format!("{name}.frames"),
            ExportKind::Video => format!("{name}.mp4"),
            ExportKind::Run => format!("{name}.run"),
        }
    }
}
