//! Whole exports: they draw with the software adapter and fail without one.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};
use serde_json::json;
use tempfile::TempDir;

use super::*;
use crate::render::fixture::{frame, look_at, square};
use crate::run::{RUN_FORMAT, RunInfo, RunReader};
use crate::scene::Surface;
use crate::shot::{CameraKey, CameraPath, Lens, Track};
use crate::sim::Frame;

/// Longer than any export here takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

const FIRST_FRAME: i64 = 1001;

/// A sheet that rises, seen by a camera that drives past.
struct Reel {
    frames: BTreeMap<u32, Arc<Frame>>,
    /// Of frames that other settings have made.
    other_hashes: BTreeMap<u32, String>,
    /// What a frame takes to come.
    delay: Duration,
    camera: Option<CameraPath>,
}

impl Reel {
    fn new(count: u32) -> Self {
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

fn driving_camera() -> CameraPath {
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

fn witness() -> View {
    look_at(DVec3::new(3.0, -2.6, 2.0), DVec3::new(0.0, -0.5, 0.2), 35.0, [300, 300])
}

fn request(what: ExportKind, to: &Path) -> ExportRequest {
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

fn begin(request: ExportRequest, reel: Reel) -> ExportJob {
    start(request, Box::new(reel), AdapterChoice::Software, Arc::new(|| ()))
}

fn wait_until(job: &ExportJob, is_reached: impl Fn(&ExportProgress) -> bool) -> ExportProgress {
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

fn end_of(job: &ExportJob) -> ExportProgress {
    wait_until(job, |progress| progress.state != ExportState::Running)
}

fn done(request: ExportRequest, reel: Reel) -> u32 {
    let to = request.to.clone();
    let progress = end_of(&begin(request, reel));
    assert_eq!(progress.state, ExportState::Done(to));
    assert_eq!(progress.done, progress.total);
    progress.done
}

fn why_not(request: ExportRequest, reel: Reel) -> String {
    match end_of(&begin(request, reel)).state {
        ExportState::Failed(why) => why,
        other => panic!("it should fail: {other:?}"),
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn size_of(path: &Path) -> (u32, u32) {
    image::image_dimensions(path).unwrap()
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn fake_ffmpeg(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/support/ffmpeg").join(name)
}

#[test]
fn a_still_is_a_picture_of_the_view_with_the_strip_under_it() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let bare = request(ExportKind::Still { frame: 3 }, &to);
    assert_eq!(done(bare.clone(), Reel::new(4)), 1);
    assert_eq!(size_of(&to), (160, 90));
    let picture = image::open(&to).unwrap().into_rgba8();

    done(ExportRequest { burn_in: BurnIn::Strip, ..bare.clone() }, Reel::new(4));
    let page = image::open(&to).unwrap().into_rgba8();
    assert!(page.height() > 90);
    assert!(image::imageops::crop_imm(&page, 0, 0, 160, 90).to_image() == picture);

    done(ExportRequest { view: ExportView::Witness(witness()), ..bare.clone() }, Reel::new(4));
    assert_eq!(size_of(&to), (160, 160), "the witness has a shape of its own");
    done(ExportRequest { view: ExportView::Both(witness()), ..bare }, Reel::new(4));
    assert_eq!(size_of(&to), (328, 90));
    assert_eq!(names(folder.path()), ["still.png"]);
}

#[test]
fn without_a_shot_camera_the_witness_can_be_exported_and_nothing_else() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let reel = || Reel { camera: None, ..Reel::new(2) };
    let bare = request(ExportKind::Still { frame: 1 }, &to);
    let seen = ExportRequest {
        view: ExportView::Witness(witness()),
        burn_in: BurnIn::Strip,
        ..bare.clone()
    };
    assert_eq!(done(seen, reel()), 1);
    assert_eq!(size_of(&to).0, 160);
    for view in [ExportView::Shot, ExportView::Both(witness())] {
        let why = why_not(ExportRequest { view, ..bare.clone() }, reel());
        assert!(why.contains("the shot has no camera"), "{why}");
    }
    let run = request(ExportKind::Run { first: 0, last: 1 }, &folder.path().join("run"));
    assert_eq!(done(run, reel()), 2);
}

#[test]
fn the_witness_needs_no_camera_that_can_be_used_and_its_strip_names_its_own_lens() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let bare = request(ExportKind::Still { frame: 1 }, &to);
    let seen = ExportRequest {
        view: ExportView::Witness(witness()),
        width: 640,
        burn_in: BurnIn::Strip,
        ..bare.clone()
    };
    let unusable = CameraPath { near: -1.0, ..driving_camera() };
    let strip = |camera: Option<CameraPath>| {
        done(seen.clone(), Reel { camera, ..Reel::new(2) });
        let page = image::open(&to).unwrap().into_rgba8();
        image::imageops::crop_imm(&page, 0, 640, 640, page.height() - 640).to_image()
    };
    let [none, broken, other] = [None, Some(unusable.clone()), Some(driving_camera())].map(strip);
    assert!(none.height() > 0 && none == broken && none == other);
    let why = why_not(bare, Reel { camera: Some(unusable), ..Reel::new(2) });
    assert!(why.contains("the shot's camera cannot be used"), "{why}");
}

#[test]
fn what_is_in_the_way_of_an_export_is_said() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let still = request(ExportKind::Still { frame: 1 }, &to);
    assert_eq!(in_the_way(&still, FIRST_FRAME), None);
    fs::write(&to, "").unwrap();
    assert!(in_the_way(&still, FIRST_FRAME).unwrap().contains("a.png"));
    let sequence = request(ExportKind::Sequence { first: 1, last: 3, stride: 1 }, folder.path());
    // Another view's pictures, and other frames.
    for name in ["1001.witness.png", "1000.shot.png", "1005.shot.png"] {
        fs::write(folder.path().join(name), "").unwrap();
    }
    assert_eq!(in_the_way(&sequence, FIRST_FRAME), None);
    fs::write(folder.path().join("1003.shot.png"), "").unwrap();
    assert!(in_the_way(&sequence, FIRST_FRAME).unwrap().contains("holds 1 of"));
}

#[test]
fn a_sequence_is_a_folder_of_the_frames_as_the_shot_counts_them() {
    let folder = folder();
    let to = folder.path().join("new/pictures");
    let what = ExportKind::Sequence { first: 1, last: 6, stride: 2 };
    assert_eq!(done(request(what, &to), Reel::new(8)), 3);
    assert_eq!(names(&to), ["1002.shot.png", "1004.shot.png", "1006.shot.png"]);
}

#[test]
fn every_change_of_progress_wakes_whoever_looks_on() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 2, stride: 1 };
    let woken = Arc::new(AtomicU32::new(0));
    let counter = woken.clone();
    let wake = Arc::new(move || {
        counter.fetch_add(1, Ordering::AcqRel);
    });
    let supply = Box::new(Reel::new(3));
    let job = start(request(what, folder.path()), supply, AdapterChoice::Software, wake);
    end_of(&job);
    // What is expected, three frames, the end; the last call may still be on its way.
    thread::sleep(Duration::from_millis(50));
    assert_eq!(woken.load(Ordering::Acquire), 5);
}

#[test]
fn a_cancelled_sequence_keeps_its_whole_frames_and_says_how_many() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 199, stride: 1 };
    let job = begin(request(what, folder.path()), Reel::new(200));
    wait_until(&job, |progress| progress.done >= 2);
    job.cancel();
    let progress = end_of(&job);
    let ExportState::Cancelled(what) = &progress.state else { panic!("{progress:?}") };
    assert!(what.contains(&format!("{} of 200 frames", progress.done)), "{what}");
    let names = names(folder.path());
    assert_eq!(names.len() as u32, progress.done);
    assert!(names.iter().all(|name| size_of(&folder.path().join(name)) == (160, 90)));
    job.cancel();
    assert_eq!(job.progress(), progress, "what has ended stays as it is");
}

