//! Motions, the obstacles that follow them, and handles.

use std::path::PathBuf;
use std::sync::Arc;

use super::limit::check_transform;
use super::{Limit, Resolver, stem};
use crate::scene::error::{LoadError, Problem, nearest};
use crate::scene::mot::bodies_from_mot;
use crate::scene::native::{KeyframeFile, MotionFile, ObstacleFile};
use crate::scene::obj::{Flat, surface_from_obj};
use crate::scene::{Handle, Motion, MotionKey, Obstacle, Pose, Surface};

/// Samples a second of a motion file that does not say.
const MOTION_FILE_FPS: f64 = 30.0;

impl Resolver<'_> {
    /// The motions and their names, in the same order.
    pub(super) fn motions(&mut self) -> Result<(Vec<Motion>, Vec<String>), LoadError> {
        let mut motions = Vec::new();
        let mut names = Vec::new();
        for (name, file) in self.file.motions.clone() {
            let path = format!("motions.{name}");
            let keys = match (&file.keys, &file.file) {
                (Some(keys), None) => self.keys(&path, keys, &file)?,
                (None, Some(relative)) => self.samples(&path, relative, &file)?,
                (None, None) => {
                    let (thing, needed) = (path.clone(), "keys or a file");
                    let problem = Problem::Missing { thing, needed };
                    return Err(problem.at(self.document.place_of(&path)));
                }
                (Some(_), Some(_)) => {
                    let (thing, first, second) = (path.clone(), "keys", "file");
                    let problem = Problem::Exclusive { thing, first, second };
                    return Err(problem.at(self.document.place_of(&path)));
                }
            };
            let motion = Motion::from_keys(keys).map_err(|error| {
                let key = error.key().map(|k| format!("{path}.keys.{k}"));
                let place = self.document.place_of(&key.unwrap_or(path));
                Problem::Motion { name: name.clone(), error }.at(place)
            })?;
            motions.push(motion);
            names.push(name);
        }
        Ok((motions, names))
    }

    fn keys(
        &self,
        path: &str,
        keys: &[KeyframeFile],
        file: &MotionFile,
    ) -> Result<Vec<MotionKey>, LoadError> {
        for (name, given) in [("fps", file.fps.is_some()), ("body", file.body.is_some())] {
            if given {
                let (thing, first, second) = (path.to_owned(), "keys", name);
                let place = self.document.place_of(&format!("{path}.{name}"));
                return Err(Problem::Exclusive { thing, first, second }.at(place));
            }
        }
        check_transform(self.document, &format!("{path}.transform"), &file.transform)?;
        let outer = file.transform.pose();
        let mut resolved = Vec::with_capacity(keys.len());
        for (k, key) in keys.iter().enumerate() {
            check_transform(self.document, &format!("{path}.keys.{k}.transform"), &key.transform)?;
            let velocity = key.velocity.map(|v| {
                let mut velocity = v.velocity();
                velocity.scale *= outer.scale;
                velocity.angular = outer.rotation * velocity.angular;
                velocity.translation = outer.transform_vector(velocity.translation);
                velocity
            });
            let pose = outer * key.transform.pose();
            resolved.push(MotionKey { time: key.time, pose, velocity });
        }
        Ok(resolved)
    }

    fn samples(
        &mut self,
        path: &str,
        relative: &str,
        file: &MotionFile,
    ) -> Result<Vec<MotionKey>, LoadError> {
        let fps = file.fps.unwrap_or(MOTION_FILE_FPS);
        self.check(&format!("{path}.fps"), fps, Limit::Positive)?;
        check_transform(self.document, &format!("{path}.transform"), &file.transform)?;
        let bodies = self.bodies(&format!("{path}.file"), relative)?;
        let body = file.body.unwrap_or(0);
        let Some(samples) = bodies.get(body) else {
            let limit = format!("less than {}, the file's number of bodies", bodies.len());
            return Err(self.out_of_range(&format!("{path}.body"), body, &limit));
        };
        let outer = file.transform.pose();
        let key = |(k, &pose): (usize, &Pose)| MotionKey {
            time: k as f64 / fps,
            pose: outer * pose,
            velocity: None,
        };
        Ok(samples.iter().enumerate().map(key).collect())
    }

    fn bodies(&mut self, path: &str, relative: &str) -> Result<Arc<Vec<Vec<Pose>>>, LoadError> {
        let (file, text) = self.text_at(path, relative)?;
        if let Some(bodies) = self.motion_files.get(&file) {
            return Ok(bodies.clone());
        }
        let bodies = Arc::new(bodies_from_mot(&file.to_string_lossy(), &text)?);
        self.motion_files.insert(file, bodies.clone());
        Ok(bodies)
    }

    pub(super) fn obstacles(&mut self, names: &[String]) -> Result<Vec<Obstacle>, LoadError> {
        let files = self.file.obstacles.clone();
        files.iter().enumerate().map(|(index, file)| self.obstacle(index, file, names)).collect()
    }

    fn obstacle(
        &mut self,
        index: usize,
        file: &ObstacleFile,
        names: &[String],
    ) -> Result<Obstacle, LoadError> {
        let path = format!("obstacles.{index}");
        check_transform(self.document, &format!("{path}.transform"), &file.transform)?;
        let motion = self.motion_index(&format!("{path}.motion"), &file.motion, names)?;
        self.check_one_kind_of_mesh(&path, file)?;
        let (first, surface, deformation) = match &file.mesh {
            Some(mesh) => {
                let (mesh_path, text) = self.text_at(&format!("{path}.mesh"), mesh)?;
                (mesh.clone(), self.surface(mesh_path, &text)?, None)
            }
            None => {
                let (first, surface, deformation) = self.deforming(&path, file)?;
                (first, surface, Some(Arc::new(deformation)))
            }
        };
        let name = file.name.clone().unwrap_or_else(|| stem(&first));
        Ok(Obstacle { name, surface, deformation, placement: file.transform.pose(), motion })
    }

    fn check_one_kind_of_mesh(&self, path: &str, file: &ObstacleFile) -> Result<(), LoadError> {
        let kinds = [
            ("mesh", file.mesh.is_some()),
            ("meshes", file.meshes.is_some()),
            ("mesh_sequence", file.mesh_sequence.is_some()),
        ];
        let given: Vec<&'static str> =
            kinds.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name).collect();
        let thing = path.to_owned();
        let problem = match given[..] {
            [_] => return Ok(()),
            [first, second, ..] => Problem::Exclusive { thing, first, second },
            [] => Problem::Missing { thing, needed: "a mesh, meshes or a mesh_sequence" },
        };
        Err(problem.at(self.document.place_of(path)))
    }

    fn surface(&mut self, path: PathBuf, text: &str) -> Result<Arc<Surface>, LoadError> {
        if let Some(surface) = self.surfaces.get(&path) {
            return Ok(surface.clone());
        }
        let name = path.to_string_lossy();
        let surface = Arc::new(surface_from_obj(&name, text, Flat::LeftOut, self.warnings)?);
        self.warn_of_open_edges(&name, &surface);
        self.surfaces.insert(path, surface.clone());
        Ok(surface)
    }

    pub(super) fn warn_of_open_edges(&mut self, file: &str, surface: &Surface) {
        let open_edges = surface.open_edge_count();
        if open_edges > 0 {
            self.warnings.push(format!(
                "{file}: the surface has {open_edges} open edges: cloth beside them may be taken \
                 for inside"
            ));
        }
    }

    fn motion_index(
        &self,
        path: &str,
        name: &Option<String>,
        names: &[String],
    ) -> Result<Option<usize>, LoadError> {
        let Some(name) = name else { return Ok(None) };
        if let Some(index) = names.iter().position(|known| known == name) {
            return Ok(Some(index));
        }
        let nearest = nearest(name, names.iter().map(String::as_str));
        let problem = Problem::UnknownName { kind: "motion", name: name.clone(), nearest };
        Err(problem.at(self.document.place_of(path)))
    }

    /// Nodes are checked when the garment's mesh is read.
    pub(super) fn handles(&self, names: &[String]) -> Result<Vec<Handle>, LoadError> {
        let mut handles = Vec::new();
        let garment_count = self.file.garments.len();
        for (h, file) in self.file.handles.iter().enumerate() {
            let path = format!("handles.{h}");
            if file.garment >= garment_count {
                let limit = format!("less than {garment_count}, the number of garments");
                return Err(self.out_of_range(&format!("{path}.garment"), file.garment, &limit));
            }
            if file.nodes.is_empty() {
                return Err(self.out_of_range(
                    &format!("{path}.nodes"),
                    "empty",
                    "a list of nodes",
                ));
            }
            self.check(&format!("{path}.start_time"), file.start_time, Limit::Finite)?;
            let end_time = file.end_time.unwrap_or(f64::INFINITY);
            self.check(&format!("{path}.end_time"), end_time, Limit::Above(file.start_time))?;
            handles.push(Handle {
                garment: file.garment,
                nodes: file.nodes.clone(),
                motion: self.motion_index(&format!("{path}.motion"), &file.motion, names)?,
                start_time: file.start_time,
                end_time,
            });
        }
        Ok(handles)
    }
}
