//! The previewer at work: the state, and the threads that plan, simulate and keep for it.
//!
//! Three calls drive it, all of which return at once: [`Previewer::act`] does what a user asks,
//! [`Previewer::receive`] takes in what the threads have done, [`Previewer::tick`] moves time on.

mod camera;
mod files;
mod frames;
mod making;
mod opening;
mod parts;
mod rival;
mod settings;
mod time;

use std::collections::{BTreeMap, HashSet, VecDeque};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use super::Plan;
use super::action::{Action, Export};
use super::engine::Engine;
use super::keeper::Keeper;
use super::message::{Event, Outbox, Wake};
use super::navigate::EyeAndTarget;
use super::planner::{Planner, Source};
use super::reader::FrameReader;
use super::scenery::Scenery;
use super::state::{Level, Look, Overwriting, State};
use super::store::FrameStore;
use super::timeline::{Cost, Timeline};
use crate::run::RunInfo;

pub use time::Shown;

use parts::{
    Deferred, Frames, Making, Occasion, Open, Planning, Rival, Showing, Standing, Watched,
};

/// How a previewer begins.
pub struct Start {
    pub source: Source,
    pub look: Look,
    /// Where frames are kept; `None` keeps none beyond the program's end.
    pub cache: Option<PathBuf>,
    /// Memory for frames (bytes).
    pub memory: u64,
    /// Whether to simulate without being asked.
    pub simulating: bool,
    pub wake: Wake,
}

/// What an action asks of whoever owns windows and pictures.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    Export(Export),
    CancelExport,
    /// Size of text and controls.
    Scale(f32),
    /// Puts the cloth of the current frame into the witness's view.
    FrameCloth,
    /// Something else is open: for the window's title and the list of recent files.
    Opened(Source),
    /// What is open has changed its name.
    Renamed(Source),
    Quit,
}

/// See the module.
pub struct Previewer {
    state: State,
    open: Open,
    planning: Planning,
    frames: Frames,
    making: Making,
    rival: Rival,
    showing: Showing,
    watched: Watched,
    /// What the threads have done.
    events: Receiver<Event>,
    /// What is asked of others.
    effects: Vec<Effect>,
}

impl Previewer {
    /// Opens what it is told to; that, too, happens in the background.
    pub fn start(start: Start) -> Self {
        let (outbox, events) = Outbox::new(start.wake);
        let mut previewer = Self {
            state: State { look: start.look, simulating: start.simulating, ..State::default() },
            open: Open {
                source: start.source.clone(),
                scenery: None,
                plan: None,
                run: None,
                saved: None,
            },
            planning: Planning {
                planner: Planner::start(outbox.clone()),
                awaited: None,
                opening_failure: None,
                refusals: Vec::new(),
                proved: Standing::default(),
                tried: Vec::new(),
                unedited_camera: None,
                deferred: VecDeque::new(),
            },
            frames: Frames {
                timeline: Timeline::default(),
                store: FrameStore::new(start.memory),
                keeper: Keeper::start(start.cache.clone(), outbox.clone()),
                cache: start.cache,
                loading: HashSet::new(),
                has_kept_failure: false,
            },
            making: Making {
                engine: Engine::start("simulation", outbox.clone()),
                job: None,
                failure: None,
                since: None,
                seconds: 0.0,
                warned: BTreeMap::new(),
                simulated: 0,
            },
            rival: Rival {
                engine: Engine::start("adaptive", outbox.for_rival()),
                job: None,
                costs: Vec::new(),
                keys: Vec::new(),
                on: false,
            },
            showing: Showing::default(),
            watched: Watched::default(),
            events,
            effects: Vec::new(),
        };
        previewer.ask(start.source, Occasion::Opening, None);
        previewer
    }

    /// Does what a user asks. Returns at once; what takes time is done by a thread, and what builds upon
    /// a plan that is not there yet is done when it is.
    pub fn act(&mut self, action: Action) {
        let is_early = match &self.planning.awaited {
            None => false,
            Some(awaited) if awaited.occasion == Occasion::Change => action.needs_the_plan(),
            Some(_) => action.is_about_what_is_open(),
        };
        if is_early {
            let (current, dragged_camera) =
                (self.state.playback.current, self.state.dragged_camera);
            self.planning.deferred.push_back(Deferred { action, current, dragged_camera });
            return;
        }
        if action.gives_up_edits() && self.has_unsaved_edits() {
            self.state.unsaved = Some(action);
            return;
        }
        self.carry_out(action);
    }

