//! From a file name to a scene.

use std::path::{Path, PathBuf};

use super::Scene;
use super::arcsim::Import;
use super::document::{Node, Value, apply_overrides};
use super::error::{LoadError, Place, Problem};
use super::native::{SHOT_VERSION, ShotFile};
use super::resolve::{CameraRequest, Resolver, stem};
use super::source::{FileRead, FileRole, FileSource, Reader, joined};

/// What to load, and what the command line changes about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadOptions {
    /// A native shot or an ARCSim scene.
    pub shot: PathBuf,
    /// A camera file that takes the place of the shot camera.
    pub camera: Option<PathBuf>,
    /// Overrides, `path.to.field=value`, in order.
    pub sets: Vec<String>,
    /// Frames per second of scene and camera, where they disagree or should be another.
    pub fps: Option<f64>,
}

/// A shot and what is to be known about its files.
#[derive(Clone, Debug)]
pub struct LoadedShot {
    pub scene: Scene,
    /// What was read but has no effect, and what may surprise.
    pub warnings: Vec<String>,
    /// Every file the scene depends on.
    pub files_read: Vec<FileRead>,
    /// All settings, with nothing left to defaults.
    pub resolved: serde_json::Value,
    /// What the shot file says itself, with the scene it imports and the overrides: what it leaves to
    /// defaults is absent, fabrics are named with their factors, cameras may be file names.
    pub written: serde_json::Value,
}

/// Reads a shot and every file it names.
///
/// # Errors
/// The first thing that is not as it must be: where, what, its value and its limit.
pub fn load(options: &LoadOptions, source: &dyn FileSource) -> Result<LoadedShot, LoadError> {
    let reader = Reader::new(source);
    let mut warnings = Vec::new();
    let folder = options.shot.parent().unwrap_or(Path::new("")).to_path_buf();
    let document = document(options, &folder, &reader, &mut warnings)?;
    let name = stem(&options.shot.to_string_lossy());
    let request = CameraRequest { file: options.camera.clone(), fps: options.fps };
    let resolver = Resolver::new(&document, folder, &reader, &mut warnings)?;
    let (scene, resolved) = resolver.scene(name, &request)?;
    let written = document.json();
    Ok(LoadedShot { scene, warnings, files_read: reader.into_files_read(), resolved, written })
}

/// The JSON Schema of the native shot file.
pub fn shot_schema() -> serde_json::Value {
    schemars::schema_for!(ShotFile).to_value()
}

/// The shot file as a tree: the imported scene, what the shot says over it, and the overrides.
fn document(
    options: &LoadOptions,
    folder: &Path,
    reader: &Reader<'_>,
    warnings: &mut Vec<String>,
) -> Result<Node, LoadError> {
    let shot = parsed(&joined(Path::new(""), &options.shot), reader)?;
    let mut document = if shot.child("shotsilk").is_some() {
        match shot.child("import").cloned() {
            Some(import) => wrapped(shot, &import, folder, reader, warnings)?,
            None => shot,
        }
    } else {
        let scene_path = options.shot.file_name().map(PathBuf::from).unwrap_or_default();
        imported(&shot, &scene_path, folder, reader, warnings)?
    };
    apply_overrides(&mut document, &options.sets, &shot_schema())?;
    Ok(document)
}

/// A shot over the scene that it imports.
fn wrapped(
    shot: Node,
    import: &Node,
    folder: &Path,
    reader: &Reader<'_>,
    warnings: &mut Vec<String>,
) -> Result<Node, LoadError> {
    // The version decides what the rest means.
    check_version(&shot)?;
    let scene_path: PathBuf = import.deserialize()?;
    let scene = parsed(&joined(folder, &scene_path), reader).map_err(|e| e.or_at(&import.place))?;
    if scene.child("shotsilk").is_some() {
        let thing = "importing another shot".to_owned();
        return Err(Problem::NotSupported { thing }.at(import.place.clone()));
    }
    let mut document = imported(&scene, &scene_path, folder, reader, warnings)?;
    document.place = shot.place.clone();
    document.overlay(shot);
    Ok(document)
}

fn check_version(shot: &Node) -> Result<(), LoadError> {
    let Some(version) = shot.child("shotsilk") else { return Ok(()) };
    let (found, supported) = (version.deserialize()?, SHOT_VERSION);
    if found == supported {
        Ok(())
    } else {
        Err(Problem::Version { found, supported }.at(version.place.clone()))
    }
}

fn imported(
    scene: &Node,
    scene_path: &Path,
    folder: &Path,
    reader: &Reader<'_>,
    warnings: &mut Vec<String>,
) -> Result<Node, LoadError> {
    if !matches!(scene.value, Value::Object(_)) || scene.child("cloths").is_none() {
        let place = match &scene.place {
            Place::Text { file, .. } => Place::File { file: file.clone() },
            other => other.clone(),
        };
        return Err(Problem::NeitherShotNorScene.at(place));
    }
    Import::new(scene, scene_path, folder, reader, warnings).shot(scene)
}

fn parsed(path: &Path, reader: &Reader<'_>) -> Result<Node, LoadError> {
    Node::parse(&path.to_string_lossy(), &reader.text_for(FileRole::Document, path)?)
}

#[cfg(test)]
#[path = "load_tests.rs"]
mod tests;
