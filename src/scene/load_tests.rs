//! Whole shots, good and bad.

#[path = "load_tests/cameras.rs"]
mod cameras;
#[path = "load_tests/deforming.rs"]
mod deforming;
#[path = "load_tests/imported.rs"]
mod imported;

use glam::DVec3;

use super::*;
use crate::scene::{EmbeddedFiles, LoadedShot, ViewRule};

const SHEET: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 1 3 4\n";
const BALL: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const COTTON: &str = r#"{ // a material
    "density": 0.1,
    "stretching": [[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4]],
    "bending": [[1,1,1,1,1],[2,2,2,2,2],[3,3,3,3,3]]
}"#;
const CAMERA: &str = r#"{
    "fps": 24, "resolution": [640, 360], "near": 0.1, "far": 50,
    "keys": [
        {"frame": 0, "eye": [0, -4, 0], "target": [0, 0, 0], "fov_y_deg": 40},
        {"frame": 9, "eye": [0, -3, 0], "target": [0, 0, 0], "fov_y_deg": 30, "cut": true}
    ]
}"#;
const SHOT: &str = r#"{
    "shotsilk": 1, // the version
    "view": {"nu_out": 0.05},
    "camera": "main.camera.json",
    "fabrics": {"cotton": {"file": "cotton.json", "thicken": 2, "bending_mult": 3}},
    "garments": [{
        "mesh": "meshes/sheet.obj", "fabric": "cotton",
        "sizing": {"refine_velocity": null, "edge_length_max": 0.5},
        "view": {"nu_back": 0.5}
    }],
    "motions": {
        "lift": {"keys": [
            {"time": 0}, {"time": 2, "transform": {"translate": [0, 0, 1]}}
        ]},
        "dance": {"file": "a.mot", "fps": 2, "transform": {"translate": [5, 0, 0]}}
    },
    "obstacles": [{"mesh": "meshes/ball.obj", "motion": "dance"}],
    "handles": [{"nodes": [2, 3], "motion": "lift", "end_time": 1.5}]
}"#;
const ONE_GARMENT: &str = r#""fabrics": {"cotton": {"file": "cotton.json"}},
    "garments": [{"mesh": "meshes/sheet.obj", "fabric": "cotton"}]"#;
const MOTION: &str = "NumFrames: 2\nbody[0] position\n0 0 0\n1 0 0\n\nbody[0] orientation\n\
    1 0 0 0\n1 0 0 0\n\n";
const SCENE: &str = r#"{
    "timestep": 0.005, "save_frames": 8, "end_time": 2, "end_frame": 60,
    "cloths": [{
        "mesh": "meshes/sheet.obj",
        "materials": [{"data": "cotton.json", "yield_curv": 3}],
        "remeshing": {"refine_angle": 0.3, "size": [0.01, 0.2], "aspect_min": 0.2}
    }],
    "obstacles": "meshes/part%02d.obj",
    "handles": [{"vertices": [0]}],
    "disable": ["separation", "popfilter"],
    "magic": {"edge_flip_threshold": 1}
}"#;

fn files() -> EmbeddedFiles {
    EmbeddedFiles::default()
        .with("w/meshes/sheet.obj", SHEET.as_bytes())
        .with("w/meshes/ball.obj", BALL.as_bytes())
        .with("w/meshes/part00.obj", BALL.as_bytes())
        .with("w/meshes/part01.obj", BALL.as_bytes())
        .with("w/cotton.json", COTTON.as_bytes())
        .with("w/main.camera.json", CAMERA.as_bytes())
        .with("w/a.mot", MOTION.as_bytes())
        .with("w/conf/scene.json", SCENE.as_bytes())
}

fn load_text(shot: &str, sets: &[&str]) -> Result<LoadedShot, LoadError> {
    let source = files().with("w/a.json", shot.as_bytes().to_vec());
    let sets = sets.iter().map(|&s| s.to_owned()).collect();
    load(&LoadOptions { shot: "w/a.json".into(), sets, ..LoadOptions::default() }, &source)
}

fn message(shot: &str, sets: &[&str]) -> String {
    load_text(shot, sets).expect_err("the shot is bad").to_string()
}

/// The message for the good shot with one thing replaced.
fn message_after(from: &str, to: &str) -> String {
    assert!(SHOT.contains(from), "{from}");
    message(&SHOT.replacen(from, to, 1), &[])
}

