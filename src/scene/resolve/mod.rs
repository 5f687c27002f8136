//! From the shot file to the scene: every number is checked, every file read, every name found.

mod body;
mod camera;
mod cloth;
mod deforming;
mod fabric;
mod limit;
mod record;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use super::document::Node;
use super::error::{LoadError, Problem};
use super::native::{SHOT_VERSION, ShotFile, ViewFile, stages};
use super::source::{Reader, joined};
use super::{Contact, Handle, Pose, Scene, Surface, ViewSettings};
use fabric::CONTACT_THICKNESS_LIMIT;
use limit::{Limit, check, out_of_range};

pub(super) use camera::CameraRequest;
pub use camera::{load_camera, recorded_viewers};
pub use fabric::contact_thickness_most;

/// Far from where adding a frame's number would overflow.
const FIRST_FRAME_LIMIT: Limit = Limit::Between(-1e9, 1e9);

/// Everything needed to turn a shot file into a scene.
pub(super) struct Resolver<'a> {
    /// The shot file as a tree, for places.
    pub document: &'a Node,
    pub file: ShotFile,
    /// What relative paths start from.
    pub folder: PathBuf,
    pub reader: &'a Reader<'a>,
    pub warnings: &'a mut Vec<String>,
    surfaces: HashMap<PathBuf, Arc<Surface>>,
    motion_files: HashMap<PathBuf, Arc<Vec<Vec<Pose>>>>,
}

impl<'a> Resolver<'a> {
    pub fn new(
        document: &'a Node,
        folder: PathBuf,
        reader: &'a Reader<'a>,
        warnings: &'a mut Vec<String>,
    ) -> Result<Self, LoadError> {
        let file: ShotFile = document.deserialize()?;
        Ok(Self {
            document,
            file,
            folder,
            reader,
            warnings,
            surfaces: HashMap::new(),
            motion_files: HashMap::new(),
        })
    }

    /// The scene, and all its settings for the record.
    ///
    /// # Errors
    /// The first setting, name or file that is not as it must be.
    pub fn scene(
        mut self,
        name: String,
        request: &CameraRequest,
    ) -> Result<(Scene, serde_json::Value), LoadError> {
        self.check_version()?;
        if let Some(fps) = request.fps {
            self.file.fps = fps;
        }
        self.check_setup()?;
        if self.file.garments.is_empty() {
            let (thing, needed) = ("the shot".into(), "at least one garment");
            return Err(Problem::Missing { thing, needed }.at(self.document.place_of("garments")));
        }
        let view = self.file.view.over(ViewSettings::default());
        self.check_view("view", &view)?;
        let (cameras, viewers) = self.viewers(request)?.into_iter().unzip();
        let (motions, motion_names) = self.motions()?;
        let obstacles = self.obstacles(&motion_names)?;
        let handles = self.handles(&motion_names)?;
        let garments = self.garments(view, &handles)?;
        let scene = Scene {
            name,
            fps: self.file.fps,
            steps_per_frame: self.file.steps_per_frame,
            last_frame: self.file.frames,
            first_frame: self.file.first_frame,
            gravity: DVec3::from_array(self.file.gravity),
            air: self.file.air.air(),
            contact: Contact { thickness: self.thickest_contact()?, ..self.file.contact.contact() },
            dynamics: self.file.dynamics.dynamics(),
            handle_stiffness: self.file.handle_stiffness,
            start_perturbation: self.file.start_perturbation,
            stages: stages(&self.file.disable),
            garments,
            obstacles,
            motions,
            handles,
            viewers,
        };
        let record = record::settings(self.file, &scene, cameras);
        Ok((scene, record))
    }

    fn check_version(&self) -> Result<(), LoadError> {
        let (found, supported) = (self.file.shotsilk, SHOT_VERSION);
        if found != supported {
            let place = self.document.place_of("shotsilk");
            return Err(Problem::Version { found, supported }.at(place));
        }
        for (name, value) in [("instances", &self.file.instances), ("takes", &self.file.takes)] {
            if value.is_some() {
                let place = self.document.place_of(name);
                return Err(Problem::NotSupported { thing: format!("{name:?}") }.at(place));
            }
        }
        Ok(())
    }

