//! The thread that simulates. It is told what to make and says what it has made; between two steps it
//! looks whether it is still wanted.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use super::courtesy::give_way;
use super::key::FrameKey;
use super::message::{Event, Outbox};
use crate::scene::Scene;
use crate::sim::{Frame, SimError, SimSettings, Simulation};

/// Jobs are numbered; a later one takes the place of an earlier one.
pub type JobId = u64;

/// Frames to be made.
pub struct Job {
    pub scene: Arc<Scene>,
    pub settings: SimSettings,
    /// The frame to go on from; `None` begins at frame 0.
    pub start: Option<Arc<Frame>>,
    /// Keys of the frames to be made, in order; the first is the one after `start`.
    pub frames: Vec<FrameKey>,
}

/// A handle to the thread. Dropped, the thread ends within a step.
pub struct Engine {
    jobs: Sender<(JobId, Job)>,
    /// The job that is wanted; 0 is none.
    wanted: Arc<AtomicU64>,
    last: JobId,
}

impl Engine {
    /// `name` tells threads apart in profiles.
    pub fn start(name: &str, outbox: Outbox) -> Self {
        let (jobs, queue) = channel();
        let wanted = Arc::new(AtomicU64::new(0));
        let watched = wanted.clone();
        thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || {
                give_way();
                work(&queue, &watched, &outbox);
            })
            .expect("the system starts threads");
        Self { jobs, wanted, last: 0 }
    }

    /// Begins a job; the one in work, if any, ends within a step.
    pub fn begin(&mut self, job: Job) -> JobId {
        self.last += 1;
        self.wanted.store(self.last, Ordering::Release);
        // The thread is there as long as this is.
        let _ = self.jobs.send((self.last, job));
        self.last
    }

    /// Ends the job in work within a step.
    pub fn stop(&self) {
        self.wanted.store(0, Ordering::Release);
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.stop();
    }
}

fn work(queue: &Receiver<(JobId, Job)>, wanted: &AtomicU64, outbox: &Outbox) {
    while let Ok((id, job)) = queue.recv() {
        let is_wanted = || wanted.load(Ordering::Acquire) == id;
        if !is_wanted() {
            continue;
        }
        let first = job.start.as_ref().map_or(0, |frame| frame.number + 1);
        let mut made = 0;
        let publish = |key, frame| {
            made += 1;
            outbox.send(Event::Simulated { job: id, key, frame: Arc::new(frame) });
        };
        // A simulation that panics must not take the program along, nor leave it waiting.
        let result = catch_unwind(AssertUnwindSafe(|| simulate(job, &is_wanted, publish)));
        let why = match result {
            Ok(Ok(())) => None,
            Ok(Err(error)) => Some(error.to_string()),
            Err(_) => Some("it failed in a way that was not foreseen".to_owned()),
        };
        outbox.send(match why {
            None => Event::Finished { job: id },
            Some(why) => Event::Failed { job: id, frame: first + made, why },
        });
    }
}

/// Makes the frames of a job while it is wanted.
fn simulate(
    job: Job,
    is_wanted: &dyn Fn() -> bool,
    mut publish: impl FnMut(FrameKey, Frame),
) -> Result<(), SimError> {
    let Job { scene, settings, start, frames } = job;
    let mut frames = frames.into_iter();
    let mut simulation = match start {
        Some(frame) => Simulation::from_frame(scene, settings, &frame)?,
        None => {
            let Some(key) = frames.next() else { return Ok(()) };
            let started = Simulation::start_while(scene, settings, is_wanted)?;
            let Some((simulation, frame)) = started else { return Ok(()) };
            publish(key, frame);
            simulation
        }
    };
    for key in frames {
        match simulation.advance_while(is_wanted)? {
            Some(frame) => publish(key, frame),
            None => break,
        }
    }
    Ok(())
}
