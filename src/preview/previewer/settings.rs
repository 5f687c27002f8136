//! Settings: changed, taken back, compared.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::Value;

use super::Previewer;
use super::parts::{Awaited, Occasion, Saved, Standing};
use crate::preview::action::{Action, Reach};
use crate::preview::history::Version;
use crate::preview::plan::Anchor;
use crate::preview::planner::Source;
use crate::preview::state::{Level, Remembered};
use crate::preview::{Difference, Edits, Said, differences, parameters, tuned_differences};
use crate::request::Request;
use crate::scene::joined;

impl Previewer {
    pub(super) fn act_on_settings(&mut self, action: Action) {
        match action {
            Action::Set { path, value } => self.edit(|edits| edits.set(&path, value)),
            Action::Reset { path } => match self.saved_edits().get(&path).cloned() {
                Some(value) => self.edit(|edits| edits.set(&path, value)),
                None => self.edit(|edits| edits.reset(&path)),
            },
            Action::ResetAll => {
                let saved = self.saved_edits().clone();
                self.edit(|edits| *edits = saved);
            }
            Action::SetReach { reach } => self.state.reach = reach,
            Action::ReRun => {
                self.change(Version { anchor: None, ..self.state.version.clone() });
                self.simulate(true);
            }
            Action::Undo => {
                if let Some(before) = self.state.history.undo(self.state.version.clone()) {
                    self.enforce(before);
                }
            }
            Action::Redo => {
                if let Some(after) = self.state.history.redo(self.state.version.clone()) {
                    self.enforce(after);
                }
            }
            Action::KeepAsA => {
                self.keep_as_a();
                self.state.say(Level::Note, "kept as A: A | B compares what comes with it");
            }
            Action::Compare { wipe } => {
                self.state.wipe = wipe.map(|share| share.clamp(0.0, 1.0));
                if self.state.a.is_none() && wipe.is_some() {
                    self.keep_as_a();
                }
                self.refresh_shown();
            }
            Action::SwapAAndB => {
                let Some(a) = self.state.a.take() else { return };
                self.keep_as_a();
                self.change(a.version);
            }
            other => unreachable!("{other:?} is about other things"),
        }
    }

    /// Changes edits from the current frame on, or from the start.
    fn edit(&mut self, change: impl FnOnce(&mut Edits)) {
        let mut version = self.state.version.clone();
        change(&mut version.edits);
        if version.edits == self.state.version.edits {
            return;
        }
        version.anchor = match self.state.reach {
            Reach::FromStart => None,
            Reach::FromHere => self.anchor_here(),
        };
        self.change(version);
    }

    /// The camera is edited: what it reaches is known from the frames' keys, so nothing need be held.
    pub(super) fn edit_camera(&mut self, path: &str, camera: serde_json::Value) {
        let mut version = self.state.version.clone();
        match self.planning.unedited_camera.as_ref() == Some(&camera) {
            true => version.edits.reset(path),
            false => version.edits.set(path, camera),
        }
        self.change(version);
    }

    /// The frame that is shown, or the last before it that there is. Frame 0 is made by the settings
    /// alone, so there is nothing to go on from.
    fn anchor_here(&self) -> Option<Anchor> {
        let frame =
            self.frames.timeline.nearest_before(self.state.playback.current).filter(|&f| f > 0)?;
        let slot = self.frames.timeline.slot(frame)?;
        let keys = self.frames.timeline.keys().into_iter().take(frame as usize + 1).collect();
        Some(Anchor { frame, key: slot.key, keys: Arc::new(keys) })
    }

    /// Puts a version into force that can be undone.
    pub(super) fn change(&mut self, version: Version) {
        if version == self.state.version {
            return;
        }
        if self.open.plan.is_none() && self.planning.awaited.is_none() {
            let text = "this is a finished run: open its shot to change settings";
            self.state.say(Level::Note, text);
            return;
        }
        self.state.history.note(self.state.version.clone());
        self.enforce(version);
    }

    /// What is in work goes on until the plan is there: it may be just what is wanted.
    fn enforce(&mut self, version: Version) {
        self.state.version = version;
        self.state.dragged_camera = None;
        self.planning.tried.push(self.standing());
        // A change while something is opened, or saved, is one of what that comes to.
        match self.planning.awaited.take() {
            Some(Awaited { source, occasion, saved, .. }) => self.ask(source, occasion, saved),
            None => self.ask(self.open.source.clone(), Occasion::Change, None),
        }
    }

