//! Scripts that drive the program: for tests, for pictures in the manual, for showing a bug.
//!
//! A file of JSON, with comments if wanted: a list of steps, each an object with one member.

use std::path::PathBuf;

use serde::Deserialize;
use thiserror::Error;

use crate::preview::Action;
use crate::scene::from_json;

/// See the module. What waits does so for ten minutes at most, and the script for its end.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ScriptStep {
    /// What a user would do.
    Act(Action),
    /// Waits until these frames are there and shown as they should be: by number, both included.
    WaitForFrames { first: u32, last: u32 },
    /// Waits until nothing is being simulated, read, opened or exported.
    WaitUntilIdle,
    /// Waits while playing, until the frame is shown.
    WaitUntilShown { frame: u32 },
    /// (s).
    Wait { seconds: f64 },
    /// The pointer goes there and its first button is pressed and let go (points).
    Click { at: [f32; 2] },
    /// The pointer is pressed, dragged and let go (points).
    Drag { from: [f32; 2], to: [f32; 2], button: Button },
    /// A key is pressed and let go, by its name in egui: `Space`, `ArrowLeft`, `K`.
    Press { key: String },
    /// The window as PNG.
    Screenshot { to: PathBuf },
    /// Where the program stands, as JSON.
    Report { to: PathBuf },
    /// The measurements of the report begin here.
    ClearPace,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Button {
    Primary,
    Secondary,
    Middle,
}

/// Why a script cannot be replayed.
#[derive(Debug, Error)]
pub enum ScriptError {
    #[error("cannot read the script {path:?}")]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{0}")]
    Parse(String),
    /// Nothing was opened after it.
    #[error("{0}")]
    NotOpened(String),
    #[error("step {step} of the script, {what}: {why}")]
    Failed { step: usize, what: String, why: String },
}

/// # Errors
/// What is not as it must be, with its place.
pub fn script_from_text(name: &str, text: &str) -> Result<Vec<ScriptStep>, ScriptError> {
    from_json(name, text).map_err(|error| ScriptError::Parse(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_is_a_list_of_steps_with_comments() {
        let text = r#"[
            // Some frames first.
            {"wait-for-frames": {"first": 0, "last": 20}},
            {"act": "play"},
            {"act": {"set": {"path": "view.nu_out", "value": 0.1}}},
            "wait-until-idle",
            {"press": {"key": "Space"}},
        ]"#;
        let steps = script_from_text("s.json", text).unwrap();
        assert_eq!(steps.len(), 5);
        assert_eq!(steps[1], ScriptStep::Act(Action::Play));
        assert_eq!(steps[3], ScriptStep::WaitUntilIdle);
    }

    #[test]
    fn what_no_step_is_called_is_named_with_its_place() {
        let error = script_from_text("s.json", "[{\"jump\": 3}]").unwrap_err().to_string();
        assert!(error.starts_with("s.json:1:3: unknown value \"jump\""), "{error}");
    }
}