    fn check_setup(&self) -> Result<(), LoadError> {
        let file = &self.file;
        let steps = f64::from(file.steps_per_frame);
        let iterations = f64::from(file.dynamics.iterations);
        let mut numbers = vec![
            ("fps".to_owned(), file.fps, Limit::Positive),
            ("steps_per_frame".to_owned(), steps, Limit::AtLeast(1.0)),
            ("first_frame".to_owned(), file.first_frame as f64, FIRST_FRAME_LIMIT),
            ("air.density".to_owned(), file.air.density, Limit::AtLeastZero),
            ("air.tangential_drag".to_owned(), file.air.tangential_drag, Limit::AtLeastZero),
            ("contact.thickness".to_owned(), file.contact.thickness, CONTACT_THICKNESS_LIMIT),
            ("contact.stiffness".to_owned(), file.contact.stiffness, Limit::Positive),
            ("contact.friction_cloth".to_owned(), file.contact.friction_cloth, Limit::AtLeastZero),
            (
                "contact.friction_obstacle".to_owned(),
                file.contact.friction_obstacle,
                Limit::AtLeastZero,
            ),
            ("dynamics.iterations".to_owned(), iterations, Limit::AtLeast(1.0)),
            ("dynamics.tolerance".to_owned(), file.dynamics.tolerance, Limit::Positive),
            ("handle_stiffness".to_owned(), file.handle_stiffness, Limit::Positive),
            ("start_perturbation".to_owned(), file.start_perturbation, Limit::AtLeastZero),
        ];
        for k in 0..3 {
            numbers.push((format!("gravity.{k}"), file.gravity[k], Limit::Finite));
            numbers.push((format!("air.velocity.{k}"), file.air.velocity[k], Limit::Finite));
        }
        numbers.into_iter().try_for_each(|(path, value, limit)| self.check(&path, value, limit))
    }

    /// Checks the view settings written at `path`.
    fn check_view(&self, path: &str, view: &ViewSettings) -> Result<(), LoadError> {
        for (name, value, limit) in [
            ("nu_front", view.nu_front, Limit::Share),
            ("nu_back", view.nu_back, Limit::Share),
            ("nu_out", view.nu_out, Limit::Share),
            ("margin_m", view.margin_m, Limit::AtLeastZero),
            ("anticipation_frames", view.anticipation_frames, Limit::AtLeastZero),
            ("min_screen_edge_px", view.min_screen_edge_px, Limit::AtLeastZero),
            ("buckling_exponent", view.buckling_exponent, Limit::AtLeastZero),
            ("silhouette_threshold", view.silhouette_threshold, Limit::AtLeastZero),
        ] {
            self.check(&format!("{path}.{name}"), value, limit)?;
        }
        Ok(())
    }

    fn garment_view(
        &self,
        index: usize,
        base: ViewSettings,
        over: ViewFile,
    ) -> Result<ViewSettings, LoadError> {
        let view = over.over(base);
        self.check_view(&format!("garments.{index}.view"), &view)?;
        Ok(view)
    }

    fn check(&self, path: &str, value: f64, limit: Limit) -> Result<(), LoadError> {
        check(self.document, path, value, limit)
    }

    fn out_of_range(&self, path: &str, value: impl ToString, limit: &str) -> LoadError {
        out_of_range(self.document, path, value, limit)
    }

    /// The text of the file that is named at `path` of the document, and how to call it.
    fn is_file(&self, relative: &str) -> bool {
        self.reader.is_file(&joined(&self.folder, Path::new(relative)))
    }

    fn text_at(&self, path: &str, relative: &str) -> Result<(PathBuf, Arc<str>), LoadError> {
        let file = joined(&self.folder, Path::new(relative));
        let text = self.reader.text(&file);
        Ok((file, text.map_err(|e| e.or_at(&self.document.place_of(path)))?))
    }
}

/// The file's name without folders and extension.
pub(super) fn stem(path: &str) -> String {
    let stem = Path::new(path).file_stem().map(|s| s.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| path.to_owned())
}

/// The nodes held by handles of a garment.
fn pinned(handles: &[Handle], garment: usize) -> Vec<u32> {
    let of_garment = handles.iter().filter(|h| h.garment == garment);
    of_garment.flat_map(|h| h.nodes.iter().copied()).collect()
}
