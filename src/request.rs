//! From what somebody asks for - a file, a camera, a few settings - to a shot that can be simulated.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use crate::own_shot::own_shot;
use crate::run::{InputHasher, RUN_FORMAT, RunInfo, cpu_features};
use crate::scene::{
    EmbeddedFiles, FileRead, FileSource, FileSystem, LoadError, LoadOptions, LoadedShot, Scene,
    Surface, joined, load,
};
use crate::sim::{SimSettings, SizingMode};

/// What is to be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// A shot file or an ARCSim scene; `None` is the shot that comes with the program.
    pub shot: Option<PathBuf>,
    /// What the shot file says, if that is not what is on disk.
    pub text: Option<Arc<str>>,
    /// A camera file that takes the place of the shot camera.
    pub camera: Option<PathBuf>,
    /// Overrides, `path.to.field=value`, in order.
    pub sets: Vec<String>,
    /// Frames per second, where scene and camera disagree.
    pub fps: Option<f64>,
    /// `None`: as far as both shot and camera go.
    pub frames: Option<FrameRange>,
    pub sizing: SizingMode,
}

/// Frames from the first to the last, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRange {
    pub first: u32,
    pub last: u32,
}

impl FrameRange {
    pub fn contains(self, frame: u32) -> bool {
        (self.first..=self.last).contains(&frame)
    }
}

/// Why a request cannot be met.
#[derive(Debug, Error)]
pub enum RequestError {
    #[error("{path:?} is a folder, but a shot is a file")]
    Folder { path: String },
    #[error("cannot simulate {path:?}: neither shot nor camera says how many frames there are")]
    Endless { path: String },
    #[error(transparent)]
    Load(#[from] LoadError),
}

/// A shot that can be simulated, and which of its frames are wanted.
#[derive(Clone, Debug)]
pub struct Requested {
    pub scene: Arc<Scene>,
    pub settings: SimSettings,
    pub frames: FrameRange,
    /// How a run of it begins.
    pub info: RunInfo,
    /// What was read but has no effect, and what may surprise.
    pub warnings: Vec<String>,
    /// Every file the scene depends on.
    pub files_read: Vec<FileRead>,
    /// What the shot file says itself, with what it imports and the overrides.
    pub written: serde_json::Value,
    /// Where relative names of files start from.
    pub folder: PathBuf,
}

impl Request {
    /// The shot's file as its folder calls it.
    pub fn path(&self) -> PathBuf {
        self.shot.clone().unwrap_or_else(|| own_shot().0)
    }

    /// # Errors
    /// If the shot cannot be loaded, or does not say where it ends.
    pub fn load(&self) -> Result<Requested, RequestError> {
        let (path, source) = self.path_and_source()?;
        let options = LoadOptions {
            shot: path.clone(),
            camera: self.camera.clone(),
            sets: self.sets.clone(),
            fps: self.fps,
        };
        let loaded = load(&options, source.as_ref())?;
        let frames = match self.frames.or_else(|| length(&loaded.scene)) {
            Some(frames) => frames,
            None => return Err(RequestError::Endless { path: path.display().to_string() }),
        };
        let settings = SimSettings { sizing: self.sizing };
        let info = run_info(&loaded, settings);
        let LoadedShot { scene, warnings, files_read, resolved: _, written } = loaded;
        let scene = Arc::new(scene);
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Requested { scene, settings, frames, info, warnings, files_read, written, folder })
    }

    fn path_and_source(&self) -> Result<(PathBuf, Box<dyn FileSource>), RequestError> {
        match &self.shot {
            Some(path) if path.is_dir() => {
                Err(RequestError::Folder { path: path.display().to_string() })
            }
            Some(path) => match &self.text {
                Some(text) => {
                    let (path, text) = (path.clone(), text.clone());
                    Ok((path.clone(), Box::new(OtherText { path, text })))
                }
                None => Ok((path.clone(), Box::new(FileSystem))),
            },
            None => {
                let (path, files) = own_shot();
                Ok((path, Box::new(OwnShotFiles(files))))
            }
        }
    }
}

impl Requested {
    /// The obstacles at rest, in the scene's order.
    pub fn surfaces(&self) -> Vec<Arc<Surface>> {
        self.scene.obstacles.iter().map(|o| o.surface.clone()).collect()
    }
}

/// The files of the own shot; what else is named, such as a camera, is a real file.
struct OwnShotFiles(EmbeddedFiles);

