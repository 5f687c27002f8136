//! Frames: made by the engine, kept by the keeper, shown where they belong.

use std::sync::Arc;

use super::Previewer;
use super::parts::{Failure, Frames, Work};
use crate::preview::engine::{Job, JobId};
use crate::preview::key::FrameKey;
use crate::preview::message::Event;
use crate::preview::state::Level;
use crate::preview::store::Place;
use crate::preview::timeline::Cost;
use crate::sim::Frame;

/// Frames on disk are read ahead until they fill this share of the memory, so that costs are known
/// and scrubbing is immediate.
const READ_AHEAD_SHARE: f64 = 0.8;

impl Previewer {
    pub(super) fn take(&mut self, event: Event) {
        match event {
            Event::Planned { request, opened } => self.take_plan(request, opened),
            Event::FilesChanged { paths } => {
                self.watched.changed.extend(paths);
                self.watched.changed.sort();
                self.watched.changed.dedup();
            }
            Event::Simulated { job, key, frame } => self.take_frame(job, key, frame),
            Event::Finished { job } if self.is_in_work(job) => {
                self.making.job = None;
                self.pursue();
            }
            Event::Finished { .. } => {}
            Event::Failed { job, frame, why } if self.is_in_work(job) => {
                self.making.job = None;
                self.note_failure(frame, &why);
            }
            Event::Failed { .. } => {}
            Event::Rival(event) => self.take_rival(*event),
            Event::Loaded { key, frame } => self.take_loaded(key, frame),
            Event::Found { keys } => self.take_found(keys),
            Event::Kept { key } => self.frames.store.note_on_disk(key),
            Event::CannotKeep { why } => {
                self.frames.has_kept_failure = true;
                self.frames.store.note_disk_full();
                let text = format!("frames are not kept beyond the end of the program: {why}");
                self.state.say(Level::Warning, text);
            }
        }
    }

    /// Holds the timeline against the plan, after either or the store has changed.
    pub(super) fn refresh(&mut self) {
        if let Some(plan) = &self.open.plan {
            self.frames.timeline.follow(
                plan,
                self.state.version.anchor.as_ref(),
                &self.frames.store,
            );
        }
        self.note_costs_at_hand();
        self.refresh_shown();
    }

    /// What frames in memory cost, they tell themselves.
    pub(super) fn note_costs_at_hand(&mut self) {
        let Frames { timeline, store, .. } = &mut self.frames;
        for number in 0..timeline.len() as u32 {
            let unknown = timeline.slot(number).filter(|slot| slot.cost.is_none());
            let Some(key) = unknown.map(|slot| slot.key) else { continue };
            if let Place::Memory(frame) = store.find(key) {
                timeline.note_cost(key, Cost::of(&frame));
            }
        }
    }

    /// Sets the engine to work on the first frame that is wanted and not there.
    pub(super) fn pursue(&mut self) {
        if !self.state.simulating || self.making.job.is_some() || self.planning.awaited.is_some() {
            return;
        }
        let Some(plan) = self.open.plan.clone() else { return };
        let gap = self.frames.timeline.gap(&self.frames.store);
        let next = gap.as_ref().and_then(|(_, frames)| frames.first());
        if self.making.failure.as_ref().is_some_and(|failure| Some(&failure.key) == next) {
            return;
        }
        self.forget_failure();
        let Some((first, frames)) = gap else { return };
        let start = match first.checked_sub(1) {
            None => None,
            Some(before) => match self.start_frame(before) {
                Some(frame) => Some(frame),
                // It is being read, or nothing can be made from it.
                None => return,
            },
        };
        let scene = plan.requested.scene.clone();
        let keys = frames.clone();
        let job = Job { scene, settings: plan.settings(), start, frames };
        self.making.job = Some(Work { id: self.making.engine.begin(job), keys });
    }

