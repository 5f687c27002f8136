//! A small sheet that hangs from two corners, and a previewer that is waited for.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::json;
use tempfile::TempDir;

use super::super::*;
use crate::preview::{FrameStatus, Level};
use crate::request::{FrameRange, Request};
use crate::run::RunWriter;
use crate::sim::{Frame, Simulation, SizingMode};

pub const LAST: u32 = 12;
pub const PATIENCE: Duration = Duration::from_secs(120);

/// A shot of a sheet under a camera with keys at 0, 4 (a cut), 8 and 12, and a folder for it.
pub struct Stage {
    pub folder: TempDir,
}

impl Stage {
    pub fn set() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("sheet.obj"), sheet()).unwrap();
        fs::write(folder.path().join("shot.json"), SHOT).unwrap();
        Self { folder }
    }

    pub fn shot(&self) -> PathBuf {
        self.folder.path().join("shot.json")
    }

    /// With the shot open and nothing simulated.
    pub fn opened(&self) -> Driven {
        let mut p = self.start(false);
        p.until_opened();
        p
    }

    pub fn request(&self) -> Request {
        Request {
            shot: Some(self.shot()),
            text: None,
            camera: None,
            sets: Vec::new(),
            fps: None,
            frames: Some(FrameRange { first: 0, last: LAST }),
            sizing: SizingMode::View,
        }
    }

    /// A run folder with the shot's first four frames.
    pub fn finished_run(&self) -> PathBuf {
        let requested = self.request().load().unwrap();
        let folder = self.folder.path().join("run");
        let surfaces = requested.surfaces();
        let mut writer =
            RunWriter::create(&folder, &requested.info, &surfaces, Default::default()).unwrap();
        let (mut simulation, frame) =
            Simulation::start(requested.scene.clone(), requested.settings).unwrap();
        writer.write(&frame).unwrap();
        (0..3).for_each(|_| writer.write(&simulation.advance().unwrap()).unwrap());
        writer.finish().unwrap();
        folder
    }

    pub fn start(&self, simulating: bool) -> Driven {
        self.open(Source::Shot(self.request()), simulating)
    }

    pub fn open(&self, source: Source, simulating: bool) -> Driven {
        self.open_with(source, simulating, Some(self.folder.path().join("cache")), 64 << 20)
    }

    pub fn open_with(
        &self,
        source: Source,
        simulating: bool,
        cache: Option<PathBuf>,
        memory: u64,
    ) -> Driven {
        let previewer = Previewer::start(Start {
            source,
            look: Look::default(),
            cache,
            memory,
            simulating,
            wake: Arc::new(|| {}),
        });
        Driven(previewer)
    }
}

pub const SHOT: &str = r#"{
    "shotsilk": 1,
    // As short as can be.
    "fps": 24, "steps_per_frame": 2,
    "view": {"anticipation_frames": 2, "nu_out": 0.2, "margin_m": 0.1},
    "fabrics": {"cloth": {"preset": "cotton"}},
    "garments": [{
        "mesh": "sheet.obj", "fabric": "cloth",
        "sizing": {"edge_length_min": 0.05, "edge_length_max": 0.3}
    }],
    "handles": [{"nodes": [0, 4]}],
    "camera": {
        "resolution": [320, 180], "fov_y_deg": 20,
        "keys": [
            {"frame": 0, "eye": [0, -3, 0.2], "target": [0, 0, 0.2]},
            {"frame": 4, "eye": [0, -3, 0.2], "target": [0.6, 0, 0.2], "cut": true},
            {"frame": 8, "eye": [0.5, -3, 0.2], "target": [0.3, 0, 0.2]},
            {"frame": 12, "eye": [0, -3, 0.2], "target": [0, 0, 0.2]}
        ]
    }
}
"#;

/// 5 x 5 nodes, 0.8 m wide.
pub fn sheet() -> String {
    let mut obj = String::new();
    let at = |k: u32| 0.2 * f64::from(k) - 0.4;
    for (j, i) in (0..5).flat_map(|j| (0..5).map(move |i| (j, i))) {
        writeln!(obj, "v {} {} {}\nvt {} {}", at(i), 0.02 * at(j), -at(j), at(i), -at(j)).unwrap();
    }
    for (j, i) in (0..4).flat_map(|j| (0..4).map(move |i| (j, i))) {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| 5 * j + i + 1);
        writeln!(obj, "f {a}/{a} {c}/{c} {d}/{d}\nf {a}/{a} {d}/{d} {b}/{b}").unwrap();
    }
    obj
}

/// A previewer and the patience to wait for it.
pub struct Driven(pub Previewer);

impl Driven {
    pub fn until(&mut self, what: &str, is_so: impl Fn(&Previewer) -> bool) {
        let began = Instant::now();
        while !is_so(&self.0) {
            self.0.receive();
            let errors = self.0.state.messages.iter().filter(|m| m.level == Level::Error);
            assert_eq!(errors.count(), 0, "{:?}", self.0.state.messages);
            assert!(began.elapsed() < PATIENCE, "{what} has not come about");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// As [`Self::until`], whatever is said meanwhile.
    pub fn wait_for(&mut self, is_so: impl Fn(&Previewer) -> bool) {
        let began = Instant::now();
        while !is_so(&self.0) {
            self.0.receive();
            assert!(began.elapsed() < PATIENCE, "{:?}", self.0.state.messages);
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    pub fn until_opened(&mut self) {
        self.until("opening", |p| !p.is_opening());
    }

    /// An answer that may be an error.
    pub fn until_refused(&mut self) {
        let began = Instant::now();
        while self.0.is_opening() {
            self.0.receive();
            assert!(began.elapsed() < PATIENCE, "there is no answer");
        }
    }

    pub fn until_done(&mut self) {
        self.until("the last frame", |p| {
            let is_there = |frame| {
                matches!(p.timeline().status(frame), FrameStatus::Ready | FrameStatus::Mixed)
            };
            !p.is_opening() && p.timeline().len() > 1 && (1..=p.timeline().last()).all(is_there)
        });
    }

    pub fn act(&mut self, action: Action) {
        self.0.act(action);
    }

    pub fn statuses(&self) -> String {
        let letter = |frame| match self.0.timeline().status(frame) {
            FrameStatus::Ready => 'r',
            FrameStatus::Mixed => 'm',
            FrameStatus::Stale => 's',
            FrameStatus::Missing => '.',
        };
        (0..self.0.timeline().len() as u32).map(letter).collect()
    }

    pub fn frame(&mut self, number: u32) -> Arc<Frame> {
        self.act(Action::GoTo { frame: number });
        self.until("the frame", |p| p.shown().is_some_and(|shown| shown.number == number));
        self.0.shown().unwrap().frame.clone()
    }
}

/// Positions and velocities, bit by bit.
pub fn bits(frame: &Frame) -> Vec<u64> {
    let of = |mesh: &Arc<crate::mesh::Mesh>| {
        let both = mesh.position.iter().chain(mesh.velocity.iter());
        both.flat_map(|v| v.to_array()).map(f64::to_bits).collect::<Vec<_>>()
    };
    frame.garments.iter().flat_map(of).collect()
}

/// The last frame of a plan, simulated without a previewer.
pub fn straight(plan: &Plan) -> Frame {
    let scene = plan.requested.scene.clone();
    let (mut simulation, mut frame) = Simulation::start(scene, plan.settings()).unwrap();
    for _ in 0..plan.last() {
        frame = simulation.advance().unwrap();
    }
    frame
}

pub fn windy(x: f64) -> Action {
    Action::Set { path: "air.velocity".into(), value: json!([x, 2.0, 0.0]) }
}
