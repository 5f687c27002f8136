//! What the previewer shows and how it is set: plain data, changed by [actions](super::Action) only.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::action::{Action, Reach};
use super::history::{History, Version};
use super::key::FrameKey;
use super::navigate::EyeAndTarget;
use crate::shot::CameraPath;

/// See the module.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub playback: Playback,
    pub look: Look,
    /// `None`: found by itself.
    pub witness: Option<EyeAndTarget>,
    /// What is in force, and what was and may be again.
    pub version: Version,
    pub history: History,
    pub reach: Reach,
    /// What B is compared with.
    pub a: Option<Remembered>,
    /// Where the wipe between A and B stands, 0..1; `None` shows B alone.
    pub wipe: Option<f64>,
    pub camera_unlocked: bool,
    /// The shot camera while it is dragged; a key takes it over, a step in time drops it.
    pub dragged_camera: Option<EyeAndTarget>,
    pub simulating: bool,
    /// What would lose changed settings, and waits for a word about that.
    pub unsaved: Option<Action>,
    /// What would write over files, and waits for a word about that.
    pub overwriting: Option<Overwriting>,
    pub messages: Vec<Message>,
}

/// Where time stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Playback {
    pub current: u32,
    /// The range that plays, both included.
    pub first: u32,
    pub last: u32,
    pub playing: bool,
    pub looping: bool,
}

/// How frames are shown.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default)]
pub struct Look {
    pub layout: Layout,
    pub colour: ColourMode,
    pub wireframe: bool,
    pub legend: bool,
    /// Crossing faces stand out.
    pub intersections: bool,
    pub safe_areas: bool,
    /// The frustum as it will be at the end of the look-ahead.
    pub ghost: bool,
    pub ground: bool,
    pub parameters_panel: bool,
    pub cost_panel: bool,
    pub help_panel: bool,
    pub files_panel: bool,
    pub save_panel: bool,
    pub export_panel: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            layout: Layout::Both,
            colour: ColourMode::ViewFactor,
            wireframe: true,
            legend: true,
            intersections: false,
            safe_areas: false,
            ghost: true,
            ground: true,
            parameters_panel: true,
            cost_panel: true,
            help_panel: false,
            files_panel: false,
            save_panel: false,
            export_panel: false,
        }
    }
}

impl Look {
    pub fn overlay_mut(&mut self, overlay: Overlay) -> &mut bool {
        match overlay {
            Overlay::Wireframe => &mut self.wireframe,
            Overlay::Legend => &mut self.legend,
            Overlay::Intersections => &mut self.intersections,
            Overlay::SafeAreas => &mut self.safe_areas,
            Overlay::Ghost => &mut self.ghost,
            Overlay::Ground => &mut self.ground,
        }
    }

