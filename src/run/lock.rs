//! One program at a time writes a run.
//!
//! The operating system keeps the lock and gives it back when the program ends, however it ends; the
//! file that it hangs on says nothing by being there. Where a file system has no locks, nothing is
//! kept from being written twice.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::RunError;

/// Held as long as a run is open for writing.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

/// Every attempt after the first means that another program ended just now.
const ATTEMPTS_MAX: usize = 8;

impl Lock {
    /// # Errors
    /// If another program holds it, or the folder cannot be written.
    pub fn take(path: &Path) -> Result<Self, RunError> {
        for _ in 0..ATTEMPTS_MAX {
            let file = open(path).map_err(RunError::io("create", path))?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => break,
                // Whoever ends takes the file away: the one locked here may be gone already.
                Ok(()) if !is_locked(path) => {}
                Ok(()) | Err(TryLockError::Error(_)) => {
                    return Ok(Self { path: path.to_owned(), _file: file });
                }
            }
        }
        let folder = path.parent().unwrap_or(path);
        Err(RunError::InUse { path: folder.to_owned() })
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // What is left behind is in nobody's way.
        let _ = fs::remove_file(&self.path);
    }
}

/// Whether the file that is at the path now is locked.
fn is_locked(path: &Path) -> bool {
    let file = OpenOptions::new().write(true).open(path);
    file.is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
}

fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new().create(true).truncate(false).write(true).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_is_held_once_until_it_is_dropped_and_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.lock");
        let lock = Lock::take(&path).unwrap();
        let error = Lock::take(&path).unwrap_err();
        assert!(matches!(&error, RunError::InUse { path } if path == folder.path()), "{error}");
        drop(lock);
        assert!(!path.exists());
        Lock::take(&path).unwrap();
    }

    #[test]
    fn a_file_that_nobody_holds_is_no_obstacle() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.lock");
        fs::write(&path, "left by a program that was killed").unwrap();
        Lock::take(&path).unwrap();
    }

    #[test]
    fn a_lock_on_a_file_that_was_taken_away_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.lock");
        let gone = open(&path).unwrap();
        fs::remove_file(&path).unwrap();
        gone.try_lock().unwrap();
        assert!(!is_locked(&path));
    }
}
