//! The thread that resolves shots and opens runs, so that nobody else waits for their files; between
//! two wishes it looks whether files have changed.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, SystemTime};

use super::edits::edit_as_override;
use super::message::{Event, Outbox};
use super::{Edits, Plan};
use crate::request::{Request, RequestError};
use crate::run::RunReader;
use crate::scene::{LoadError, Place, Problem};

/// How often files are looked at.
const LOOK_EVERY: Duration = Duration::from_secs(1);

/// What is open.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    Shot(Request),
    /// A folder that `simulate` wrote.
    Run(PathBuf),
}

/// What has been opened.
#[derive(Debug)]
pub enum Opened {
    Shot(Box<Plan>),
    Run(Arc<RunReader>),
}

/// A handle to the thread; it ends when this is dropped.
pub struct Planner {
    wishes: Sender<Wish>,
    last: u64,
}

/// See [`Planner::open`].
struct Wish {
    number: u64,
    source: Source,
    edits: Edits,
    unread: Option<PathBuf>,
}

impl Planner {
    pub fn start(outbox: Outbox) -> Self {
        let (wishes, queue) = channel();
        thread::Builder::new()
            .name("planner".into())
            .spawn(move || work(&queue, &outbox))
            .expect("the system starts threads");
        Self { wishes, last: 0 }
    }

    /// Opens a source, then says [`Event::Planned`] with the number returned here. Of several wishes
    /// that wait only the last is met. A file whose text the source brings along is `unread`: changes of
    /// it are noticed since it was read, not since now.
    pub fn open(&mut self, source: Source, edits: Edits, unread: Option<PathBuf>) -> u64 {
        self.last += 1;
        let wish = Wish { number: self.last, source, edits, unread };
        // The thread is there as long as this is.
        let _ = self.wishes.send(wish);
        self.last
    }
}

fn work(queue: &Receiver<Wish>, outbox: &Outbox) {
    let mut watch = Watch::default();
    loop {
        match queue.recv_timeout(LOOK_EVERY) {
            Ok(mut wish) => {
                while let Ok(later) = queue.try_recv() {
                    wish = later;
                }
                let Wish { number: request, source, edits, unread } = wish;
                let opened = catch_unwind(AssertUnwindSafe(|| opened(&source, &edits)))
                    .unwrap_or_else(|_| Err("the shot cannot be read".to_owned()));
                if let Ok(opened) = &opened {
                    watch = Watch::over(opened).keeping(&watch, unread.as_deref());
                }
                outbox.send(Event::Planned { request, opened });
            }
            Err(RecvTimeoutError::Timeout) => {
                let paths = watch.changed();
                if !paths.is_empty() {
                    outbox.send(Event::FilesChanged { paths });
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

fn opened(source: &Source, edits: &Edits) -> Result<Opened, String> {
    match source {
        Source::Shot(request) => {
            let plan = Plan::new(request, edits).map_err(|error| words(error, edits))?;
            Ok(Opened::Shot(Box::new(plan)))
        }
        Source::Run(folder) => {
            let reader = RunReader::open(folder).map_err(|error| chain(&error))?;
            Ok(Opened::Run(Arc::new(reader)))
        }
    }
}

/// Of a value that an edit gives, the setting and the value are named; the command line, which has its
/// own words for it, is not where it was given.
fn words(error: RequestError, edits: &Edits) -> String {
    /// Longer values say nothing at a glance (characters).
    const VALUE_MAX: usize = 40;
    let (argument, problem) = match &error {
        RequestError::Load(LoadError { place: Some(Place::Set { argument }), problem }) => {
            (argument, problem)
        }
        RequestError::Load(LoadError {
            place: Some(Place::Text { file, line: 1, column: 1 }),
            problem: Problem::Syntax(_),
        }) => return format!("{file} is no shot: it is no text of JSON"),
        _ => return error.to_string(),
    };
    match edits.iter().find(|(path, value)| **argument == edit_as_override(path, value)) {
        Some((path, _)) if problem.to_string().contains(path) => problem.to_string(),
        Some((path, value)) if value.to_string().len() <= VALUE_MAX => {
            format!("{path} cannot be {value}: {problem}")
        }
        Some((path, _)) => format!("{path}: {problem}"),
        None => error.to_string(),
    }
}

/// An error with its causes, on one line.
pub(super) fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text.push_str(&format!(": {error}"));
        cause = error.source();
    }
    text
}

/// Files and when they were last written.
#[derive(Default)]
struct Watch {
    files: Vec<(PathBuf, Option<SystemTime>)>,
}

impl Watch {
    fn over(opened: &Opened) -> Self {
        let Opened::Shot(plan) = opened else { return Self::default() };
        // Those that the program carries are no files, and never change.
        let real = plan.files().filter(|path| path.is_file());
        Self { files: real.map(|path| (path.clone(), written(path))).collect() }
    }

    /// With the time that another has of a file.
    fn keeping(mut self, other: &Self, unread: Option<&Path>) -> Self {
        let is_it = |(path, _): &&mut (PathBuf, _)| Some(path.as_path()) == unread;
        let before = other.files.iter().find(|(path, _)| Some(path.as_path()) == unread);
        if let (Some((_, time)), Some((_, before))) = (self.files.iter_mut().find(is_it), before) {
            *time = *before;
        }
        self
    }

    /// Files written since the last call.
    fn changed(&mut self) -> Vec<PathBuf> {
        let mut changed = Vec::new();
        for (path, before) in &mut self.files {
            let now = written(path);
            // A file that is gone for a moment is being replaced.
            if now.is_some() && now != *before {
                *before = now;
                changed.push(path.clone());
            }
        }
        changed
    }
}

fn written(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|about| about.modified()).ok()
}