    /// What cannot be simulated is not tried again until settings change or somebody asks.
    fn note_failure(&mut self, frame: u32, why: &str) {
        let shown = self.open.scenery.as_ref().map_or(0, |s| s.shown(frame));
        let why = why.strip_prefix(&format!("frame {frame}: ")).unwrap_or(why);
        let said = format!(
            "frame {shown} cannot be simulated with these settings: {why}. Undo or change them, or \
             Simulate (S) to try again"
        );
        self.state.say(Level::Error, said.clone());
        self.making.failure =
            self.frames.timeline.wanted(frame).map(|key| Failure { frame, key, said });
    }

    pub(super) fn forget_failure(&mut self) {
        if let Some(failure) = self.making.failure.take() {
            self.state.take_back(&failure.said);
        }
    }

    fn is_in_work(&self, job: JobId) -> bool {
        self.making.job.as_ref().is_some_and(|work| work.id == job)
    }

    /// Ends a job that does not make just what is to be made next.
    pub(super) fn end_stale_job(&mut self) {
        let Some(work) = &self.making.job else { return };
        let gap = self.frames.timeline.gap(&self.frames.store);
        let wanted = gap.map_or(Vec::new(), |(_, frames)| frames);
        let is_wanted = !wanted.is_empty()
            && work.keys.len() >= wanted.len()
            && work.keys.iter().rev().zip(wanted.iter().rev()).all(|(a, b)| a == b);
        if !is_wanted {
            self.halt();
        }
    }

    /// Ends the job in work within a step.
    pub(super) fn halt(&mut self) {
        self.making.engine.stop();
        self.making.job = None;
    }

    /// The frame to go on from, if it is at hand.
    fn start_frame(&mut self, number: u32) -> Option<Arc<Frame>> {
        let anchor = self.state.version.anchor.as_ref().filter(|anchor| anchor.frame == number);
        let key =
            anchor.map(|anchor| anchor.key).or_else(|| self.frames.timeline.wanted(number))?;
        match self.frames.store.find(key) {
            Place::Memory(frame) => Some(frame),
            Place::Disk => {
                self.load(key, number);
                None
            }
            Place::Nowhere => {
                // Only an anchor can be lost: all else is made again.
                self.state.version.anchor = None;
                self.state.say(Level::Warning, "the frame to go on from is lost: from the start");
                self.refresh();
                self.pursue();
                None
            }
        }
    }

    pub(super) fn simulate(&mut self, on: bool) {
        self.state.simulating = on;
        if on {
            self.forget_failure();
            self.pursue();
        } else {
            self.halt();
        }
    }

    fn take_frame(&mut self, job: JobId, key: FrameKey, frame: Arc<Frame>) {
        self.making.simulated += 1;
        let shown = self.open.scenery.as_ref().map_or(0, |s| s.shown(frame.number));
        for warning in &frame.report.warnings {
            self.warn_of_frame(shown, warning);
        }
        let hash = self.open.plan.as_ref().map_or("", |plan| plan.settings_hash()).to_owned();
        let (number, cost) = (frame.number, Cost::of(&frame));
        self.take_in(key, frame.clone());
        if self.frames.cache.is_some() && !self.frames.has_kept_failure {
            self.frames.store.note_coming(key);
            self.frames.keeper.keep(key, frame);
        }
        self.frames.timeline.put(number, key, &hash, cost);
        self.frames.timeline.note_cost(key, cost);
        if !self.is_in_work(job) {
            // A plan that came meanwhile may want just this frame.
            self.pursue();
        }
        self.refresh_shown();
    }

    /// The same of many frames is said once, of the last of them.
    pub(super) fn warn_of_frame(&mut self, shown: i64, warning: &str) {
        // Frames differ in how many, not in what.
        let kind = warning.replace(|c: char| c.is_ascii_digit(), "");
        let warned = &mut self.making.warned;
        let before = match warned.get(&kind) {
            Some((said, before)) if self.state.messages.iter().any(|m| m.text == *said) => {
                self.state.take_back(said);
                before + 1
            }
            _ => 0,
        };
        let mut said = format!("frame {shown}: {warning}");
        if before > 0 {
            said += &format!(" (and {before} frames before it likewise)");
        }
        self.state.say(Level::Warning, said.clone());
        warned.insert(kind, (said, before));
    }