    /// What was deferred, until one of it asks for a plan again.
    fn act_on_deferred(&mut self) {
        while self.planning.awaited.is_none()
            && let Some(deferred) = self.planning.deferred.pop_front()
        {
            let now = (self.state.playback.current, self.state.dragged_camera);
            (self.state.playback.current, self.state.dragged_camera) =
                (deferred.current, deferred.dragged_camera);
            self.carry_out(deferred.action);
            (self.state.playback.current, self.state.dragged_camera) = now;
        }
    }

    fn carry_out(&mut self, action: Action) {
        match action {
            Action::Play
            | Action::Pause
            | Action::PlayOrPause
            | Action::Step { .. }
            | Action::GoTo { .. }
            | Action::GoToStart
            | Action::GoToEnd
            | Action::GoToKey { .. }
            | Action::SetIn { .. }
            | Action::SetOut { .. }
            | Action::ClearRange
            | Action::SetLooping { .. } => self.act_on_time(action),

            Action::Set { .. }
            | Action::Reset { .. }
            | Action::ResetAll
            | Action::SetReach { .. }
            | Action::ReRun
            | Action::Undo
            | Action::Redo
            | Action::KeepAsA
            | Action::Compare { .. }
            | Action::SwapAAndB => self.act_on_settings(action),

            Action::UnlockCamera { .. }
            | Action::MoveCamera { .. }
            | Action::SetKey
            | Action::DeleteKey { .. }
            | Action::MoveKey { .. }
            | Action::SetCut { .. }
            | Action::SetFocalLength { .. }
            | Action::SetFieldOfView { .. }
            | Action::MakeKeys { .. } => self.act_on_camera(action),

            Action::Open { .. }
            | Action::OpenOwn
            | Action::Reload
            | Action::IgnoreChanges
            | Action::SaveFirst
            | Action::Save
            | Action::SaveAs { .. } => self.act_on_files(action),

            Action::SetLayout { .. }
            | Action::SetColour { .. }
            | Action::SetOverlay { .. }
            | Action::SetPanel { .. }
            | Action::SetWitness { .. }
            | Action::ResetWitness
            | Action::FrameCloth
            | Action::SetScale { .. } => self.act_on_looks(action),

            Action::Simulate { on } => self.simulate(on),
            Action::MeasureAdaptive { on } => self.measure_adaptive(on),
            Action::SetMemory { megabytes } => self.set_memory(megabytes),
            Action::Export { export } => self.effects.push(Effect::Export(export)),
            Action::CancelExport => self.effects.push(Effect::CancelExport),
            Action::Quit => self.effects.push(Effect::Quit),

            Action::DismissMessage { .. }
            | Action::DismissAll
            | Action::WriteOver { .. }
            | Action::GiveUpEdits { .. } => self.act_on_words(action),
        }
    }

    /// What is shown, and how.
    fn act_on_looks(&mut self, action: Action) {
        let look = &mut self.state.look;
        match action {
            Action::SetLayout { layout } => look.layout = layout,
            Action::SetColour { colour } => look.colour = colour,
            Action::SetOverlay { overlay, on } => *look.overlay_mut(overlay) = on,
            Action::SetPanel { panel, open } => *look.panel_mut(panel) = open,
            Action::SetWitness { eye, target } => {
                self.state.witness = Some(EyeAndTarget { eye, target });
            }
            Action::ResetWitness => self.state.witness = None,
            Action::FrameCloth => self.effects.push(Effect::FrameCloth),
            Action::SetScale { scale } => self.effects.push(Effect::Scale(scale)),
            other => unreachable!("{other:?} is about other things"),
        }
    }

    /// What has been said, and what has been asked.
    fn act_on_words(&mut self, action: Action) {
        match action {
            Action::DismissMessage { text } => self.state.take_back(&text),
            Action::DismissAll => self.state.messages.clear(),
            Action::WriteOver { yes } => {
                if let Some(asked) = self.state.overwriting.take().filter(|_| yes) {
                    self.act(asked.action);
                }
            }
            Action::GiveUpEdits { yes } => {
                if let Some(action) = self.state.unsaved.take().filter(|_| yes) {
                    self.carry_out(action);
                }
            }
            other => unreachable!("{other:?} is about other things"),
        }
    }

