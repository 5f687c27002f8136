//! A camera over the frames of a shot.

use std::ops::RangeInclusive;

use glam::{DMat4, DVec3};

use super::{Lens, View, baked, interpolate::monotone};

/// A camera path as files give it. [`CameraPath::check`] says whether it can be used.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    pub name: String,
    /// Width and height of the shot's image (px).
    pub resolution: [u32; 2],
    /// Width over height of a pixel.
    pub pixel_aspect: f64,
    /// Distances of the near and the far plane (m).
    pub near: f64,
    pub far: f64,
    pub track: Track,
}

/// How the camera moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Track {
    /// In order of frame, at least one; the first key is no cut.
    Keys(Vec<CameraKey>),
    /// Per frame from frame 0 a world_from_camera matrix and a lens: the baked form. The frames in
    /// `cuts`, ascending, begin a new run.
    Matrices { samples: Vec<(DMat4, Lens)>, cuts: Vec<u32> },
}

/// Where the camera stands at a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    pub frame: f64,
    /// (m), world.
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    pub lens: Lens,
    /// The camera jumps to this key.
    pub cut: bool,
}

/// From which side in time a frame is approached: it matters at cuts alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// What is shown at the frame.
    At,
    /// What was shown until just before it.
    Before,
}

impl CameraPath {
    /// The view at a frame (need not be whole); at a cut the new one. Held outside the path.
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn view(&self, frame: f64) -> View {
        self.view_from(Side::At, frame)
    }

    /// The view just before a frame: at a cut the old one, elsewhere that of [`CameraPath::view`].
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn view_before(&self, frame: f64) -> View {
        self.view_from(Side::Before, frame)
    }

    /// The lens at a frame, as [`CameraPath::view`] finds it.
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn lens(&self, frame: f64) -> Lens {
        self.placed(Side::At, frame).1
    }

    /// The frames at which the camera jumps, ascending.
    pub fn cuts(&self) -> Vec<f64> {
        match &self.track {
            Track::Keys(keys) => keys.iter().filter(|k| k.cut).map(|k| k.frame).collect(),
            Track::Matrices { cuts, .. } => cuts.iter().map(|&c| f64::from(c)).collect(),
        }
    }

    /// The first and the last frame at which the path says something.
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn frame_range(&self) -> [f64; 2] {
        match &self.track {
            Track::Keys(keys) => [keys[0].frame, keys[keys.len() - 1].frame],
            Track::Matrices { samples, .. } => [0.0, (samples.len() - 1) as f64],
        }
    }

    /// The frames at which a key stands; baked paths have none.
    pub fn key_frames(&self) -> Vec<f64> {
        match &self.track {
            Track::Keys(keys) => keys.iter().map(|k| k.frame).collect(),
            Track::Matrices { .. } => Vec::new(),
        }
    }

    /// World positions of the eye at every frame of a range (m), a list for each run between cuts.
    pub fn eyes(&self, frames: RangeInclusive<u32>) -> Vec<Vec<DVec3>> {
        let cuts = self.cuts();
        let run_of = |frame: u32| cuts.partition_point(|&cut| cut <= f64::from(frame));
        let frames: Vec<u32> = frames.collect();
        frames
            .chunk_by(|&a, &b| run_of(a) == run_of(b))
            .map(|run| run.iter().map(|&frame| self.view(f64::from(frame)).eye).collect())
            .collect()
    }

    fn view_from(&self, side: Side, frame: f64) -> View {
        let (pose, lens) = self.placed(side, frame);
        let image_aspect =
            f64::from(self.resolution[0]) * self.pixel_aspect / f64::from(self.resolution[1]);
        let [gate_min, gate_max] = lens.gate(image_aspect);
        View {
            eye: pose.eye,
            right: pose.right,
            up: pose.up,
            back: pose.back,
            gate_min,
            gate_max,
            near: self.near,
            far: self.far,
            resolution: self.resolution,
        }
    }

    fn placed(&self, side: Side, frame: f64) -> (Pose, Lens) {
        match &self.track {
            Track::Keys(keys) => {
                let key = interpolated(run_at(keys, side, frame), frame);
                (Pose::looking_at(key.eye, key.target, key.up), key.lens)
            }
            Track::Matrices { samples, cuts } => baked::interpolated(samples, cuts, side, frame),
        }
    }
}

/// Where a camera stands and how it is turned: `right`, `up` and `back` are orthonormal.
pub(super) struct Pose {
    pub eye: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub back: DVec3,
}

impl Pose {
    /// `up` need be neither unit nor orthogonal. Where it does not say which way is up, as an
    /// interpolated one may, any direction across the line of sight does.
    fn looking_at(eye: DVec3, target: DVec3, up: DVec3) -> Self {
        let back = (eye - target).try_normalize().unwrap_or(DVec3::Z);
        let right = up.cross(back).try_normalize().unwrap_or_else(|| back.any_orthonormal_vector());
        Self { eye, right, up: back.cross(right), back }
    }
}

/// The keys of the run, from cut to cut, which holds the frame.
fn run_at(keys: &[CameraKey], side: Side, frame: f64) -> &[CameraKey] {
    let has_begun = |key: &CameraKey| match side {
        Side::At => key.frame <= frame,
        Side::Before => key.frame < frame,
    };
    let start = keys.iter().rposition(|k| k.cut && has_begun(k)).unwrap_or(0);
    let rest = &keys[start..];
    let end = rest.iter().skip(1).position(|k| k.cut).map_or(rest.len(), |i| i + 1);
    &rest[..end]
}

/// The key that a run passes through at a frame, in its middle or held at its ends.
fn interpolated(run: &[CameraKey], frame: f64) -> CameraKey {
    let vector = |component: fn(&CameraKey) -> DVec3| {
        DVec3::from_array(monotone(run, frame, |k| k.frame, |k| component(k).to_array()))
    };
    let lens = monotone(run, frame, |k| k.frame, |k| k.lens.components());
    CameraKey {
        frame,
        eye: vector(|k| k.eye),
        target: vector(|k| k.target),
        up: vector(|k| k.up),
        lens: run[0].lens.with_components(lens),
        cut: false,
    }
}

#[cfg(test)]
#[path = "path_tests.rs"]
mod tests;
