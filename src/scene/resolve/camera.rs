//! Cameras: from files and shots to paths that can be evaluated everywhere.

use std::path::{Path, PathBuf};

use glam::{DMat4, DVec2, DVec3, DVec4};

use super::limit::{Limit, check, out_of_range};
use super::{Resolver, stem};
use crate::scene::document::{Node, Value};
use crate::scene::error::{LoadError, Problem};
use crate::scene::native::{CameraFile, KeyFile, SampleFile};
use crate::scene::source::{FileRole, FileSource, Reader, joined};
use crate::shot::{CameraKey, CameraPath, Lens, Track};

/// Frame rates that differ less than this (relative) are the same.
const FPS_TOLERANCE: f64 = 1e-9;

/// Sine of the angle between up and the view direction below which the image could roll freely.
const PARALLEL_SINE_MIN: f64 = 1e-6;

/// How far a baked matrix may be from a rigid one: files write about six digits.
const RIGID_TOLERANCE: f64 = 1e-4;

/// What the command line says about cameras.
pub(in crate::scene) struct CameraRequest {
    /// Replaces the shot camera; seen from the working folder.
    pub file: Option<PathBuf>,
    /// Holds for scene and camera alike.
    pub fps: Option<f64>,
}

impl Resolver<'_> {
    /// The cameras as written, and as paths; the first is the shot camera.
    pub(super) fn viewers(
        &self,
        request: &CameraRequest,
    ) -> Result<Vec<(CameraFile, CameraPath)>, LoadError> {
        let document = self.document;
        if self.file.camera.is_some() && !self.file.viewers.is_empty() {
            let (thing, first, second) = ("the shot".into(), "camera", "viewers");
            let problem = Problem::Exclusive { thing, first, second };
            return Err(problem.at(document.place_of("viewers")));
        }
        let mut nodes: Vec<&Node> = match document.at("viewers").map(|n| &n.value) {
            Some(Value::Array(elements)) => elements.iter().collect(),
            _ => Vec::new(),
        };
        nodes.extend(document.at("camera").filter(|_| self.file.camera.is_some()));
        let mut viewers = Vec::new();
        if let Some(path) = &request.file {
            viewers.push(self.camera_file(path, request)?);
        }
        for node in nodes.into_iter().skip(viewers.len()) {
            let viewer = match node.as_str() {
                Some(relative) => {
                    let path = joined(&self.folder, Path::new(relative));
                    self.camera_file(&path, request).map_err(|e| e.or_at(&node.place))?
                }
                None => self.camera(node, &stem(&node_file(node)), request)?,
            };
            viewers.push(viewer);
        }
        Ok(viewers)
    }

    fn camera_file(
        &self,
        path: &Path,
        request: &CameraRequest,
    ) -> Result<(CameraFile, CameraPath), LoadError> {
        let text = self.reader.text_for(FileRole::Camera, path)?;
        let name = path.to_string_lossy();
        self.camera(&Node::parse(&name, &text)?, stem(&name).trim_end_matches(".camera"), request)
    }

    fn camera(
        &self,
        document: &Node,
        default_name: &str,
        request: &CameraRequest,
    ) -> Result<(CameraFile, CameraPath), LoadError> {
        let (file, path) = camera_path(document, default_name)?;
        if request.fps.is_none() {
            check_fps(document, &file, self.file.fps)?;
        }
        Ok((file, path))
    }
}

/// A camera as written, and as a path.
fn camera_path(document: &Node, default_name: &str) -> Result<(CameraFile, CameraPath), LoadError> {
    let file: CameraFile = document.deserialize()?;
    if let Some(fps) = file.fps {
        check(document, "fps", fps, Limit::Positive)?;
    }
    check_image(document, &file)?;
    let track = match (&file.keys, &file.matrices) {
        (Some(keys), None) => keys_track(document, &file, keys)?,
        (None, Some(samples)) => matrices_track(document, &file, samples)?,
        (None, None) => {
            let (thing, needed) = ("the camera".into(), "keys or matrices");
            return Err(Problem::Missing { thing, needed }.at(document.place.clone()));
        }
        (Some(_), Some(_)) => {
            let (thing, first, second) = ("the camera".into(), "keys", "matrices");
            let problem = Problem::Exclusive { thing, first, second };
            return Err(problem.at(document.place_of("matrices")));
        }
    };
    let path = CameraPath {
        name: file.name.clone().unwrap_or_else(|| default_name.to_owned()),
        resolution: file.resolution,
        pixel_aspect: file.pixel_aspect.unwrap_or(1.0),
        near: file.near,
        far: file.far,
        track,
    };
    Ok((file, path))
}

