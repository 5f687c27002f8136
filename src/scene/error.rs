//! Why a shot cannot be loaded: where, what, and what would have been right.

use std::fmt;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use thiserror::Error;

use super::deformation::DeformationError;
use super::fabric::PRESETS;
use super::motion::MotionError;
use crate::mesh::MeshError;

/// Where in the input something stands. Lines and columns count from 1; columns are characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    Text {
        file: Arc<str>,
        line: usize,
        column: usize,
    },
    Line {
        file: Arc<str>,
        line: usize,
    },
    File {
        file: Arc<str>,
    },
    /// An override from the command line.
    Set {
        argument: Arc<str>,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Text { file, line, column } => write!(f, "{file}:{line}:{column}"),
            Place::Line { file, line } => write!(f, "{file}:{line}"),
            Place::File { file } => f.write_str(file),
            Place::Set { argument } => write!(f, "--set {argument}"),
        }
    }
}

/// A shot that cannot be loaded; its text holds the whole chain.
#[derive(Debug)]
pub struct LoadError {
    pub place: Option<Place>,
    pub problem: Problem,
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "{place}: {}", self.problem),
            None => write!(f, "{}", self.problem),
        }
    }
}

impl std::error::Error for LoadError {}

impl LoadError {
    /// The same error; at `place` unless it has one already.
    pub(super) fn or_at(mut self, place: &Place) -> Self {
        self.place.get_or_insert_with(|| place.clone());
        self
    }
}

/// What is wrong.
#[derive(Debug, Error)]
pub enum Problem {
    #[error("cannot read {path:?}: {error}")]
    Read { path: PathBuf, error: io::Error },
    /// The text is no JSON.
    #[error("{0}")]
    Syntax(String),
    /// A value of the wrong kind, an unknown or a missing key.
    #[error("{0}")]
    Shape(String),
    #[error("the key {name:?} appears twice in one object")]
    RepeatedKey { name: String },
    #[error("this is neither a shot (no \"shotsilk\": 1) nor an ARCSim scene (no \"cloths\")")]
    NeitherShotNorScene,
    #[error("the shot file has version {found}, but this program reads version {supported}")]
    Version { found: u32, supported: u32 },
    #[error("{thing} is {value}, but must be {limit}")]
    OutOfRange { thing: String, value: String, limit: String },
    #[error("there is no {kind} {name:?}{}", suggestion(nearest))]
    UnknownName { kind: &'static str, name: String, nearest: Option<String> },
    #[error("there is no preset {name:?} among {}{}", preset_names().join(", "), suggestion(nearest))]
    UnknownPreset { name: String, nearest: Option<String> },
    #[error("{thing} is not supported yet")]
    NotSupported { thing: String },
    #[error("{thing} needs {needed}")]
    Missing { thing: String, needed: &'static str },
    #[error("{thing} has both {first} and {second}, but they exclude each other")]
    Exclusive { thing: String, first: &'static str, second: &'static str },
    #[error("there is no setting {path:?}{}", suggestion(nearest))]
    UnknownSetting { path: String, nearest: Option<String> },
    #[error("{0:?} is no override: write path.to.field=value")]
    NoOverride(String),
    #[error("cannot set {path:?}: {parent:?} is {found}, which has no settings inside")]
    NoGroup { path: String, parent: String, found: &'static str },
    #[error("{thing}: {error}")]
    Mesh { thing: String, error: MeshError },
    #[error("expected {expected}, found {found:?}")]
    Token { expected: &'static str, found: String },
    #[error("a {thing} names {what} {index}, but there are {count}")]
    Index { thing: &'static str, what: &'static str, index: i64, count: usize },
    #[error("motion {name:?}: {error}")]
    Motion { name: String, error: MotionError },
    #[error("{thing}: {error}")]
    Deformation { thing: String, error: DeformationError },
    #[error(
        "it has {} points and {} triangles, but {first:?} has {} and {}: all meshes of a deforming obstacle must have the same triangles",
        found[0], found[1], expected[0], expected[1]
    )]
    OtherTriangles { first: String, found: [usize; 2], expected: [usize; 2] },
    #[error(
        "the camera path has {camera} frames a second, but the scene has {scene}: say with --fps which holds"
    )]
    FrameRate { camera: f64, scene: f64 },
    #[error("{thing}: {what}")]
    Camera { thing: String, what: &'static str },
}

pub(super) fn preset_names() -> [&'static str; PRESETS.len()] {
    PRESETS.map(|preset| preset.name)
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!(": did you mean {name:?}?")).unwrap_or_default()
}

impl Problem {
    pub(super) fn at(self, place: Place) -> LoadError {
        LoadError { place: Some(place), problem: self }
    }

    pub(super) fn nowhere(self) -> LoadError {
        LoadError { place: None, problem: self }
    }
}

/// The candidate that differs least from `name`, if any is close enough to be a slip.
pub(super) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    let limit = (name.chars().count() / 3).max(2);
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|&(distance, _)| distance <= limit)
        .min()
        .map(|(_, candidate)| candidate.to_owned())
}

/// Levenshtein's distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, p) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &q) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(p != q);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_a_slip_away_or_absent() {
        let names = ["nu_front", "nu_back", "margin_m"];
        assert_eq!(nearest("nu_bakc", names), Some("nu_back".into()));
        assert_eq!(nearest("gravity", names), None);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }
}
