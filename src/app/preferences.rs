//! What the program remembers of its user, in a file of JSON.

use std::fs;
use std::path::{Path, PathBuf};

use etcetera::{BaseStrategy, choose_base_strategy};
use serde::{Deserialize, Serialize};

use crate::output::{PendingFile, folder_of};
use crate::preview::{Look, MEMORY_BUDGET};

/// Recent files listed.
const RECENT_KEPT: usize = 10;

/// See the module. What a file does not say, or says in a way that is not understood, is as by default.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(default)]
pub struct Preferences {
    /// The latest first.
    pub recent: Vec<PathBuf>,
    /// Memory for frames (MB).
    pub memory_mb: u64,
    /// Size of text and controls.
    pub scale: f32,
    pub look: Look,
    /// Where they are kept; `None` keeps them nowhere.
    #[serde(skip)]
    pub file: Option<PathBuf>,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            recent: Vec::new(),
            memory_mb: MEMORY_BUDGET >> 20,
            scale: 1.0,
            look: Look::default(),
            file: None,
        }
    }
}

impl Preferences {
    /// Those of the user who runs the program.
    pub fn of_user() -> Self {
        let folder = choose_base_strategy().ok().map(|base| base.config_dir().join("shotsilk"));
        match folder {
            Some(folder) => Self::read(&folder.join("preferences.json")),
            None => Self::default(),
        }
    }

    /// Those in a file, to be kept there; the defaults if there is none.
    pub fn read(file: &Path) -> Self {
        let text = fs::read_to_string(file).unwrap_or_default();
        let read: Self = serde_json::from_str(&text).unwrap_or_default();
        let scale = if read.scale.is_finite() { read.scale.clamp(0.5, 3.0) } else { 1.0 };
        Self { file: Some(file.to_owned()), scale, ..read }
    }

    /// # Errors
    /// In words, if they cannot be written.
    pub fn save(&self) -> Result<(), String> {
        let Some(file) = &self.file else { return Ok(()) };
        let text = serde_json::to_string_pretty(self).expect("preferences are plain data");
        let write = || -> anyhow::Result<()> {
            fs::create_dir_all(folder_of(file))?;
            PendingFile::create(file)?.write(text.as_bytes())
        };
        write()
            .map_err(|error| format!("cannot keep preferences in {:?}: {error:#}", file.display()))
    }

    /// The file or folder has been opened.
    pub fn note_recent(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(RECENT_KEPT);
    }
}

/// Where frames are kept between starts of the program.
pub fn cache_folder() -> Option<PathBuf> {
    let base = choose_base_strategy().ok()?;
    Some(base.cache_dir().join("shotsilk").join("frames"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferences_come_back_and_nonsense_is_as_by_default() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("deep/preferences.json");
        let mut preferences = Preferences::read(&file);
        assert_eq!(preferences.memory_mb, 1024);
        preferences.memory_mb = 64;
        preferences.look.wireframe = false;
        for name in ["a", "b", "a"] {
            preferences.note_recent(Path::new(name));
        }
        preferences.save().unwrap();
        let read = Preferences::read(&file);
        assert_eq!(read, preferences);
        assert_eq!(read.recent.len(), 2);
        assert!(read.recent[0].ends_with("a"));
        fs::write(&file, "{\"memory_mb\": \"much\"}").unwrap();
        assert_eq!(Preferences::read(&file).memory_mb, 1024);
    }

    #[test]
    fn a_place_that_cannot_be_written_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let preferences = Preferences::read(&file.join("preferences.json"));
        assert!(preferences.save().unwrap_err().starts_with("cannot keep preferences in"));
    }
}
