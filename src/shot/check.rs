//! What a camera path must be before anything is computed from it.

use glam::{DMat3, DMat4, DVec3};
use thiserror::Error;

use super::{CameraKey, CameraPath, Lens, Track};

/// Largest deviation of a baked rotation from orthonormal: files keep matrices in single precision.
const RIGID_DEVIATION_MAX: f64 = 1e-4;

/// Least angle between the line of sight and up (rad): below it rounding decides which way is up.
const UP_ANGLE_MIN: f64 = 1e-6;

/// What is wrong with a camera path. Frames are those of the path, without the shot's first frame.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CameraPathError {
    #[error("the camera path has no keys")]
    Empty,
    #[error("the resolution is {width} x {height} px: both must be at least 1")]
    Resolution { width: u32, height: u32 },
    #[error("the pixel aspect is {value}: it must be a finite number above 0")]
    PixelAspect { value: f64 },
    #[error("the near plane is at {near} m: it must be a finite distance above 0")]
    Near { near: f64 },
    #[error(
        "the far plane is at {far} m: it must be a finite distance beyond the near plane, {near} m"
    )]
    Far { near: f64, far: f64 },
    #[error("key {index} has frame {frame}: it must be a finite number")]
    NonFiniteFrame { index: usize, frame: f64 },
    #[error("the key at frame {frame} follows the one at frame {previous}: frames must ascend")]
    Unsorted { previous: f64, frame: f64 },
    #[error("the first key, at frame {frame}, is a cut: there is nothing to cut from")]
    FirstKeyCut { frame: f64 },
    #[error("the {what} at frame {frame} is not finite")]
    NonFinite { what: &'static str, frame: f64 },
    #[error("eye and target coincide at frame {frame}")]
    EyeAtTarget { frame: f64 },
    #[error("up at frame {frame} is zero or parallel to the line of sight")]
    UpAlongSight { frame: f64 },
    #[error(
        "the vertical field of view at frame {frame} is {degrees} degrees: it must be above 0 and below 180"
    )]
    FieldOfView { frame: f64, degrees: f64 },
    #[error("the {what} at frame {frame} is {millimetres} mm: it must be above 0")]
    FilmBack { what: &'static str, frame: f64, millimetres: f64 },
    #[error(
        "the lens at frame {frame} is given in another way than the one before: between cuts all must be fields of view or all film backs"
    )]
    MixedLenses { frame: f64 },
    #[error(
        "the matrix at frame {frame} is no rotation and translation: it deviates by {deviation:.1e}, more than {RIGID_DEVIATION_MAX:.0e}"
    )]
    NotRigid { frame: f64, deviation: f64 },
    #[error("there is a cut at frame {frame}: cuts must ascend from 1 to {last}, the last frame")]
    CutOutOfOrder { frame: u32, last: usize },
}

impl CameraPath {
    /// Verifies all that [`CameraPath::view`] takes for granted.
    ///
    /// # Errors
    /// The first thing found wrong.
    pub fn check(&self) -> Result<(), CameraPathError> {
        self.check_image()?;
        match &self.track {
            Track::Keys(keys) => check_keys(keys),
            Track::Matrices { samples, cuts } => check_matrices(samples, cuts),
        }
    }

    fn check_image(&self) -> Result<(), CameraPathError> {
        let [width, height] = self.resolution;
        let (near, far, value) = (self.near, self.far, self.pixel_aspect);
        if width == 0 || height == 0 {
            return Err(CameraPathError::Resolution { width, height });
        }
        if !(value > 0.0 && value.is_finite()) {
            return Err(CameraPathError::PixelAspect { value });
        }
        if !(near > 0.0 && near.is_finite()) {
            return Err(CameraPathError::Near { near });
        }
        if !(far > near && far.is_finite()) {
            return Err(CameraPathError::Far { near, far });
        }
        Ok(())
    }
}