    pub(super) fn standing(&self) -> Standing {
        Standing { version: self.state.version.clone(), history: self.state.history.clone() }
    }

    /// Opens something else, with no edits yet.
    pub(super) fn open_with(&mut self, source: Source) {
        self.state.version = Version::default();
        self.planning.opening_failure = None;
        self.planning.tried.clear();
        self.ask(source, Occasion::Opening, None);
    }

    /// `saved` is what has just been written.
    pub(super) fn ask(&mut self, source: Source, occasion: Occasion, saved: Option<Saved>) {
        let edits = self.state.version.edits.clone();
        let base = saved.as_ref().or(self.open.saved.as_ref());
        let (from, edits, unread) = match (&source, base) {
            (Source::Shot(request), Some(base)) if occasion == Occasion::Change => {
                // As written, it has the hash of the file.
                let (text, edits) = match edits == base.edits {
                    true => (base.written.clone(), Edits::none()),
                    false => (base.text.clone(), edits),
                };
                let unread = self.shot_file().filter(|_| saved.is_none());
                (Source::Shot(Request { text: Some(text), ..request.clone() }), edits, unread)
            }
            _ => (source.clone(), edits, None),
        };
        let request = self.planning.planner.open(from, edits, unread);
        self.planning.awaited =
            Some(Awaited { request, source, occasion, saved, follows_refusal: false });
    }

    /// The open shot's file, as plans call it.
    pub(super) fn shot_file(&self) -> Option<PathBuf> {
        let Source::Shot(request) = &self.open.source else { return None };
        request.shot.as_deref().map(|shot| joined(Path::new(""), shot))
    }

    /// The edits that are in the file already.
    fn saved_edits(&self) -> &Edits {
        static NONE: Edits = Edits::none();
        let saved = match &self.planning.awaited {
            // What is being read counts from what it will be.
            Some(awaited) if awaited.occasion != Occasion::Change => None,
            Some(awaited) => awaited.saved.as_ref().or(self.open.saved.as_ref()),
            None => self.open.saved.as_ref(),
        };
        saved.map_or(&NONE, |saved| &saved.edits)
    }

    /// Whether a setting is otherwise than in the file.
    pub fn is_unsaved(&self, path: &str) -> bool {
        self.state.version.edits.get(path) != self.saved_edits().get(path)
    }

    /// Whether there are edits that are not in the file.
    pub fn has_unsaved_edits(&self) -> bool {
        self.state.version.edits != *self.saved_edits()
    }

    /// All settings of what is open.
    fn resolved(&self) -> Option<&Value> {
        let of_run = || self.open.run.as_ref().map(|run| &run.info().settings);
        self.open.plan.as_ref().map(|plan| plan.resolved()).or_else(of_run)
    }

    /// Finds in what A and B differ, after either has changed.
    pub(super) fn compare_settings(&mut self) {
        let Some(a) = &self.state.a else { return self.showing.differences.clear() };
        let tuned = self.open.plan.as_ref().map(|plan| {
            let requested = &plan.requested;
            let of_a = Said { written: &a.written, edits: &a.version.edits };
            let of_b = Said { written: &requested.written, edits: &self.state.version.edits };
            tuned_differences(of_a, of_b, &parameters(&requested.written, &requested.scene))
        });
        let tuned = tuned.unwrap_or_default();
        self.showing.differences = match self.resolved() {
            // They may differ in what no slider shows.
            Some(b) if tuned.is_empty() => differences(&a.resolved, b),
            _ => tuned,
        };
    }

    /// The settings in which B, what is in force, differs from A; none without an A.
    pub fn differences(&self) -> &[Difference] {
        &self.showing.differences
    }

    fn keep_as_a(&mut self) {
        let scenery = self.open.scenery.as_ref();
        self.state.a = Some(Remembered {
            version: self.state.version.clone(),
            keys: self.frames.timeline.keys(),
            camera: scenery.and_then(|scenery| scenery.camera.clone()),
            anticipation: scenery.map_or(0.0, |scenery| scenery.anticipation()),
            settings_hash: scenery.map_or_else(String::new, |s| s.settings_hash.clone()),
            resolved: Arc::new(self.resolved().cloned().unwrap_or_default()),
            written: Arc::new(
                self.open.plan.as_ref().map(|p| p.requested.written.clone()).unwrap_or_default(),
            ),
        });
        self.compare_settings();
        self.showing.of_a = None;
        self.refresh_shown();
    }
}
