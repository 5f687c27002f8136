//! Time: playing, stepping, and which frame is to be seen.

use std::sync::Arc;

use super::Previewer;
use crate::preview::action::{Action, Direction};
use crate::preview::state::Playback;
use crate::preview::store::Place;
use crate::sim::Frame;

/// Frames that are read ahead of the one shown.
const AHEAD: u32 = 24;

/// The frame to be seen.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Which the cloth is of: the current one, or the last before it that there is.
    pub number: u32,
    pub frame: Arc<Frame>,
}

impl Previewer {
    pub(super) fn act_on_time(&mut self, action: Action) {
        let Playback { current, first, last, playing, .. } = self.state.playback;
        match action {
            Action::Play => self.play(),
            Action::Pause => self.pause(),
            Action::PlayOrPause if playing => self.pause(),
            Action::PlayOrPause => self.play(),
            Action::Step { by } => {
                self.pause();
                self.go_to(current.saturating_add_signed(by));
            }
            Action::GoTo { frame } => self.go_to(frame),
            Action::GoToStart => self.go_to(first),
            Action::GoToEnd => self.go_to(last),
            Action::GoToKey { direction } => {
                if let Some(frame) = self.key_beside(current, direction) {
                    self.pause();
                    self.go_to(frame);
                }
            }
            Action::SetIn { frame } => {
                let frame = frame.min(self.frames.timeline.last());
                self.state.playback.first = frame;
                self.state.playback.last = last.max(frame);
            }
            Action::SetOut { frame } => {
                let frame = frame.min(self.frames.timeline.last());
                self.state.playback.last = frame;
                self.state.playback.first = first.min(frame);
            }
            Action::ClearRange => {
                self.state.playback.first = 0;
                self.state.playback.last = self.frames.timeline.last();
            }
            Action::SetLooping { on } => self.state.playback.looping = on,
            other => unreachable!("{other:?} is about other things"),
        }
    }

    /// Moves playback on to a time (s, of any clock that runs evenly), and lets notes go; returns when
    /// to come again.
    pub fn tick(&mut self, now: f64) -> Option<f64> {
        let in_work = self.in_work();
        if self.making.since.map(|(frame, _)| frame) != in_work {
            self.making.since = in_work.map(|frame| (frame, now));
        }
        self.making.seconds = self.making.since.map_or(0.0, |(_, since)| now - since);
        let next = [self.play_on(now), self.state.let_notes_go(now)];
        next.into_iter().flatten().reduce(f64::min)
    }

    fn play_on(&mut self, now: f64) -> Option<f64> {
        if !self.state.playback.playing {
            return None;
        }
        let fps = self.open.scenery.as_ref()?.fps;
        let (since, from) =
            *self.showing.played_from.get_or_insert((now, self.state.playback.current));
        let Playback { first, last, looping, .. } = self.state.playback;
        let end = self.playable_end();
        // A clock that jumps back stands still.
        let passed = ((now - since).max(0.0) * fps).floor();
        let target = f64::from(from) + passed;
        if target <= f64::from(end) {
            self.show(target as u32);
            return Some(since + (passed + 1.0) / fps);
        }
        if end < last {
            // The frames after it are not there yet: time waits for them.
            self.show(end);
            self.showing.played_from = Some((now, end));
            return Some(now + 1.0 / fps);
        }
        if looping && end > first {
            let turn = f64::from(last - first + 1);
            let place = (f64::from(from) - f64::from(first) + passed).rem_euclid(turn);
            self.show(first + place as u32);
            return Some(since + (passed + 1.0) / fps);
        }
        self.show(end);
        self.pause();
        None
    }

    pub fn shown(&self) -> Option<&Shown> {
        self.showing.frame.as_ref()
    }

    /// What A has at the current frame, while it is compared with.
    pub fn shown_of_a(&self) -> Option<&Arc<Frame>> {
        let current = self.state.playback.current;
        self.showing.of_a.as_ref().filter(|(number, _)| *number == current).map(|(_, frame)| frame)
    }

    fn play(&mut self) {
        let playback = &mut self.state.playback;
        if playback.current >= playback.last || playback.current < playback.first {
            playback.current = playback.first;
        }
        playback.playing = true;
        self.showing.played_from = None;
        self.refresh_shown();
    }

    fn pause(&mut self) {
        self.state.playback.playing = false;
        self.showing.played_from = None;
    }

    fn go_to(&mut self, frame: u32) {
        self.showing.played_from = None;
        self.show(frame.min(self.frames.timeline.last()));
    }

    fn show(&mut self, frame: u32) {
        if self.state.playback.current != frame {
            self.state.dragged_camera = None;
        }
        self.state.playback.current = frame;
        self.refresh_shown();
    }

    /// The last frame that can be played without a gap from the current one.
    fn playable_end(&self) -> u32 {
        let Playback { current, last, .. } = self.state.playback;
        let gap = (current..=last).find(|&number| self.frames.timeline.slot(number).is_none());
        gap.map_or(last, |number| number.saturating_sub(1).max(current))
    }

    fn key_beside(&self, current: u32, direction: Direction) -> Option<u32> {
        let frames = self.open.scenery.as_ref()?.camera.as_ref()?.key_frames();
        let frames = frames.into_iter().map(|frame| frame.round().max(0.0) as u32);
        match direction {
            Direction::Back => frames.filter(|&frame| frame < current).max(),
            Direction::Forward => frames.filter(|&frame| frame > current).min(),
        }
    }

    /// Finds the frame to be seen. One that must be read first is awaited: until it is there the one
    /// before stays.
    pub(super) fn refresh_shown(&mut self) {
        let current = self.state.playback.current;
        match self.frames.timeline.nearest_before(current) {
            Some(number) => {
                let key = self.frames.timeline.slot(number).expect("it is there").key;
                match self.frames.store.find(key) {
                    Place::Memory(frame) => self.showing.frame = Some(Shown { number, frame }),
                    Place::Disk | Place::Nowhere => self.load(key, number),
                }
            }
            None => self.showing.frame = None,
        }
        self.refresh_shown_of_a(current);
        if self.state.playback.playing {
            self.read_frames_ahead(current);
        }
    }

    fn refresh_shown_of_a(&mut self, current: u32) {
        let compared = self.state.a.as_ref().filter(|_| self.state.wipe.is_some());
        let key = compared.and_then(|a| a.keys.get(current as usize).copied().flatten());
        let Some(key) = key else {
            self.showing.of_a = None;
            return;
        };
        match self.frames.store.find(key) {
            Place::Memory(frame) => self.showing.of_a = Some((current, frame)),
            Place::Disk => self.load(key, current),
            Place::Nowhere => self.showing.of_a = None,
        }
    }

    /// Frames like those at hand that memory has room for.
    fn frames_that_fit(&self) -> u32 {
        let count = self.frames.store.len().max(1) as u64;
        let each = (self.frames.store.used() / count).max(1);
        u32::try_from(self.frames.store.budget() / each).unwrap_or(u32::MAX)
    }

    fn read_frames_ahead(&mut self, current: u32) {
        let ahead = AHEAD.min(self.frames_that_fit() / 2);
        for number in current..=(current + ahead).min(self.state.playback.last) {
            let Some(slot) = self.frames.timeline.slot(number) else { break };
            let key = slot.key;
            if !self.frames.store.is_in_memory(key) {
                self.load(key, number);
            }
        }
    }
}
