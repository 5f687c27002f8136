//! Edges in order of urgency.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::mesh::CornerId;

/// Edges by priority, the highest first and of equals the smaller corner. Entries go stale when the
/// mesh changes; who takes one must look at the edge again.
#[derive(Default)]
pub struct EdgeQueue {
    heap: BinaryHeap<Entry>,
}

struct Entry {
    priority: f64,
    corner: CornerId,
}

impl EdgeQueue {
    pub fn push(&mut self, corner: CornerId, priority: f64) {
        debug_assert!(priority.is_finite(), "priority {priority} of {corner:?}");
        self.heap.push(Entry { priority, corner });
    }

    pub fn pop(&mut self) -> Option<(CornerId, f64)> {
        self.heap.pop().map(|entry| (entry.corner, entry.priority))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.priority.total_cmp(&other.priority).then_with(|| other.corner.cmp(&self.corner))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}