#[test]
fn a_native_shot_resolves_to_a_scene_with_defaults() {
    let loaded = load_text(SHOT, &[]).unwrap();
    let scene = &loaded.scene;
    assert_eq!((scene.fps, scene.steps_per_frame, scene.last_frame), (24.0, 8, None));
    assert_eq!((scene.handle_stiffness, scene.air.density), (1e6, 1.0));
    assert_eq!(scene.gravity, DVec3::new(0.0, 0.0, -9.81));
    let garment = &scene.garments[0];
    assert_eq!(garment.name, "sheet");
    assert!(garment.two_sided);
    assert_eq!((garment.view.nu_out, garment.view.nu_back), (0.05, 0.5));
    assert_eq!(garment.sizing.refine_velocity, f64::INFINITY);
    assert_eq!((garment.sizing.edge_length_min, garment.sizing.edge_length_max), (0.01, 0.5));
    assert_eq!(garment.fabric.density(), 0.2);
    assert_eq!(garment.fabric.hinge_stiffness(0.0, 0.0), 6.0);
    let handle = &scene.handles[0];
    assert_eq!((handle.nodes.as_slice(), handle.end_time), ([2, 3].as_slice(), 1.5));
    let lifted = scene.motions[handle.motion.unwrap()].pose(1.0).translation;
    assert!(lifted.distance(DVec3::new(0.0, 0.0, 0.5)) < 1e-12);
    let danced = scene.obstacle_pose(&scene.obstacles[0], 3.0).translation;
    assert_eq!(danced, DVec3::new(6.0, 0.0, 0.0));
    assert_eq!(loaded.warnings, Vec::<String>::new());
}

#[test]
fn every_file_is_recorded_once_with_its_hash() {
    let loaded = load_text(SHOT, &[]).unwrap();
    let mut paths: Vec<_> = loaded.files_read.iter().map(|f| f.path.to_str().unwrap()).collect();
    paths.sort_unstable();
    let expected = [
        "w/a.json",
        "w/a.mot",
        "w/cotton.json",
        "w/main.camera.json",
        "w/meshes/ball.obj",
        "w/meshes/sheet.obj",
    ];
    assert_eq!(paths, expected);
    assert!(loaded.files_read.iter().all(|f| f.sha256.len() == 64));
}

#[test]
fn the_record_is_a_shot_of_its_own_and_means_the_same() {
    let loaded = load_text(SHOT, &["garments.0.two_sided=false"]).unwrap();
    let mut record = loaded.resolved;
    assert_eq!(record["name"], "a");
    record.as_object_mut().unwrap().remove("name");
    let again = load_text(&record.to_string(), &[]).unwrap();
    assert_eq!(again.scene.garments[0].fabric, loaded.scene.garments[0].fabric);
    assert_eq!(again.scene.garments[0].sizing, loaded.scene.garments[0].sizing);
    assert_eq!(again.scene.garments[0].view, loaded.scene.garments[0].view);
    assert!(!again.scene.garments[0].two_sided);
    assert_eq!(again.scene.viewers[0].track, loaded.scene.viewers[0].track);
}

#[test]
fn what_is_written_keeps_factors_and_leaves_defaults_out() {
    let written = load_text(SHOT, &["view.nu_back=0.3"]).unwrap().written;
    assert_eq!(written["view"], serde_json::json!({"nu_out": 0.05, "nu_back": 0.3}));
    assert_eq!(written["fabrics"]["cotton"]["thicken"], 2);
    assert_eq!(written["camera"], "main.camera.json");
    assert_eq!(written.get("air"), None);
    let wrapper = r#"{"shotsilk": 1, "import": "conf/scene.json", "fps": 24}"#;
    let written = load_text(wrapper, &[]).unwrap().written;
    assert_eq!(
        (&written["fps"], &written["garments"][0]["fabric"]),
        (&24.into(), &"cloth0".into())
    );
}

#[test]
fn overrides_replace_and_add_settings() {
    let sets = [
        "view.nu_out=0.1",
        "view.rule=papers",
        "steps_per_frame=4",
        "garments.0.sizing.edge_length_min=0.02",
        "garments.0.name=cape",
        "air.velocity=[1, 2, 3]",
        "camera.resolution=[10, 10]",
    ];
    let scene = load_text(SHOT, &sets[..6]).unwrap().scene;
    let garment = &scene.garments[0];
    assert_eq!((garment.view.nu_out, garment.view.rule), (0.1, ViewRule::Papers));
    assert_eq!((scene.steps_per_frame, garment.sizing.edge_length_min), (4, 0.02));
    assert_eq!((garment.name.as_str(), scene.air.velocity), ("cape", DVec3::new(1., 2., 3.)));
    let error = message(SHOT, &sets[6..]);
    assert!(error.contains("\"camera\" is a string, which has no settings inside"), "{error}");
}

#[test]
fn unknown_overrides_are_answered_with_the_nearest_name() {
    for (set, expected) in [
        ("view.nu_ou=1", "did you mean \"view.nu_out\"?"),
        ("nu_out=1", "did you mean \"view.nu_out\"?"),
        ("edge_length_min=1", "did you mean \"garments.0.sizing.edge_length_min\"?"),
        ("fps.x=1", "there is no setting \"fps.x\""),
        ("garments.3.two_sided=true", "is 3, but must be less than 1"),
        ("fps", "is no override: write path.to.field=value"),
        ("gravity=[0, 0", "--set gravity=[0, 0: Unterminated array"),
        ("gravity=[0, 0, 1e999]", "--set gravity=[0, 0, 1e999]: "),
        ("garments=[]", "--set garments=[]: the shot needs at least one garment"),
        ("fps=fast", "--set fps=fast: expected a number, found \"fast\""),
        ("view.nu_out=2", "--set view.nu_out=2: view.nu_out is 2, but must be greater than 0"),
        ("takes=[]", "\"takes\" is not supported yet"),
    ] {
        let error = message(SHOT, &[set]);
        assert!(error.contains(expected), "{set}: {error}");
    }
}

