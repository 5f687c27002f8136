//! What can go wrong with a run folder. Causes are in the error's source, so that a chain names
//! each thing once.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::mesh::MeshError;

/// Why a run folder cannot be written or read.
#[derive(Debug, Error)]
pub enum RunError {
    #[error("cannot {action} \"{}\"", path.display())]
    Io { action: &'static str, path: PathBuf, source: io::Error },
    #[error("cannot read \"{}\"", path.display())]
    State { path: PathBuf, source: StateError },
    #[error("cannot read \"{}\"", path.display())]
    Info { path: PathBuf, source: serde_json::Error },
    #[error(
        "\"{}\" has run format {found}; this program reads formats 1 to {}",
        path.display(), super::RUN_FORMAT
    )]
    InfoFormat { path: PathBuf, found: u64 },
    #[error("\"{}\" is not a run folder: it has no readable run.json", path.display())]
    NotARun { path: PathBuf },
    #[error(
        "the run.json of \"{}\" is damaged: the run can only be replaced, with --overwrite",
        path.display()
    )]
    Broken { path: PathBuf },
    #[error("\"{}\" is not empty and not a run folder: choose another folder", path.display())]
    Occupied { path: PathBuf },
    #[error(
        "\"{}\" already holds a run: go on with it by --resume, replace it with --overwrite or choose another folder",
        path.display()
    )]
    AlreadyARun { path: PathBuf },
    #[error("\"{}\" is being written by another program", path.display())]
    InUse { path: PathBuf },
    #[error("\"{}\" has no frame {number}: {}", path.display(), held(*.first_and_last))]
    NoSuchFrame { path: PathBuf, number: u32, first_and_last: Option<[u32; 2]> },
    #[error("\"{}\" holds frame {found}, not frame {expected}", path.display())]
    WrongFrame { path: PathBuf, found: u32, expected: u32 },
    #[error(
        "\"{}\" comes from other settings or files (hash {found}) than this simulation (hash {expected})",
        path.display()
    )]
    OtherInput { path: PathBuf, found: String, expected: String },
    #[error(
        "\"{}\" was begun by version {found} of this program, which has version {expected}: it may compute otherwise, so that the run can only be replaced, with --overwrite",
        path.display()
    )]
    OtherVersion { path: PathBuf, found: String, expected: String },
    #[error(
        "\"{}\" holds frame {held}, but not frame {wanted} to begin with: ask for frames from {held} on with --frames, or replace the run with --overwrite",
        path.display()
    )]
    BeginsLater { path: PathBuf, held: u32, wanted: u32 },
}

/// What is wrong with the bytes of a stored state.
#[derive(Debug, Error)]
pub enum StateError {
    #[error("it is too short: the {what} needs {needed} bytes, {left} are left")]
    TooShort { what: &'static str, needed: u64, left: usize },
    #[error("it does not start with {expected:?} but with {found:?}: not a shotsilk state")]
    NotAState { expected: String, found: String },
    #[error("it has format version {found}; this program reads versions 1 to {known}")]
    Version { found: u32, known: u32 },
    #[error("it holds {found} bytes after the header, the header promises {expected}")]
    StoredLength { found: u64, expected: u64 },
    #[error("its checksum is {found}, the header promises {expected}: the file is damaged")]
    Checksum { found: String, expected: String },
    #[error("it cannot be decompressed")]
    Compression(#[source] io::Error),
    #[error("it decompresses to {found} bytes or more, the header promises {expected}")]
    FullLength { found: u64, expected: u64 },
    #[error("{count} bytes follow the end of the state")]
    Surplus { count: usize },
    #[error("the {what} is {found}, expected {expected}")]
    Value { what: &'static str, found: u64, expected: &'static str },
    #[error("warning {index} is not UTF-8 text")]
    Text { index: usize },
    #[error("garment {index}")]
    Garment { index: usize, source: MeshError },
    #[error("triangle {triangle} of obstacle {obstacle} names point {point} of {count}")]
    Triangle { obstacle: usize, triangle: usize, point: u32, count: usize },
}

impl RunError {
    /// True if what was given is no run, a damaged one or the wrong one; false if the system failed.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, RunError::Io { .. } | RunError::InUse { .. })
    }

    /// True if a file is not what was written under its name.
    pub(super) fn is_damage(&self) -> bool {
        match self {
            RunError::State { source, .. } => !matches!(source, StateError::Version { .. }),
            RunError::WrongFrame { .. } => true,
            _ => false,
        }
    }

    pub(super) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| RunError::Io { action, path, source }
    }
}

fn held(first_and_last: Option<[u32; 2]>) -> String {
    match first_and_last {
        None => "it holds no frames yet".to_owned(),
        Some([first, last]) => format!("it holds frames between {first} and {last}"),
    }
}
