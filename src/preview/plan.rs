//! What would be simulated now: the shot with the user's edits, resolved, and the key of every frame.

use std::path::PathBuf;
use std::sync::Arc;

use serde_json::Value;

use super::Edits;
use super::key::{FrameKey, StepKey, step_keys};
use crate::request::{Request, RequestError, Requested};
use crate::scene::{Surface, ViewSettings};
use crate::shot::CameraPath;
use crate::sim::SimSettings;

/// Where simulation is to go on from a frame that other settings made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Anchor {
    /// This frame stays as it is; those after it are made with the settings in force.
    pub frame: u32,
    pub key: FrameKey,
    /// Of the frames up to that one, as they were when settings changed.
    pub keys: Arc<Vec<Option<FrameKey>>>,
}

/// See the module. Never changes once made.
#[derive(Clone, Debug)]
pub struct Plan {
    pub requested: Requested,
    /// One for each frame from 0 to the last wanted one.
    pub steps: Vec<StepKey>,
}

impl Plan {
    /// # Errors
    /// As [`Request::load`].
    pub fn new(request: &Request, edits: &Edits) -> Result<Self, RequestError> {
        let mut request = request.clone();
        if edits.get("camera").is_some() || edits.get("viewers.0").is_some() {
            // The edited camera has grown out of the file's.
            request.camera = None;
        }
        request.sets.extend(edits.overrides());
        let requested = request.load()?;
        let steps = step_keys(&requested, requested.frames.last);
        Ok(Self { requested, steps })
    }

    pub fn last(&self) -> u32 {
        self.requested.frames.last
    }

    /// The keys that frames 0 to the last would have, by frame. Those up to an anchor are not made by
    /// this plan: `None`.
    pub fn keys(&self, anchor: Option<&Anchor>) -> Vec<Option<FrameKey>> {
        let mut parent = anchor.map(|a| a.key);
        let first = anchor.map_or(0, |a| a.frame as usize + 1);
        let mut keys = vec![None; first.min(self.steps.len())];
        for &step in self.steps.iter().skip(first) {
            let key = FrameKey::after(parent, step);
            keys.push(Some(key));
            parent = Some(key);
        }
        keys
    }

    /// The hash that a run with these settings would carry.
    pub fn settings_hash(&self) -> &str {
        &self.requested.info.input_hash
    }

    /// The shot camera, where there is one.
    pub fn camera(&self) -> Option<&CameraPath> {
        self.requested.scene.viewers.first()
    }

    pub fn surfaces(&self) -> Vec<Arc<Surface>> {
        self.requested.surfaces()
    }

    pub fn view_settings(&self) -> Vec<ViewSettings> {
        self.requested.scene.garments.iter().map(|g| g.view).collect()
    }

    pub fn settings(&self) -> SimSettings {
        self.requested.settings
    }

    /// All settings, with nothing left to defaults.
    pub fn resolved(&self) -> &Value {
        &self.requested.info.settings
    }

    /// Every file the plan was made from.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.requested.files_read.iter().map(|file| &file.path)
    }
}