#[test]
fn a_dropped_job_stops() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 4_999, stride: 1 };
    let reel = Reel { delay: Duration::from_millis(10), ..Reel::new(5_000) };
    let job = begin(request(what, folder.path()), reel);
    wait_until(&job, |progress| progress.done >= 1);
    drop(job);
    // The frame in work, on a busy machine.
    thread::sleep(Duration::from_secs(1));
    let count = names(folder.path()).len();
    thread::sleep(Duration::from_millis(500));
    assert_eq!(names(folder.path()).len(), count);
}

#[test]
fn a_contact_sheet_shows_both_views_of_its_frames() {
    let folder = folder();
    let to = folder.path().join("sheet.png");
    let what = ExportKind::Sheet { frames: vec![0, 4, 7] };
    let shot_only = request(what, &to);
    let both = ExportRequest { view: ExportView::Both(witness()), ..shot_only.clone() };
    assert_eq!(done(both, Reel::new(8)), 3);
    let (width, height) = size_of(&to);
    assert!(width > 2 * 160 && height > 90, "{width} x {height}");
    assert!(why_not(shot_only, Reel::new(8)).contains("needs a witness"));
}

#[test]
fn a_legend_is_drawn_once_on_a_pair_and_not_into_the_pictures_of_a_sheet() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let drawn = |what: ExportKind, legend_px: Option<f32>| {
        let mut export =
            ExportRequest { view: ExportView::Both(witness()), width: 320, ..request(what, &to) };
        export.options.legend_px = legend_px;
        done(export, Reel::new(2));
        image::open(&to).unwrap().into_rgba8()
    };
    let [with, without] = [Some(9.0), None].map(|l| drawn(ExportKind::Still { frame: 1 }, l));
    let half = |image: &image::RgbaImage, x: u32| {
        image::imageops::crop_imm(image, x, 0, 320, 180).to_image()
    };
    assert!(half(&with, 0) != half(&without, 0) && half(&with, 328) == half(&without, 328));
    let sheet = || ExportKind::Sheet { frames: vec![0, 1] };
    // Captions of the two are equal: these frames took no time.
    assert!(drawn(sheet(), Some(9.0)) == drawn(sheet(), None));
}