    /// Into the store; what this pushes out and is nowhere else is gone.
    fn take_in(&mut self, key: FrameKey, frame: Arc<Frame>) {
        let lost = self.frames.store.insert(key, frame);
        self.give_up(&lost);
    }

    /// Frames that are in neither memory nor disk any more.
    fn give_up(&mut self, lost: &[FrameKey]) {
        if lost.is_empty() {
            return;
        }
        lost.iter().for_each(|&key| self.frames.timeline.forget(key));
        // Made again, they would push out others, without end.
        self.simulate(false);
        let megabytes = self.frames.store.budget() >> 20;
        let text = format!(
            "the frames do not fit into {megabytes} MB of memory and cannot be kept on disk: the \
             simulation is halted"
        );
        self.state.say(Level::Warning, text);
    }

    fn take_loaded(&mut self, key: FrameKey, frame: Result<Arc<Frame>, String>) {
        self.frames.loading.remove(&key);
        match frame {
            Ok(frame) => {
                self.frames.timeline.note_cost(key, Cost::of(&frame));
                self.frames.store.note_on_disk(key);
                self.take_in(key, frame);
            }
            Err(why) => {
                let text = self.unreadable(key, &why);
                self.frames.store.note_lost(key);
                self.frames.timeline.forget(key);
                self.state.say(Level::Warning, text);
                self.refresh();
            }
        }
        self.refresh_shown();
        self.pursue();
        if self.frames.loading.is_empty() {
            self.read_ahead();
        }
    }

    /// What is said of a frame that cannot be read: a finished run has no settings to make it again.
    fn unreadable(&self, key: FrameKey, why: &str) -> String {
        let Some(scenery) = self.open.scenery.as_ref().filter(|_| self.open.run.is_some()) else {
            return format!("{why}: the frame is made again");
        };
        let keys = self.frames.timeline.keys();
        let number = keys.iter().position(|&of_frame| of_frame == Some(key));
        let shown = number.map_or("a frame".to_owned(), |number| {
            format!("frame {}", scenery.shown(number as u32))
        });
        format!("{shown} of the run cannot be shown: {why}")
    }

    fn take_found(&mut self, keys: Vec<FrameKey>) {
        keys.iter().for_each(|&key| self.frames.store.note_on_disk(key));
        self.refresh();
        self.end_stale_job();
        self.pursue();
        self.read_ahead();
    }

    /// Asks for the next frame that is on disk alone, while there is room.
    pub(super) fn read_ahead(&mut self) {
        let room = (self.frames.store.budget() as f64 * READ_AHEAD_SHARE) as u64;
        if self.frames.store.used() >= room {
            return;
        }
        let unread = |&number: &u32| {
            let slot = self.frames.timeline.slot(number);
            slot.is_some_and(|slot| !self.frames.store.is_in_memory(slot.key))
        };
        if let Some(number) = (0..self.frames.timeline.len() as u32).find(unread) {
            let key = self.frames.timeline.slot(number).expect("found just now").key;
            self.load(key, number);
        }
    }

    /// Has a frame read, once.
    pub(super) fn load(&mut self, key: FrameKey, number: u32) {
        if !self.frames.loading.insert(key) {
            return;
        }
        match &self.open.run {
            Some(run) => self.frames.keeper.load_of_run(key, run.clone(), number),
            None => self.frames.keeper.load(key),
        }
    }

    pub(super) fn set_memory(&mut self, megabytes: u64) {
        self.set_budget(megabytes.max(1) << 20);
    }

    /// (bytes).
    pub(super) fn set_budget(&mut self, bytes: u64) {
        let lost = self.frames.store.set_budget(bytes);
        self.give_up(&lost);
        self.refresh_shown();
    }
}
