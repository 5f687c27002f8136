//! The frames at hand, by key: in memory up to a budget, on disk beyond it and beyond the program's
//! end. Nothing here waits for the disk: what is to be read or written is said to the [keeper](super::Keeper).

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec3;

use super::key::FrameKey;
use crate::sim::Frame;

/// Memory for frames, unless the preferences say otherwise (bytes).
pub const MEMORY_BUDGET: u64 = 1 << 30;

/// Where a frame is.
#[derive(Clone, Debug)]
pub enum Place {
    Memory(Arc<Frame>),
    /// It can be read.
    Disk,
    Nowhere,
}

/// See the module.
pub struct FrameStore {
    memory: BTreeMap<FrameKey, Held>,
    on_disk: BTreeSet<FrameKey>,
    /// On their way to the disk: they stay in memory until they are there.
    coming: BTreeSet<FrameKey>,
    budget: u64,
    used: u64,
    /// Counts accesses: the order of last use.
    clock: u64,
}

struct Held {
    frame: Arc<Frame>,
    bytes: u64,
    last_use: u64,
}

impl FrameStore {
    pub fn new(budget: u64) -> Self {
        Self {
            memory: BTreeMap::new(),
            on_disk: BTreeSet::new(),
            coming: BTreeSet::new(),
            budget,
            used: 0,
            clock: 0,
        }
    }

    /// Takes a frame in; returns the keys of frames that are no longer anywhere, because they
    /// neither fit into memory nor had reached the disk.
    pub fn insert(&mut self, key: FrameKey, frame: Arc<Frame>) -> Vec<FrameKey> {
        let bytes = frame_bytes(&frame);
        let last_use = self.tick();
        if let Some(before) = self.memory.insert(key, Held { frame, bytes, last_use }) {
            self.used -= before.bytes;
        }
        self.used += bytes;
        self.make_room(key)
    }

    /// The frame has been written, or was found, on disk.
    pub fn note_on_disk(&mut self, key: FrameKey) {
        self.coming.remove(&key);
        self.on_disk.insert(key);
    }

    /// The frame is being written.
    pub fn note_coming(&mut self, key: FrameKey) {
        self.coming.insert(key);
    }

    /// Nothing that is being written will ever be on disk.
    pub fn note_disk_full(&mut self) {
        self.coming.clear();
    }

    /// The frame cannot be read after all.
    pub fn note_lost(&mut self, key: FrameKey) {
        self.on_disk.remove(&key);
    }

    /// Where the frame is; asking counts as use.
    pub fn find(&mut self, key: FrameKey) -> Place {
        let now = self.tick();
        if let Some(held) = self.memory.get_mut(&key) {
            held.last_use = now;
            return Place::Memory(held.frame.clone());
        }
        if self.on_disk.contains(&key) { Place::Disk } else { Place::Nowhere }
    }

    pub fn has(&self, key: FrameKey) -> bool {
        self.memory.contains_key(&key) || self.on_disk.contains(&key)
    }

    pub fn is_in_memory(&self, key: FrameKey) -> bool {
        self.memory.contains_key(&key)
    }

    /// Frames in memory.
    pub fn len(&self) -> usize {
        self.memory.len()
    }

    pub fn is_empty(&self) -> bool {
        self.memory.is_empty()
    }

    pub fn is_on_disk(&self, key: FrameKey) -> bool {
        self.on_disk.contains(&key)
    }

    /// The frames of these keys that are in memory.
    pub fn held(&self, keys: impl IntoIterator<Item = FrameKey>) -> BTreeMap<FrameKey, Arc<Frame>> {
        let held = |key| Some((key, self.memory.get(&key)?.frame.clone()));
        keys.into_iter().filter_map(held).collect()
    }

    /// Memory in use by frames (bytes, about).
    pub fn used(&self) -> u64 {
        self.used
    }

    pub fn budget(&self) -> u64 {
        self.budget
    }

