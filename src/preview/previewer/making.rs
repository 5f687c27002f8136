//! The simulation: set to work on what is wanted and not there, halted, and what comes of it.

use std::sync::Arc;

use super::Previewer;
use super::parts::{Failure, Work};
use crate::preview::engine::{Job, JobId};
use crate::preview::key::FrameKey;
use crate::preview::state::Level;
use crate::preview::store::Place;
use crate::preview::timeline::Cost;
use crate::sim::Frame;

impl Previewer {
    /// Sets the engine to work on the first frame that is wanted and not there.
    pub(super) fn pursue(&mut self) {
        if self.planning.awaited.is_some() || self.making.job.is_some() {
            return;
        }
        self.review_failure();
        if !self.state.simulating || self.making.failure.is_some() {
            return;
        }
        let Some(plan) = self.open.plan.clone() else { return };
        let Some((first, frames)) = self.frames.timeline.gap(&self.frames.store) else { return };
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
                self.planning.proved.version.anchor = None;
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

    pub(super) fn is_in_work(&self, job: JobId) -> bool {
        self.making.job.as_ref().is_some_and(|work| work.id == job)
    }

    /// What cannot be simulated is not tried again until settings change or somebody asks.
    pub(super) fn note_failure(&mut self, frame: u32, why: &str) {
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

    /// A failure is one of the frame that is to be made next, or of nothing any more.
    pub(super) fn review_failure(&mut self) {
        let Some(failure) = &self.making.failure else { return };
        let gap = self.frames.timeline.gap(&self.frames.store);
        let next = gap.as_ref().and_then(|(_, frames)| frames.first());
        if next != Some(&failure.key) {
            self.forget_failure();
        }
    }

    pub(super) fn forget_failure(&mut self) {
        if let Some(failure) = self.making.failure.take() {
            self.state.take_back(&failure.said);
        }
    }

    pub(super) fn take_frame(&mut self, job: JobId, key: FrameKey, frame: Arc<Frame>) {
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
        let warned = self.making.warned.entry(kind).or_default();
        if !self.state.messages.iter().any(|message| message.text == warned.said) {
            warned.frames.clear();
        }
        self.state.take_back(&warned.said);
        warned.said = format!("frame {shown}: {warning}");
        match warned.frames.range(..shown).count() {
            0 => {}
            1 => warned.said += " (and a frame before it likewise)",
            before => warned.said += &format!(" (and {before} frames before it likewise)"),
        }
        warned.frames.insert(shown);
        self.state.say(Level::Warning, warned.said.clone());
    }

    /// What was said of frames that are not those of the settings in force any more.
    pub(super) fn take_back_warnings(&mut self) {
        for warned in std::mem::take(&mut self.making.warned).into_values() {
            self.state.take_back(&warned.said);
        }
    }
}
