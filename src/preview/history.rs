//! Undo and redo.

use super::Edits;
use super::plan::Anchor;

/// What the frames are made from: the user's edits, and from where they hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Version {
    pub edits: Edits,
    pub anchor: Option<Anchor>,
}

/// Versions before and after the one in force.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    done: Vec<Version>,
    undone: Vec<Version>,
}

/// Versions kept.
const DEPTH: usize = 200;

impl History {
    /// Notes the version that is about to be changed; what was undone is given up.
    pub fn note(&mut self, before: Version) {
        self.undone.clear();
        self.done.push(before);
        if self.done.len() > DEPTH {
            self.done.remove(0);
        }
    }

    /// The version before, if there is one; `now` can be had back by [`History::redo`].
    pub fn undo(&mut self, now: Version) -> Option<Version> {
        let before = self.done.pop()?;
        self.undone.push(now);
        Some(before)
    }

    pub fn redo(&mut self, now: Version) -> Option<Version> {
        let after = self.undone.pop()?;
        self.done.push(now);
        Some(after)
    }

    pub fn can_undo(&self) -> bool {
        !self.done.is_empty()
    }

    pub fn can_redo(&self) -> bool {
        !self.undone.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn version(value: f64) -> Version {
        let mut version = Version::default();
        version.edits.set("view.nu_out", json!(value));
        version
    }

    #[test]
    fn what_is_undone_can_be_redone_until_something_else_is_done() {
        let mut history = History::default();
        history.note(version(0.0));
        history.note(version(1.0));
        assert_eq!(history.undo(version(2.0)), Some(version(1.0)));
        assert_eq!(history.undo(version(1.0)), Some(version(0.0)));
        assert_eq!(history.undo(version(0.0)), None);
        assert_eq!(history.redo(version(0.0)), Some(version(1.0)));
        history.note(version(1.0));
        assert!(!history.can_redo() && history.can_undo());
    }
}