#[test]
fn a_run_folder_has_the_frames_bit_for_bit() {
    let folder = folder();
    let to = folder.path().join("run");
    let reel = Reel::new(5);
    let wanted = reel.frames[&3].clone();
    assert_eq!(done(request(ExportKind::Run { first: 2, last: 4 }, &to), reel), 3);
    let reader = RunReader::open(&to).unwrap();
    assert_eq!((reader.frames(), reader.info().first_frame), (&[2, 3, 4][..], FIRST_FRAME));
    let read = reader.frame(3).unwrap();
    assert_eq!(read.garments[0].position, wanted.garments[0].position);
}

#[test]
fn a_run_of_mixed_settings_is_refused_before_anything_is_written() {
    let folder = folder();
    let to = folder.path().join("run");
    let mut reel = Reel::new(5);
    reel.other_hashes.insert(3, "ffffffffffffffff".to_owned());
    let why = why_not(request(ExportKind::Run { first: 0, last: 4 }, &to), reel);
    assert!(why.contains("frame 1004") && why.contains("ffffffffffff"), "{why}");
    assert!(!to.exists());
}

#[test]
fn a_film_is_piped_to_the_program_in_whole_even_frames() {
    let folder = folder();
    let to = folder.path().join("film.mp4");
    let film = ExportRequest {
        view: ExportView::Both(witness()),
        width: 161,
        burn_in: BurnIn::Strip,
        ffmpeg: fake_ffmpeg("whole"),
        ..request(ExportKind::Video { first: 1, last: 4 }, &to)
    };
    assert_eq!(done(film, Reel::new(6)), 4);
    let said = fs::read_to_string(&to).unwrap();
    let size = said.split_whitespace().skip_while(|&word| word != "-video_size").nth(1).unwrap();
    let sides: Vec<u64> = size.split('x').map(|side| side.parse().unwrap()).collect();
    assert!(sides[0] == 2 * 160 + 8 && sides.iter().all(|side| side % 2 == 0), "{size}");
    let byte_count: u64 = said.lines().nth(1).unwrap().trim().parse().unwrap();
    assert_eq!(byte_count, 4 * 3 * sides[0] * sides[1]);
    for wanted in ["-framerate 24 ", "-c:v libx264 ", "yuv420p", "-f mp4 "] {
        assert!(said.contains(wanted), "{wanted} is missing in {said}");
    }
    assert_eq!(names(folder.path()), ["film.mp4"]);
}

#[test]
fn cancelling_a_film_ends_a_program_that_takes_nothing_and_leaves_no_file() {
    let folder = folder();
    let to = folder.path().join("film.mkv");
    let film = ExportRequest {
        ffmpeg: fake_ffmpeg("stuck"),
        ..request(ExportKind::Video { first: 0, last: 99 }, &to)
    };
    let job = begin(film, Reel::new(100));
    // What a pipe holds without anyone reading.
    wait_until(&job, |progress| progress.done >= 1);
    let asked = Instant::now();
    job.cancel();
    assert!(asked.elapsed() < Duration::from_millis(500), "it waits for nobody");
    let progress = end_of(&job);
    assert!(matches!(progress.state, ExportState::Cancelled(_)), "{progress:?}");
    assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
}

