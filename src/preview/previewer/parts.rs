//! What a previewer consists of.

use std::collections::{BTreeMap, BTreeSet, HashSet, VecDeque};
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::Value;

#[cfg(doc)]
use super::Previewer;
use super::time::Shown;
use crate::preview::action::Action;
use crate::preview::engine::{Engine, JobId};
use crate::preview::history::{History, Version};
use crate::preview::keeper::Keeper;
use crate::preview::key::FrameKey;
use crate::preview::navigate::EyeAndTarget;
use crate::preview::planner::{Planner, Source};
use crate::preview::scenery::Scenery;
use crate::preview::store::FrameStore;
use crate::preview::timeline::{Cost, Timeline};
use crate::preview::{Difference, Edits, Plan};
use crate::run::RunReader;
use crate::sim::Frame;

/// What is open.
pub(super) struct Open {
    pub source: Source,
    /// `None` while the first shot is being opened, or could not be.
    pub scenery: Option<Arc<Scenery>>,
    /// Of a shot.
    pub plan: Option<Arc<Plan>>,
    /// What is open if it is a finished run.
    pub run: Option<Arc<RunReader>>,
    /// What a shot was before it was saved, so that this can be undone.
    pub saved: Option<Saved>,
}

/// A shot that has been saved since it was read. Versions go on counting from the text without their
/// edits: so those of before stay what they were.
#[derive(Clone)]
pub(super) struct Saved {
    /// Without edits; with what the command line changed.
    pub text: Arc<str>,
    /// As it was written, with its edits.
    pub written: Arc<str>,
    pub edits: Edits,
}

/// From settings to plans.
pub(super) struct Planning {
    pub planner: Planner,
    /// The plan that is awaited, and for what.
    pub awaited: Option<Awaited>,
    /// Why what was to be opened last could not be.
    pub opening_failure: Option<String>,
    /// What was said about plans that could not be made, until one can.
    pub refusals: Vec<String>,
    /// Of the plan that is in force: what is returned to if no other can be.
    pub proved: Standing,
    /// What has been changed to since, in order; a change that cannot be takes none of the others along.
    pub tried: Vec<Standing>,
    /// The shot camera as it was before it was edited: one that is so again is no edit.
    pub unedited_camera: Option<Value>,
    /// What has to wait for a plan, and where the user was when asking for it.
    pub deferred: VecDeque<Deferred>,
}

/// A version, and what can be undone and redone there.
#[derive(Clone, Default)]
pub(super) struct Standing {
    pub version: Version,
    pub history: History,
}

/// What a plan was asked for.
pub(super) struct Awaited {
    pub request: u64,
    pub source: Source,
    pub occasion: Occasion,
    /// What has just been saved, which holds when the plan does.
    pub saved: Option<Saved>,
    /// What it is asked for instead of has just been refused: that stays said.
    pub follows_refusal: bool,
}

/// Why a plan is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Occasion {
    /// Something else is opened.
    Opening,
    /// What is open has been changed or saved.
    Change,
    /// The files of what is open are read again, whatever was saved.
    Reading,
}

/// An action that builds upon the plan in force, asked for while another is awaited.
pub(super) struct Deferred {
    pub action: Action,
    pub current: u32,
    pub dragged_camera: Option<EyeAndTarget>,
}

/// Which frames there are, and where.
pub(super) struct Frames {
    pub timeline: Timeline,
    pub store: FrameStore,
    pub keeper: Keeper,
    /// Where the keeper keeps them.
    pub cache: Option<PathBuf>,
    /// Those that are being read.
    pub loading: HashSet<FrameKey>,
    /// The disk takes no more of them.
    pub has_kept_failure: bool,
}

/// The simulation.
pub(super) struct Making {
    pub engine: Engine,
    pub job: Option<Work>,
    /// What could not be simulated: not tried again until settings change or somebody asks.
    pub failure: Option<Failure>,
    /// The frame in work, and since when (s, the clock of [`Previewer::tick`]).
    pub since: Option<(u32, f64)>,
    /// How long it has been in work (s).
    pub seconds: f64,
    /// Warnings of frames by kind.
    pub warned: BTreeMap<String, Warned>,
    /// Counts the frames that were simulated.
    pub simulated: u64,
}

/// What was said last of frames of one kind, and which they are, as captions count.
#[derive(Default)]
pub(super) struct Warned {
    pub said: String,
    pub frames: BTreeSet<i64>,
}

/// A frame that could not be simulated.
pub(super) struct Failure {
    pub frame: u32,
    pub key: FrameKey,
    pub said: String,
}

/// What the engine has been told to make.
pub(super) struct Work {
    pub id: JobId,
    pub keys: Vec<FrameKey>,
}

/// A second simulation of the shot, whoever looks: for its costs alone.
pub(super) struct Rival {
    pub engine: Engine,
    pub job: Option<JobId>,
    pub costs: Vec<Option<Cost>>,
    /// Of the frames that the costs are those of.
    pub keys: Vec<FrameKey>,
    pub on: bool,
}

/// What is to be seen.
#[derive(Default)]
pub(super) struct Showing {
    pub frame: Option<Shown>,
    /// What A has, and of which frame.
    pub of_a: Option<(u32, Arc<Frame>)>,
    /// Settings in which A and B differ.
    pub differences: Vec<Difference>,
    /// When playback began, and at which frame.
    pub played_from: Option<(f64, u32)>,
}

/// Files that were read, and have changed on disk since.
#[derive(Default)]
pub(super) struct Watched {
    pub changed: Vec<PathBuf>,
    /// Those of them that the user would not have read again.
    pub ignored: Vec<PathBuf>,
}
