//! A shot that takes no time: two by two quads of cloth, held at two corners, over a small solid.

use std::fs;
use std::path::{Path, PathBuf};

use shotsilk::run::RunReader;
use tempfile::TempDir;

use super::program::{self, Outcome};

pub const CLOTH: &str = "\
v 0.0 0.0 1
v 0.5 0.0 1
v 1.0 0.0 1
v 0.0 0.5 1
v 0.5 0.5 1
v 1.0 0.5 1
v 0.0 1.0 1
v 0.5 1.0 1
v 1.0 1.0 1
f 1 2 5
f 1 5 4
f 2 3 6
f 2 6 5
f 4 5 8
f 4 8 7
f 5 6 9
f 5 9 8
";

const SOLID: &str = "\
v 0.2 0.2 0.6
v 0.8 0.2 0.6
v 0.5 0.8 0.6
v 0.5 0.5 0.9
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
";

const COTTON: &str = r#"{
    "density": 0.15,
    "stretching": [[40, 4, 40, 20], [40, 4, 40, 20], [40, 4, 40, 20],
                   [40, 4, 40, 20], [40, 4, 40, 20], [40, 4, 40, 20]],
    "bending": [[2e-5, 2e-5, 2e-5, 2e-5, 2e-5], [2e-5, 2e-5, 2e-5, 2e-5, 2e-5],
                [2e-5, 2e-5, 2e-5, 2e-5, 2e-5]]
}"#;

const CAMERA: &str = r#"{
    "fps": 24, "resolution": [320, 180], "near": 0.1, "far": 50,
    "keys": [
        {"frame": 0, "eye": [0.5, -3, 1.5], "target": [0.5, 0.5, 0.7], "fov_y_deg": 40},
        {"frame": 4, "eye": [1.5, -3, 1.5], "target": [0.5, 0.5, 0.7], "fov_y_deg": 40}
    ]
}"#;

const SHOT: &str = r#"{
    "shotsilk": 1, // the version
    "fps": 24,
    "frames": 4,
    "camera": "main.camera.json",
    "fabrics": {"cotton": {"file": "cotton.json"}},
    "garments": [{
        "mesh": "cloth.obj", "fabric": "cotton",
        "sizing": {"edge_length_min": 0.1, "edge_length_max": 0.5}
    }],
    "motions": {"rise": {"keys": [
        {"time": 0}, {"time": 1, "transform": {"translate": [0, 0, 0.5]}}
    ]}},
    "obstacles": [{"mesh": "solid.obj", "motion": "rise"}],
    "handles": [{"nodes": [6, 8]}]
}"#;

/// A folder that holds the shot and goes with it.
pub struct SmallShot {
    folder: TempDir,
}

impl SmallShot {
    pub fn new() -> Self {
        let shot = Self { folder: tempfile::tempdir().expect("a temporary folder") };
        for (name, text) in [
            ("cloth.obj", CLOTH),
            ("solid.obj", SOLID),
            ("cotton.json", COTTON),
            ("main.camera.json", CAMERA),
            ("shot.json", SHOT),
        ] {
            shot.write(name, text);
        }
        shot
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the folder can be written");
    }

    pub fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("the file is there")
    }

    /// Writes a file anew with one thing in it replaced.
    #[track_caller]
    pub fn replace(&self, name: &str, from: &str, to: &str) {
        let text = self.text(name);
        assert!(text.contains(from), "{name} has no {from:?}");
        self.write(name, &text.replacen(from, to, 1));
    }

    /// Lets the camera turn so far by frame 4 that half of the cloth is out of sight.
    pub fn turn_the_camera(&self) {
        self.replace(
            "main.camera.json",
            "[1.5, -3, 1.5], \"target\": [0.5,",
            "[1.5, -3, 1.5], \"target\": [2.5,",
        );
    }

    /// Lets the solid's points move by themselves as well: it grows taller within half a second.
    pub fn deform_the_solid(&self) {
        self.write("tall.obj", &SOLID.replace("v 0.5 0.5 0.9", "v 0.6 0.4 1.3"));
        let meshes = "\"meshes\": [{\"time\": 0, \"mesh\": \"solid.obj\"},
            {\"time\": 0.5, \"mesh\": \"tall.obj\"}]";
        self.replace("shot.json", "\"mesh\": \"solid.obj\"", meshes);
    }

    pub fn run(&self, line: &str) -> Outcome {
        program::run(self.folder(), line)
    }

    pub fn reader(&self, run: &str) -> RunReader {
        RunReader::open(&self.path(run)).expect("the run can be read")
    }

    /// What is in a folder, in order.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).expect("the folder is there");
        let name = |entry: std::io::Result<fs::DirEntry>| {
            entry.expect("the folder can be listed").file_name().to_string_lossy().into_owned()
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort_unstable();
        names
    }

    /// Simulating the shot is refused as bad input, with these parts in the message, and nothing is
    /// left.
    #[track_caller]
    pub fn is_refused(&self, parts: &[&str]) {
        self.is_refused_with("", parts);
    }

    /// The same with further arguments.
    #[track_caller]
    pub fn is_refused_with(&self, arguments: &str, parts: &[&str]) {
        let before = self.names("");
        self.run(&format!("simulate shot.json --out run {arguments}")).fails(3, parts);
        assert_eq!(self.names(""), before, "something is left behind");
    }
}

/// The good shot with one thing in one of its files replaced is refused.
#[track_caller]
pub fn refused_after(name: &str, from: &str, to: &str, parts: &[&str]) {
    let shot = SmallShot::new();
    shot.replace(name, from, to);
    shot.is_refused(parts);
}
