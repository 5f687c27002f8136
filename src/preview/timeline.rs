//! Which frames there are, what made them and what they cost.

use std::collections::BTreeMap;

use super::key::FrameKey;
use super::plan::{Anchor, Plan};
use super::store::FrameStore;
use crate::sim::{Frame, StageSeconds};

/// How a frame stands to the settings in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameStatus {
    /// Not there.
    Missing,
    /// Made with other settings than those in force.
    Stale,
    /// Made with the settings in force, but from a frame that other settings made.
    Mixed,
    /// What a run from the start with the settings in force would give, bit for bit.
    Ready,
}

/// A frame that is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    pub key: FrameKey,
    /// The settings in force when it was made, as the hash of a run with them.
    pub settings_hash: String,
    pub cost: Option<Cost>,
}

/// What a frame cost and how it went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    pub faces: usize,
    /// (s).
    pub wall: f64,
    pub stages: StageSeconds,
    pub intersections: Option<usize>,
    /// Largest principal stretch minus 1.
    pub largest_stretch: f64,
}

impl Cost {
    pub fn of(frame: &Frame) -> Self {
        let report = &frame.report;
        Self {
            faces: frame.face_count(),
            wall: report.stages.total(),
            stages: report.stages,
            intersections: report.intersections,
            largest_stretch: report.largest_stretch,
        }
    }
}

/// The frames of a shot by number. Slots stay when settings change, until something takes their
/// place: an artist would rather see an old frame than none.
#[derive(Clone, Debug, Default)]
pub struct Timeline {
    slots: Vec<Option<Slot>>,
    /// The key that each frame would have in a run from the start, and in the one going on from the
    /// anchor.
    clean: Vec<Option<FrameKey>>,
    wanted: Vec<Option<FrameKey>>,
    /// What is known of frames that have been there, to be said again when they return. Those that the
    /// store has no more do not: made again, they are known again.
    known: BTreeMap<FrameKey, (String, Option<Cost>)>,
}

impl Timeline {
    /// The frames of a finished run; `run` tells it from all others.
    pub fn of_run(last: u32, frames: &[u32], input_hash: &str, run: &str) -> Self {
        let mut timeline = Self { slots: vec![None; last as usize + 1], ..Self::default() };
        timeline.clean = vec![None; timeline.slots.len()];
        for &number in frames.iter().filter(|&&number| number <= last) {
            let key = FrameKey::of_run(run, number);
            let slot = Slot { key, settings_hash: input_hash.to_owned(), cost: None };
            timeline.slots[number as usize] = Some(slot);
            timeline.clean[number as usize] = Some(key);
        }
        timeline.wanted = timeline.clean.clone();
        timeline
    }

    /// Takes over a plan: what the store has of it fills the slots, the rest stays as it was.
    pub fn follow(&mut self, plan: &Plan, anchor: Option<&Anchor>, store: &FrameStore) {
        self.clean = plan.keys(None);
        self.wanted = plan.keys(anchor);
        self.known.retain(|key, _| store.has(*key));
        self.slots.resize(self.wanted.len(), None);
        for (number, slot) in self.slots.iter_mut().enumerate() {
            let known = |key: &FrameKey| store.has(*key);
            let before = anchor.and_then(|a| a.keys.get(number).copied().flatten());
            // Up to an anchor, what was there comes back; what is missing may be as a clean run has it.
            let fitting = self.wanted[number].or(before).filter(known).or_else(|| {
                let is_there = slot.as_ref().is_some_and(|slot| known(&slot.key));
                self.clean[number].filter(|key| !is_there && known(key))
            });
            match fitting {
                Some(key) if slot.as_ref().is_some_and(|slot| slot.key == key) => {}
                Some(key) => {
                    let usual = || (plan.settings_hash().to_owned(), None);
                    let (settings_hash, cost) = self.known.get(&key).cloned().unwrap_or_else(usual);
                    *slot = Some(Slot { key, settings_hash, cost });
                }
                None if slot.as_ref().is_some_and(|slot| !known(&slot.key)) => *slot = None,
                None => {}
            }
        }
    }

