//! Putting edits into the text of a shot file, and nothing else: comments, layout and number formats
//! stay as their author wrote them.

mod entries;
mod insert;
mod keep;
mod layout;
mod put;
mod rebase;

pub use rebase::{rebased, seen_from};

use serde_json::Value;
use thiserror::Error;

use super::Edits;
use crate::scene::native::SHOT_VERSION;
use crate::scene::{Known, shot_schema};
use put::Document;

/// Why edits cannot be written into a shot file.
#[derive(Debug, Error)]
pub enum SaveError {
    #[error("the shot file is no JSON: {0}")]
    Syntax(String),
    #[error(
        "this is not a shot of this program (no \"shotsilk\": {SHOT_VERSION}), so it is never \
         written to: save a new shot that imports it"
    )]
    NotAShot,
    #[error("cannot write {path:?}: {problem}")]
    Unknown { path: String, problem: String },
    #[error("cannot write {path:?}: the list {list:?} has no element {index:?} in the shot file")]
    NoElement { path: String, list: String, index: String },
    #[error("cannot write {path:?}: {parent:?} is {found} in the shot file")]
    NoGroup { path: String, parent: String, found: &'static str },
    #[error(
        "cannot write {path:?}: a shot that imports a scene can change elements of its garments, \
         but of {list:?} only the whole list"
    )]
    ImportedList { path: String, list: String },
    #[error(
        "cannot write {path:?}: a shot that imports a scene can only add to {path:?}, not replace \
         it: set what is inside one by one"
    )]
    ImportedGroup { path: String },
    #[error("the folder {0:?} must be given in full")]
    RelativeFolder(std::path::PathBuf),
}

/// The text of a native shot file with the edits in it: loading it gives the settings that loading
/// the original with [`Edits::overrides`] gives. New keys stand where the format has them.
///
/// # Errors
/// If the text is no native shot, if a path is no setting or does not fit what stands in the file,
/// and if the file imports a scene over which it cannot say what the edit says.
pub fn saved_text(original: &str, edits: &Edits) -> Result<String, SaveError> {
    let (mark, original) = parted_mark(original);
    let schema = shot_schema();
    let known = Known::of(&schema);
    let imports = {
        let document = Document::parse(original)?;
        if !document.has_key("shotsilk") {
            return Err(SaveError::NotAShot);
        }
        document.has_key("import")
    };
    let mut text = original.to_owned();
    for (path, value) in edits.iter() {
        known.check(path).map_err(|problem| SaveError::Unknown {
            path: path.to_owned(),
            problem: problem.to_string(),
        })?;
        if imports && is_merged(path, value) {
            return Err(SaveError::ImportedGroup { path: path.to_owned() });
        }
        text = Document::parse(&text)?.with(&known, path, value)?;
    }
    Ok(format!("{mark}{text}"))
}

/// The text of a new shot around an ARCSim scene, which itself is never written to. `import` is the
/// scene's file as the new shot's folder sees it ([`seen_from`]).
///
/// # Errors
/// If a path is no setting, or if a shot around a scene cannot say what the edit says.
pub fn wrapped_text(import: &str, edits: &Edits) -> Result<String, SaveError> {
    let import = Value::from(import);
    let bare = format!("{{\n    \"shotsilk\": {SHOT_VERSION},\n    \"import\": {import}\n}}\n");
    saved_text(&bare, edits)
}

/// True if a shot's value is merged into the imported scene's, where an override replaces it.
/// Scenes have no cameras, so that those are the shot's own.
fn is_merged(path: &str, value: &Value) -> bool {
    let is_camera = matches!(path.split('.').next(), Some("camera" | "viewers"));
    !is_camera && (value.is_object() || path == "garments")
}

/// The byte order mark of a text, if it has one, and the text behind it.
fn parted_mark(text: &str) -> (&str, &str) {
    text.split_at(if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 })
}

#[cfg(test)]
mod tests;
