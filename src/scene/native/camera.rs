//! The camera file as it is written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A pinhole camera over the frames of a shot: keys, or a matrix for every frame. The lens is
/// `fov_y_deg`, or `focal_mm` with `aperture_mm`; what a key does not say about it holds from here.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// For captions. Default the file's name.
    pub name: Option<String>,
    /// Frames per second; must agree with the shot. Default the shot's.
    pub fps: Option<f64>,
    /// Width and height of the image (pixels).
    pub resolution: [u32; 2],
    /// Width of a pixel over its height. Default 1.
    pub pixel_aspect: Option<f64>,
    /// Distance of the near plane (m). Default 0.01.
    #[serde(default = "default_near")]
    pub near: f64,
    /// Distance of the far plane (m). Default 1000.
    #[serde(default = "default_far")]
    pub far: f64,
    /// Vertical field of view (degrees), above 0 and below 180.
    pub fov_y_deg: Option<f64>,
    /// Focal length (mm).
    pub focal_mm: Option<f64>,
    /// Width and height of the film back (mm); the horizontal fit holds if its shape is not the
    /// image's.
    pub aperture_mm: Option<[f64; 2]>,
    /// Shift of the film back (mm). Default [0, 0].
    pub offset_mm: Option<[f64; 2]>,
    /// Keys in order of frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keys: Option<Vec<KeyFile>>,
    /// The camera's placement at every frame from 0, instead of keys.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrices: Option<Vec<SampleFile>>,
}

/// Where the camera stands at a frame.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct KeyFile {
    /// The frame; need not be whole.
    pub frame: f64,
    /// Where the camera is (m, world).
    pub eye: [f64; 3],
    /// What it looks at (m, world).
    pub target: [f64; 3],
    /// The direction that is up in the image. Default [0, 0, 1].
    #[serde(default = "default_up")]
    pub up: [f64; 3],
    /// Vertical field of view (degrees), above 0 and below 180.
    pub fov_y_deg: Option<f64>,
    /// Focal length (mm).
    pub focal_mm: Option<f64>,
    /// Width and height of the film back (mm).
    pub aperture_mm: Option<[f64; 2]>,
    /// Shift of the film back (mm).
    pub offset_mm: Option<[f64; 2]>,
    /// The camera jumps to this key instead of moving there. Default false.
    #[serde(default)]
    pub cut: bool,
}

/// The camera's placement at one frame of the baked form.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SampleFile {
    /// The frame; if given, the sample's place in the list.
    pub frame: Option<u32>,
    /// From camera to world, row by row; the camera looks along -z, y is up.
    #[serde(alias = "matrix")]
    pub world_from_camera: MatrixFile,
    /// Vertical field of view (degrees), above 0 and below 180.
    pub fov_y_deg: Option<f64>,
    /// Focal length (mm).
    pub focal_mm: Option<f64>,
    /// Width and height of the film back (mm).
    pub aperture_mm: Option<[f64; 2]>,
    /// Shift of the film back (mm).
    pub offset_mm: Option<[f64; 2]>,
    /// The camera jumped since the frame before. Default false.
    #[serde(default)]
    pub cut: bool,
}

/// Sixteen numbers, or four rows of four.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum MatrixFile {
    Flat([f64; 16]),
    Rows([[f64; 4]; 4]),
}

impl MatrixFile {
    pub(in crate::scene) fn rows(self) -> [[f64; 4]; 4] {
        match self {
            MatrixFile::Rows(rows) => rows,
            MatrixFile::Flat(m) => std::array::from_fn(|i| std::array::from_fn(|j| m[4 * i + j])),
        }
    }
}

fn default_near() -> f64 {
    0.01
}

fn default_far() -> f64 {
    1000.0
}

fn default_up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}
