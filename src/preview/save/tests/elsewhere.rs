//! Shots around scenes, and shots that move to another folder.

use std::path::Path;

use serde_json::json;

use super::{between, edits, remarks};
use crate::preview::save::*;
use crate::preview::{Edits, parameters};
use crate::scene::{EmbeddedFiles, LoadOptions, LoadedShot, load};

const SHEET: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
const BALL: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const COTTON: &str = r#"{
    "density": 0.1,
    "stretching": [[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4],[1,2,3,4]],
    "bending": [[1,1,1,1,1],[2,2,2,2,2],[3,3,3,3,3]]
}"#;
const SCENE: &str = r#"{
    "frame_time": 0.04, "wind": {"density": 2, "velocity": [1, 0, 0]},
    "cloths": [
        {"mesh": "meshes/sheet.obj", "materials": [{"data": "cotton.json", "thicken": 2}],
         "remeshing": {"refine_angle": 0.3, "size": [0.01, 0.2]}},
        {"mesh": "meshes/sheet.obj", "materials": [{"data": "cotton.json"}],
         "remeshing": {"refine_angle": 0.3, "size": [0.01, 0.2]}}
    ],
    "motions": [[{"time": 0}, {"time": 1}]],
    "obstacles": [{"mesh": "meshes/ball.obj", "motion": 0}]
}"#;
const CAMERA: &str = r#"{"resolution": [64, 36], "fov_y_deg": 40,
    "keys": [{"frame": 0, "eye": [0, -4, 0], "target": [0, 0, 0]}]}"#;
const MOTION: &str = "NumFrames: 2\nbody[0] position\n0 0 0\n1 0 0\n\nbody[0] orientation\n\
    1 0 0 0\n1 0 0 0\n\n";

fn files() -> EmbeddedFiles {
    EmbeddedFiles::default()
        .with("/w/meshes/sheet.obj", SHEET.as_bytes())
        .with("/w/meshes/ball.obj", BALL.as_bytes())
        .with("/w/meshes/body.0001.obj", BALL.as_bytes())
        .with("/w/cotton.json", COTTON.as_bytes())
        .with("/w/shots/main.camera.json", CAMERA.as_bytes())
        .with("/w/a.mot", MOTION.as_bytes())
        .with("/w/conf/scene.json", SCENE.as_bytes())
}

fn loaded(path: &str, text: Option<&str>, edits: &Edits) -> LoadedShot {
    let mut files = files();
    if let Some(text) = text {
        files = files.with(path, text.as_bytes().to_vec());
    }
    let options =
        LoadOptions { shot: path.into(), sets: edits.overrides(), ..LoadOptions::default() };
    load(&options, &files).unwrap_or_else(|error| panic!("{error}\n{text:?}"))
}

fn resolved(path: &str, text: Option<&str>, edits: &Edits) -> Value {
    loaded(path, text, edits).resolved
}

fn without_name(mut resolved: Value) -> Value {
    resolved.as_object_mut().unwrap().remove("name");
    resolved
}

#[test]
fn a_shot_around_a_scene_loads_to_the_settings_of_the_scene_with_the_edits() {
    let all = edits([
        ("air.velocity", json!([0.1, 0.0, 0.0])),
        ("garments.1.view.nu_back", json!(0.3)),
        ("garments.1.sizing.refine_velocity", json!(0.7)),
        ("garments.0.sizing.refine_angle", Value::Null),
        ("fabrics.cloth0.thicken", json!(3.0)),
        ("motions.0.transform.scale", json!(2.0)),
        ("camera", serde_json::from_str(CAMERA).unwrap()),
    ]);
    let text = wrapped_text("../conf/scene.json", &all).unwrap();
    let expected = r#"{
    "shotsilk": 1,
    "import": "../conf/scene.json",
    "air": {"velocity": [0.1, 0, 0]},
    "camera": {
        "resolution": [64, 36],
        "fov_y_deg": 40,
        "keys": [{"frame": 0, "eye": [0, -4, 0], "target": [0, 0, 0]}]
    },
    "fabrics": {"cloth0": {"thicken": 3}},
    "garments": [{"sizing": {"refine_angle": null}}, {"sizing": {"refine_velocity": 0.7}, "view": {"nu_back": 0.3}}],
    "motions": {"0": {"transform": {"scale": 2}}}
}
"#;
    assert_eq!(text, expected);
    let wrapped = resolved("/w/shots/new.json", Some(&text), &Edits::default());
    let scene = resolved("/w/conf/scene.json", None, &all);
    assert_eq!(without_name(wrapped), without_name(scene));
}

