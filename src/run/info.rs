//! `run.json`: what was simulated, by which program, from which input.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::RunError;

/// The version of the run folder as a whole; the first key of `run.json`.
pub const RUN_FORMAT: u32 = 1;

/// What a run is, apart from its frames. A reader ignores keys it does not know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunInfo {
    /// [`RUN_FORMAT`] of the program that wrote it.
    pub shotsilk_run: u32,
    /// Version of the program that wrote it.
    pub program_version: String,
    /// Name of the shot, for captions.
    pub shot: String,
    /// How fineness was decided: a word of the command line, such as `view`.
    pub sizing_mode: String,
    /// Frames per second.
    pub fps: f64,
    /// What frame 0 is called in `stats.csv` and in the names of OBJ files; state files keep the
    /// frame's own number.
    pub first_frame: i64,
    /// Names, in the order of the garments in a state.
    pub garments: Vec<String>,
    /// Names, in the order of the obstacles in a state.
    pub obstacles: Vec<String>,
    /// See [`InputHasher`](super::InputHasher).
    pub input_hash: String,
    /// What the processor offers: other features may give other bits.
    pub cpu_features: Vec<String>,
    /// Name of the graphics adapter; `None` if none was used.
    pub adapter: Option<String>,
    /// The shot as resolved, viewers included, so that the run can be drawn without the shot's
    /// file.
    pub settings: Value,
}

/// How the file begins.
const OPENING: &[u8] = b"{\n  \"shotsilk_run\":";

/// The part that every version has.
#[derive(Deserialize)]
struct Version {
    shotsilk_run: u64,
}

impl RunInfo {
    pub(super) fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec_pretty(self)
            .expect("strings, numbers and a JSON value have a JSON form");
        json.push(b'\n');
        json
    }

    /// # Errors
    /// If the file cannot be read, is not a `run.json`, or is one of a later format.
    pub(super) fn read(path: &Path) -> Result<Self, RunError> {
        let text = fs::read(path).map_err(RunError::io("read", path))?;
        let info_error = |source| RunError::Info { path: path.to_owned(), source };
        let Version { shotsilk_run } = serde_json::from_slice(&text).map_err(info_error)?;
        if !(1..=u64::from(RUN_FORMAT)).contains(&shotsilk_run) {
            return Err(RunError::InfoFormat { path: path.to_owned(), found: shotsilk_run });
        }
        serde_json::from_slice(&text).map_err(info_error)
    }

    /// True if the file is the `run.json` of any version.
    pub(super) fn is_at(path: &Path) -> bool {
        // A struct is read from an array as well, which is none of ours.
        let is_ours = |value: Value| value.get("shotsilk_run").is_some_and(Value::is_u64);
        fs::read(path).is_ok_and(|text| serde_json::from_slice(&text).is_ok_and(is_ours))
    }

    /// True if the file is what a failing disk or power makes of a `run.json`: empty, zeros, or only
    /// a part of one. What anyone else may have written is not.
    pub(super) fn is_broken_at(path: &Path) -> bool {
        fs::read(path).is_ok_and(|text| {
            let is_empty = text.iter().all(|&byte| byte == 0);
            let is_part =
                text.starts_with(OPENING) && serde_json::from_slice::<Value>(&text).is_err();
            is_empty || is_part
        })
    }
}
