//! Where an export goes. A folder that is missing is made, with those above it, whatever the kind of the
//! export; what cannot be is said before anything is drawn.

use std::path::Path;

use anyhow::{Result, anyhow, bail};

use crate::output::{PendingFolder, folder_of};

/// The folder of a file that is to be written. Kept until the file is there: dropped while empty, it
/// takes what it made away again.
///
/// # Errors
/// As [`opened_folder`].
pub(super) fn opened_folder_of(file: &Path) -> Result<PendingFolder> {
    opened_folder(folder_of(file))
}

/// A folder that files can be written into.
///
/// # Errors
/// If it, or what should be a folder above it, is a file, and if it cannot be made or written.
pub(super) fn opened_folder(folder: &Path) -> Result<PendingFolder> {
    check_folder(folder)?;
    PendingFolder::create(folder).map_err(|error| {
        // What comes before the cause names a file that only tries the folder.
        anyhow!("cannot write into the folder {:?}: {}", folder.display(), error.root_cause())
    })
}

/// # Errors
/// If a folder that is to be written, or what should be one above it, is a file.
pub(super) fn check_folder(folder: &Path) -> Result<()> {
    match folder.ancestors().find(|path| path.exists()) {
        Some(found) if !found.is_dir() => bail!(
            "cannot write into the folder {:?}: {:?} is a file",
            folder.display(),
            found.display()
        ),
        _ => Ok(()),
    }
}