    /// Puts a frame where it belongs: where a plan wants it.
    pub fn put(&mut self, number: u32, key: FrameKey, settings_hash: &str, cost: Cost) {
        self.known.insert(key, (settings_hash.to_owned(), Some(cost)));
        let Some(slot) = self.slots.get_mut(number as usize) else { return };
        if self.wanted[number as usize] == Some(key) {
            *slot = Some(Slot { key, settings_hash: settings_hash.to_owned(), cost: Some(cost) });
        }
    }

    /// What a frame that has been read cost.
    pub fn note_cost(&mut self, key: FrameKey, cost: Cost) {
        for slot in self.slots.iter_mut().flatten().filter(|slot| slot.key == key) {
            slot.cost = Some(cost);
            self.known.insert(key, (slot.settings_hash.clone(), Some(cost)));
        }
    }

    /// The frame is nowhere any more.
    pub fn forget(&mut self, key: FrameKey) {
        self.known.remove(&key);
        for slot in &mut self.slots {
            if slot.as_ref().is_some_and(|slot| slot.key == key) {
                *slot = None;
            }
        }
    }

    #[cfg(test)]
    pub fn known_count(&self) -> usize {
        self.known.len()
    }

    /// Number of frames, missing ones included.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    pub fn last(&self) -> u32 {
        (self.slots.len() as u32).saturating_sub(1)
    }

    pub fn slot(&self, number: u32) -> Option<&Slot> {
        self.slots.get(number as usize)?.as_ref()
    }

    pub fn keys(&self) -> Vec<Option<FrameKey>> {
        self.slots.iter().map(|slot| slot.as_ref().map(|slot| slot.key)).collect()
    }

    /// The key that the settings in force want at a frame.
    pub fn wanted(&self, number: u32) -> Option<FrameKey> {
        self.wanted.get(number as usize).copied().flatten()
    }

    pub fn wanted_keys(&self) -> impl Iterator<Item = FrameKey> {
        self.wanted.iter().chain(&self.clean).flatten().copied()
    }

    pub fn status(&self, number: u32) -> FrameStatus {
        let Some(slot) = self.slot(number) else { return FrameStatus::Missing };
        let is = |keys: &[Option<FrameKey>]| keys[number as usize] == Some(slot.key);
        if is(&self.clean) {
            FrameStatus::Ready
        } else if is(&self.wanted) {
            FrameStatus::Mixed
        } else {
            FrameStatus::Stale
        }
    }

    /// Whether every frame of a range is what a run from the start would give.
    pub fn is_clean(&self, first: u32, last: u32) -> bool {
        (first..=last).all(|number| self.status(number) == FrameStatus::Ready)
    }

    /// The nearest frame at or before this one that is there.
    pub fn nearest_before(&self, number: u32) -> Option<u32> {
        (0..=number.min(self.last())).rev().find(|&n| self.slot(n).is_some())
    }

    /// What is to be simulated next: the number of the first frame wanted and not there, with its key
    /// and those after it, up to the next that is there.
    pub fn gap(&self, store: &FrameStore) -> Option<(u32, Vec<FrameKey>)> {
        let first = self.first_gap(store)?;
        let frames = (first as usize..self.wanted.len())
            .take_while(|&number| self.is_gap(number, store))
            .filter_map(|number| self.wanted[number])
            .collect();
        Some((first, frames))
    }

    /// The number of the first frame wanted and not there.
    pub fn first_gap(&self, store: &FrameStore) -> Option<u32> {
        (0..self.wanted.len()).find(|&number| self.is_gap(number, store)).map(|n| n as u32)
    }

    fn is_gap(&self, number: usize, store: &FrameStore) -> bool {
        self.wanted[number].is_some_and(|key| !store.has(key))
    }
}