#[test]
fn every_parameter_of_a_scene_can_be_said_by_a_shot_around_it() {
    let scene = loaded("/w/conf/scene.json", None, &Edits::default());
    let mut all = Edits::default();
    for parameter in parameters(&scene.written, &scene.scene) {
        let value = between(parameter.kind, 0.75);
        wrapped_text("../conf/scene.json", &edits([(&parameter.path, value.clone())])).unwrap();
        all.set(&parameter.path, value);
    }
    let text = wrapped_text("../conf/scene.json", &all).unwrap();
    let wrapped = resolved("/w/shots/new.json", Some(&text), &Edits::default());
    let scene = resolved("/w/conf/scene.json", None, &all);
    assert_eq!(without_name(wrapped), without_name(scene));
}

#[test]
fn a_shot_around_a_scene_gets_garments_up_to_the_one_that_is_edited() {
    let shot = r#"{"shotsilk": 1, "import": "s.json", "garments": [{"view": {"nu_back": 1}},]}"#;
    let saved = saved_text(shot, &edits([("garments.2.two_sided", json!(true))])).unwrap();
    let expected = shot.replace("1}}", "1}}, {}, {\"two_sided\": true}");
    assert_eq!(saved, expected);
    let none = shot.replace("{\"view\": {\"nu_back\": 1}},", "");
    let saved = saved_text(&none, &edits([("garments.0.two_sided", json!(true))])).unwrap();
    assert_eq!(saved, none.replace("[]", "[{\"two_sided\": true}]"));
}

#[test]
fn a_shot_around_a_scene_says_what_it_cannot_say() {
    for (path, value, expected) in [
        ("obstacles.0.transform.scale", json!(2), "but of \"obstacles\" only the whole list"),
        ("air", json!({"density": 2}), "can only add to \"air\""),
        ("garments", json!([]), "can only add to \"garments\""),
        ("garments.99999999999.two_sided", json!(true), "has no element"),
        (
            "garments.0.transform.translate.0",
            json!(1),
            "but of \"garments.0.transform.translate\" only the whole list",
        ),
    ] {
        let error = wrapped_text("scene.json", &edits([(path, value)])).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    let list = edits([("obstacles", json!([]))]);
    let text = wrapped_text("../conf/scene.json", &list).unwrap();
    let wrapped = resolved("/w/shots/new.json", Some(&text), &Edits::default());
    assert_eq!(wrapped["obstacles"], json!([]));
}

/// Every place where a shot names a file.
const NAMES: &str = r#"{
    "shotsilk": 1, // "../cotton.json" in a remark stays
    "camera": "main.camera.json",
    "fabrics": {"cotton": {"file": "../cotton.json"}},
    "garments": [{"mesh": "../meshes/sheet.obj", "fabric": "cotton"},
        {"mesh": "/w/meshes/sheet.obj", "fabric": "cotton"}],
    "motions": {"dance": {"file": "./../a.mot", "fps": 2}},
    "obstacles": [{"mesh": "../meshes/ball.obj", "motion": "dance"},
        {"meshes": [{"time": 0, "mesh": "../meshes/ball.obj"}]},
        {"mesh_sequence": {"pattern": "../meshes/body.%04d.obj", "fps": 2, "first": 1, "last": 1}}]
}"#;

#[test]
fn a_shot_that_moves_names_the_same_files() {
    let before = resolved("/w/shots/a.json", Some(NAMES), &Edits::default());
    for folder in ["/w", "/w/shots/new", "/elsewhere", "/"] {
        let text = rebased(NAMES, Path::new("/w/shots"), Path::new(folder)).unwrap();
        let after = resolved(&format!("{folder}/a.json"), Some(&text), &Edits::default());
        assert_eq!(after["viewers"], before["viewers"]);
        assert_eq!(after["fabrics"], before["fabrics"]);
        assert_eq!(remarks(&text), remarks(NAMES));
        let back = rebased(&text, Path::new(folder), Path::new("/w/shots")).unwrap();
        assert_eq!(back, NAMES.replace("./../", "../"));
    }
    let text = rebased(NAMES, Path::new("/w/shots"), Path::new("/w")).unwrap();
    assert!(text.contains("\"mesh\": \"meshes/ball.obj\"") && text.contains("\"/w/meshes/sheet"));
    let viewers =
        r#"{"shotsilk": 1, "import": "s.json", "viewers": ["a.json", {"name": "b.json"}]}"#;
    let text = rebased(viewers, Path::new("/w"), Path::new("/w/new")).unwrap();
    assert_eq!(text, viewers.replace("\"s.json", "\"../s.json").replace("\"a.json", "\"../a.json"));
    let error = rebased(NAMES, Path::new("shots"), Path::new("/w")).unwrap_err();
    assert!(error.to_string().contains("\"shots\" must be given in full"));
}
