//! Files: opened, reloaded, saved.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::Previewer;
use super::parts::{Occasion, Saved};
use crate::output::{PendingFile, folder_of};
use crate::own_shot::own_shot_parts;
use crate::preview::action::Action;
use crate::preview::camera_edit::camera_setting;
use crate::preview::history::Version;
use crate::preview::parameters::stated_value;
use crate::preview::planner::Source;
use crate::preview::save::{rebased, saved_text, seen_from, wrapped_text};
use crate::preview::state::Level;
use crate::preview::{Edits, Plan};
use crate::request::Request;
use crate::scene::{content_hash, from_json};
use crate::sim::SizingMode;

/// It has been said why.
struct NotSaved;

impl Previewer {
    pub(super) fn act_on_files(&mut self, action: Action) {
        match action {
            Action::Open { path } => self.open(Some(path)),
            Action::OpenOwn => self.open(None),
            Action::Reload => self.reload(),
            Action::SaveFirst => {
                if let Some(next) = self.state.unsaved.take()
                    && self.save(None).is_ok()
                {
                    self.act(next);
                }
            }
            Action::IgnoreChanges => self.watched.ignored.append(&mut self.watched.changed),
            Action::Save => drop(self.save(None)),
            Action::SaveAs { path, overwrite } => {
                if !overwrite && path.exists() && !self.is_open_shot(&path) {
                    let what = format!("there is another {:?} already", path.display());
                    let action = Action::SaveAs { path, overwrite: true };
                    self.ask_before_overwriting(what, action);
                } else {
                    let _ = self.save(Some(path));
                }
            }
            other => unreachable!("{other:?} is about other things"),
        }
    }

    fn is_open_shot(&self, path: &Path) -> bool {
        let Source::Shot(Request { shot: Some(shot), .. }) = &self.open.source else {
            return false;
        };
        fs::canonicalize(shot).is_ok_and(|shot| fs::canonicalize(path).is_ok_and(|p| p == shot))
    }

    /// What was open stays until the new shot turns out to be one.
    fn open(&mut self, path: Option<PathBuf>) {
        let source = match path {
            Some(path) if path.is_dir() => Source::Run(path),
            shot => Source::Shot(Request {
                shot,
                text: None,
                camera: None,
                sets: Vec::new(),
                fps: None,
                frames: None,
                sizing: SizingMode::View,
            }),
        };
        self.open_with(source);
    }

    /// Reads all files again. What was changed since the shot was saved stays changed; what was undone
    /// since then stays undone where the shot said something before.
    fn reload(&mut self) {
        let (source, saved) = (self.open.source.clone(), self.open.saved.as_ref());
        self.state.say(Level::Note, "all files are read again; changed settings go on to hold");
        let Some(saved) = saved else { return self.ask(source, Occasion::Reading, None) };
        let now = self.state.version.edits.clone();
        let mut edits = now.beyond(&saved.edits);
        let text: Value = from_json("shot", &saved.text).unwrap_or_default();
        for (path, _) in saved.edits.iter().filter(|(path, _)| now.get(path).is_none()) {
            match stated_value(&text, path) {
                Some(value) => edits.set(path, value.clone()),
                None => {
                    let words = format!("{path} is as the file has it, though that was undone");
                    self.state.say(Level::Warning, words);
                }
            }
        }
        self.state.version = Version { edits, ..self.state.version.clone() };
        self.ask(source, Occasion::Reading, None);
    }

    /// Into the shot's own file, or into another, which is then the one that is open. All that could be
    /// undone before can be still.
    ///
    /// # Errors
    /// If nothing is written; why has been said.
    fn save(&mut self, to: Option<PathBuf>) -> Result<(), NotSaved> {
        match self.saved(to) {
            Ok((request, saved)) => {
                self.state.say(Level::Note, format!("saved {:?}", request.path().display()));
                self.state.look.save_panel = false;
                self.ask(Source::Shot(request), Occasion::Change, Some(saved));
                Ok(())
            }
            Err(why) => {
                self.say_until_planned(Level::Error, why);
                Err(NotSaved)
            }
        }
    }

    /// Writes the file. Returns what is open then.
    fn saved(&self, to: Option<PathBuf>) -> Result<(Request, Saved), String> {
        let Source::Shot(request) = &self.open.source else {
            return Err("a finished run has no settings to save".to_owned());
        };
        let edits = self.state.version.edits.clone();
        let overrides = overrides(request, self.open.plan.as_deref())?;
        let mut all = overrides.clone();
        edits.iter().for_each(|(path, value)| all.set(path, value.clone()));
        let (to, text, written) = match (to, request.shot.as_deref()) {
            (Some(to), None) => {
                write_files_of_own_shot(&to)?;
                let text = String::from_utf8_lossy(own_shot_parts().0);
                (to, edited(&text, &overrides)?, edited(&text, &all)?)
            }
            (None, None) => {
                return Err("the program's own shot is part of the program: Save as writes a copy"
                    .to_owned());
            }
            (to, Some(from)) => {
                let to = to.unwrap_or_else(|| from.to_owned());
                let original = self.original(from, &to)?;
                let [text, written] =
                    [&overrides, &all].map(|edits| text_for(&original, from, &to, edits));
                (to, text?, written?)
            }
        };
        write_whole(&to, &written)?;
        let request = Request { shot: Some(to), camera: None, sets: Vec::new(), ..request.clone() };
        Ok((request, Saved { text: text.into(), written: written.into(), edits }))
    }

