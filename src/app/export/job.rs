//! An export under way: the thread's side and the side of whoever looks on. Neither waits for the other.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::process::{Child, ExitStatus};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use std::{io, thread};

use anyhow::Result;

/// How far an export is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportProgress {
    /// Frames that are finished.
    pub done: u32,
    /// Frames asked for; 0 until the request is checked.
    pub total: u32,
    pub state: ExportState,
}

/// Whether an export is still at work, and how it ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportState {
    Running,
    /// The file or folder is there.
    Done(PathBuf),
    /// Why, in words.
    Failed(String),
    /// What was written until then, in words.
    Cancelled(String),
}

/// An export under way. Dropped, it is cancelled.
pub struct ExportJob {
    shared: Arc<Shared>,
}

/// How a worker comes to an end that is no error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Whole,
    /// What stays, in words.
    Cancelled(String),
}

/// The worker's side of a job.
pub(super) struct Ticket {
    shared: Arc<Shared>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

struct Shared {
    done: AtomicU32,
    total: AtomicU32,
    is_cancelled: AtomicBool,
    state: Mutex<ExportState>,
    /// The program that the export waits for. Held for moments only, by both sides.
    child: Mutex<Option<Child>>,
}

/// How often the end of another program is looked for.
const CHILD_POLL: Duration = Duration::from_millis(10);

/// Runs `work` on a thread of its own.
pub(super) fn start(
    to: PathBuf,
    wake: Arc<dyn Fn() + Send + Sync>,
    work: impl FnOnce(&Ticket) -> Result<Outcome> + Send + 'static,
) -> ExportJob {
    let shared = Arc::new(Shared {
        done: AtomicU32::new(0),
        total: AtomicU32::new(0),
        is_cancelled: AtomicBool::new(false),
        state: Mutex::new(ExportState::Running),
        child: Mutex::new(None),
    });
    let ticket = Ticket { shared: shared.clone(), wake };
    let spawned = thread::Builder::new().name("export".to_owned()).spawn(move || {
        // A job that fell silent would be looked at for ever.
        let state = match catch_unwind(AssertUnwindSafe(|| work(&ticket))) {
            Ok(Ok(Outcome::Whole)) => ExportState::Done(to),
            Ok(Ok(Outcome::Cancelled(what))) => ExportState::Cancelled(what),
            Ok(Err(error)) => ExportState::Failed(format!("{error:#}")),
            Err(panic) => ExportState::Failed(format!("the export broke off: {}", words(&*panic))),
        };
        ticket.end(state);
    });
    if let Err(error) = spawned {
        *locked(&shared.state) = ExportState::Failed(format!("cannot start a thread: {error}"));
    }
    ExportJob { shared }
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("it gives no reason")
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl ExportJob {
    pub fn progress(&self) -> ExportProgress {
        // First: when it says that all is done, the counts are the last ones.
        let state = locked(&self.shared.state).clone();
        ExportProgress {
            done: self.shared.done.load(Ordering::Acquire),
            total: self.shared.total.load(Ordering::Acquire),
            state,
        }
    }

    /// Asks the export to stop: it does after the frame in work, and its state then says what stays.
    /// One that has ended stays as it is.
    pub fn cancel(&self) {
        self.shared.is_cancelled.store(true, Ordering::Release);
        // The worker may be waiting for it to take the next frame.
        if let Some(child) = locked(&self.shared.child).as_mut() {
            let _ = child.kill();
        }
    }
}

impl Drop for ExportJob {
    fn drop(&mut self) {
        self.cancel();
    }
}

impl Ticket {
    /// So many frames will be made.
    pub fn expect(&self, frame_count: u32) {
        self.shared.total.store(frame_count, Ordering::Release);
        (self.wake)();
    }

    /// A frame is finished.
    pub fn step(&self) {
        self.shared.done.fetch_add(1, Ordering::AcqRel);
        (self.wake)();
    }

    pub fn is_cancelled(&self) -> bool {
        self.shared.is_cancelled.load(Ordering::Acquire)
    }

    /// Frames finished and frames asked for.
    pub fn counts(&self) -> [u32; 2] {
        [&self.shared.done, &self.shared.total].map(|count| count.load(Ordering::Acquire))
    }

    fn end(&self, state: ExportState) {
        *locked(&self.shared.state) = state;
        (self.wake)();
    }

    /// Hands a program to whoever may cancel, until [`Ticket::wait_for_child`] or
    /// [`Ticket::stop_child`].
    pub fn keep_child(&self, mut child: Child) {
        if self.is_cancelled() {
            let _ = child.kill();
        }
        *locked(&self.shared.child) = Some(child);
        // Between the question and the keeping someone may have cancelled.
        if self.is_cancelled() {
            self.kill_child();
        }
    }

    /// How the program ended, as soon as it has; however long that takes, since only it knows how much
    /// is left to do. Cancelling ends it.
    ///
    /// # Errors
    /// If the system cannot tell, or there is no program.
    pub fn wait_for_child(&self) -> io::Result<ExitStatus> {
        loop {
            if let Some(status) = self.ended_child()? {
                locked(&self.shared.child).take();
                return Ok(status);
            }
            thread::sleep(CHILD_POLL);
        }
    }

    fn ended_child(&self) -> io::Result<Option<ExitStatus>> {
        match locked(&self.shared.child).as_mut() {
            Some(child) => child.try_wait(),
            None => Err(io::Error::other("the program is not there")),
        }
    }

    /// Ends the program, if one is kept.
    pub fn stop_child(&self) {
        self.kill_child();
        let child = locked(&self.shared.child).take();
        if let Some(mut child) = child {
            let _ = child.wait();
        }
    }

    fn kill_child(&self) {
        if let Some(child) = locked(&self.shared.child).as_mut() {
            let _ = child.kill();
        }
    }
}