    /// Takes in what the threads have done; true if anything was.
    pub fn receive(&mut self) -> bool {
        let mut any = false;
        while let Ok(event) = self.events.try_recv() {
            any = true;
            self.take(event);
        }
        any
    }

    /// What actions have asked of others since the last call.
    pub fn take_effects(&mut self) -> Vec<Effect> {
        std::mem::take(&mut self.effects)
    }

    pub fn state(&self) -> &State {
        &self.state
    }

    /// `None` while the first shot is being opened, or could not be.
    pub fn scenery(&self) -> Option<&Arc<Scenery>> {
        self.open.scenery.as_ref()
    }

    /// `None` for a run, which nothing can be changed about.
    pub fn plan(&self) -> Option<&Arc<Plan>> {
        self.open.plan.as_ref()
    }

    pub fn source(&self) -> &Source {
        &self.open.source
    }

    pub fn timeline(&self) -> &Timeline {
        &self.frames.timeline
    }

    pub fn store(&self) -> &FrameStore {
        &self.frames.store
    }

    /// Whether frames are being made.
    pub fn is_working(&self) -> bool {
        self.making.job.is_some()
    }

    /// The frame that is being made.
    pub fn in_work(&self) -> Option<u32> {
        self.making.job.as_ref()?;
        self.frames.timeline.first_gap(&self.frames.store)
    }

    /// How long that frame has been in work (s).
    pub fn seconds_in_work(&self) -> f64 {
        self.making.seconds
    }

    /// The frame that could not be simulated.
    pub fn failed_frame(&self) -> Option<u32> {
        self.making.failure.as_ref().map(|failure| failure.frame)
    }

    /// Whether frames are wanted that nobody has made, and nobody is to make.
    pub fn is_halted(&self) -> bool {
        let is_wanted = || self.frames.timeline.first_gap(&self.frames.store).is_some();
        self.open.plan.is_some() && !self.state.simulating && is_wanted()
    }

    /// Whether who simulates or halts simulates: where a frame could not be, that is tried again.
    pub fn would_simulate(&self) -> bool {
        !self.state.simulating || self.failed_frame().is_some()
    }

    /// Whether something is being opened.
    pub fn is_opening(&self) -> bool {
        self.planning.awaited.is_some()
    }

    /// Why what was to be opened last could not be; `None` if it is open, or still being opened.
    pub fn opening_failure(&self) -> Option<&str> {
        self.planning.opening_failure.as_deref()
    }

    /// Whether frames are being read.
    pub fn is_loading(&self) -> bool {
        !self.frames.loading.is_empty()
    }

    /// Frames simulated since the program began.
    pub fn simulated(&self) -> u64 {
        self.making.simulated
    }

    /// Costs of the adaptive run, by frame; empty unless asked for.
    pub fn rival_costs(&self) -> &[Option<Cost>] {
        &self.rival.costs
    }

    /// Whether the adaptive run is asked for, and whether it is going on.
    pub fn rival(&self) -> (bool, bool) {
        (self.rival.on, self.rival.job.is_some())
    }

    /// Files that have changed on disk since they were read.
    pub fn changed_files(&self) -> &[PathBuf] {
        &self.watched.changed
    }

    /// For threads that may wait: the frames that the timeline has now.
    pub fn frame_reader(&self) -> FrameReader {
        FrameReader {
            held: self.frames.store.held(self.frames.timeline.keys().into_iter().flatten()),
            folder: self.frames.cache.clone(),
            run: self.open.run.clone(),
        }
    }

    /// How a run of what is open begins.
    pub fn run_info(&self) -> Option<RunInfo> {
        let of_run = || self.open.run.as_ref().map(|run| run.info().clone());
        self.open.plan.as_ref().map(|plan| plan.requested.info.clone()).or_else(of_run)
    }

    /// Has the user asked before files are written over; `action` is what then does so.
    pub fn ask_before_overwriting(&mut self, what: String, action: Action) {
        self.state.overwriting = Some(Overwriting { what, action });
    }

    /// A message from whoever draws or writes.
    pub fn say(&mut self, level: Level, text: impl Into<String>) {
        self.state.say(level, text);
    }
}

#[cfg(test)]
pub(super) mod tests;
