//! Editing a camera: keys set, moved and deleted, cuts, lens. Numbers that nobody touches keep their
//! bits, so that frames they decide stay valid.

mod keyed;
mod lens;

pub use lens::LensValue;

use glam::DVec3;
use serde_json::{Value, json};
use thiserror::Error;

use super::edits::is_same;
use crate::scene::native::{CameraFile, KeyFile};
use crate::scene::{Scene, recorded_viewers};
use crate::shot::CameraPath;

/// A camera with keys as its file has it: valid at all times, an edit that would break it is refused. Two
/// are the same if they are bit for bit.
#[derive(Clone, Debug)]
pub struct CameraEdit {
    file: CameraFile,
}

/// Where the camera stands and what it looks at (m, world).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    pub eye: DVec3,
    pub target: DVec3,
    /// The direction that is up in the image.
    pub up: DVec3,
}

/// Whether the camera jumps to a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    Yes,
    No,
}

/// Which keys a lens is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LensScope {
    /// The key at this frame.
    Key(f64),
    WholePath,
}

/// Why a camera cannot be edited that way. Frames are those of the shot, from 0.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CameraEditError {
    #[error("the shot has no camera")]
    NoCamera,
    #[error("the camera has a matrix a frame and no keys: turn it into keys first")]
    Baked,
    #[error("the camera has no key at frame {0}")]
    NoKey(f64),
    #[error("the camera has a key at frame {0} already")]
    Occupied(f64),
    #[error("the key at frame {0} is the camera's only one")]
    LastKey(f64),
    #[error("the key at frame {0} is the first: there is nothing to cut from")]
    FirstKeyCut(f64),
    #[error("the camera's lens is an angle of view: there is no film back for a focal length")]
    NoFilmBack,
    #[error("the camera cannot be so: {0}")]
    Invalid(String),
}

impl CameraEdit {
    /// The shot camera of a loaded shot: of [`LoadedShot::resolved`](crate::scene::LoadedShot) and
    /// the scene.
    ///
    /// # Errors
    /// If the shot has no camera, or one without keys.
    pub fn of_shot(resolved: &Value, scene: &Scene) -> Result<Self, CameraEditError> {
        let file = file_of_shot(resolved, scene)?;
        match file.keys {
            Some(_) => Self::checked(file),
            None => Err(CameraEditError::Baked),
        }
    }

    /// As a value for [`camera_setting`]: what has its default is left out.
    pub fn json(&self) -> Value {
        let mut camera = without_nulls(json!(self.file));
        for key in camera["keys"].as_array_mut().into_iter().flatten() {
            let Some(key) = key.as_object_mut() else { continue };
            key.retain(|name, value| !is_implied(name, value));
        }
        camera
    }

    /// As it moves.
    ///
    /// # Panics
    /// Never: the camera is valid at all times.
    pub fn path(&self) -> CameraPath {
        path_of(&self.file).expect("it was checked when it was made")
    }

    /// In order of frame, at least one.
    pub fn keys(&self) -> &[KeyFile] {
        self.file.keys.as_deref().unwrap_or_default()
    }

    /// With a key at a frame. One that is there is replaced and stays a cut if it was one; a new one
    /// is none. Without a lens it keeps the one it had, or has what the path had at the frame.
    ///
    /// # Errors
    /// If the placement is no view, or the lens does not suit the camera.
    pub fn set_key(
        &self,
        frame: f64,
        placement: Placement,
        lens: Option<LensValue>,
    ) -> Result<Self, CameraEditError> {
        let mut edit = self.clone();
        let [eye, target, up] =
            [placement.eye, placement.target, placement.up].map(|v| v.to_array());
        match edit.index(frame) {
            Some(index) => {
                let key = &mut edit.keys_mut()[index];
                *key = KeyFile { eye, target, up, ..key.clone() };
            }
            None => {
                let of_lens = self.new_lens_at(frame);
                let index = self.keys().partition_point(|key| key.frame < frame);
                let key = KeyFile { frame, eye, target, up, cut: false, ..of_lens };
                edit.keys_mut().insert(index, key);
            }
        }
        match lens {
            Some(value) => edit.set_lens(LensScope::Key(frame), value),
            None => Self::checked(edit.file),
        }
    }

    /// Without the key at a frame. Its cut goes with it; if it was the first, the next is no cut.
    ///
    /// # Errors
    /// If there is no such key or no other, and where the lens would change its kind without a cut.
    pub fn delete_key(&self, frame: f64) -> Result<Self, CameraEditError> {
        let index = self.existing(frame)?;
        if self.keys().len() == 1 {
            return Err(CameraEditError::LastKey(frame));
        }
        let mut edit = self.clone();
        edit.keys_mut().remove(index);
        edit.keys_mut()[0].cut = false;
        Self::checked(edit.file)
    }