    pub fn panel_mut(&mut self, panel: PanelName) -> &mut bool {
        match panel {
            PanelName::Parameters => &mut self.parameters_panel,
            PanelName::Costs => &mut self.cost_panel,
            PanelName::Help => &mut self.help_panel,
            PanelName::Files => &mut self.files_panel,
            PanelName::SaveAs => &mut self.save_panel,
            PanelName::Export => &mut self.export_panel,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    #[default]
    Both,
    Shot,
    Witness,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Viewport {
    Shot,
    Witness,
    Both,
}

/// What the colour of the cloth shows.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ColourMode {
    #[default]
    ViewFactor,
    EdgeSize,
    Strain,
    Velocity,
    Plain,
}

impl ColourMode {
    pub const ALL: [Self; 5] =
        [Self::ViewFactor, Self::EdgeSize, Self::Strain, Self::Velocity, Self::Plain];

    pub fn label(self) -> &'static str {
        match self {
            Self::ViewFactor => "View factor",
            Self::EdgeSize => "Edge size",
            Self::Strain => "Strain",
            Self::Velocity => "Velocity",
            Self::Plain => "Plain",
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Overlay {
    Wireframe,
    Legend,
    Intersections,
    SafeAreas,
    Ghost,
    Ground,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PanelName {
    Parameters,
    Costs,
    Help,
    Files,
    SaveAs,
    Export,
}

/// Frames and settings to compare with.
#[derive(Clone, Debug, PartialEq)]
pub struct Remembered {
    pub version: Version,
    /// By frame number.
    pub keys: Vec<Option<FrameKey>>,
    /// The shot camera that they were simulated for.
    pub camera: Option<Arc<CameraPath>>,
    /// The longest look-ahead that they were simulated with (frames).
    pub anticipation: f64,
    pub settings_hash: String,
    /// All settings, with nothing left to defaults.
    pub resolved: Arc<Value>,
    /// What the shot said itself, edits included.
    pub written: Arc<Value>,
}

/// A question before files are written over.
#[derive(Clone, Debug, PartialEq)]
pub struct Overwriting {
    /// What is there, in words.
    pub what: String,
    /// What is done if they may be.
    pub action: Action,
}

/// Something the user should know.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    pub level: Level,
    pub text: String,
    /// When it goes by itself (s, the clock of [`tick`](super::Previewer::tick)), if that is known yet;
    /// only notes do.
    pub until: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Note,
    Warning,
    Error,
}

/// Notes go after so long (s): the time to read two lines.
const NOTE_LASTS: f64 = 10.0;
/// Messages kept; older ones go.
const MESSAGES_KEPT: usize = 20;

impl State {
    /// Whether a question waits for its answer, before which nothing else is done.
    pub fn has_question(&self) -> bool {
        self.unsaved.is_some() || self.overwriting.is_some()
    }

    /// A message that repeats the last one is said once.
    pub fn say(&mut self, level: Level, text: impl Into<String>) {
        let message = Message { level, text: text.into(), until: None };
        let is_last = |last: &&mut Message| last.level == level && last.text == message.text;
        match self.messages.last_mut().filter(is_last) {
            Some(last) => last.until = None,
            None => self.messages.push(message),
        }
        if self.messages.len() > MESSAGES_KEPT {
            let is_error = |message: &Message| message.level == Level::Error;
            let least = self.messages.iter().position(|message| !is_error(message));
            self.messages.remove(least.unwrap_or(0));
        }
    }

    /// Lets notes go that have been there long enough. Returns when the next one does.
    pub(super) fn let_notes_go(&mut self, now: f64) -> Option<f64> {
        for note in self.messages.iter_mut().filter(|message| message.level == Level::Note) {
            note.until.get_or_insert(now + NOTE_LASTS);
        }
        self.messages.retain(|message| message.until.is_none_or(|until| until > now));
        self.messages.iter().filter_map(|message| message.until).reduce(f64::min)
    }

    /// Takes back a message that is not true any more.
    pub(super) fn take_back(&mut self, text: &str) {
        self.messages.retain(|message| message.text != text);
    }
}

impl Playback {
    /// Stands at the start of a shot with frames 0 to `last`.
    pub fn of(last: u32) -> Self {
        Self { last, looping: true, ..Self::default() }
    }

    /// Keeps its place in a shot of another length; a range that was the whole shot stays so.
    pub fn with_last(self, old_last: u32, last: u32) -> Self {
        let kept = if self.last == old_last { last } else { self.last.min(last) };
        Self { current: self.current.min(last), first: self.first.min(kept), last: kept, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_lasts_from_when_it_was_said_last_and_an_error_for_ever() {
        let mut state = State::default();
        state.say(Level::Error, "error");
        state.say(Level::Note, "note");
        assert_eq!(state.let_notes_go(1.0), Some(1.0 + NOTE_LASTS));
        state.say(Level::Note, "note");
        assert_eq!(state.let_notes_go(5.0), Some(5.0 + NOTE_LASTS));
        assert_eq!((state.let_notes_go(14.9), state.messages.len()), (Some(15.0), 2));
        assert_eq!((state.let_notes_go(15.0), state.messages.len()), (None, 1));
        assert_eq!(state.let_notes_go(1e9), None);
        assert_eq!(state.messages[0].text, "error");
    }

    #[test]
    fn of_too_many_messages_errors_stay_longest() {
        let mut state = State::default();
        state.say(Level::Error, "error");
        for number in 0..2 * MESSAGES_KEPT {
            state.say(Level::Warning, format!("warning {number}"));
        }
        assert_eq!(state.messages.len(), MESSAGES_KEPT);
        assert_eq!(state.messages[0].text, "error");
    }
}
