//! A supply of frames, and requests for them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};
use serde_json::json;
use tempfile::TempDir;

use crate::app::export::*;
use crate::render::fixture::{frame, look_at, square};
use crate::run::{RUN_FORMAT, RunInfo};
use crate::scene::Surface;
use crate::shot::{CameraKey, CameraPath, Lens, Track};
use crate::sim::Frame;

/// Longer than any export here takes on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(120);

pub const FIRST_FRAME: i64 = 1001;

/// A sheet that rises, seen by a camera that drives past.
pub struct Reel {
    pub frames: BTreeMap<u32, Arc<Frame>>,
    /// Of frames that other settings have made.
    pub other_hashes: BTreeMap<u32, String>,
    /// What a frame takes to come.
    pub delay: Duration,
    pub camera: Option<CameraPath>,
}

impl Reel {
    pub fn new(count: u32) -> Self {
        let rising = |number: u32| {
            let cloth = square(0.02 * f64::from(number), 0.1);
            (number, Arc::new(Frame { number, ..frame([cloth]) }))
        };
        Self {
            frames: (0..count).map(rising).collect(),
            other_hashes: BTreeMap::new(),
            delay: Duration::ZERO,
            camera: Some(driving_camera()),
        }
    }
}

impl FrameSupply for Reel {
    fn frame(&self, number: u32) -> Result<Arc<Frame>, String> {
        thread::sleep(self.delay);
        let found = self.frames.get(&number);
        found.cloned().ok_or_else(|| "it is not simulated yet".to_owned())
    }

    fn settings_hash(&self, number: u32) -> Result<String, String> {
        let other = self.other_hashes.get(&number);
        Ok(other.cloned().unwrap_or_else(|| self.info().input_hash))
    }

    fn surfaces(&self) -> Vec<Arc<Surface>> {
        Vec::new()
    }

    fn camera(&self) -> Option<CameraPath> {
        self.camera.clone()
    }

    fn info(&self) -> RunInfo {
        RunInfo {
            shotsilk_run: RUN_FORMAT,
            program_version: "test".to_owned(),
            shot: "sh010".to_owned(),
            sizing_mode: "view".to_owned(),
            fps: 24.0,
            first_frame: FIRST_FRAME,
            garments: vec!["sheet".to_owned()],
            obstacles: Vec::new(),
            input_hash: "a1b2c3d4e5f60718".to_owned(),
            cpu_features: Vec::new(),
            adapter: None,
            settings: json!({}),
        }
    }
}

pub fn driving_camera() -> CameraPath {
    let aperture_mm = DVec2::new(36.0, 24.0);
    let key = |frame: f64, x: f64| CameraKey {
        frame,
        eye: DVec3::new(x, -1.6, 0.9),
        target: DVec3::ZERO,
        up: DVec3::Z,
        lens: Lens::FilmBack { focal_mm: 35.0, aperture_mm, offset_mm: DVec2::ZERO },
        cut: false,
    };
    CameraPath {
        name: "drive".to_owned(),
        resolution: [320, 180],
        pixel_aspect: 1.0,
        near: 0.05,
        far: 40.0,
        track: Track::Keys(vec![key(0.0, -0.6), key(20.0, 0.9)]),
    }
}

pub fn witness() -> View {
    look_at(DVec3::new(3.0, -2.6, 2.0), DVec3::new(0.0, -0.5, 0.2), 35.0, [300, 300])
}

pub fn request(what: ExportKind, to: &Path) -> ExportRequest {
    ExportRequest {
        what,
        view: ExportView::Shot,
        width: 160,
        options: PictureOptions::default(),
        ghost_frames: None,
        burn_in: BurnIn::None,
        ffmpeg: FFMPEG.into(),
        to: to.to_owned(),
    }
}

pub fn begin(request: ExportRequest, reel: Reel) -> ExportJob {
    start(request, Box::new(reel), AdapterChoice::Software, Arc::new(|| ()))
}

pub fn wait_until(job: &ExportJob, is_reached: impl Fn(&ExportProgress) -> bool) -> ExportProgress {
    let begun = Instant::now();
    loop {
        let progress = job.progress();
        if is_reached(&progress) {
            return progress;
        }
        assert!(begun.elapsed() < PATIENCE, "{progress:?}");
        thread::sleep(Duration::from_millis(5));
    }
}

pub fn end_of(job: &ExportJob) -> ExportProgress {
    wait_until(job, |progress| progress.state != ExportState::Running)
}

pub fn done(request: ExportRequest, reel: Reel) -> u32 {
    let to = request.to.clone();
    let progress = end_of(&begin(request, reel));
    assert_eq!(progress.state, ExportState::Done(to));
    assert_eq!(progress.done, progress.total);
    progress.done
}

pub fn why_not(request: ExportRequest, reel: Reel) -> String {
    match end_of(&begin(request, reel)).state {
        ExportState::Failed(why) => why,
        other => panic!("it should fail: {other:?}"),
    }
}

pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

pub fn size_of(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).unwrap()
}

pub fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

pub fn fake_ffmpeg(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/support/ffmpeg").join(name)
}
