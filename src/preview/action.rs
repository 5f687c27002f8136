//! Everything a user can do, as plain data: what the panels send, what a script replays, what a test
//! states. Nothing else changes the [state](super::State).

use std::path::PathBuf;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::state::{ColourMode, Layout, Overlay, PanelName, Viewport};

/// See the module. As JSON: `{"go-to": {"frame": 12}}`, `"play"`.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Action {
    // Time.
    Play,
    Pause,
    PlayOrPause,
    /// Forwards or backwards by so many frames.
    Step {
        by: i32,
    },
    GoTo {
        frame: u32,
    },
    /// To the first, or the last, frame of the range that plays.
    GoToStart,
    GoToEnd,
    /// To the camera key before, or after, the current frame.
    GoToKey {
        direction: Direction,
    },
    /// The range that plays begins, or ends, here.
    SetIn {
        frame: u32,
    },
    SetOut {
        frame: u32,
    },
    /// The whole shot plays.
    ClearRange,
    SetLooping {
        on: bool,
    },

    // What is shown.
    SetLayout {
        layout: Layout,
    },
    SetColour {
        colour: ColourMode,
    },
    SetOverlay {
        overlay: Overlay,
        on: bool,
    },
    SetPanel {
        panel: PanelName,
        open: bool,
    },
    /// Where the witness stands and what it looks at (m).
    SetWitness {
        eye: DVec3,
        target: DVec3,
    },
    /// Back to the place that is found by itself.
    ResetWitness,
    /// Puts the cloth of the current frame into the witness's view.
    FrameCloth,

    // Settings.
    /// A setting by its path in the shot file.
    Set {
        path: String,
        value: Value,
    },
    /// Back to what the file says.
    Reset {
        path: String,
    },
    ResetAll,
    /// Whether changes hold from the current frame on or from the start.
    SetReach {
        reach: Reach,
    },
    /// Everything anew from the start, with the settings in force.
    ReRun,
    Undo,
    Redo,
    /// Remembers the frames and settings there are as A.
    KeepAsA,
    /// A on the left, B (what is in force) on the right; the wipe is a share of the width, 0..1.
    Compare {
        wipe: Option<f64>,
    },
    /// What was A comes into force, and what was in force becomes A.
    SwapAAndB,

    // The camera.
    /// Whether moves in the shot's viewport move the shot camera.
    UnlockCamera {
        on: bool,
    },
    /// The camera as it is dragged, at the current frame; no frame is computed for it.
    MoveCamera {
        eye: DVec3,
        target: DVec3,
    },
    /// A key at the current frame where the camera is: dragged, or on its path.
    SetKey,
    DeleteKey {
        frame: f64,
    },
    MoveKey {
        from: f64,
        to: f64,
    },
    SetCut {
        frame: f64,
        cut: bool,
    },
    /// Focal length (mm), at a frame, which gets a key if it has none, or for the whole path.
    SetFocalLength {
        frame: Option<f64>,
        focal_mm: f64,
    },
    /// Vertical field of view (degrees), likewise.
    SetFieldOfView {
        frame: Option<f64>,
        degrees: f64,
    },
    /// A baked camera becomes one with a key every so many frames.
    MakeKeys {
        every: u32,
    },

    // The simulation.
    Simulate {
        on: bool,
    },
    /// Simulates the shot for nobody in particular, to see what the camera saves.
    MeasureAdaptive {
        on: bool,
    },

    // Files.
    Open {
        path: PathBuf,
    },
    /// The shot that comes with the program.
    OpenOwn,
    Reload,
    /// The files that have changed stay as they were read.
    IgnoreChanges,
    Save,
    SaveAs {
        path: PathBuf,
        /// Whether another file of that name is written over without a question.
        #[serde(default)]
        overwrite: bool,
    },
    Export {
        export: Export,
    },
    CancelExport,

    // The program.
    SetMemory {
        megabytes: u64,
    },
    /// Size of text and controls, 0.5 to 3.
    SetScale {
        scale: f32,
    },
    /// The message of this text.
    DismissMessage {
        text: String,
    },
    DismissAll,
    Quit,
    /// Whether an action that would write over files is to be done all the same.
    WriteOver {
        yes: bool,
    },
    /// Saves changed settings, then does what would have lost them.
    SaveFirst,
    /// Whether an action that would lose changed settings is to be done all the same.
    GiveUpEdits {
        yes: bool,
    },
}

impl Action {
    /// Whether it builds upon the plan in force: a camera as it is, settings as they are proved.
    pub fn needs_the_plan(&self) -> bool {
        matches!(
            self,
            Self::SetKey
                | Self::DeleteKey { .. }
                | Self::MoveKey { .. }
                | Self::SetCut { .. }
                | Self::SetFocalLength { .. }
                | Self::SetFieldOfView { .. }
                | Self::MakeKeys { .. }
                | Self::Reload
                | Self::SaveFirst
                | Self::Save
                | Self::SaveAs { .. }
        )
    }

    /// Whether it is about the settings or frames of what is open, which something else must not get
    /// that is being opened.
    pub fn is_about_what_is_open(&self) -> bool {
        matches!(
            self,
            Self::Set { .. }
                | Self::Reset { .. }
                | Self::ResetAll
                | Self::ReRun
                | Self::Undo
                | Self::Redo
                | Self::KeepAsA
                | Self::SwapAAndB
        ) || self.needs_the_plan()
    }

    /// Whether changed settings that are not saved are lost with it.
    pub fn gives_up_edits(&self) -> bool {
        matches!(self, Self::Open { .. } | Self::OpenOwn | Self::Quit)
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    Back,
    Forward,
}

/// From where a change of settings holds.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reach {
    /// The frame that is shown stays; those after it are made with the new settings.
    #[default]
    FromHere,
    FromStart,
}

/// What is to be written, and where.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Export {
    pub kind: ExportKind,
    pub viewport: Viewport,
    /// Width of a picture (px).
    pub width: u32,
    /// Shot, frame, lens and settings in a strip under the picture.
    pub burn_in: bool,
    pub to: PathBuf,
    /// Whether files of its names are written over without a question.
    #[serde(default)]
    pub overwrite: bool,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExportKind {
    /// The current frame as PNG.
    Still,
    /// The range that plays, as one page.
    Sheet,
    /// The range that plays, a PNG a frame, into a folder.
    Sequence,
    /// The range that plays, as a film.
    Video,
    /// From the first frame to the end of the range, as a run folder, for `render`, `sheet` and
    /// `compare`.
    Run,
}