    /// What the open shot's file says without edits.
    fn original(&self, from: &Path, to: &Path) -> Result<String, String> {
        let on_disk = || {
            fs::read_to_string(from)
                .map_err(|error| format!("cannot read {:?}: {error}", from.display()))
        };
        let changed = |since, cure| {
            format!("{:?} has changed on disk since it was {since}: {cure}", from.display())
        };
        let Some(saved) = &self.open.saved else {
            let text = on_disk()?;
            return match self.is_as_read(&text) {
                true => Ok(text),
                false => Err(changed("read", "Reload it first")),
            };
        };
        if self.is_open_shot(to) && on_disk().is_ok_and(|text| *text != *saved.written) {
            return Err(changed("saved", "Reload it first, or Save as another"));
        }
        Ok(saved.text.to_string())
    }

    /// Whether the shot's file says what the plan in force was made from.
    fn is_as_read(&self, text: &str) -> bool {
        let (Some(plan), Some(shot)) = (&self.open.plan, self.shot_file()) else { return true };
        let read = plan.requested.files_read.iter().find(|file| file.path == shot);
        read.is_none_or(|file| file.sha256 == content_hash(text.as_bytes()))
    }
}

/// What the command line changed about the shot, which is saved with it.
fn overrides(request: &Request, plan: Option<&Plan>) -> Result<Edits, String> {
    let mut edits = Edits::default();
    for set in &request.sets {
        let (path, value) = set.split_once('=').ok_or_else(|| format!("{set:?} is no override"))?;
        // As the command line has it: what is no JSON is a string.
        let value = serde_json::from_str(value.trim()).unwrap_or_else(|_| value.trim().into());
        edits.set(path.trim(), value);
    }
    if let Some(camera) = &request.camera {
        let camera = std::path::absolute(camera).unwrap_or_else(|_| camera.clone());
        let path = plan.map_or("camera", |plan| camera_setting(&plan.requested.written));
        edits.set(path, camera.to_string_lossy().into_owned().into());
    }
    Ok(edits)
}

/// The text of a shot with edits, for a file that may lie elsewhere than the one it is read from.
fn text_for(original: &str, from: &Path, to: &Path, edits: &Edits) -> Result<String, String> {
    let folder = |path: &Path| {
        let folder = folder_of(path);
        fs::canonicalize(folder)
            .map_err(|error| format!("cannot write to {:?}: {error}", folder.display()))
    };
    let (from_folder, to_folder) = (folder(from)?, folder(to)?);
    if is_native(original) {
        let text = edited(original, edits)?;
        if from_folder == to_folder {
            return Ok(text);
        }
        return rebased(&text, &from_folder, &to_folder).map_err(|error| error.to_string());
    }
    let scene = from_folder.join(from.file_name().unwrap_or_default());
    if to.file_name() == from.file_name() && to_folder == from_folder {
        return Err(format!(
            "{:?} is an ARCSim scene, which is never written to: use Save as for a shot that imports it",
            from.display()
        ));
    }
    wrapped_text(&seen_from(&to_folder, &scene), edits).map_err(|error| error.to_string())
}

fn edited(text: &str, edits: &Edits) -> Result<String, String> {
    saved_text(text, edits).map_err(|error| error.to_string())
}

/// The files that a copy of the program's own shot names, beside where it is to be. Files of other
/// content that are there already are not written over.
fn write_files_of_own_shot(shot: &Path) -> Result<(), String> {
    let folder = folder_of(shot);
    for (name, contents) in own_shot_parts().1 {
        let path = folder.join(name);
        let cannot = |error| format!("cannot write {:?}: {error}", path.display());
        match fs::read(&path) {
            Ok(there) if there == contents => continue,
            Ok(_) => return Err(format!("there is another {:?} already", path.display())),
            Err(_) => {}
        }
        fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(cannot)?;
        fs::write(&path, contents).map_err(cannot)?;
    }
    Ok(())
}

/// Whether a text is a native shot, not a scene to import.
fn is_native(text: &str) -> bool {
    from_json::<Value>("shot", text).is_ok_and(|value| value.get("shotsilk").is_some())
}

/// The file is the old one or the new one, never a part.
fn write_whole(path: &Path, text: &str) -> Result<(), String> {
    let write = || PendingFile::create(path)?.write_lastingly(text.as_bytes());
    write().map_err(|error| format!("{error:#}"))
}
