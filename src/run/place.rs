//! Where things are in a run folder, and how a file gets there.

use std::fs;
use std::path::{Path, PathBuf};

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

    /// Makes sure that a new run can be put here, and that nothing foreign is lost.
    pub fn claim(&self, overwrite: bool) -> Result<(), RunError> {
        let path = || self.dir.clone();
        if RunInfo::is_at(&self.info()) {
            return if overwrite {
                self.clear()
            } else {
                Err(RunError::AlreadyARun { path: path() })
            };
        }
        fs::create_dir_all(&self.dir).map_err(RunError::io("create", &self.dir))?;
        match names_in(&self.dir)?.is_empty() {
            true => Ok(()),
            false => Err(RunError::Occupied { path: path() }),
        }
    }

    /// Removes what a run writes, and nothing else. `run.json` goes last: without it the rest
    /// would no longer be known for a run.
    fn clear(&self) -> Result<(), RunError> {
        for (dir, is_ours) in [
            (self.frames(), is_state_name as fn(&str) -> bool),
            (self.objs(), is_obj_name as fn(&str) -> bool),
        ] {
            for name in names_in(&dir)?.iter().filter(|name| is_ours(name)) {
                remove(&dir.join(name))?;
            }
        }
        remove(&self.stats())?;
        remove(&self.obstacles())?;
        remove(&self.info())
    }

    /// Removes states and stray temporary files after frame `last`.
    pub fn forget_after(&self, last: u32) -> Result<(), RunError> {
        for name in names_in(&self.frames())? {
            let later = frame_number(&name).is_some_and(|number| number > last);
            if later || (is_state_name(&name) && name.ends_with(PARTIAL)) {
                remove(&self.frames().join(name))?;
            }
        }
        Ok(())
    }
}

/// Writes a file under a temporary name and renames it.
pub(super) fn write_whole(path: &Path, contents: &[u8]) -> Result<(), RunError> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".");
    partial.push(PARTIAL);
    let partial = PathBuf::from(partial);
    fs::write(&partial, contents)
        .and_then(|()| fs::rename(&partial, path))
        .map_err(RunError::io("write", path))
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

fn is_state_name(name: &str) -> bool {
    frame_number(without_partial(name)).is_some()
}

/// `FFFF_CC.obj` or `FFFF_obs_PP.obj`.
fn is_obj_name(name: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let Some((frame, item)) =
        without_partial(name).strip_suffix(".obj").and_then(|stem| stem.split_once('_'))
    else {
        return false;
    };
    digits(frame.strip_prefix('-').unwrap_or(frame))
        && digits(item.strip_prefix("obs_").unwrap_or(item))
}
