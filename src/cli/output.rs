//! Files that appear under their name only when they are whole.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use image::{ImageFormat, RgbaImage};
use tempfile::NamedTempFile;

/// An output that can be written but is not there yet; dropped, it leaves nothing.
pub struct PendingFile {
    file: NamedTempFile,
    path: PathBuf,
}

impl PendingFile {
    /// Creates the temporary file beside `path`: before the work starts, so that an output which
    /// cannot be written is known at once.
    ///
    /// # Errors
    /// If the folder is missing or cannot be written, or `path` is a folder.
    pub fn create(path: &Path) -> Result<Self> {
        let cannot = || format!("cannot write {:?}", path.display());
        if path.is_dir() {
            anyhow::bail!("{}: it is a folder", cannot());
        }
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let file = tempfile::Builder::new()
            .prefix(".shotsilk-")
            .permissions_of_a_new_file()
            .tempfile_in(folder)
            .with_context(cannot)?;
        Ok(Self { file, path: path.to_owned() })
    }

    /// # Errors
    /// If the file system refuses.
    pub fn write_png(self, image: &RgbaImage) -> Result<()> {
        let cannot = || format!("cannot write {:?}", self.path.display());
        let mut writer = std::io::BufWriter::new(self.file.as_file());
        image.write_to(&mut writer, ImageFormat::Png).with_context(cannot)?;
        std::io::Write::flush(&mut writer).with_context(cannot)?;
        drop(writer);
        self.file.persist(&self.path).map_err(|e| e.error).with_context(cannot)?;
        Ok(())
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
            self.permissions(std::fs::Permissions::from_mode(0o666))
        }
        #[cfg(not(unix))]
        self
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

    #[test]
    fn an_output_in_a_missing_folder_or_in_place_of_one_is_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        assert!(PendingFile::create(&folder.path().join("no/a.png")).is_err());
        assert!(PendingFile::create(folder.path()).is_err());
    }
}
