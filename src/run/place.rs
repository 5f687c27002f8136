//! Where things are in a run folder, and how a file gets there.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::lock::Lock;
use super::{RunError, RunInfo};

/// The names within one run folder.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub dir: PathBuf,
}

/// Ends the name of a file that is not whole yet.
const PARTIAL: &str = "partial";

impl Place {
    pub fn info(&self) -> PathBuf {
        self.dir.join("run.json")
    }

    /// Here only while a program writes the run, and after it was killed.
    pub fn lock(&self) -> PathBuf {
        self.dir.join("run.lock")
    }

    pub fn stats(&self) -> PathBuf {
        self.dir.join("stats.csv")
    }

    pub fn obstacles(&self) -> PathBuf {
        self.dir.join("obstacles.bin")
    }

    pub fn frames(&self) -> PathBuf {
        self.dir.join("frames")
    }

    pub fn objs(&self) -> PathBuf {
        self.dir.join("obj")
    }

    /// `number` counts from the start of the simulation, whatever frame 0 is called.
    pub fn frame(&self, number: u32) -> PathBuf {
        self.frames().join(format!("{number:06}.sfr"))
    }

    /// `shown` is the frame's number with the shot's first frame added.
    pub fn cloth_obj(&self, shown: i64, garment: usize) -> PathBuf {
        self.objs().join(format!("{shown:04}_{garment:02}.obj"))
    }

    pub fn obstacle_obj(&self, shown: i64, obstacle: usize) -> PathBuf {
        self.objs().join(format!("{shown:04}_obs_{obstacle:02}.obj"))
    }

    /// The numbers of the states that are there, in order.
    pub fn frame_numbers(&self) -> Result<Vec<u32>, RunError> {
        let frames = self.frames();
        let mut numbers: Vec<u32> =
            names_in(&frames)?.iter().filter_map(|name| frame_number(name)).collect();
        numbers.sort_unstable();
        Ok(numbers)
    }

    /// Makes room for a new run, and sure that nothing foreign is lost.
    pub fn claim(&self, overwrite: bool) -> Result<Lock, RunError> {
        self.check_free(overwrite)?;
        let lock = Lock::take(&self.lock())?;
        // Another program may have begun a run in between.
        self.check_free(overwrite)?;
        self.clear()?;
        Ok(lock)
    }

    fn check_free(&self, overwrite: bool) -> Result<(), RunError> {
        if RunInfo::is_at(&self.info()) || self.is_broken()? {
            let path = self.dir.clone();
            return if overwrite { Ok(()) } else { Err(RunError::AlreadyARun { path }) };
        }
        fs::create_dir_all(&self.dir).map_err(RunError::io("create", &self.dir))?;
        if self.is_vacant()? || self.is_begun()? {
            Ok(())
        } else {
            Err(RunError::Occupied { path: self.dir.clone() })
        }
    }

    /// True if the folder is empty or not there.
    pub fn is_vacant(&self) -> Result<bool, RunError> {
        Ok(names_in(&self.dir)?.is_empty())
    }

    /// True if the folder holds nothing but what a program leaves that is killed before `run.json`
    /// is in place.
    pub fn is_begun(&self) -> Result<bool, RunError> {
        let names = names_in(&self.dir)?;
        let is_marked =
            |name: &String| self.is_pending_info(name) || self.dir.join(name) == self.lock();
        Ok(names.iter().any(is_marked) && names.iter().all(|name| self.is_ours(name)))
    }

    /// True if the folder holds a run whose `run.json` has lost what it said.
    pub fn is_broken(&self) -> Result<bool, RunError> {
        let info = self.info();
        let is_ours = |name: &String| self.dir.join(name) == info || self.is_ours(name);
        Ok(RunInfo::is_broken_at(&info) && names_in(&self.dir)?.iter().all(is_ours))
    }

    /// True of the names that a run has besides `run.json`.
    fn is_ours(&self, name: &str) -> bool {
        let files = [self.lock(), self.stats(), self.obstacles(), self.frames(), self.objs()];
        files.contains(&self.dir.join(without_partial(name))) || self.is_pending_info(name)
    }

    fn is_pending_info(&self, name: &str) -> bool {
        self.dir.join(name) == partial(&self.info())
    }

