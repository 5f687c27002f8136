//! What a frame's bits depend on, as a chain of hashes: two frames of one key have the same bits,
//! whenever and by whichever run they were made.
//!
//! ```text
//! key of frame n = hash(key of frame n - 1, step of frame n)
//! step of frame n = hash(everything but the cameras, what the cameras see that frame n looks at)
//! ```
//! So an edit of the camera changes the keys from the first frame on whose window it reaches, and
//! those of no frame before; one that is undone gives the old keys back, and with them the frames.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::request::Requested;
use crate::run::InputHasher;
use crate::scene::{FileRole, Scene, joined};
use crate::shot::View;
use crate::sim::SizingMode;
use crate::view::ViewerWindow;

/// Names the bits of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FrameKey([u8; 32]);

/// Names all that the step to a frame depends on besides the frame before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StepKey([u8; 32]);

/// Settings that no bit of a frame depends on: what it is called, how many there are, and the
/// cameras, which are counted by what they see.
const NOT_COUNTED: [&str; 4] = ["name", "frames", "first_frame", "viewers"];

impl FrameKey {
    /// Of a frame that comes after `parent`; of frame 0 without one.
    pub fn after(parent: Option<FrameKey>, step: StepKey) -> Self {
        let mut hash = Sha256::new();
        hash.update(parent.map_or([0; 32], |key| key.0));
        hash.update(step.0);
        Self(hash.finalize().into())
    }

    /// Of a frame of a finished run, by what tells that run from all others.
    pub fn of_run(run: &str, number: u32) -> Self {
        let mut hash = Sha256::new();
        hash.update(b"run");
        hash.update(run.as_bytes());
        hash.update(number.to_le_bytes());
        Self(hash.finalize().into())
    }
}

/// Lower-case hexadecimal.
impl fmt::Display for FrameKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// The steps to frames 0 to `last`.
pub fn step_keys(requested: &Requested, last: u32) -> Vec<StepKey> {
    let base = base_hash(requested);
    let watched = requested.settings.sizing == SizingMode::View;
    let seen: Vec<[u8; 32]> = (0..=last)
        .map(|frame| if watched { seen_hash(&requested.scene, frame) } else { [0; 32] })
        .collect();
    (0..=last as usize)
        .map(|frame| {
            let mut hash = Sha256::new();
            hash.update(base);
            // What nobody sees is compensated with the window of the frame before.
            hash.update(seen[frame.saturating_sub(1)]);
            hash.update(seen[frame]);
            StepKey(hash.finalize().into())
        })
        .collect()
}

/// Over the settings without the cameras, the files that these name, the program and the processor.
fn base_hash(requested: &Requested) -> [u8; 32] {
    let info = &requested.info;
    let mut settings = info.settings.clone();
    if let Value::Object(map) = &mut settings {
        NOT_COUNTED.iter().for_each(|name| {
            map.remove(*name);
        });
        if requested.settings.sizing != SizingMode::View {
            map.remove("view");
            for garment in
                map.get_mut("garments").and_then(Value::as_array_mut).into_iter().flatten()
            {
                garment.as_object_mut().and_then(|garment| garment.remove("view"));
            }
        }
    }
    let contents: BTreeMap<&Path, &str> =
        requested.files_read.iter().map(|f| (f.path.as_path(), f.sha256.as_str())).collect();
    name_by_contents(&mut settings, &requested.folder, &contents);
    let mut hasher = InputHasher::new(&settings);
    for file in requested.files_read.iter().filter(|file| file.role == FileRole::Scene) {
        hasher.add_file(file.sha256.as_bytes());
    }
    hasher.add_file(info.program_version.as_bytes());
    hasher.add_file(info.cpu_features.join(" ").as_bytes());
    Sha256::digest(hasher.finish().as_bytes()).into()
}

/// Puts in place of a file's name what the file holds: a shot that moves is the same shot.
fn name_by_contents(value: &mut Value, folder: &Path, contents: &BTreeMap<&Path, &str>) {
    match value {
        Value::String(name) => {
            if let Some(sha256) = contents.get(joined(folder, Path::new(name.as_str())).as_path()) {
                *name = (*sha256).to_owned();
            }
        }
        Value::Array(items) => {
            items.iter_mut().for_each(|item| name_by_contents(item, folder, contents));
        }
        Value::Object(map) => {
            map.values_mut().for_each(|value| name_by_contents(value, folder, contents));
        }
        _ => {}
    }
}

/// Over the views that the garments' windows at a frame hold.
fn seen_hash(scene: &Scene, frame: u32) -> [u8; 32] {
    let mut ahead: Vec<f64> = scene.garments.iter().map(|g| g.view.anticipation_frames).collect();
    ahead.sort_by(f64::total_cmp);
    ahead.dedup();
    let mut hash = Sha256::new();
    for path in &scene.viewers {
        for &ahead in &ahead {
            for sample in ViewerWindow::new(path, f64::from(frame), ahead).samples() {
                hash.update(sample.weight.to_le_bytes());
                view_numbers(&sample.view).iter().for_each(|x| hash.update(x.to_le_bytes()));
            }
        }
        hash.update(b"|");
    }
    hash.finalize().into()
}

fn view_numbers(view: &View) -> Vec<f64> {
    // Exhaustive, so that a new field cannot be forgotten here.
    let View { eye, right, up, back, gate_min, gate_max, near, far, resolution } = *view;
    let mut numbers: Vec<f64> = [eye, right, up, back].iter().flat_map(|v| v.to_array()).collect();
    numbers.extend(gate_min.to_array());
    numbers.extend(gate_max.to_array());
    numbers.extend([near, far]);
    numbers.extend(resolution.map(f64::from));
    numbers
}

#[cfg(test)]
#[path = "key_tests.rs"]
mod tests;