    /// Returns what is lost, as [`FrameStore::insert`].
    pub fn set_budget(&mut self, budget: u64) -> Vec<FrameKey> {
        self.budget = budget;
        match self.memory.iter().max_by_key(|(_, held)| held.last_use).map(|(&key, _)| key) {
            Some(newest) => self.make_room(newest),
            None => Vec::new(),
        }
    }

    /// Lets the longest unused frames go, never the one just taken in; those on disk first.
    fn make_room(&mut self, keep: FrameKey) -> Vec<FrameKey> {
        let mut lost = Vec::new();
        if self.used <= self.budget {
            return lost;
        }
        let mut order: Vec<(bool, u64, FrameKey)> = self
            .memory
            .iter()
            .filter(|&(key, _)| *key != keep && !self.coming.contains(key))
            .map(|(&key, held)| (!self.on_disk.contains(&key), held.last_use, key))
            .collect();
        order.sort_unstable();
        for (is_nowhere_else, _, key) in order {
            if self.used <= self.budget {
                break;
            }
            let held = self.memory.remove(&key).expect("listed just now");
            self.used -= held.bytes;
            if is_nowhere_else {
                lost.push(key);
            }
        }
        lost
    }

    fn tick(&mut self) -> u64 {
        self.clock += 1;
        self.clock
    }
}

/// What a frame takes in memory (bytes), nearly all of it meshes.
fn frame_bytes(frame: &Frame) -> u64 {
    let points = |points: &Arc<Vec<DVec3>>| size_of_val(points.as_slice());
    let meshes: usize = frame.garments.iter().map(|mesh| mesh.memory()).sum();
    let moved: usize = frame.obstacle_points.values().map(points).sum();
    (meshes + moved + size_of::<Frame>()) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u32) -> Arc<Frame> {
        let points = [(0, Arc::new(vec![DVec3::ZERO; 1000]))];
        Arc::new(Frame { number, obstacle_points: points.into(), ..Frame::default() })
    }

    fn key(number: u32) -> FrameKey {
        FrameKey::of_run("test", number)
    }

    fn room_for(count: u64) -> FrameStore {
        FrameStore::new(count * frame_bytes(&frame(0)))
    }

    #[test]
    fn the_longest_unused_frame_goes_first_and_is_then_on_disk() {
        let mut store = room_for(2);
        for number in 0..2 {
            assert!(store.insert(key(number), frame(number)).is_empty());
            store.note_on_disk(key(number));
        }
        assert!(matches!(store.find(key(0)), Place::Memory(_)));
        assert!(store.insert(key(2), frame(2)).is_empty());
        assert!(matches!(store.find(key(1)), Place::Disk));
        assert!(matches!(store.find(key(0)), Place::Memory(_)));
        assert!(store.used() <= store.budget());
    }

    #[test]
    fn what_is_nowhere_else_goes_last_and_is_said_to_be_lost() {
        let mut store = room_for(2);
        store.insert(key(0), frame(0));
        store.insert(key(1), frame(1));
        store.note_on_disk(key(1));
        assert!(store.insert(key(2), frame(2)).is_empty());
        assert!(store.is_in_memory(key(0)), "the frame on disk had to go before it");
        assert_eq!(store.insert(key(3), frame(3)), [key(0)]);
        assert!(matches!(store.find(key(0)), Place::Nowhere));
    }

    #[test]
    fn a_frame_too_large_for_the_budget_is_still_held_while_it_is_the_newest() {
        let mut store = FrameStore::new(1);
        store.insert(key(0), frame(0));
        assert!(store.is_in_memory(key(0)));
        assert_eq!(store.insert(key(1), frame(1)), [key(0)]);
    }

    #[test]
    fn a_smaller_budget_holds_at_once_and_a_frame_taken_in_twice_counts_once() {
        let mut store = room_for(5);
        (0..5).for_each(|number| drop(store.insert(key(number), frame(number))));
        let used = store.used();
        store.insert(key(4), frame(4));
        assert_eq!(store.used(), used);
        assert_eq!(store.set_budget(used / 5).len(), 4);
        assert!(store.is_in_memory(key(4)));
    }
}