/// The camera's own frame rate, where it names one, must be the scene's.
fn check_fps(document: &Node, file: &CameraFile, scene: f64) -> Result<(), LoadError> {
    match file.fps {
        Some(camera) if (camera - scene).abs() > FPS_TOLERANCE * scene => {
            Err(Problem::FrameRate { camera, scene }.at(document.place_of("fps")))
        }
        _ => Ok(()),
    }
}

/// The cameras in the record of a run ([`LoadedShot::resolved`](crate::scene::LoadedShot)).
///
/// # Errors
/// If the record has been damaged.
pub fn recorded_viewers(record: &serde_json::Value) -> Result<Vec<CameraPath>, LoadError> {
    let viewers = record["viewers"].as_array().map(Vec::as_slice).unwrap_or_default();
    let path = |viewer: &serde_json::Value| {
        Ok(camera_path(&Node::parse("run.json", &viewer.to_string())?, "camera")?.1)
    };
    viewers.iter().map(path).collect()
}

/// A camera file for a scene of a frame rate (frames per second); `None` takes any.
///
/// # Errors
/// If the file cannot be read, is no camera, or has another frame rate.
pub fn load_camera(
    path: &Path,
    scene_fps: Option<f64>,
    source: &dyn FileSource,
) -> Result<CameraPath, LoadError> {
    let name = path.to_string_lossy();
    let document = Node::parse(&name, &Reader::new(source).text(path)?)?;
    let (file, path) = camera_path(&document, stem(&name).trim_end_matches(".camera"))?;
    if let Some(fps) = scene_fps {
        check_fps(&document, &file, fps)?;
    }
    Ok(path)
}

/// The file an inline camera is written in.
fn node_file(node: &Node) -> String {
    match &node.place {
        crate::scene::Place::Text { file, .. } => file.to_string(),
        other => other.to_string(),
    }
}

fn check_image(document: &Node, file: &CameraFile) -> Result<(), LoadError> {
    for (k, pixels) in file.resolution.into_iter().enumerate() {
        check(document, &format!("resolution.{k}"), f64::from(pixels), Limit::AtLeast(1.0))?;
    }
    check(document, "pixel_aspect", file.pixel_aspect.unwrap_or(1.0), Limit::Positive)?;
    check(document, "near", file.near, Limit::Positive)?;
    check(document, "far", file.far, Limit::Finite)?;
    check(document, "far", file.far, Limit::Above(file.near))
}

fn keys_track(document: &Node, file: &CameraFile, keys: &[KeyFile]) -> Result<Track, LoadError> {
    let mut resolved: Vec<CameraKey> = Vec::with_capacity(keys.len());
    for (k, key) in keys.iter().enumerate() {
        let path = format!("keys.{k}");
        if let Some(before) = resolved.last() {
            check(document, &format!("{path}.frame"), key.frame, Limit::Above(before.frame))?;
        } else if key.cut {
            return Err(camera_error(document, &format!("{path}.cut"), "the first key is no cut"));
        }
        let given = [key.fov_y_deg, key.focal_mm].map(|n| n.is_some()).contains(&true);
        let lens = LensFile {
            fov_y_deg: key.fov_y_deg.or(file.fov_y_deg.filter(|_| !given)),
            focal_mm: key.focal_mm.or(file.focal_mm.filter(|_| !given)),
            aperture_mm: key.aperture_mm.or(file.aperture_mm),
            offset_mm: key.offset_mm.or(file.offset_mm),
        };
        let lens = lens.resolved(document, &path)?;
        if resolved.last().is_some_and(|b| !key.cut && kind(b.lens) != kind(lens)) {
            let what = "the lens changes between fov_y_deg and focal_mm without a cut";
            return Err(camera_error(document, &path, what));
        }
        let [eye, target, up] = [key.eye, key.target, key.up].map(DVec3::from_array);
        check_axes(document, &path, eye, target, up)?;
        resolved.push(CameraKey { frame: key.frame, eye, target, up, lens, cut: key.cut });
    }
    if resolved.is_empty() {
        return Err(camera_error(document, "keys", "a camera needs at least one key"));
    }
    Ok(Track::Keys(resolved))
}