    /// Removes what a run writes, and nothing else. `run.json` is put aside first: a run half
    /// removed is none, and the folder still known for its remains.
    fn clear(&self) -> Result<(), RunError> {
        let info = self.info();
        if info.exists() {
            fs::rename(&info, partial(&info)).map_err(RunError::io("replace", &info))?;
        }
        self.forget_after(None, 0)?;
        self.remove_partials()?;
        remove(&self.stats())?;
        remove(&self.obstacles())
    }

    /// Removes states and OBJ files after frame `last`, or all. Frame 0 is shown as `first_frame`.
    pub fn forget_after(&self, last: Option<u32>, first_frame: i64) -> Result<(), RunError> {
        let is_later = |number: i64| last.is_none_or(|last| number > i64::from(last));
        // The last first: what a kill leaves of them has no gap.
        for name in names_in(&self.frames())?.iter().rev() {
            if frame_number(name).is_some_and(|number| is_later(i64::from(number))) {
                remove(&self.frames().join(name))?;
            }
        }
        for name in names_in(&self.objs())? {
            if obj_frame(&name).is_some_and(|shown| is_later(shown.saturating_sub(first_frame))) {
                remove(&self.objs().join(name))?;
            }
        }
        Ok(())
    }

    /// Removes temporary files that an interruption has left, but for that of `run.json`.
    pub fn remove_partials(&self) -> Result<(), RunError> {
        for (dir, is_ours) in [
            (self.frames(), (|name| frame_number(name).is_some()) as fn(&str) -> bool),
            (self.objs(), |name| obj_frame(name).is_some()),
            (self.dir.clone(), |name| ["stats.csv", "obstacles.bin"].contains(&name)),
        ] {
            for name in names_in(&dir)? {
                if is_partial(&name) && is_ours(without_partial(&name)) {
                    remove(&dir.join(name))?;
                }
            }
        }
        Ok(())
    }
}

/// Whether a file outlasts a power cut once it has its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lasting {
    /// What is in it may be lost: it has to be sealed, or not be missed.
    No,
    /// Without it the others are of no use.
    Yes,
}

/// Writes a file under a temporary name and renames it. The name is known to those that go on with a run
/// and remove what an interruption has left, so that this is no matter for [`crate::output`].
pub(super) fn write_whole(path: &Path, contents: &[u8], lasting: Lasting) -> Result<(), RunError> {
    let partial = partial(path);
    let write = || -> std::io::Result<()> {
        let mut file = fs::File::create(&partial)?;
        file.write_all(contents)?;
        if lasting == Lasting::Yes {
            file.sync_all()?;
        }
        fs::rename(&partial, path)
    };
    write().map_err(RunError::io("write", path))
}

/// The temporary name of a file.
fn partial(path: &Path) -> PathBuf {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".");
    partial.push(PARTIAL);
    PathBuf::from(partial)
}

fn remove(path: &Path) -> Result<(), RunError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(RunError::io("remove", path)(error))
        }
        _ => Ok(()),
    }
}

/// Names of a folder's entries, sorted; none if the folder is missing. Names that are not Unicode
/// are kept, if garbled: they count as foreign.
fn names_in(dir: &Path) -> Result<Vec<String>, RunError> {
    let entries = match fs::read_dir(dir) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(RunError::io("list", dir))?,
    };
    let mut names = entries
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<std::io::Result<Vec<_>>>()
        .map_err(RunError::io("list", dir))?;
    names.sort_unstable();
    Ok(names)
}

fn frame_number(name: &str) -> Option<u32> {
    let digits = name.strip_suffix(".sfr")?;
    (digits.len() >= 6 && digits.bytes().all(|b| b.is_ascii_digit()))
        .then(|| digits.parse().ok())
        .flatten()
}

fn without_partial(name: &str) -> &str {
    name.strip_suffix(PARTIAL).and_then(|name| name.strip_suffix('.')).unwrap_or(name)
}

fn is_partial(name: &str) -> bool {
    without_partial(name) != name
}

/// The frame shown in `FFFF_CC.obj` or `FFFF_obs_PP.obj`.
fn obj_frame(name: &str) -> Option<i64> {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let (frame, item) = name.strip_suffix(".obj")?.split_once('_')?;
    let is_ours = is_number(frame.strip_prefix('-').unwrap_or(frame))
        && is_number(item.strip_prefix("obs_").unwrap_or(item));
    is_ours.then(|| frame.parse().ok()).flatten()
}