#[test]
fn bad_shots_are_answered_with_place_value_and_limit() {
    for (from, to, expected) in [
        ("\"nu_out\": 0.05", "\"nu_out\": 0", "w/a.json:3:24: view.nu_out is 0, but must be"),
        ("\"nu_out\": 0.05", "\"nu_uot\": 0", "w/a.json:3:14: unknown key \"nu_uot\""),
        ("\"shotsilk\": 1", "\"shotsilk\": 7", "w/a.json:2:17: the shot file has version 7"),
        ("\"view\": {", "\"fps\": -1, \"view\": {", "w/a.json:3:12: fps is -1, but must be"),
        ("\"view\": {", "\"steps_per_frame\": 0, \"view\": {", "steps_per_frame is 0, but"),
        ("\"view\": {", "\"contact\": {\"friction_cloth\": -1}, \"view\": {", "is -1, but must"),
        ("\"view\": {", "\"instances\": [], \"view\": {", "\"instances\" is not supported yet"),
        ("\"view\": {", "\"disable\": [\"fun\"], \"view\": {", "unknown value \"fun\""),
        ("\"edge_length_max\": 0.5", "\"edge_length_min\": 0.5", "is 0.5, but must be at most 0.2"),
        ("\"edge_length_max\": 0.5", "\"edge_length_max\": -1", "is -1, but must be greater"),
        ("\"fabric\": \"cotton\"", "\"fabric\": \"coton\"", "no fabric \"coton\": did you mean"),
        (
            "\"motion\": \"lift\"",
            "\"motion\": \"lif\"",
            "no motion \"lif\": did you mean \"lift\"?",
        ),
        ("[2, 3]", "[2, 5]", "w/a.json:18:31: handles.0.nodes.1 is 5, but must be less than 5"),
        ("[2, 3]", "[2, 4]", "handles.0.nodes.1 is 4, but must be a node of at least one face"),
        ("[2, 3]", "[]", "handles.0.nodes is empty"),
        ("\"end_time\": 1.5", "\"end_time\": 0", "end_time is 0, but must be greater than 0"),
        ("\"end_time\": 1.5", "\"garment\": 2", "garment is 2, but must be less than 1"),
        ("\"time\": 2", "\"time\": 0", "w/a.json:13:26: motion \"lift\": key 1 at 0 s"),
        ("\"fps\": 2", "\"body\": 1", "body is 1, but must be less than 1"),
        ("\"thicken\": 2", "\"thicken\": 0", "fabrics.cotton.thicken is 0"),
        ("\"thicken\": 2", "\"density\": 1", "fabrics.cotton has both file and density"),
        ("\"thicken\": 2", "\"strain_limits\": [1.1, 1.2]", "strain_limits.0 is 1.1"),
        ("meshes/sheet.obj", "meshes/no.obj", "w/a.json:7:17: cannot read \"w/meshes/no.obj\""),
        ("\"main.camera.json\"", "\"no.json\"", "w/a.json:4:15: cannot read \"w/no.json\""),
        ("[0, 0, 1]", "[0, 0, 1e400]", "out of range"),
    ] {
        let error = message_after(from, to);
        assert!(error.contains(expected), "{to}: {error}");
    }
}

#[test]
fn a_bad_mesh_is_named_with_its_line() {
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n";
    let source =
        files().with("w/a.json", SHOT.as_bytes()).with("w/meshes/sheet.obj", sheet.as_bytes());
    let options = LoadOptions { shot: "w/a.json".into(), ..LoadOptions::default() };
    let error = load(&options, &source).unwrap_err().to_string();
    assert!(
        error.starts_with("w/meshes/sheet.obj:6: garment \"sheet\": face 1 is clockwise"),
        "{error}"
    );
}

#[test]
fn what_is_neither_shot_nor_scene_is_refused() {
    let neither = "w/a.json: this is neither a shot";
    assert!(message("{\"a\": 1}", &[]).starts_with(neither));
    assert!(message("[1]", &[]).starts_with(neither));
    assert!(message("{", &[]).starts_with("w/a.json:1:1: "));
    let scene_error = message(&SCENE.replace("[0.01, 0.2]", "[0.01]"), &[]);
    assert!(scene_error.contains("a.json:6:52: size must be a list"), "{scene_error}");
    let bad = message(&SCENE.replace("\"vertices\": [0]", "\"vertices\": [7]"), &[]);
    assert!(bad.contains("w/a.json:9:31: handles.0.nodes.0 is 7"), "{bad}");
}

#[test]
fn the_example_of_the_manual_is_a_shot_file() {
    let manual = include_str!("../../docs/shot-file.md");
    let example = manual.split("```").nth(1).unwrap().strip_prefix("jsonc").unwrap();
    let file: ShotFile = Node::parse("shot-file.md", example).unwrap().deserialize().unwrap();
    assert_eq!((file.shotsilk, file.garments.len(), file.handles.len()), (SHOT_VERSION, 1, 1));
}
