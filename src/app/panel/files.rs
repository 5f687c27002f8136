//! Opening and saving: a folder to walk through, a path to type, what was open before.

use std::fs;
use std::path::{Path, PathBuf};

use egui::{Label, RichText, ScrollArea, TextEdit, Ui};

use super::Context;
use crate::app::theme;
use crate::preview::{Action, Level, PanelName, Source};
use crate::run::RunReader;

/// See the module.
pub struct FilesPanel {
    folder: PathBuf,
    /// What is typed or chosen.
    path: String,
    /// Read when the folder was entered or the panel opened.
    entries: Option<Result<Vec<Entry>, String>>,
}

/// Something in a folder that may be of interest.
struct Entry {
    path: PathBuf,
    name: String,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Folder,
    Run,
    Shot,
}

impl Default for FilesPanel {
    fn default() -> Self {
        let folder = std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."));
        Self { folder, path: String::new(), entries: None }
    }
}

impl FilesPanel {
    pub fn show(&mut self, ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let mut open = true;
        egui::Window::new("Open and save as")
            .constrain_to(ui.max_rect())
            .open(&mut open)
            .default_width(520.0)
            .show(ui.ctx(), |ui| {
                recent(ui, context, actions);
                self.typed(ui, context, actions);
                self.folder(ui, actions);
            });
        if !open {
            actions.push(Action::SetPanel { panel: PanelName::Files, open: false });
        }
    }

    /// The path, what can be done with it, and why it could not be done.
    fn typed(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let field = TextEdit::singleline(&mut self.path)
            .hint_text("path to open, or to save as")
            .desired_width(f32::INFINITY);
        let response = ui.add(field);
        let entered = response.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        ui.horizontal(|ui| {
            let path = self.folder.join(self.path.trim());
            let is_typed = !self.path.trim().is_empty();
            let open = ui.add_enabled(is_typed, egui::Button::new("Open")).clicked();
            if open || (entered && is_typed) {
                if is_plain_folder(&path) {
                    self.enter(&path);
                } else {
                    actions.push(Action::Open { path: path.clone() });
                }
            }
            let is_shot = matches!(context.previewer.source(), Source::Shot(_));
            let save = ui.add_enabled(is_typed && is_shot, egui::Button::new("Save as"));
            if save.on_hover_text("the shot with its changed settings, under this name").clicked() {
                actions.push(Action::SaveAs { path, overwrite: false });
            }
        });
        if context.previewer.is_opening() {
            ui.label("reading ...");
        } else if let Some(why) = context.previewer.opening_failure() {
            ui.colored_label(theme::level_colour(Level::Error), why);
        }
    }

    fn folder(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        ui.separator();
        ui.label(RichText::new(self.folder.display().to_string()).small().color(theme::FAINT));
        let mut next = None;
        if ui.button("..").on_hover_text("the folder above").clicked() {
            next = self.folder.parent().map(Path::to_owned);
        }
        let entries = self.entries.get_or_insert_with(|| entries(&self.folder));
        match entries {
            Err(why) => drop(ui.colored_label(theme::FAINT, why.as_str())),
            Ok(entries) => {
                ScrollArea::vertical().max_height(260.0).auto_shrink(false).show(ui, |ui| {
                    for entry in entries {
                        let name = match entry.kind {
                            Kind::Folder => format!("{}/", entry.name),
                            Kind::Run => format!("{}/   (run)", entry.name),
                            Kind::Shot => entry.name.clone(),
                        };
                        if !ui.selectable_label(false, name).clicked() {
                            continue;
                        }
                        if entry.kind == Kind::Folder {
                            next = Some(entry.path.clone());
                        } else {
                            self.path = entry.name.clone();
                            actions.push(Action::Open { path: entry.path.clone() });
                        }
                    }
                });
            }
        }
        if let Some(folder) = next {
            self.enter(&folder);
        }
    }

    fn enter(&mut self, folder: &Path) {
        self.folder = folder.to_owned();
        self.path.clear();
        self.entries = None;
    }

    /// The panel is not shown: who knows what the folder holds when it is again.
    pub fn rest(&mut self) {
        self.entries = None;
    }
}

/// The program's own shot, and what was open before, each with the folder it is in.
fn recent(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.strong("Recent");
        if ui.button("The program's own shot").clicked() {
            actions.push(Action::OpenOwn);
        }
    });
    for path in &context.preferences.recent {
        ui.horizontal(|ui| {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.selectable_label(false, name).clicked() {
                actions.push(Action::Open { path: path.clone() });
            }
            let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
            ui.add(Label::new(RichText::new(folder).small().color(theme::FAINT)).truncate());
        });
    }
    ui.separator();
}

fn is_plain_folder(path: &Path) -> bool {
    path.is_dir() && !RunReader::is_run(path)
}

/// Folders first, then runs, then files that may be shots; hidden ones are left out.
fn entries(folder: &Path) -> Result<Vec<Entry>, String> {
    let read = fs::read_dir(folder).map_err(|error| format!("{:?}: {error}", folder.display()))?;
    let mut entries: Vec<Entry> = read
        .flatten()
        .filter_map(|entry| {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            let kind = if path.is_dir() {
                if RunReader::is_run(&path) { Kind::Run } else { Kind::Folder }
            } else if path.extension().is_some_and(|e| e == "json" || e == "jsonc") {
                Kind::Shot
            } else {
                return None;
            };
            (!name.starts_with('.')).then_some(Entry { path, name, kind })
        })
        .collect();
    entries.sort_by(|a, b| (a.kind, &a.name).cmp(&(b.kind, &b.name)));
    Ok(entries)
}
