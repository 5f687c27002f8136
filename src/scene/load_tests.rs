//! Whole shots, good and bad.

use std::path::Path;

use glam::DVec3;

use super::*;
use crate::mesh::NodeOrigin;
use crate::scene::{EmbeddedFiles, FileSystem, LoadedShot, ViewRule};
use crate::shot::{Lens, Track};

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

/// The shot with an obstacle that deforms.
fn deforming(obstacle: &str) -> Result<LoadedShot, LoadError> {
    let moved = BALL.replace("v 0 0 1", "v 0 0 3");
    let other = BALL.replace("f 2 3 4", "f 2 4 3");
    let rigid = r#"{"mesh": "meshes/ball.obj", "motion": "dance"}"#;
    assert!(SHOT.contains(rigid));
    let source = files()
        .with("w/a.json", SHOT.replacen(rigid, obstacle, 1).into_bytes())
        .with("w/body.0001.obj", BALL.as_bytes())
        .with("w/body.0002.obj", moved.into_bytes())
        .with("w/other.0002.obj", other.into_bytes())
        .with("w/other.0001.obj", BALL.as_bytes());
    load(&LoadOptions { shot: "w/a.json".into(), ..LoadOptions::default() }, &source)
}

#[test]
fn an_obstacle_that_deforms_is_a_list_of_meshes_or_numbered_files() {
    let cases = [
        r#"{"mesh_sequence": {"pattern": "body.%04d.obj", "fps": 4, "first": 1}}"#,
        r#"{"meshes": [{"time": 0, "mesh": "body.0001.obj"},
                       {"time": 0.25, "mesh": "body.0002.obj"}]}"#,
    ];
    for case in cases {
        let scene = deforming(case).unwrap().scene;
        let obstacle = &scene.obstacles[0];
        assert_eq!(obstacle.name, "body.0001");
        let points = scene.moved_points(0.125);
        assert_eq!(points[&0][3], DVec3::Z * 2.0);
        assert_eq!(obstacle.surface.positions[3], DVec3::Z);
    }
}

