//! A camera with a matrix a frame turned into one with keys.

use std::collections::BTreeSet;
use std::num::NonZeroU32;

use glam::{DMat4, DVec3};
use serde_json::Value;

use super::{CameraEdit, CameraEditError, file_of_shot, invalid, path_of};
use crate::scene::Scene;
use crate::scene::native::{CameraFile, KeyFile, SampleFile};
use crate::shot::Track;

impl CameraEdit {
    /// The shot camera with keys instead of matrices: at the ends of every run between cuts, and
    /// every so many frames from its start. Cuts stay where they are; at the keys the camera stands
    /// as it stood, between them it moves smoothly. The targets lie `target_distance` in front of
    /// the eye (m). A camera with keys stays as it is.
    ///
    /// # Errors
    /// If the shot has no camera, or the distance is no positive number.
    pub fn keyed(
        resolved: &Value,
        scene: &Scene,
        every: NonZeroU32,
        target_distance: f64,
    ) -> Result<Self, CameraEditError> {
        let mut file = file_of_shot(resolved, scene)?;
        let Some(written) = file.matrices.take() else { return Self::checked(file) };
        if !(target_distance > 0.0 && target_distance.is_finite()) {
            return Err(invalid(format!(
                "the target is {target_distance} m in front of it, but must be more than 0"
            )));
        }
        let baked = CameraFile { matrices: Some(written.clone()), ..file.clone() };
        let Track::Matrices { samples, cuts } = path_of(&baked)?.track else {
            return Err(CameraEditError::NoCamera);
        };
        let key = |frame: u32| {
            let index = frame as usize;
            let is_cut = cuts.contains(&frame);
            key(frame, samples[index].0, &written[index], target_distance, is_cut)
        };
        file.keys =
            Some(key_frames(samples.len() as u32, &cuts, every).into_iter().map(key).collect());
        Self::checked(file)
    }
}

/// Ascending.
fn key_frames(frame_count: u32, cuts: &[u32], every: NonZeroU32) -> BTreeSet<u32> {
    let starts = std::iter::once(0).chain(cuts.iter().copied());
    let ends = cuts.iter().copied().chain([frame_count]);
    let of_run = |(start, end): (u32, u32)| {
        (start..end).step_by(every.get() as usize).chain(end.checked_sub(1))
    };
    starts.zip(ends).flat_map(of_run).collect()
}

/// The sample's lens is taken as it is written: what it does not say the camera still does.
fn key(
    frame: u32,
    world_from_camera: DMat4,
    sample: &SampleFile,
    target_distance: f64,
    cut: bool,
) -> KeyFile {
    let eye = world_from_camera.w_axis.truncate();
    let target = eye - target_distance * world_from_camera.z_axis.truncate().normalize_or(DVec3::Z);
    KeyFile {
        frame: f64::from(frame),
        eye: eye.to_array(),
        target: target.to_array(),
        up: world_from_camera.y_axis.truncate().to_array(),
        fov_y_deg: sample.fov_y_deg,
        focal_mm: sample.focal_mm,
        aperture_mm: sample.aperture_mm,
        offset_mm: sample.offset_mm,
        cut,
    }
}
