//! What the threads have done, and frames: kept, found, read and given up.

use std::sync::Arc;

use super::Previewer;
use super::parts::Frames;
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

    /// Into the store; what this pushes out and is nowhere else is gone.
    pub(super) fn take_in(&mut self, key: FrameKey, frame: Arc<Frame>) {
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
        if !self.frames.loading.remove(&key) {
            // Something else has been opened since.
            return;
        }
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