    /// With the key at `from` at another frame. It may pass others; the key that is then first is no
    /// cut.
    ///
    /// # Errors
    /// If there is no key at `from` or one at `to`, and where the lens would change its kind without
    /// a cut.
    pub fn move_key(&self, from: f64, to: f64) -> Result<Self, CameraEditError> {
        let index = self.existing(from)?;
        if from == to {
            return Ok(self.clone());
        }
        if self.index(to).is_some() {
            return Err(CameraEditError::Occupied(to));
        }
        let mut edit = self.clone();
        let keys = edit.keys_mut();
        let key = KeyFile { frame: to, ..keys.remove(index) };
        let index = keys.partition_point(|other| other.frame < to);
        keys.insert(index, key);
        keys[0].cut = false;
        Self::checked(edit.file)
    }

    /// # Errors
    /// If there is no such key, if the first is to be a cut, and where the lens would change its
    /// kind without one.
    pub fn set_cut(&self, frame: f64, cut: Cut) -> Result<Self, CameraEditError> {
        let index = self.existing(frame)?;
        if index == 0 && cut == Cut::Yes {
            return Err(CameraEditError::FirstKeyCut(frame));
        }
        let mut edit = self.clone();
        edit.keys_mut()[index].cut = cut == Cut::Yes;
        Self::checked(edit.file)
    }

    fn checked(file: CameraFile) -> Result<Self, CameraEditError> {
        path_of(&file)?;
        Ok(Self { file })
    }

    fn keys_mut(&mut self) -> &mut Vec<KeyFile> {
        self.file.keys.get_or_insert_default()
    }

    fn index(&self, frame: f64) -> Option<usize> {
        self.keys().iter().position(|key| key.frame == frame)
    }

    fn existing(&self, frame: f64) -> Result<usize, CameraEditError> {
        self.index(frame).ok_or(CameraEditError::NoKey(frame))
    }
}

impl PartialEq for CameraEdit {
    fn eq(&self, other: &Self) -> bool {
        is_same(&json!(self.file), &json!(other.file))
    }
}

/// Whether a key that does not say this means the same.
pub(super) fn is_implied(name: &str, value: &Value) -> bool {
    match name {
        "cut" => *value == json!(false),
        "up" => is_same(value, &json!([0.0, 0.0, 1.0])),
        _ => false,
    }
}

/// The setting that holds the shot camera: `camera`, or the first of several viewers. `written` is
/// [`LoadedShot::written`](crate::scene::LoadedShot).
pub fn camera_setting(written: &Value) -> &'static str {
    match written["viewers"].as_array() {
        Some(viewers) if !viewers.is_empty() => "viewers.0",
        _ => "camera",
    }
}

/// Whether a setting is a camera, or part of one.
pub(super) fn is_camera_setting(path: &str) -> bool {
    path == "camera" || path.starts_with("viewers")
}

/// With the name it has where it is shown: a camera that moves into the shot file loses its own
/// file's.
fn file_of_shot(resolved: &Value, scene: &Scene) -> Result<CameraFile, CameraEditError> {
    let (Some(record), Some(path)) = (resolved["viewers"].get(0), scene.viewers.first()) else {
        return Err(CameraEditError::NoCamera);
    };
    let mut file: CameraFile = serde_json::from_value(record.clone()).map_err(invalid)?;
    file.name.get_or_insert_with(|| path.name.clone());
    Ok(file)
}

/// By the checks that every camera of a shot goes through.
fn path_of(file: &CameraFile) -> Result<CameraPath, CameraEditError> {
    let record = json!({"viewers": [file]});
    let mut paths = recorded_viewers(&record).map_err(|error| invalid(error.problem))?;
    paths.pop().ok_or(CameraEditError::NoCamera)
}

fn invalid(problem: impl ToString) -> CameraEditError {
    CameraEditError::Invalid(problem.to_string())
}

fn without_nulls(value: Value) -> Value {
    match value {
        Value::Array(elements) => elements.into_iter().map(without_nulls).collect(),
        Value::Object(members) => {
            let given = members.into_iter().filter(|(_, value)| !value.is_null());
            Value::Object(given.map(|(name, value)| (name, without_nulls(value))).collect())
        }
        other => other,
    }
}

#[cfg(test)]
mod tests;