#[test]
fn a_program_that_gives_up_is_quoted_and_one_that_is_missing_is_named_with_its_package() {
    let folder = folder();
    let to = folder.path().join("film.mov");
    let film = request(ExportKind::Video { first: 0, last: 9 }, &to);
    let with = |ffmpeg: PathBuf| ExportRequest { ffmpeg, ..film.clone() };
    let why = why_not(with(fake_ffmpeg("broken")), Reel::new(10));
    assert!(why.contains("the disk of the film is full"), "{why}");
    let why = why_not(with("no-such-program-ffmpeg".into()), Reel::new(10));
    assert!(why.contains("no-such-program-ffmpeg") && why.contains("package ffmpeg"), "{why}");
    let why =
        why_not(request(ExportKind::Video { first: 0, last: 1 }, folder.path()), Reel::new(2));
    assert!(why.contains(".mp4"), "{why}");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_installed_ffmpeg_makes_a_film() {
    if std::process::Command::new(FFMPEG).arg("-version").output().is_err() {
        println!("skipped: ffmpeg is not installed");
        return;
    }
    let folder = folder();
    let to = folder.path().join("film.mp4");
    let film = ExportRequest {
        burn_in: BurnIn::Strip,
        ..request(ExportKind::Video { first: 0, last: 11 }, &to)
    };
    assert_eq!(done(film, Reel::new(12)), 12);
    let bytes = fs::read(&to).unwrap();
    assert!(bytes.len() > 1_000 && &bytes[4..8] == b"ftyp", "{} bytes", bytes.len());
}

#[test]
fn a_missing_frame_is_named_as_the_shot_counts_and_the_frames_before_it_stay() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 5, stride: 1 };
    let why = why_not(request(what, folder.path()), Reel::new(3));
    assert_eq!(why, "frame 1004 cannot be exported: it is not simulated yet");
    assert_eq!(names(folder.path()).len(), 3);
}

#[test]
fn bad_requests_are_refused_in_words_and_leave_nothing() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let still = request(ExportKind::Still { frame: 0 }, &to);
    for width in [0, WIDTH_MIN - 1, WIDTH_MAX + 1] {
        let why = why_not(ExportRequest { width, ..still.clone() }, Reel::new(1));
        assert!(why.contains(&format!("{width} px wide")), "{why}");
    }
    let occupied = folder.path().join("file");
    fs::write(&occupied, "x").unwrap();
    let cases = [
        (ExportKind::Still { frame: 0 }, folder.path().join("a.jpg"), ".png"),
        (ExportKind::Still { frame: 0 }, folder.path().join("missing/a.png"), "cannot write"),
        (ExportKind::Sheet { frames: vec![] }, to.clone(), "at least one frame"),
        (ExportKind::Sequence { first: 3, last: 2, stride: 1 }, to.clone(), "after the last"),
        (ExportKind::Sequence { first: 0, last: 2, stride: 0 }, to.clone(), "step"),
        (ExportKind::Sequence { first: 0, last: 0, stride: 1 }, occupied.clone(), "cannot create"),
        (ExportKind::Run { first: 0, last: 0 }, occupied.join("run"), "cannot"),
    ];
    for (what, path, wanted) in cases {
        let why = why_not(request(what.clone(), &path), Reel::new(1));
        assert!(why.contains(wanted), "{what:?}: {why}");
    }
    let huge = ExportRequest {
        view: ExportView::Both(witness()),
        width: 4_096,
        ..request(ExportKind::Sheet { frames: (0..100).collect() }, &to)
    };
    assert!(why_not(huge, Reel::new(1)).contains("too large"));
    assert_eq!(names(folder.path()), ["file"]);
}

#[test]
fn an_adapter_that_is_not_there_is_named() {
    let folder = folder();
    let still = request(ExportKind::Still { frame: 0 }, &folder.path().join("a.png"));
    let adapter = AdapterChoice::Named("no such card".to_owned());
    let job = start(still, Box::new(Reel::new(1)), adapter, Arc::new(|| ()));
    let ExportState::Failed(why) = end_of(&job).state else { panic!() };
    assert!(why.contains("no such card"), "{why}");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_supply_that_panics_ends_the_export_in_words() {
    let job = job::start("a.png".into(), Arc::new(|| ()), |_| panic!("the supply is gone"));
    let ExportState::Failed(why) = end_of(&job).state else { panic!() };
    assert!(why.contains("the supply is gone"), "{why}");
}
