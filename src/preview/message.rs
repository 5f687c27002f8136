//! What the threads of the previewer say to the one that shows.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::engine::JobId;
use super::key::FrameKey;
use super::planner::Opened;
use crate::sim::Frame;

/// Called after each event, from the thread that sent it: wakes whoever sleeps until something
/// happens. Must return at once.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Something happened on another thread.
#[derive(Debug)]
pub enum Event {
    /// A shot or a run was opened, or not; `request` is the number it was asked for with.
    Planned { request: u64, opened: Result<Opened, String> },
    /// Files that what is open was read from have been written since.
    FilesChanged { paths: Vec<PathBuf> },
    /// A frame was simulated.
    Simulated { job: JobId, key: FrameKey, frame: Arc<Frame> },
    /// The simulation has reached the last frame wanted, or stopped because it was told to.
    Finished { job: JobId },
    /// The simulation cannot go on.
    Failed { job: JobId, frame: u32, why: String },
    /// The same of the simulation that runs for its costs.
    Rival(Box<Event>),
    /// A frame has been read.
    Loaded { key: FrameKey, frame: Result<Arc<Frame>, String> },
    /// Frames that are on disk.
    Found { keys: Vec<FrameKey> },
    /// A frame is on disk now.
    Kept { key: FrameKey },
    /// Frames cannot be written to disk.
    CannotKeep { why: String },
}

/// Sends events and wakes their reader. Never blocks.
#[derive(Clone)]
pub struct Outbox {
    sender: Sender<Event>,
    wake: Wake,
    /// Events go out as [`Event::Rival`].
    is_rival: bool,
}

impl Outbox {
    pub fn new(wake: Wake) -> (Self, Receiver<Event>) {
        let (sender, events) = channel();
        (Self { sender, wake, is_rival: false }, events)
    }

    /// The same, for the simulation that runs for its costs.
    pub fn for_rival(&self) -> Self {
        Self { is_rival: true, ..self.clone() }
    }

    /// An event that nobody waits for any more is dropped.
    pub fn send(&self, event: Event) {
        let event = if self.is_rival { Event::Rival(Box::new(event)) } else { event };
        if self.sender.send(event).is_ok() {
            (self.wake)();
        }
    }

    #[cfg(test)]
    pub fn for_tests() -> (Self, Receiver<Event>) {
        Self::new(Arc::new(|| {}))
    }
}
