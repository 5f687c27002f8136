//! The lens of a key. A camera stays of the kind it is, angle of view or film back.

use super::{CameraEdit, CameraEditError, LensScope};
use crate::scene::native::{CameraFile, KeyFile};
use crate::shot::Lens;

/// A lens as an artist gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LensValue {
    /// Vertical angle of view (degrees), above 0 and below 180.
    FovYDeg(f64),
    /// Focal length (mm), above 0; for a camera with a film back.
    FocalMm(f64),
}

impl LensValue {
    /// Of a camera with a film back its focal length, of any other its angle.
    pub fn of(lens: Lens) -> Self {
        match lens {
            Lens::FieldOfView { fov_y } => Self::FovYDeg(fov_y.to_degrees()),
            Lens::FilmBack { focal_mm, .. } => Self::FocalMm(focal_mm),
        }
    }
}

/// What a key's own words and the camera's come to.
#[derive(Clone, Copy, PartialEq)]
enum Given {
    Angle { fov_y_deg: f64 },
    FilmBack { focal_mm: f64, aperture_mm: [f64; 2], offset_mm: [f64; 2] },
}

impl CameraEdit {
    /// With another lens, for one key or for all. An angle for a camera with a film back becomes the
    /// focal length that sees as much.
    ///
    /// # Errors
    /// If there is no such key, if a focal length is given to a camera without a film back, and if
    /// the value is out of range.
    pub fn set_lens(&self, scope: LensScope, value: LensValue) -> Result<Self, CameraEditError> {
        let mut edit = self.clone();
        match scope {
            LensScope::Key(frame) => edit.set_lens_of(self.existing(frame)?, value)?,
            LensScope::WholePath => {
                (0..self.keys().len()).try_for_each(|index| edit.set_lens_of(index, value))?;
                edit.say_once();
            }
        }
        Self::checked(edit.file)
    }

    /// The lens of the key at a frame, as the camera has it.
    ///
    /// # Errors
    /// If there is no such key.
    pub fn lens(&self, frame: f64) -> Result<LensValue, CameraEditError> {
        let key = &self.keys()[self.existing(frame)?];
        Ok(match given(&self.file, key)? {
            Given::Angle { fov_y_deg } => LensValue::FovYDeg(fov_y_deg),
            Given::FilmBack { focal_mm, .. } => LensValue::FocalMm(focal_mm),
        })
    }

    /// Whether keys differ in their lens.
    pub fn zooms(&self) -> bool {
        let lens = |key: &KeyFile| given(&self.file, key).ok();
        self.keys().windows(2).any(|pair| lens(&pair[0]) != lens(&pair[1]))
    }

    fn set_lens_of(&mut self, index: usize, value: LensValue) -> Result<(), CameraEditError> {
        let [width, height] = self.file.resolution.map(f64::from);
        let image_aspect = width * self.file.pixel_aspect.unwrap_or(1.0) / height;
        let given = given(&self.file, &self.keys()[index])?;
        let value = match (given, value) {
            (Given::Angle { .. }, LensValue::FocalMm(_)) => {
                return Err(CameraEditError::NoFilmBack);
            }
            (Given::FilmBack { aperture_mm: [width, _], .. }, LensValue::FovYDeg(degrees)) => {
                // The film back is fitted horizontally: its height follows from the image's.
                let half_height = 0.5 * width / image_aspect;
                LensValue::FocalMm(half_height / (0.5 * degrees.to_radians()).tan())
            }
            (_, value) => value,
        };
        let key = &mut self.keys_mut()[index];
        (key.fov_y_deg, key.focal_mm) = match value {
            LensValue::FovYDeg(degrees) => (Some(degrees), None),
            LensValue::FocalMm(millimetres) => (None, Some(millimetres)),
        };
        self.leave_out_what_the_camera_says(index);
        Ok(())
    }

    /// What a key has from the camera anyway it need not say.
    fn leave_out_what_the_camera_says(&mut self, index: usize) {
        let key = &self.keys()[index];
        let silent = KeyFile { fov_y_deg: None, focal_mm: None, ..key.clone() };
        let [own, inherited] = [key, &silent].map(|key| given(&self.file, key).ok());
        if own == inherited {
            self.keys_mut()[index] = silent;
        }
    }

    /// One lens for all keys is the camera's.
    fn say_once(&mut self) {
        let of = |key: &KeyFile| (key.fov_y_deg, key.focal_mm);
        let first = of(&self.keys()[0]);
        if first == (None, None) || self.keys().iter().any(|key| of(key) != first) {
            return;
        }
        (self.file.fov_y_deg, self.file.focal_mm) = first;
        for key in self.keys_mut() {
            (key.fov_y_deg, key.focal_mm) = (None, None);
        }
    }

    /// A key with the lens that the path has at a frame, to the bit where it does not change there.
    pub(super) fn new_lens_at(&self, frame: f64) -> KeyFile {
        let keys = self.keys();
        let next = keys.partition_point(|key| key.frame <= frame);
        // The run that the frame is in; before the first key, and behind the last, that is the
        // neighbour's.
        let before = &keys[next.saturating_sub(1)];
        let after = keys.get(next).filter(|key| !key.cut).unwrap_or(before);
        let [a, b] = [before, after].map(|key| given(&self.file, key).ok());
        if a == b || next == 0 {
            return before.clone();
        }
        let key = before.clone();
        match self.path().lens(frame) {
            Lens::FieldOfView { fov_y } => {
                KeyFile { fov_y_deg: Some(fov_y.to_degrees()), focal_mm: None, ..key }
            }
            Lens::FilmBack { focal_mm, aperture_mm, offset_mm } => KeyFile {
                fov_y_deg: None,
                focal_mm: Some(focal_mm),
                aperture_mm: Some(aperture_mm.to_array()),
                offset_mm: Some(offset_mm.to_array()),
                ..key
            },
        }
    }
}

/// A key's own lens, or the camera's for what the key does not say.
fn given(file: &CameraFile, key: &KeyFile) -> Result<Given, CameraEditError> {
    let is_own = key.fov_y_deg.is_some() || key.focal_mm.is_some();
    let fov_y_deg = key.fov_y_deg.or(file.fov_y_deg.filter(|_| !is_own));
    let focal_mm = key.focal_mm.or(file.focal_mm.filter(|_| !is_own));
    match (fov_y_deg, focal_mm, key.aperture_mm.or(file.aperture_mm)) {
        (Some(fov_y_deg), None, _) => Ok(Given::Angle { fov_y_deg }),
        (None, Some(focal_mm), Some(aperture_mm)) => {
            let offset_mm = key.offset_mm.or(file.offset_mm).unwrap_or_default();
            Ok(Given::FilmBack { focal_mm, aperture_mm, offset_mm })
        }
        _ => Err(CameraEditError::NoFilmBack),
    }
}