fn check_axes(
    document: &Node,
    path: &str,
    eye: DVec3,
    target: DVec3,
    up: DVec3,
) -> Result<(), LoadError> {
    let Some(direction) = (target - eye).try_normalize() else {
        let path = format!("{path}.target");
        return Err(camera_error(document, &path, "eye and target are the same point"));
    };
    let path = format!("{path}.up");
    match up.try_normalize() {
        None => Err(camera_error(document, &path, "up has no direction")),
        Some(up) if up.cross(direction).length() < PARALLEL_SINE_MIN => {
            Err(camera_error(document, &path, "up is parallel to the view direction"))
        }
        Some(_) => Ok(()),
    }
}

fn matrices_track(
    document: &Node,
    file: &CameraFile,
    matrices: &[SampleFile],
) -> Result<Track, LoadError> {
    let mut samples = Vec::with_capacity(matrices.len());
    let mut cuts = Vec::new();
    for (k, sample) in matrices.iter().enumerate() {
        let path = format!("matrices.{k}");
        if let Some(frame) = sample.frame.filter(|&frame| frame as usize != k) {
            let limit = format!("{k}, its place in the list");
            return Err(out_of_range(document, &format!("{path}.frame"), frame, &limit));
        }
        if sample.cut && k == 0 {
            let path = format!("{path}.cut");
            return Err(camera_error(document, &path, "the first matrix is no cut"));
        }
        cuts.extend(sample.cut.then_some(k as u32));
        let given = sample.fov_y_deg.is_some() || sample.focal_mm.is_some();
        let lens = LensFile {
            fov_y_deg: sample.fov_y_deg.or(file.fov_y_deg.filter(|_| !given)),
            focal_mm: sample.focal_mm.or(file.focal_mm.filter(|_| !given)),
            aperture_mm: sample.aperture_mm.or(file.aperture_mm),
            offset_mm: sample.offset_mm.or(file.offset_mm),
        };
        let rows = sample.world_from_camera.rows().map(DVec4::from_array);
        let matrix = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
        if !is_rigid(matrix) {
            let what = "the matrix is no rotation and translation (row by row, translation last)";
            return Err(camera_error(document, &path, what));
        }
        samples.push((matrix, lens.resolved(document, &path)?));
    }
    if samples.is_empty() {
        return Err(camera_error(document, "matrices", "a camera needs at least one matrix"));
    }
    Ok(Track::Matrices { samples, cuts })
}

fn is_rigid(matrix: DMat4) -> bool {
    let rotation = glam::DMat3::from_mat4(matrix);
    let product = rotation.transpose() * rotation;
    matrix.is_finite()
        && product.abs_diff_eq(glam::DMat3::IDENTITY, RIGID_TOLERANCE)
        && rotation.determinant() > 0.0
        && matrix.row(3).abs_diff_eq(DVec4::W, RIGID_TOLERANCE)
}

fn camera_error(document: &Node, path: &str, what: &'static str) -> LoadError {
    Problem::Camera { thing: path.to_owned(), what }.at(document.place_of(path))
}

/// True for a film back.
fn kind(lens: Lens) -> bool {
    matches!(lens, Lens::FilmBack { .. })
}

/// What a key and the camera say about the lens.
struct LensFile {
    fov_y_deg: Option<f64>,
    focal_mm: Option<f64>,
    aperture_mm: Option<[f64; 2]>,
    offset_mm: Option<[f64; 2]>,
}

impl LensFile {
    fn resolved(self, document: &Node, path: &str) -> Result<Lens, LoadError> {
        let error = |problem: Problem| Err(problem.at(document.place_of(path)));
        let thing = path.to_owned();
        match (self.fov_y_deg, self.focal_mm) {
            (Some(_), Some(_)) => {
                let (first, second) = ("fov_y_deg", "focal_mm");
                error(Problem::Exclusive { thing, first, second })
            }
            (None, None) => error(Problem::Missing { thing, needed: "fov_y_deg or focal_mm" }),
            (Some(degrees), None) => {
                let limit = Limit::Between(0.0, 180.0);
                check(document, &format!("{path}.fov_y_deg"), degrees, limit)?;
                Ok(Lens::FieldOfView { fov_y: degrees.to_radians() })
            }
            (None, Some(focal_mm)) => {
                check(document, &format!("{path}.focal_mm"), focal_mm, Limit::Positive)?;
                let Some(aperture) = self.aperture_mm else {
                    return error(Problem::Missing { thing, needed: "aperture_mm with focal_mm" });
                };
                for (k, size) in aperture.into_iter().enumerate() {
                    check(document, &format!("{path}.aperture_mm.{k}"), size, Limit::Positive)?;
                }
                let offset_mm = DVec2::from_array(self.offset_mm.unwrap_or_default());
                Ok(Lens::FilmBack { focal_mm, aperture_mm: aperture.into(), offset_mm })
            }
        }
    }
}