#[test]
fn a_deforming_obstacle_that_makes_no_sense_is_refused() {
    let message = |obstacle: &str| deforming(obstacle).expect_err("it is bad").to_string();
    let sequence = |rest: &str| message(&format!("{{\"mesh_sequence\": {{{rest}}}}}"));
    let other = sequence(r#""pattern": "other.%04d.obj", "fps": 4, "first": 1"#);
    assert!(other.contains("w/other.0002.obj: ") && other.contains("same triangles"), "{other}");
    let none = sequence(r#""pattern": "body.%04d.obj", "fps": 4, "first": 7"#);
    assert!(none.contains("a file with the first number"), "{none}");
    let missing = sequence(r#""pattern": "body.%04d.obj", "fps": 4, "first": 1, "last": 3"#);
    assert!(missing.contains("body.0003.obj"), "{missing}");
    for (first, last, limit) in
        [(1, 0, "from 1 (first) to 100000"), (2, 100_002, "from 2 (first) to 100001")]
    {
        let rest = format!(
            "\"pattern\": \"body.%04d.obj\", \"fps\": 4, \"first\": {first}, \"last\": {last}"
        );
        let message = sequence(&rest);
        let named = format!("mesh_sequence.last is {last}, but must be {limit}");
        assert!(message.contains(&named), "{message}");
    }
    let wide = sequence(r#""pattern": "body.%99999d.obj", "fps": 4, "first": 1"#);
    assert!(wide.contains("one %d"), "{wide}");
    let still = sequence(r#""pattern": "body.%04d.obj", "fps": 0"#);
    assert!(still.contains("fps"), "{still}");
    let both = message(r#"{"mesh": "meshes/ball.obj", "meshes": []}"#);
    assert!(both.contains("exclude each other"), "{both}");
    assert!(message("{}").contains("a mesh, meshes or a mesh_sequence"));
    assert!(message(r#"{"meshes": []}"#).contains("at least one mesh"));
    let order = message(
        r#"{"meshes": [{"time": 1, "mesh": "body.0001.obj"}, {"time": 1, "mesh": "body.0002.obj"}]}"#,
    );
    assert!(order.contains("does not come after"), "{order}");
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
        ("fps=fast", "--set fps=fast: invalid type: string \"fast\", expected a number"),
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
        ("\"nu_out\": 0.05", "\"nu_uot\": 0", "w/a.json:3:14: unknown field `nu_uot`"),
        ("\"shotsilk\": 1", "\"shotsilk\": 7", "w/a.json:2:17: the shot file has version 7"),
        ("\"view\": {", "\"fps\": -1, \"view\": {", "w/a.json:3:12: fps is -1, but must be"),
        ("\"view\": {", "\"steps_per_frame\": 0, \"view\": {", "steps_per_frame is 0, but"),
        ("\"view\": {", "\"contact\": {\"friction_cloth\": -1}, \"view\": {", "is -1, but must"),
        ("\"view\": {", "\"instances\": [], \"view\": {", "\"instances\" is not supported yet"),
        ("\"view\": {", "\"disable\": [\"fun\"], \"view\": {", "unknown variant `fun`"),
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

/// The message for a camera with one thing replaced, given on the command line.
fn camera_message(from: &str, to: &str) -> String {
    assert!(CAMERA.contains(from), "{from}");
    let source = files()
        .with("w/a.json", SHOT.as_bytes())
        .with("other.json", CAMERA.replace(from, to).into_bytes());
    let camera = Some("other.json".into());
    let options = LoadOptions { shot: "w/a.json".into(), camera, ..LoadOptions::default() };
    load(&options, &source).expect_err("the camera is bad").to_string()
}

#[test]
fn bad_cameras_are_answered_with_the_place() {
    for (from, to, expected) in [
        ("\"frame\": 9", "\"frame\": 0", "other.json:5:19: keys.1.frame is 0, but must be greater"),
        ("640", "0", "resolution.0 is 0, but must be at least 1"),
        ("[0, -4, 0]", "[0, 0, 0]", "keys.0.target: eye and target are the same point"),
        ("\"frame\": 9", "\"up\": [0, 1, 0], \"frame\": 9", "keys.1.up: up is parallel"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 180", "keys.0.fov_y_deg is 180, but must be"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 0", "keys.0.fov_y_deg is 0, but must be"),
        ("\"fov_y_deg\": 40", "\"focal_mm\": 35", "keys.0 needs aperture_mm with focal_mm"),
        ("\"fov_y_deg\": 40", "\"aperture_mm\": [3, 2]", "keys.0 needs fov_y_deg or focal_mm"),
        ("\"near\": 0.1", "\"near\": 0", "near is 0, but must be greater than 0"),
        ("\"near\": 0.1", "\"near\": 50", "far is 50, but must be greater than 50"),
        ("\"fps\": 24", "\"fps\": 25", "other.json:2:12: the camera path has 25 frames a second"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 40, \"cut\": true", "the first key is no cut"),
        ("\"far\": 50", "\"far\": 50, \"zoom\": 1", "unknown field `zoom`"),
        ("\"far\": 50", "\"far\": 50, \"matrices\": []", "has both keys and matrices"),
    ] {
        let error = camera_message(from, to);
        assert!(error.contains(expected), "{to}: {error}");
    }
}

#[test]
fn the_frame_rate_of_the_command_line_ends_the_dispute() {
    let shot = SHOT.replacen("\"view\": {", "\"fps\": 30, \"view\": {", 1);
    let source = files().with("w/a.json", shot.into_bytes());
    let mut options = LoadOptions { shot: "w/a.json".into(), ..LoadOptions::default() };
    assert!(load(&options, &source).is_err());
    options.fps = Some(24.0);
    assert_eq!(load(&options, &source).unwrap().scene.fps, 24.0);
}

#[test]
fn baked_cameras_must_be_rigid_and_keep_their_cuts() {
    let baked = |second: &str| {
        format!(
            r#"{{"shotsilk": 1, {ONE_GARMENT}, "viewers": [{{"resolution": [10, 10], "focal_mm": 35,
            "aperture_mm": [36, 24], "matrices": [
            {{"world_from_camera": [1,0,0,5, 0,0,-1,6, 0,1,0,7, 0,0,0,1]}},
            {{"frame": 1, "matrix": {second}, "fov_y_deg": 30, "cut": true}}]}}]}}"#
        )
    };
    let rows = "[[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]";
    let viewers = load_text(&baked(rows), &[]).unwrap().scene.viewers;
    let Track::Matrices { samples, cuts } = &viewers[0].track else { panic!("{viewers:?}") };
    assert_eq!(cuts, &[1]);
    assert_eq!(samples[0].0.transform_point3(DVec3::Y), DVec3::new(5.0, 6.0, 8.0));
    assert!(matches!(samples[0].1, Lens::FilmBack { focal_mm: 35.0, .. }));
    assert!(matches!(samples[1].1, Lens::FieldOfView { .. }));
    let mirrored = message(&baked("[[-1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]"), &[]);
    assert!(mirrored.contains("matrices.1: the matrix is no rotation"), "{mirrored}");
}

#[test]
fn a_scene_keeps_its_own_defaults_and_reports_what_it_leaves_out() {
    let options = LoadOptions { shot: "w/conf/scene.json".into(), ..LoadOptions::default() };
    let loaded = load(&options, &files()).unwrap();
    let scene = loaded.scene;
    assert_eq!((scene.fps, scene.steps_per_frame, scene.last_frame), (25.0, 8, Some(50)));
    assert_eq!((scene.handle_stiffness, scene.contact.thickness), (1e3, 1e-3));
    assert_eq!((scene.gravity, scene.air.density), (DVec3::ZERO, 1.0));
    assert_eq!(scene.garments[0].sizing.refine_velocity, f64::INFINITY);
    assert_eq!(scene.obstacles.len(), 2);
    assert!(!scene.stages.untangling && scene.stages.collision);
    let text = loaded.warnings.join("\n");
    for part in ["\"yield_curv\" is not supported", "\"popfilter\"", "\"edge_flip_threshold\""] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    assert_eq!(loaded.warnings.len(), 3);
}

#[test]
fn a_wrapper_and_overrides_change_an_imported_scene_by_native_names() {
    let wrapper = r#"{"shotsilk": 1, "import": "conf/scene.json", "handle_stiffness": 5,
        "garments": [{"view": {"nu_back": 0.7}}], "camera": "main.camera.json", "fps": 24}"#;
    let sets = ["garments.0.sizing.refine_velocity=2", "garments.0.two_sided=false"];
    let scene = load_text(wrapper, &sets).unwrap().scene;
    let garment = &scene.garments[0];
    assert_eq!((scene.handle_stiffness, scene.fps, scene.viewers.len()), (5.0, 24.0, 1));
    assert_eq!((garment.view.nu_back, garment.sizing.refine_velocity), (0.7, 2.0));
    assert!(!garment.two_sided);
    let error = message(&wrapper.replace("\"nu_back\": 0.7", "\"nu_back\": 7"), &[]);
    assert!(error.starts_with("w/a.json:2:43: garments.0.view.nu_back is 7"), "{error}");
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

/// The reference scenes, if they are there.
fn reference(scene: &str, camera: Option<&str>) -> Option<LoadedShot> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let shot = data.join("arcsim/conf").join(scene);
    if !shot.is_file() {
        eprintln!("skipped: {} is not there", shot.display());
        return None;
    }
    let camera = camera.map(|name| data.join("cameras").join(name));
    let options = LoadOptions { shot, camera, ..LoadOptions::default() };
    Some(load(&options, &FileSystem).unwrap())
}

#[test]
fn the_reference_dress_loads_with_body_and_camera() {
    let Some(loaded) = reference("dress-blue.json", Some("solo-dancer.camera.json")) else {
        return;
    };
    let scene = loaded.scene;
    let garment = &scene.garments[0];
    assert_eq!(garment.mesh.check(), Ok(()));
    let mesh = &garment.mesh;
    assert_eq!((mesh.node_count(), mesh.vertex_count(), mesh.face_count()), (78, 104, 112));
    assert!(!garment.two_sided);
    assert_eq!((scene.motions.len(), scene.obstacles.len()), (16, 16));
    let triangles: usize = scene.obstacles.iter().map(|o| o.surface.triangles.len()).sum();
    assert!((26_000..=26_842).contains(&triangles), "{triangles}");
    assert_eq!((scene.fps, scene.last_frame), (25.0, Some(500)));
    assert_eq!(scene.contact.thickness, 5e-3);
    assert_eq!(scene.obstacles[11].motion.map(|m| scene.motions[m].keys().len()), Some(716));
    // The body stands where the dress is: between head and floor of the dance.
    let pose = scene.obstacle_pose(&scene.obstacles[0], 0.0);
    assert!(pose.translation.length() < 2.0, "{pose:?}");
    assert_eq!(loaded.warnings, Vec::<String>::new());
}

#[test]
fn the_reference_sheets_load_as_two_sided_garments() {
    for (scene, camera, handles) in [
        ("flag.json", Some("flag.camera.json"), 1),
        ("sphere.json", Some("sphere.camera.json"), 1),
        ("sphere-annotated.json", None, 1),
        ("square.json", None, 2),
    ] {
        let Some(loaded) = reference(scene, camera) else { return };
        let garment = &loaded.scene.garments[0];
        assert_eq!(garment.mesh.check(), Ok(()));
        assert!(garment.two_sided, "{scene}");
        assert_eq!(loaded.scene.handles.len(), handles);
        let node = loaded.scene.handles[0].nodes[0];
        let kept = NodeOrigin::Kept { index: node };
        assert!(garment.mesh.node_ids().any(|n| garment.mesh.node_origin(n) == kept));
        let expected = usize::from(scene == "flag.json");
        assert_eq!(loaded.warnings.len(), expected, "{:?}", loaded.warnings);
    }
}

#[test]
fn the_square_has_no_velocity_criterion_and_stops_at_its_keys() {
    let Some(loaded) = reference("square.json", None) else { return };
    let scene = loaded.scene;
    assert_eq!(scene.garments[0].sizing.refine_velocity, f64::INFINITY);
    assert!(!scene.stages.strain_limiting);
    let motion = &scene.motions[scene.handles[0].motion.unwrap()];
    assert_eq!(motion.pose(6.5).translation, DVec3::new(0.45, 0.0, 0.0));
}

#[test]
fn the_example_of_the_manual_is_a_shot_file() {
    let manual = include_str!("../../docs/shot-file.md");
    let example = manual.split("```").nth(1).unwrap().strip_prefix("jsonc").unwrap();
    let file: ShotFile = Node::parse("shot-file.md", example).unwrap().deserialize().unwrap();
    assert_eq!((file.shotsilk, file.garments.len(), file.handles.len()), (SHOT_VERSION, 1, 1));
}
