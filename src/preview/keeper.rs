//! The thread that reads and writes frames on disk, so that nobody else waits for it.
//!
//! A frame lies under its key, `FOLDER/ab/abcd....sfr`, in the bytes of a run's states. What is there
//! is found again by whoever looks for that key, now or after a restart.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::SystemTime;

use super::key::FrameKey;
use super::message::{Event, Outbox};
use super::planner::chain;
use crate::run::{RunReader, read_frame_file, write_frame_file};
use crate::sim::Frame;

/// Disk space for frames (bytes), over all shots; the longest unused files go first.
pub const DISK_BUDGET: u64 = 8 << 30;

/// Frames written between two looks at how much space they take.
const TIDY_EVERY: u32 = 500;

/// What the keeper is asked for; in order, loads before all else.
enum Wish {
    Keep(FrameKey, Arc<Frame>),
    Load(FrameKey),
    LoadOfRun(FrameKey, Arc<RunReader>, u32),
    /// Which of these are there.
    Look(Vec<FrameKey>),
}

/// A handle to the thread; it ends when this is dropped, after what it has in hand.
pub struct Keeper {
    urgent: Sender<Wish>,
    wishes: Sender<Wish>,
    bell: Sender<()>,
}

impl Keeper {
    /// `folder` is made when the first frame is written; `None` keeps nothing.
    pub fn start(folder: Option<PathBuf>, outbox: Outbox) -> Self {
        let (urgent, urgent_wishes) = channel();
        let (wishes, other_wishes) = channel();
        let (bell, rings) = channel();
        let work = Work { folder, outbox, has_failed: false };
        thread::Builder::new()
            .name("keeper".into())
            .spawn(move || work.run(&rings, &urgent_wishes, &other_wishes))
            .expect("the system starts threads");
        Self { urgent, wishes, bell }
    }

    /// Writes a frame, then says [`Event::Kept`].
    pub fn keep(&self, key: FrameKey, frame: Arc<Frame>) {
        self.send(&self.wishes, Wish::Keep(key, frame));
    }

    /// Reads a frame, then says [`Event::Loaded`].
    pub fn load(&self, key: FrameKey) {
        self.send(&self.urgent, Wish::Load(key));
    }

    /// Reads a frame of a run.
    pub fn load_of_run(&self, key: FrameKey, run: Arc<RunReader>, number: u32) {
        self.send(&self.urgent, Wish::LoadOfRun(key, run, number));
    }

    /// Says [`Event::Found`] for those that are there.
    pub fn look(&self, keys: Vec<FrameKey>) {
        self.send(&self.urgent, Wish::Look(keys));
    }

    fn send(&self, queue: &Sender<Wish>, wish: Wish) {
        // The thread is there as long as this is.
        if queue.send(wish).is_ok() {
            let _ = self.bell.send(());
        }
    }
}

struct Work {
    folder: Option<PathBuf>,
    outbox: Outbox,
    /// A disk that cannot be written is said once.
    has_failed: bool,
}

impl Work {
    fn run(mut self, rings: &Receiver<()>, urgent: &Receiver<Wish>, others: &Receiver<Wish>) {
        if let Some(folder) = &self.folder {
            tidy(folder, DISK_BUDGET);
        }
        let mut kept = 0u32;
        // One ring for each wish, whatever its queue.
        while rings.recv().is_ok() {
            if let Ok(wish) = urgent.try_recv().or_else(|_| others.try_recv()) {
                kept += u32::from(matches!(wish, Wish::Keep(..)));
                self.meet(wish);
            }
            if kept == TIDY_EVERY {
                kept = 0;
                self.folder.iter().for_each(|folder| tidy(folder, DISK_BUDGET));
            }
        }
    }

    fn meet(&mut self, wish: Wish) {
        match wish {
            Wish::Keep(key, frame) => self.keep(key, &frame),
            Wish::Load(key) => {
                let Some(folder) = &self.folder else { return };
                let path = path_of(folder, key);
                let frame = read_frame_file(&path).map_err(|error| chain(&error));
                if frame.is_ok() {
                    touch(&path);
                }
                self.outbox.send(Event::Loaded { key, frame: frame.map(Arc::new) });
            }
            Wish::LoadOfRun(key, run, number) => {
                let frame = run.frame(number).map_err(|error| chain(&error));
                self.outbox.send(Event::Loaded { key, frame: frame.map(Arc::new) });
            }
            Wish::Look(keys) => {
                let folder = self.folder.as_deref();
                let is_there = |key: &FrameKey| folder.is_some_and(|f| path_of(f, *key).is_file());
                let found = keys.into_iter().filter(is_there).collect();
                self.outbox.send(Event::Found { keys: found });
            }
        }
    }

