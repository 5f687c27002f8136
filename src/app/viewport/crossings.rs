//! Where cloth passes through something, found on a thread of its own: it takes about as long as
//! drawing the frame.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread;

use super::Same;
use crate::preview::{Scenery, Wake};
use crate::render::Crossings;
use crate::sim::Frame;

/// Those of the frame that was asked for last.
pub struct FoundCrossings {
    wake: Wake,
    found: Option<(Same<Frame>, Arc<Crossings>)>,
    coming: Option<(Same<Frame>, Receiver<Crossings>)>,
}

impl FoundCrossings {
    pub fn new(wake: Wake) -> Self {
        Self { wake, found: None, coming: None }
    }

    /// The crossings of a frame, if they are known; otherwise they are looked for, one frame at a time.
    pub fn of(&mut self, frame: &Arc<Frame>, scenery: &Arc<Scenery>) -> Option<Arc<Crossings>> {
        if let Some((of, coming)) = &self.coming
            && let Ok(crossings) = coming.try_recv()
        {
            self.found = Some((of.clone(), Arc::new(crossings)));
            self.coming = None;
        }
        let this = Same(frame.clone());
        if let Some((_, crossings)) = self.found.as_ref().filter(|(of, _)| *of == this) {
            return Some(crossings.clone());
        }
        if self.coming.is_none() {
            self.look(this, scenery.clone());
        }
        None
    }

    fn look(&mut self, this: Same<Frame>, scenery: Arc<Scenery>) {
        let frame = this.0.clone();
        let (sender, coming) = channel();
        let wake = self.wake.clone();
        let thread = thread::Builder::new().name("crossings".into()).spawn(move || {
            // Nobody may be waiting any more.
            let _ = sender.send(Crossings::of(&frame, &scenery.surfaces));
            wake();
        });
        // Without a thread there are no marks, which is better than none of the rest.
        self.coming = thread.is_ok().then_some((this, coming));
    }
}
