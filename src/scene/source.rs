//! Where files come from: the file system, or a table of bytes that the program carries.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use sha2::{Digest, Sha256};

use super::error::{LoadError, Problem};

/// Anything that answers to paths. Relative paths mean what they mean to the source.
pub trait FileSource {
    /// # Errors
    /// As the file system reports them.
    fn read(&self, path: &Path) -> io::Result<Vec<u8>>;
    fn is_file(&self, path: &Path) -> bool;
}

/// The real file system.
#[derive(Clone, Copy, Debug, Default)]
pub struct FileSystem;

impl FileSource for FileSystem {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        std::fs::read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }
}

/// Files that are part of the program, or of a test, by normalised path.
#[derive(Clone, Debug, Default)]
pub struct EmbeddedFiles {
    files: BTreeMap<PathBuf, Cow<'static, [u8]>>,
}

impl EmbeddedFiles {
    #[must_use]
    pub fn with(mut self, path: impl AsRef<Path>, content: impl Into<Cow<'static, [u8]>>) -> Self {
        self.files.insert(joined(Path::new(""), path.as_ref()), content.into());
        self
    }
}

impl FileSource for EmbeddedFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match self.files.get(path) {
            Some(content) => Ok(content.to_vec()),
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.files.contains_key(path)
    }
}

/// A file that a shot depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRead {
    pub path: PathBuf,
    /// Of the contents, in hexadecimal digits.
    pub sha256: String,
    pub role: FileRole,
}

/// What a file is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileRole {
    /// The shot or the scene it imports: all that it says is in the resolved settings.
    Document,
    /// What the shot simulates.
    Scene,
    /// A camera: how finely the scene is simulated.
    Camera,
}

/// Of what is in a file, as [`FileRead`] has it.
pub(crate) fn content_hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Reads each file once and remembers which.
pub(super) struct Reader<'a> {
    source: &'a dyn FileSource,
    texts: RefCell<HashMap<PathBuf, Arc<str>>>,
    files_read: RefCell<Vec<FileRead>>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(source: &'a dyn FileSource) -> Self {
        Self { source, texts: RefCell::default(), files_read: RefCell::default() }
    }

    /// A whole file of UTF-8 text; bytes that are not become replacement characters, since old OBJ
    /// files carry comments in other encodings.
    pub(super) fn text(&self, path: &Path) -> Result<Arc<str>, LoadError> {
        self.text_for(FileRole::Scene, path)
    }

    /// As [`Reader::text`]. A file that is read for both counts as read for the first.
    pub(super) fn text_for(&self, role: FileRole, path: &Path) -> Result<Arc<str>, LoadError> {
        if let Some(text) = self.texts.borrow().get(path) {
            return Ok(text.clone());
        }
        let bytes = self
            .source
            .read(path)
            .map_err(|error| Problem::Read { path: path.to_path_buf(), error }.nowhere())?;
        let sha256 = content_hash(&bytes);
        self.files_read.borrow_mut().push(FileRead { path: path.to_path_buf(), sha256, role });
        let text: Arc<str> = String::from_utf8_lossy(&bytes).into();
        self.texts.borrow_mut().insert(path.to_path_buf(), text.clone());
        Ok(text)
    }

    pub(super) fn is_file(&self, path: &Path) -> bool {
        self.source.is_file(path)
    }

    pub(super) fn into_files_read(self) -> Vec<FileRead> {
        self.files_read.into_inner()
    }
}

/// `relative` seen from `folder`, without `.` and with `..` taken out where the name before it is
/// known, so that one file has one path.
pub(crate) fn joined(folder: &Path, relative: &Path) -> PathBuf {
    let mut path = PathBuf::new();
    for component in folder.join(relative).components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(path.components().next_back(), Some(Component::Normal(_))) =>
            {
                path.pop();
            }
            other => path.push(other),
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_paths_hold_no_detours() {
        let cases = [
            ("conf", "../meshes/a.obj", "meshes/a.obj"),
            ("", "../a", "../a"),
            ("../x", "..", ".."),
            ("/w/conf", "./b", "/w/conf/b"),
            ("x", "/abs", "/abs"),
        ];
        for (folder, relative, expected) in cases {
            assert_eq!(joined(Path::new(folder), Path::new(relative)), Path::new(expected));
        }
    }

    #[test]
    fn a_file_read_twice_is_listed_once_with_its_hash() {
        let source = EmbeddedFiles::default().with("a.txt", b"abc".as_slice());
        let reader = Reader::new(&source);
        for _ in 0..2 {
            assert_eq!(&*reader.text(Path::new("a.txt")).unwrap(), "abc");
        }
        let files = reader.into_files_read();
        assert_eq!(files.len(), 1);
        assert!(files[0].sha256.starts_with("ba7816bf"));
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Reader::new(&FileSystem).text(Path::new("no/such.obj")).unwrap_err();
        assert!(error.to_string().starts_with("cannot read \"no/such.obj\": "), "{error}");
    }
}