    fn keep(&mut self, key: FrameKey, frame: &Frame) {
        let Some(folder) = &self.folder else { return };
        let path = path_of(folder, key);
        let written = fs::create_dir_all(path.parent().unwrap_or(folder))
            .map_err(|error| format!("cannot create {:?}: {error}", folder.display()))
            .and_then(|()| write_frame_file(&path, frame).map_err(|error| chain(&error)));
        match written {
            Ok(()) => self.outbox.send(Event::Kept { key }),
            Err(why) if !self.has_failed => {
                self.has_failed = true;
                self.outbox.send(Event::CannotKeep { why });
            }
            Err(_) => {}
        }
    }
}

/// Where a frame lies.
pub(super) fn path_of(folder: &Path, key: FrameKey) -> PathBuf {
    let name = key.to_string();
    folder.join(&name[..2]).join(format!("{name}.sfr"))
}

/// Marks a file as just used.
fn touch(path: &Path) {
    let now = SystemTime::now();
    // A folder that can only be read keeps its order; nothing is lost.
    let _ = fs::File::options().write(true).open(path).and_then(|file| file.set_modified(now));
}

/// Removes the longest unused files until the rest fits. What cannot be read or removed is left.
fn tidy(folder: &Path, budget: u64) {
    let mut files: Vec<(SystemTime, u64, PathBuf)> = subfolders(folder)
        .flat_map(|sub| fs::read_dir(sub).into_iter().flatten().flatten())
        .filter(|entry| entry.path().extension().is_some_and(|e| e == "sfr"))
        .filter_map(|entry| {
            let about = entry.metadata().ok()?;
            Some((about.modified().ok()?, about.len(), entry.path()))
        })
        .collect();
    let mut used: u64 = files.iter().map(|(_, bytes, _)| bytes).sum();
    files.sort();
    for (_, bytes, path) in files {
        if used <= budget {
            break;
        }
        if fs::remove_file(&path).is_ok() {
            used -= bytes;
        }
    }
}

fn subfolders(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_dir())
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::Receiver;
    use std::time::Duration;

    use super::*;

    fn key(number: u32) -> FrameKey {
        FrameKey::of_run("test", number)
    }

    fn started(folder: &Path) -> (Keeper, Receiver<Event>) {
        let (outbox, events) = Outbox::for_tests();
        (Keeper::start(Some(folder.to_owned()), outbox), events)
    }

    fn next(events: &Receiver<Event>) -> Event {
        events.recv_timeout(Duration::from_secs(20)).expect("the keeper answers")
    }

    #[test]
    fn a_kept_frame_is_found_and_read_after_a_restart() {
        let folder = tempfile::tempdir().unwrap();
        let (keeper, events) = started(folder.path());
        let frame = Arc::new(Frame { number: 7, time: 0.25, ..Frame::default() });
        keeper.keep(key(7), frame);
        assert!(matches!(next(&events), Event::Kept { key: k } if k == key(7)));
        drop(keeper);
        let (keeper, events) = started(folder.path());
        keeper.look(vec![key(6), key(7)]);
        assert!(matches!(next(&events), Event::Found { keys } if keys == [key(7)]));
        keeper.load(key(7));
        let Event::Loaded { frame: Ok(frame), .. } = next(&events) else { panic!("not read") };
        assert_eq!((frame.number, frame.time), (7, 0.25));
    }

    #[test]
    fn a_damaged_file_is_said_and_no_frame() {
        let folder = tempfile::tempdir().unwrap();
        let path = path_of(folder.path(), key(1));
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, b"SILKFRAM, but not for long").unwrap();
        let (keeper, events) = started(folder.path());
        keeper.load(key(1));
        assert!(matches!(next(&events), Event::Loaded { frame: Err(_), .. }));
    }

    #[test]
    fn a_disk_that_cannot_be_written_is_said_once() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "in the way").unwrap();
        let (keeper, events) = started(&file);
        (0..3).for_each(|n| keeper.keep(key(n), Arc::default()));
        keeper.look(Vec::new());
        assert!(matches!(next(&events), Event::CannotKeep { .. } | Event::Found { .. }));
        drop(keeper);
        let rest = events.iter().filter(|e| matches!(e, Event::CannotKeep { .. })).count();
        assert!(rest <= 1, "said {rest} times more");
    }

    #[test]
    fn tidying_removes_the_longest_unused_files() {
        let folder = tempfile::tempdir().unwrap();
        for (age, number) in [(30, 0), (20, 1), (10, 2)] {
            let path = path_of(folder.path(), key(number));
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, [0; 100]).unwrap();
            let then = SystemTime::now() - Duration::from_secs(age);
            fs::File::options().write(true).open(&path).unwrap().set_modified(then).unwrap();
        }
        tidy(folder.path(), 250);
        let there = [0, 1, 2].map(|number| path_of(folder.path(), key(number)).is_file());
        assert_eq!(there, [false, true, true]);
    }
}