impl FileSource for OwnShotFiles {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        if self.0.is_file(path) { self.0.read(path) } else { FileSystem.read(path) }
    }

    fn is_file(&self, path: &Path) -> bool {
        self.0.is_file(path) || FileSystem.is_file(path)
    }
}

/// All files as they are but for one, which says something else.
struct OtherText {
    path: PathBuf,
    text: Arc<str>,
}

impl FileSource for OtherText {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        if is_same(path, &self.path) {
            return Ok(self.text.as_bytes().to_vec());
        }
        FileSystem.read(path)
    }

    fn is_file(&self, path: &Path) -> bool {
        is_same(path, &self.path) || FileSystem.is_file(path)
    }
}

/// Whether a path is another's, which may be written with more words.
fn is_same(path: &Path, other: &Path) -> bool {
    path == joined(Path::new(""), other)
}

/// The frames of the scene; where it runs on, those of its camera.
fn length(scene: &Scene) -> Option<FrameRange> {
    let camera_last = scene.viewers.first().map(|path| path.frame_range()[1].round() as u32);
    let last = match (scene.last_frame, camera_last) {
        (Some(scene), Some(camera)) if camera > 0 => scene.min(camera),
        (Some(last), _) => last,
        (None, Some(last)) if last > 0 => last,
        (None, _) => return None,
    };
    Some(FrameRange { first: 0, last })
}

fn run_info(loaded: &LoadedShot, settings: SimSettings) -> RunInfo {
    let sizing = serde_json::to_value(settings.sizing).expect("sizing is plain data");
    let mut recorded = loaded.resolved.clone();
    recorded["sizing_mode"] = sizing;
    let mut hasher = InputHasher::new(&recorded);
    for file in &loaded.files_read {
        hasher.add_file(file.sha256.as_bytes());
    }
    RunInfo {
        shotsilk_run: RUN_FORMAT,
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        shot: loaded.scene.name.clone(),
        sizing_mode: settings.sizing.name().to_owned(),
        fps: loaded.scene.fps,
        first_frame: loaded.scene.first_frame,
        garments: loaded.scene.garments.iter().map(|g| g.name.clone()).collect(),
        obstacles: loaded.scene.obstacles.iter().map(|o| o.name.clone()).collect(),
        input_hash: hasher.finish(),
        cpu_features: cpu_features(),
        adapter: None,
        settings: recorded,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own() -> Request {
        Request {
            shot: None,
            text: None,
            camera: None,
            sets: Vec::new(),
            fps: None,
            frames: None,
            sizing: SizingMode::View,
        }
    }

    #[test]
    fn the_own_shot_ends_where_its_camera_does() {
        let requested = own().load().unwrap();
        let last = requested.scene.viewers[0].frame_range()[1].round() as u32;
        assert_eq!(requested.frames, FrameRange { first: 0, last });
        assert_eq!(requested.surfaces().len(), requested.scene.obstacles.len());
    }

    #[test]
    fn what_changes_the_simulation_changes_the_hash() {
        let hash = |request: &Request| request.load().unwrap().info.input_hash;
        let other = Request { sets: vec!["view.nu_out=0.3".into()], ..own() };
        let adaptive = Request { sizing: SizingMode::Adaptive, ..own() };
        assert_eq!(hash(&own()), hash(&own()));
        assert_ne!(hash(&own()), hash(&other));
        assert_ne!(hash(&own()), hash(&adaptive));
    }

    #[test]
    fn a_text_takes_the_place_of_what_is_on_disk() {
        let folder = tempfile::tempdir().unwrap();
        let (text, files) = crate::own_shot::own_shot_parts();
        for (name, contents) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, contents).unwrap();
        }
        let text = |frames: u32| {
            let text = String::from_utf8_lossy(text);
            text.replace("\"frames\": 100", &format!("\"frames\": {frames}"))
        };
        // As a path may be written.
        let shot = folder.path().join("meshes/../shot.json");
        std::fs::write(&shot, text(3)).unwrap();
        let on_disk = Request { shot: Some(shot), ..own() };
        let instead = Request { text: Some(text(5).into()), ..on_disk.clone() };
        let last = |request: &Request| request.load().unwrap().frames.last;
        assert_eq!([last(&on_disk), last(&instead)], [3, 5]);
    }

    #[test]
    fn a_folder_is_no_shot() {
        let folder = Request { shot: Some(PathBuf::from(".")), ..own() };
        assert!(matches!(folder.load(), Err(RequestError::Folder { .. })));
    }
}
