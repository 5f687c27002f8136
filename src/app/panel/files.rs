//! Opening and saving: a folder to walk through, a path to type, what was open before.

use std::fs;
use std::path::{Path, PathBuf};

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Label, RichText, ScrollArea, TextEdit, Ui};

use super::{Context, floating};
use crate::app::theme;
use crate::preview::{Action, Level, PanelName, Source};
use crate::run::RunReader;

/// See the module.
pub struct FilesPanel {
    purpose: Purpose,
    folder: PathBuf,
    /// What is typed or chosen.
    path: String,
    /// Read when the folder was entered or the panel opened.
    entries: Option<Result<Vec<Entry>, String>>,
    /// It has just been opened: what is typed is a path.
    is_fresh: bool,
    /// The path is to be typed, until it can be.
    wants_focus: bool,
    /// Why what was to be opened could not be, when that was shown last.
    failure: Option<String>,
}

/// What a path is for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    Open,
    SaveAs,
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

impl FilesPanel {
    pub fn of(purpose: Purpose) -> Self {
        let folder = std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."));
        Self {
            purpose,
            folder,
            path: String::new(),
            entries: None,
            is_fresh: true,
            wants_focus: false,
            failure: None,
        }
    }

    pub fn show(&mut self, ui: &Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let (title, panel) = match self.purpose {
            Purpose::Open => ("Open", PanelName::Files),
            Purpose::SaveAs => ("Save as", PanelName::SaveAs),
        };
        if std::mem::take(&mut self.is_fresh) {
            self.wants_focus = true;
            if self.purpose == Purpose::SaveAs {
                self.suggest(context);
            }
        }
        let mut open = true;
        floating(ui, title).open(&mut open).default_width(520.0).show(ui.ctx(), |ui| {
            if self.purpose == Purpose::Open {
                recent(ui, context, actions);
            }
            self.typed(ui, context, actions);
            self.folder(ui, actions);
        });
        if !open {
            actions.push(Action::SetPanel { panel, open: false });
        }
    }

    /// Whether the path is to be typed, and cannot be yet.
    pub fn awaits_focus(&self) -> bool {
        self.is_fresh || self.wants_focus
    }

    /// The shot's own name, where it is, as one to change.
    fn suggest(&mut self, context: &Context<'_>) {
        let Source::Shot(request) = context.previewer.source() else { return };
        self.path = self.usual_name(context);
        if let Ok(path) = std::path::absolute(request.path())
            && let Some(folder) = path.parent().filter(|_| request.shot.is_some())
        {
            self.folder = folder.to_owned();
        }
    }

    /// To begin with: of what is saved its own, of what is opened none.
    fn usual_name(&self, context: &Context<'_>) -> String {
        let name = |path: PathBuf| path.file_name().map(|n| n.to_string_lossy().into_owned());
        match (context.previewer.source(), self.purpose) {
            (Source::Shot(request), Purpose::SaveAs) => name(request.path()).unwrap_or_default(),
            _ => String::new(),
        }
    }

    /// The path, what is done with it, and why it could not be done.
    fn typed(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let id = ui.scope_id().with("path");
        let failure = context.previewer.opening_failure().map(str::to_owned);
        self.wants_focus |= failure.is_some() && failure != self.failure;
        if self.wants_focus {
            // Before the field is shown: what is typed in this pass is for it, in place of all.
            ui.memory_mut(|memory| memory.request_focus(id));
            let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
            let whole = [0, self.path.chars().count()].map(CCursor::new);
            state.cursor.set_char_range(Some(CCursorRange::two(whole[0], whole[1])));
            state.store(ui.ctx(), id);
        }
        self.failure = failure;
        let field = TextEdit::singleline(&mut self.path).id(id).hint_text("path");
        let response = ui.add(field.desired_width(f32::INFINITY));
        // A window that has just been opened, or lies under a question, is not to be had at once.
        self.wants_focus &= !response.has_focus();
        let entered = response.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        let path = self.folder.join(self.path.trim());
        let is_shot = matches!(context.previewer.source(), Source::Shot(_));
        let (name, hint, is_possible) = match self.purpose {
            Purpose::Open => ("Open", "this file or folder", true),
            Purpose::SaveAs => {
                ("Save as", "the shot with its changed settings, under this name", is_shot)
            }
        };
        let is_ready = is_possible && !self.path.trim().is_empty();
        let button = ui.add_enabled(is_ready, egui::Button::new(name)).on_hover_text(hint);
        if is_ready && (button.clicked() || entered) {
            if is_plain_folder(&path) {
                self.enter(&path);
                self.path = self.usual_name(context);
            } else {
                actions.push(match self.purpose {
                    Purpose::Open => Action::Open { path },
                    Purpose::SaveAs => Action::SaveAs { path, overwrite: false },
                });
            }
        }
        if context.previewer.is_opening() {
            ui.label("reading ...");
        } else if let Some(why) =
            context.previewer.opening_failure().filter(|_| self.purpose == Purpose::Open)
        {
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
                        match (entry.kind, self.purpose) {
                            (Kind::Folder, _) => next = Some(entry.path.clone()),
                            (_, Purpose::SaveAs) => self.path = entry.name.clone(),
                            (_, Purpose::Open) => {
                                self.path = entry.name.clone();
                                actions.push(Action::Open { path: entry.path.clone() });
                            }
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
        if self.purpose == Purpose::Open {
            self.path.clear();
        }
        self.entries = None;
    }

    /// The panel is not shown: who knows what the folder holds when it is again.
    pub fn rest(&mut self) {
        self.entries = None;
        self.is_fresh = true;
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
