//! Temporary files of outputs, and what programs that were killed have left of them.
//!
//! A temporary file is locked as long as the program lives that writes it. One with such a name that
//! nobody holds is of a program that was killed, and is removed by the next to write beside it. Where
//! a file system has no locks nothing can be told, and nothing is removed.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

const PREFIX: &str = ".shotsilk-";

/// Random letters and digits behind the prefix.
const RANDOM_COUNT: usize = 6;

/// Every attempt after the first means that another program swept in this very moment.
const ATTEMPTS_MAX: usize = 8;

/// A new temporary file.
///
/// # Errors
/// If the folder is missing or cannot be written.
pub fn create_temporary(folder: &Path) -> io::Result<NamedTempFile> {
    for _ in 0..ATTEMPTS_MAX {
        let file = tempfile::Builder::new()
            .prefix(PREFIX)
            .rand_bytes(RANDOM_COUNT)
            .permissions_of_a_new_file()
            .tempfile_in(folder)?;
        let is_swept = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
        if !is_swept && file.path().exists() {
            return Ok(file);
        }
    }
    Err(io::Error::other("other programs remove what is written there"))
}

/// Removes the temporary files in a folder that no program holds; what cannot be removed stays.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_temporary(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            remove_if_nobodys(&entry.path());
        }
    }
}

fn is_temporary(name: &OsStr) -> bool {
    name.to_str().and_then(|name| name.strip_prefix(PREFIX)).is_some_and(|random| {
        random.len() == RANDOM_COUNT && random.bytes().all(|b| b.is_ascii_alphanumeric())
    })
}

fn remove_if_nobodys(path: &Path) {
    let Ok(file) = OpenOptions::new().write(true).open(path) else { return };
    // Held until it is gone: whoever has just created it sees that it is being swept.
    if file.try_lock().is_ok() {
        let _ = fs::remove_file(path);
    }
}

/// Temporary files are private by default; an output is as open as any other file.
trait NewFilePermissions {
    fn permissions_of_a_new_file(&mut self) -> &mut Self;
}

impl NewFilePermissions for tempfile::Builder<'_, '_> {
    fn permissions_of_a_new_file(&mut self) -> &mut Self {
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What the process's mask leaves of it.
            self.permissions(fs::Permissions::from_mode(0o666))
        }
        #[cfg(not(unix))]
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_holds_is_swept_and_all_else_stays() {
        let folder = tempfile::tempdir().unwrap();
        let held = create_temporary(folder.path()).unwrap();
        let kept = [".shotsilk-notes", ".shotsilk-a1b2c3.png", "shotsilk-a1b2c3", "a.png"];
        for name in kept.into_iter().chain([".shotsilk-a1b2c3", ".shotsilk-ZZZZZZ"]) {
            fs::write(folder.path().join(name), "x").unwrap();
        }
        fs::create_dir(folder.path().join(".shotsilk-folder")).unwrap();
        sweep(folder.path());
        for name in kept.into_iter().chain([".shotsilk-folder"]) {
            assert!(folder.path().join(name).exists(), "{name}");
        }
        assert!(held.path().exists());
        assert_eq!(folder.path().read_dir().unwrap().count(), kept.len() + 2);
    }

    #[test]
    fn every_temporary_file_is_known_by_its_name() {
        let folder = tempfile::tempdir().unwrap();
        for _ in 0..100 {
            let file = create_temporary(folder.path()).unwrap();
            assert!(is_temporary(file.path().file_name().unwrap()), "{:?}", file.path());
        }
        sweep(&folder.path().join("no-folder"));
    }
}
