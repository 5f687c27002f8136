//! What has been planned comes into force, be it a change or something else that is opened.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::parts::{Awaited, Occasion};
use super::{Effect, Previewer};
use crate::preview::Plan;
use crate::preview::planner::Opened;
use crate::preview::scenery::Scenery;
use crate::preview::state::{Level, Playback};
use crate::preview::timeline::Timeline;
use crate::run::RunReader;

impl Previewer {
    pub(super) fn take_plan(&mut self, request: u64, opened: Result<Opened, String>) {
        let Some(awaited) = self.planning.awaited.take_if(|awaited| awaited.request == request)
        else {
            // A later one is on its way.
            return;
        };
        match opened {
            Ok(opened) => self.take_opened(opened, awaited),
            Err(why) => self.take_refusal(awaited, why),
        }
        self.act_on_deferred();
    }

    /// Says what is true until a plan can be made.
    pub(super) fn say_until_planned(&mut self, level: Level, text: String) {
        self.state.say(level, text.clone());
        self.planning.refusals.push(text);
    }

    /// Returns to what was in force before, or to a change in between that may be possible.
    fn take_refusal(&mut self, awaited: Awaited, why: String) {
        let Awaited { source, occasion, saved, .. } = awaited;
        let refused = match occasion {
            Occasion::Opening => {
                self.state.say(Level::Error, why.clone());
                self.planning.opening_failure = Some(why);
                None
            }
            Occasion::Change | Occasion::Reading => {
                self.say_until_planned(Level::Error, why);
                self.planning.tried.pop()
            }
        };
        let other = self.planning.tried.last().cloned();
        let is_next = other.is_some() || (refused.is_some() && saved.is_some());
        let standing = other.unwrap_or_else(|| self.planning.proved.clone());
        (self.state.version, self.state.history) = (standing.version, standing.history);
        if is_next {
            self.ask(source, occasion, saved);
            if let Some(awaited) = &mut self.planning.awaited {
                awaited.follows_refusal = true;
            }
            return;
        }
        // It is in the file, whether or not it can be planned now.
        let is_here = source == self.open.source;
        self.open.saved = saved.filter(|_| is_here).or(self.open.saved.take());
        self.pursue();
    }

    fn take_opened(&mut self, opened: Opened, awaited: Awaited) {
        let Awaited { source, occasion, saved, follows_refusal, .. } = awaited;
        let is_new = occasion == Occasion::Opening || self.open.scenery.is_none();
        let is_renamed = self.open.source != source;
        if occasion != Occasion::Change {
            self.planning.unedited_camera = None;
        }
        if occasion != Occasion::Change && self.open.saved.take().is_some() {
            // Versions counted from the text before it was saved.
            self.state.history = Default::default();
            (self.state.a, self.state.wipe) = (None, None);
        }
        self.open.source = source.clone();
        if occasion == Occasion::Opening {
            self.planning.opening_failure = None;
        }
        if !follows_refusal {
            for why in std::mem::take(&mut self.planning.refusals) {
                self.state.take_back(&why);
            }
        }
        // Of a shot that was saved earlier, what it was is planned upon, not what others have made of it.
        let is_kept = occasion == Occasion::Change && saved.is_none() && self.open.saved.is_some();
        let unread = self.shot_file().filter(|_| is_kept);
        self.note_read(is_new, unread.as_deref());
        self.open.saved = saved.or(self.open.saved.take());
        match opened {
            Opened::Shot(plan) => self.follow(Arc::from(plan), is_new),
            Opened::Run(run) => self.show_run(run),
        }
        self.planning.proved = self.standing();
        self.planning.tried.clear();
        if is_new {
            self.effects.push(Effect::Opened(source));
        } else if is_renamed {
            self.effects.push(Effect::Renamed(source));
        }
    }

    /// Files that had changed have been read with the plan.
    fn note_read(&mut self, is_new: bool, unread: Option<&Path>) {
        let is_unread = |path: &PathBuf| Some(path.as_path()) == unread;
        let before = [self.watched.changed.len(), self.watched.ignored.len()];
        self.watched.changed.retain(is_unread);
        self.watched.ignored.retain(is_unread);
        let after = [self.watched.changed.len(), self.watched.ignored.len()];
        if after[1] < before[1] && !is_new {
            let text = "files that had changed on disk were read again with this change";
            self.state.say(Level::Note, text);
        }
        if after != before {
            // It may be another now.
            self.planning.unedited_camera = None;
        }
    }

    fn follow(&mut self, plan: Arc<Plan>, is_new: bool) {
        let scenery = Scenery::of_plan(&plan);
        if is_new {
            self.forget_what_was_open(scenery.last);
            for warning in &plan.requested.warnings {
                self.state.say(Level::Warning, warning.clone());
            }
        } else {
            let before = self.open.scenery.as_ref().map_or(scenery.last, |s| s.last);
            self.state.playback = self.state.playback.with_last(before, scenery.last);
        }
        self.open.scenery = Some(Arc::new(scenery));
        if self.open.plan.as_ref().is_some_and(|before| before.steps != plan.steps) {
            self.take_back_warnings();
        }
        self.open.plan = Some(plan);
        self.open.run = None;
        self.compare_settings();
        self.refresh();
        self.review_failure();
        self.end_stale_job();
        let missing =
            self.frames.timeline.wanted_keys().filter(|&key| !self.frames.store.has(key)).collect();
        // Nothing is simulated that lies on disk: the answer sets the engine to work.
        self.frames.keeper.look(missing);
        self.follow_rival();
    }

    fn show_run(&mut self, run: Arc<RunReader>) {
        let scenery = Scenery::of_run(&run);
        self.forget_what_was_open(scenery.last);
        self.frames.timeline =
            Timeline::of_run(scenery.last, run.frames(), &run.info().input_hash, &identity(&run));
        if let Some(words) = gaps(&run, &scenery) {
            self.state.say(Level::Warning, words);
        }
        self.open.scenery = Some(Arc::new(scenery));
        self.open.plan = None;
        self.open.run = Some(run);
        self.follow_rival();
        self.note_costs_at_hand();
        self.refresh_shown();
        self.read_ahead();
    }

    fn forget_what_was_open(&mut self, last: u32) {
        self.halt();
        self.state.playback = Playback::of(last);
        self.state.history = Default::default();
        (self.state.a, self.state.wipe) = (None, None);
        self.showing.differences.clear();
        self.state.overwriting = None;
        self.state.witness = None;
        self.state.dragged_camera = None;
        self.frames.timeline = Timeline::default();
        self.showing.frame = None;
        self.showing.of_a = None;
        self.showing.played_from = None;
        self.frames.loading.clear();
        self.take_back_warnings();
        self.forget_failure();
    }
}

/// Which frames a run does not have between its first and its last, in words.
fn gaps(run: &RunReader, scenery: &Scenery) -> Option<String> {
    let there = run.frames();
    let first = there.first().copied().unwrap_or(0);
    let is_missing = |frame: &u32| there.binary_search(frame).is_err();
    let missing: Vec<u32> = (first..=scenery.last).filter(is_missing).collect();
    let shown = scenery.shown(*missing.first()?);
    Some(match missing.len() {
        1 => format!("frame {shown} is missing in the run"),
        count => format!("{count} frames are missing in the run, the first is {shown}"),
    })
}

/// What tells a run from all others: where it is, and what made it from what.
fn identity(run: &RunReader) -> String {
    let info = run.info();
    format!("{} {} {}", run.dir().display(), info.program_version, info.input_hash)
}