fn check_keys(keys: &[CameraKey]) -> Result<(), CameraPathError> {
    let first = keys.first().ok_or(CameraPathError::Empty)?;
    if let Some(index) = keys.iter().position(|k| !k.frame.is_finite()) {
        return Err(CameraPathError::NonFiniteFrame { index, frame: keys[index].frame });
    }
    if first.cut {
        return Err(CameraPathError::FirstKeyCut { frame: first.frame });
    }
    keys.iter().try_for_each(check_key)?;
    for pair in keys.windows(2) {
        let (previous, key) = (&pair[0], &pair[1]);
        if !(key.frame > previous.frame) {
            return Err(CameraPathError::Unsorted { previous: previous.frame, frame: key.frame });
        }
        if !key.cut && !key.lens.is_same_kind(&previous.lens) {
            return Err(CameraPathError::MixedLenses { frame: key.frame });
        }
    }
    Ok(())
}

fn check_key(key: &CameraKey) -> Result<(), CameraPathError> {
    let frame = key.frame;
    for (what, value) in [("eye", key.eye), ("target", key.target), ("up", key.up)] {
        if !value.is_finite() {
            return Err(CameraPathError::NonFinite { what, frame });
        }
    }
    let sight = key.target - key.eye;
    if sight == DVec3::ZERO {
        return Err(CameraPathError::EyeAtTarget { frame });
    }
    let across = key.up.normalize_or_zero().cross(sight.normalize_or_zero()).length();
    if !(across > UP_ANGLE_MIN) {
        return Err(CameraPathError::UpAlongSight { frame });
    }
    check_lens(&key.lens, frame)
}

fn check_lens(lens: &Lens, frame: f64) -> Result<(), CameraPathError> {
    if !lens.components().iter().all(|c| c.is_finite()) {
        return Err(CameraPathError::NonFinite { what: "lens", frame });
    }
    match *lens {
        Lens::FieldOfView { fov_y } => {
            if !(fov_y > 0.0 && fov_y < std::f64::consts::PI) {
                return Err(CameraPathError::FieldOfView { frame, degrees: fov_y.to_degrees() });
            }
        }
        Lens::FilmBack { focal_mm, aperture_mm, .. } => {
            for (what, millimetres) in [
                ("focal length", focal_mm),
                ("width of the film back", aperture_mm.x),
                ("height of the film back", aperture_mm.y),
            ] {
                if !(millimetres > 0.0) {
                    return Err(CameraPathError::FilmBack { what, frame, millimetres });
                }
            }
        }
    }
    Ok(())
}

fn check_matrices(samples: &[(DMat4, Lens)], cuts: &[u32]) -> Result<(), CameraPathError> {
    let last = samples.len().checked_sub(1).ok_or(CameraPathError::Empty)?;
    for (index, (matrix, lens)) in samples.iter().enumerate() {
        let frame = index as f64;
        if !matrix.is_finite() {
            return Err(CameraPathError::NonFinite { what: "matrix", frame });
        }
        let deviation = rigid_deviation(matrix);
        if deviation > RIGID_DEVIATION_MAX {
            return Err(CameraPathError::NotRigid { frame, deviation });
        }
        check_lens(lens, frame)?;
        let goes_on = index > 0 && !cuts.iter().any(|&c| c as usize == index);
        if goes_on && !lens.is_same_kind(&samples[index - 1].1) {
            return Err(CameraPathError::MixedLenses { frame });
        }
    }
    let mut previous = 0;
    for &frame in cuts {
        if frame <= previous || frame as usize > last {
            return Err(CameraPathError::CutOutOfOrder { frame, last });
        }
        previous = frame;
    }
    Ok(())
}

/// Largest deviation of R^T R from the identity, of det R from 1 and of the last row from 0 0 0 1.
fn rigid_deviation(matrix: &DMat4) -> f64 {
    let r = DMat3::from_mat4(*matrix);
    let gram = (r.transpose() * r - DMat3::IDENTITY).to_cols_array();
    let row = matrix.row(3);
    [row.x, row.y, row.z, row.w - 1.0, r.determinant() - 1.0]
        .into_iter()
        .chain(gram)
        .fold(0.0, |largest: f64, d| largest.max(d.abs()))
}

#[cfg(test)]
#[path = "check_tests.rs"]
mod tests;
