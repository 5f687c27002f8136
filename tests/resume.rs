//! The next frame follows from any stored one, with the bits of a straight run, in shots that are
//! more than a fixture. Small scenes with everything in them: `sim::tests::frame_to_frame`.

#[path = "support/frame_bits.rs"]
mod frame_bits;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frame_bits::bits;
use shotsilk::own_shot::own_shot;
use shotsilk::run::{InputHasher, RUN_FORMAT, RunInfo, RunReader, RunWriter, WriteOptions};
use shotsilk::scene::{FileSystem, LoadOptions, LoadedShot, load};
use shotsilk::sim::{SimSettings, Simulation, SizingMode};

/// What a folder of states asks to be told; nothing of it matters here.
fn info() -> RunInfo {
    let settings = serde_json::Value::Null;
    RunInfo {
        shotsilk_run: RUN_FORMAT,
        program_version: env!("CARGO_PKG_VERSION").into(),
        shot: String::new(),
        sizing_mode: String::new(),
        fps: 24.0,
        first_frame: 0,
        garments: Vec::new(),
        obstacles: Vec::new(),
        input_hash: InputHasher::new(&settings).finish(),
        cpu_features: Vec::new(),
        adapter: None,
        settings,
    }
}

/// Goes on for a frame from each of the last `count` stored frames before frame `last`.
#[track_caller]
fn assert_follows_from_stored_frames(shot: LoadedShot, sizing: SizingMode, last: u32, count: u32) {
    let (scene, settings) = (Arc::new(shot.scene), SimSettings { sizing });
    let folder = tempfile::tempdir().unwrap();
    let mut writer =
        RunWriter::create(folder.path(), &info(), &[], WriteOptions::default()).unwrap();
    let (mut straight, frame) = Simulation::start(scene.clone(), settings).unwrap();
    writer.write(&frame).unwrap();
    for _ in 0..last {
        writer.write(&straight.advance().unwrap()).unwrap();
    }
    let stored = RunReader::open(folder.path()).unwrap();
    let mut contacts = 0;
    for number in last - count..last {
        let (frame, next) = (stored.frame(number).unwrap(), stored.frame(number + 1).unwrap());
        let mut resumed = Simulation::from_frame(scene.clone(), settings, &frame).unwrap();
        assert!(bits(&resumed.advance().unwrap()) == bits(&next), "after frame {number}");
        contacts += next.report.counts.contacts;
    }
    assert!(contacts > 0, "nothing touches");
}

#[test]
fn in_the_own_shot() {
    let (path, files) = own_shot();
    let options = LoadOptions { shot: path, ..LoadOptions::default() };
    let shot = load(&options, &files).unwrap();
    assert_follows_from_stored_frames(shot, SizingMode::View, 8, 3);
}

#[test]
fn on_the_sphere() {
    let path: PathBuf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/arcsim/conf/sphere.json");
    if !path.is_file() {
        eprintln!("skipped: the reference scene {} is not there", path.display());
        return;
    }
    let options = LoadOptions { shot: path, ..LoadOptions::default() };
    let shot = load(&options, &FileSystem).unwrap();
    assert_follows_from_stored_frames(shot, SizingMode::Adaptive, 24, 8);
}
