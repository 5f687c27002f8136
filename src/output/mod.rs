//! What commands and exports leave behind: files that appear under their name only when they are
//! whole, folders that stay only with something in them.

mod leftovers;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, ImageFormat, RgbaImage};
use tempfile::NamedTempFile;

/// An output that can be written but is not there yet; dropped, it leaves nothing.
pub struct PendingFile {
    file: NamedTempFile,
    path: PathBuf,
}

impl PendingFile {
    /// Creates the temporary file beside `path`: before the work starts, so that an output which cannot
    /// be written is known at once. Those that killed programs have left there go.
    ///
    /// # Errors
    /// If the folder is missing or cannot be written, or `path` is a folder.
    pub fn create(path: &Path) -> Result<Self> {
        leftovers::sweep(folder_of(path));
        Self::begin(path)
    }

    fn begin(path: &Path) -> Result<Self> {
        if path.is_dir() {
            anyhow::bail!("{}: it is a folder", cannot_write(path));
        }
        let file = leftovers::create_temporary(folder_of(path))
            // Its text would name the temporary file.
            .map_err(|error| io::Error::from(error.kind()))
            .with_context(|| cannot_write(path))?;
        Ok(Self { file, path: path.to_owned() })
    }

    /// # Errors
    /// If the file system refuses.
    pub fn write(self, contents: &[u8]) -> Result<()> {
        self.fill(contents)?;
        self.finish()
    }

    /// Where another program may write what it is to hold, before [`PendingFile::finish`].
    pub fn temporary_path(&self) -> &Path {
        self.file.path()
    }

    /// As [`PendingFile::write`], but on the disk before it takes the place of what is there: whatever
    /// happens to the machine, the old file is left or the new one.
    ///
    /// # Errors
    /// If the file system refuses.
    pub fn write_lastingly(self, contents: &[u8]) -> Result<()> {
        self.fill(contents)?;
        self.file.as_file().sync_all().with_context(|| cannot_write(&self.path))?;
        self.finish()
    }

    fn fill(&self, contents: &[u8]) -> Result<()> {
        self.file.as_file().write_all(contents).with_context(|| cannot_write(&self.path))
    }

    /// What was written to the temporary path is whole. It takes over the permissions of a file that is
    /// there, where the file system has any: not before, since a file that nobody may write can neither
    /// be written nor, left by a killed program, be found to be nobody's.
    ///
    /// # Errors
    /// If the file system refuses.
    pub fn finish(self) -> Result<()> {
        if let Ok(about) = fs::metadata(&self.path) {
            // An output with other permissions is better than none.
            let _ = fs::set_permissions(self.file.path(), about.permissions());
        }
        let persisted = self.file.persist(&self.path).map_err(|e| e.error);
        persisted.with_context(|| cannot_write(&self.path))?;
        Ok(())
    }

    /// There is nothing to be written: what an earlier command left under the name goes, so that
    /// nobody takes it for the output of this one.
    ///
    /// # Errors
    /// If the file system refuses.
    pub fn leave_out(self) -> Result<()> {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("cannot remove {:?}", self.path.display()))
            }
            _ => Ok(()),
        }
    }

    /// # Errors
    /// If the file system refuses.
    pub fn write_png(self, image: &RgbaImage) -> Result<()> {
        let mut bytes = io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Png).with_context(|| cannot_write(&self.path))?;
        self.write(bytes.get_ref())
    }

    /// A picture for a page: without its opacity, and as small as the encoder can make it, which
    /// takes it longer.
    ///
    /// # Errors
    /// If the file system refuses.
    pub fn write_small_png(self, image: &RgbaImage) -> Result<()> {
        let mut bytes = io::Cursor::new(Vec::new());
        let opaque = DynamicImage::ImageRgba8(image.clone()).into_rgb8();
        let encoder =
            PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
        opaque.write_with_encoder(encoder).with_context(|| cannot_write(&self.path))?;
        self.write(bytes.get_ref())
    }
}

fn cannot_write(path: &Path) -> String {
    format!("cannot write {:?}", path.display())
}

/// Where a file is, or is to be.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// A folder for outputs, made with those above it. Dropped while empty, it takes what it made away
/// again.
pub struct PendingFolder {
    path: PathBuf,
    /// Deepest first.
    made: Vec<PathBuf>,
}

impl PendingFolder {
    /// Temporary files that killed programs have left in it go.
    ///
    /// # Errors
    /// If the folder cannot be made or written, or is a file.
    pub fn create(path: &Path) -> Result<Self> {
        let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
        let made = path.ancestors().take_while(is_missing).map(Path::to_owned).collect();
        let folder = Self { path: path.to_owned(), made };
        fs::create_dir_all(path).with_context(|| format!("cannot create {:?}", path.display()))?;
        leftovers::sweep(path);
        folder.file("probe")?;
        Ok(folder)
    }

    /// An output in it.
    ///
    /// # Errors
    /// If the folder cannot be written, or holds a folder of that name.
    pub fn file(&self, name: &str) -> Result<PendingFile> {
        PendingFile::begin(&self.path.join(name))
    }
}

impl Drop for PendingFolder {
    fn drop(&mut self) {
        for folder in &self.made {
            // Refused, as it should be, where there is something in it.
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dropped_output_leaves_nothing_and_a_written_one_only_itself() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        drop(PendingFile::create(&path).unwrap());
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
        PendingFile::create(&path).unwrap().write_png(&RgbaImage::new(2, 2)).unwrap();
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
        assert!(image::open(&path).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn what_takes_the_place_of_a_file_is_as_open_as_that_was() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        PendingFile::create(&path).unwrap().write(b"new").unwrap();
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[cfg(unix)]
    #[test]
    fn another_program_may_write_what_takes_the_place_of_a_file_that_nobody_may_write() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mp4");
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        let pending = PendingFile::create(&path).unwrap();
        // The superuser may write any file: only the permissions show it there.
        assert_ne!(mode(pending.temporary_path()) & 0o200, 0);
        fs::write(pending.temporary_path(), "new").unwrap();
        pending.finish().unwrap();
        assert_eq!(mode(&path), 0o444);
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
    }

    #[test]
    fn another_program_may_write_an_output() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let pending = PendingFile::create(&path).unwrap();
        fs::write(pending.temporary_path(), "whole").unwrap();
        assert!(!path.exists());
        pending.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "whole");
    }

    #[test]
    fn an_output_that_is_left_out_is_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        PendingFile::create(&path).unwrap().leave_out().unwrap();
        fs::write(&path, "an earlier one").unwrap();
        PendingFile::create(&path).unwrap().leave_out().unwrap();
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
    }

    #[test]
    fn an_output_in_a_missing_folder_or_in_place_of_one_is_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        assert!(PendingFile::create(&folder.path().join("no/a.png")).is_err());
        assert!(PendingFile::create(folder.path()).is_err());
    }

    #[test]
    fn a_folder_stays_only_with_something_in_it() {
        let above = tempfile::tempdir().unwrap();
        let path = above.path().join("a/b");
        drop(PendingFolder::create(&path).unwrap());
        assert_eq!(above.path().read_dir().unwrap().count(), 0);
        let folder = PendingFolder::create(&path).unwrap();
        folder.file("a.png").unwrap().write_png(&RgbaImage::new(2, 2)).unwrap();
        drop(folder);
        assert!(path.join("a.png").is_file());
        drop(PendingFolder::create(above.path()).unwrap());
        assert!(above.path().is_dir());
    }
}
