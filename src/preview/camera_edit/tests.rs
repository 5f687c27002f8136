use std::num::NonZeroU32;

use serde_json::json;

use super::*;
use crate::own_shot::own_shot;
use crate::preview::{Edits, saved_text};
use crate::scene::{FileSource, LoadOptions, LoadedShot, load};
use crate::shot::{Lens, View};

const FRAMES: std::ops::RangeInclusive<u32> = 0..=110;

fn loaded(edits: &Edits) -> LoadedShot {
    let (shot, files) = own_shot();
    let options = LoadOptions { shot, sets: edits.overrides(), ..LoadOptions::default() };
    load(&options, &files).unwrap_or_else(|error| panic!("{error}"))
}

fn own() -> CameraEdit {
    let shot = loaded(&Edits::default());
    CameraEdit::of_shot(&shot.resolved, &shot.scene).unwrap()
}

/// The own shot with another camera.
fn shot_with(camera: &Value) -> LoadedShot {
    let shot = loaded(&Edits::default());
    let mut edits = Edits::default();
    edits.set(camera_setting(&shot.written), camera.clone());
    loaded(&edits)
}

fn edit_with(camera: &Value) -> CameraEdit {
    let shot = shot_with(camera);
    CameraEdit::of_shot(&shot.resolved, &shot.scene).unwrap()
}

/// The path of the shot that the edit is loaded into, which must be what the edit says itself.
fn loaded_path(edit: &CameraEdit) -> CameraPath {
    let path = shot_with(&edit.json()).scene.viewers.remove(0);
    assert_eq!(path, edit.path());
    path
}

fn views(path: &CameraPath) -> Vec<View> {
    FRAMES.map(|frame| path.view(f64::from(frame))).collect()
}

fn frames(edit: &CameraEdit) -> Vec<f64> {
    edit.keys().iter().map(|key| key.frame).collect()
}

fn placement() -> Placement {
    let (eye, target) = (DVec3::new(-2.0, 1.0, 1.5), DVec3::new(0.1, 0.2, 0.9));
    Placement { eye, target, up: DVec3::new(0.1, 0.0, 1.0) }
}

/// With a film back whose focal length moves.
fn zoom() -> Value {
    json!({
        "resolution": [1280, 720], "focal_mm": 35.0, "aperture_mm": [36.0, 20.25],
        "keys": [
            {"frame": 0.0, "eye": [0.0, -4.0, 1.0], "target": [0.0, 0.0, 1.0]},
            {"frame": 50.0, "eye": [1.0, -4.0, 1.0], "target": [0.0, 0.0, 1.0], "focal_mm": 70.0}
        ]
    })
}

#[test]
fn a_camera_that_nobody_edits_keeps_its_bits() {
    let before = loaded(&Edits::default());
    let edit = own();
    assert_eq!(loaded_path(&edit), before.scene.viewers[0]);
    let mut edits = Edits::default();
    edits.set("camera", edit.json());
    assert_eq!(loaded(&edits).resolved, before.resolved);
    assert_eq!(edit.json()["keys"][0].as_object().unwrap().len(), 3);
}

#[test]
fn a_new_key_is_passed_through_and_changes_nothing_beyond_its_neighbours_neighbours() {
    let before = own().path();
    let edit = own().set_key(20.0, placement(), None).unwrap();
    assert_eq!(frames(&edit), [0.0, 8.0, 20.0, 35.0, 47.0, 54.0, 100.0]);
    let path = loaded_path(&edit);
    let view = path.view(20.0);
    assert_eq!(view.eye, placement().eye);
    let sight = (placement().target - placement().eye).normalize();
    assert!(view.back.distance(-sight) < 1e-12);
    assert_eq!(path.lens(20.0), before.lens(20.0));
    assert_eq!(views(&path)[54..], views(&before)[54..]);
    assert_eq!(path.view(0.0), before.view(0.0));
    assert_eq!(path.cuts(), before.cuts());
}

#[test]
fn a_key_that_is_set_again_keeps_its_cut_and_its_lens() {
    let edit = own().set_key(54.0, placement(), None).unwrap();
    assert_eq!(frames(&edit), frames(&own()));
    let path = loaded_path(&edit);
    assert_eq!((path.cuts(), path.view(54.0).eye), (vec![54.0], placement().eye));
    assert_eq!(edit.lens(54.0), Ok(LensValue::FovYDeg(40.0)));
    let wide = own().set_key(54.0, placement(), Some(LensValue::FovYDeg(50.0))).unwrap();
    assert_eq!(wide.lens(54.0), Ok(LensValue::FovYDeg(50.0)));
    let ahead = own().set_key(-5.0, placement(), None).unwrap();
    assert_eq!(frames(&ahead)[..2], [-5.0, 0.0]);
    loaded_path(&ahead);
}

#[test]
fn a_placement_that_is_no_view_is_refused_in_words() {
    let nowhere = Placement { target: placement().eye, ..placement() };
    let error = own().set_key(20.0, nowhere, None).unwrap_err().to_string();
    assert!(error.contains("eye and target are the same point"), "{error}");
    let along = Placement { up: placement().target - placement().eye, ..placement() };
    let error = own().set_key(20.0, along, None).unwrap_err().to_string();
    assert!(error.contains("up is parallel"), "{error}");
    let error = own().set_key(f64::NAN, placement(), None).unwrap_err();
    assert!(matches!(error, CameraEditError::Invalid(_)), "{error}");
    let lens = Some(LensValue::FovYDeg(180.0));
    let error = own().set_key(20.0, placement(), lens).unwrap_err().to_string();
    assert!(error.contains("fov_y_deg is 180"), "{error}");
}

#[test]
fn deleting_keys_ends_with_one_that_stays() {
    let edit = own().delete_key(8.0).unwrap();
    assert_eq!(frames(&edit), [0.0, 35.0, 47.0, 54.0, 100.0]);
    loaded_path(&edit);
    assert_eq!(own().delete_key(9.0), Err(CameraEditError::NoKey(9.0)));
    let mut edit = own();
    for frame in [0.0, 8.0, 35.0, 47.0] {
        edit = edit.delete_key(frame).unwrap();
        loaded_path(&edit);
    }
    // The cut at 54 has nothing left to cut from.
    assert_eq!((frames(&edit), edit.path().cuts()), (vec![54.0, 100.0], vec![]));
    let edit = edit.delete_key(100.0).unwrap();
    assert_eq!(edit.delete_key(54.0), Err(CameraEditError::LastKey(54.0)));
    let without_cut = own().delete_key(54.0).unwrap();
    assert_eq!(loaded_path(&without_cut).cuts(), [0.0; 0]);
}

#[test]
fn a_key_moves_in_time_but_not_onto_another() {
    let edit = own().move_key(35.0, 30.5).unwrap();
    assert_eq!(frames(&edit), [0.0, 8.0, 30.5, 47.0, 54.0, 100.0]);
    assert_eq!(loaded_path(&edit).view(30.5).eye, own().path().view(35.0).eye);
    assert_eq!(own().move_key(35.0, 47.0), Err(CameraEditError::Occupied(47.0)));
    assert_eq!(own().move_key(36.0, 37.0), Err(CameraEditError::NoKey(36.0)));
    assert_eq!(own().move_key(35.0, 35.0), Ok(own()));
    let passed = own().move_key(8.0, 40.0).unwrap();
    assert_eq!(frames(&passed), [0.0, 35.0, 40.0, 47.0, 54.0, 100.0]);
    assert_eq!(loaded_path(&passed).view(40.0).eye, own().path().view(8.0).eye);
    let first = own().move_key(54.0, -1.0).unwrap();
    assert_eq!((frames(&first)[0], loaded_path(&first).cuts()), (-1.0, vec![]));
    assert!(matches!(own().move_key(8.0, f64::INFINITY), Err(CameraEditError::Invalid(_))));
}

#[test]
fn a_key_becomes_a_cut_and_none_again() {
    let edit = own().set_cut(35.0, Cut::Yes).unwrap();
    assert_eq!(loaded_path(&edit).cuts(), [35.0, 54.0]);
    assert_eq!(edit.set_cut(35.0, Cut::No), Ok(own()));
    assert_eq!(own().set_cut(0.0, Cut::Yes), Err(CameraEditError::FirstKeyCut(0.0)));
    assert_eq!(own().set_cut(0.0, Cut::No), Ok(own()));
    assert_eq!(own().set_cut(1.0, Cut::Yes), Err(CameraEditError::NoKey(1.0)));
}

#[test]
fn a_lens_is_set_for_one_key_or_for_all() {
    let one = own().set_lens(LensScope::Key(100.0), LensValue::FovYDeg(55.0)).unwrap();
    assert_eq!(one.lens(100.0), Ok(LensValue::FovYDeg(55.0)));
    assert_eq!(views(&loaded_path(&one))[..54], views(&own().path())[..54]);
    let as_camera = one.set_lens(LensScope::Key(100.0), LensValue::FovYDeg(30.0)).unwrap();
    assert_eq!(as_camera.keys()[5].fov_y_deg, None);
    let all = own().set_lens(LensScope::WholePath, LensValue::FovYDeg(45.0)).unwrap();
    assert!(all.keys().iter().all(|key| key.fov_y_deg.is_none()));
    assert_eq!(all.json()["fov_y_deg"], 45.0);
    let path = loaded_path(&all);
    for frame in FRAMES {
        let Lens::FieldOfView { fov_y } = path.lens(f64::from(frame)) else { panic!("no angle") };
        assert!((fov_y.to_degrees() - 45.0).abs() < 1e-9, "{fov_y} at frame {frame}");
    }
    let focal = own().set_lens(LensScope::WholePath, LensValue::FocalMm(35.0));
    assert_eq!(focal, Err(CameraEditError::NoFilmBack));
    let error = own().set_lens(LensScope::WholePath, LensValue::FovYDeg(0.0)).unwrap_err();
    assert!(error.to_string().contains("fov_y_deg is 0"), "{error}");
}

#[test]
fn a_film_back_stays_one_and_takes_an_angle_as_the_focal_length_that_sees_as_much() {
    let edit = edit_with(&zoom());
    let tele = edit.set_lens(LensScope::Key(0.0), LensValue::FocalMm(85.0)).unwrap();
    assert_eq!(tele.lens(0.0), Ok(LensValue::FocalMm(85.0)));
    assert_eq!(tele.lens(50.0), Ok(LensValue::FocalMm(70.0)));
    let angle = edit.set_lens(LensScope::WholePath, LensValue::FovYDeg(40.0)).unwrap();
    let view = loaded_path(&angle).view(25.0);
    let seen = 2.0 * view.gate_max.y.atan();
    assert!((seen.to_degrees() - 40.0).abs() < 1e-9, "{seen}");
    assert!(matches!(angle.lens(0.0), Ok(LensValue::FocalMm(_))));
}

#[test]
fn a_new_key_has_the_lens_that_the_path_has_there() {
    let edit = edit_with(&zoom());
    let lens = edit.path().lens(20.0);
    let with_key = edit.set_key(20.0, placement(), None).unwrap();
    assert_eq!(loaded_path(&with_key).lens(20.0), lens);
    let LensValue::FocalMm(focal) = with_key.lens(20.0).unwrap() else { panic!("no film back") };
    assert!(focal > 36.0 && focal < 69.0, "{focal}");
    let behind = edit.set_key(80.0, placement(), None).unwrap();
    assert_eq!(behind.lens(80.0), Ok(LensValue::FocalMm(70.0)));
}

/// The own camera, a matrix a frame.
fn baked() -> Value {
    let path = own().path();
    let sample = |frame: u32| {
        let view = path.view(f64::from(frame));
        let row = |axis: usize| [view.right[axis], view.up[axis], view.back[axis], view.eye[axis]];
        let Lens::FieldOfView { fov_y } = path.lens(f64::from(frame)) else { panic!("no angle") };
        json!({
            "world_from_camera": [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]],
            "fov_y_deg": fov_y.to_degrees(), "cut": frame == 54
        })
    };
    let matrices: Vec<Value> = (0..=100).map(sample).collect();
    json!({"name": "baked", "resolution": [1280, 720], "near": 0.05, "far": 50.0, "matrices": matrices})
}

#[test]
fn a_baked_camera_becomes_keys_that_stand_where_it_stood() {
    let shot = shot_with(&baked());
    let refused = CameraEdit::of_shot(&shot.resolved, &shot.scene);
    assert_eq!(refused, Err(CameraEditError::Baked));
    let keyed = |every: u32, distance: f64| {
        let every = NonZeroU32::new(every).unwrap();
        CameraEdit::keyed(&shot.resolved, &shot.scene, every, distance)
    };
    let edit = keyed(20, 3.0).unwrap();
    assert_eq!(frames(&edit), [0.0, 20.0, 40.0, 53.0, 54.0, 74.0, 94.0, 100.0]);
    let path = loaded_path(&edit);
    assert_eq!((path.cuts(), path.name.as_str()), (vec![54.0], "baked"));
    for frame in frames(&edit) {
        let (old, new) = (shot.scene.viewers[0].view(frame), path.view(frame));
        let corners = [old, new].map(|v| v.clip_from_world());
        assert!(corners[0].abs_diff_eq(corners[1], 1e-9), "frame {frame}");
    }
    // With a key a frame it is the same camera everywhere.
    let path = loaded_path(&keyed(1, 3.0).unwrap());
    for frame in 0..=100 {
        let [old, new] = [&shot.scene.viewers[0], &path].map(|p| p.view(f64::from(frame)));
        assert!(old.eye.distance(new.eye) < 1e-9 && old.right.distance(new.right) < 1e-9);
    }
    assert!(matches!(keyed(20, 0.0), Err(CameraEditError::Invalid(_))));
    let own_shot = loaded(&Edits::default());
    let same = CameraEdit::keyed(&own_shot.resolved, &own_shot.scene, NonZeroU32::MIN, 1.0);
    assert_eq!(same, Ok(own()));
}

#[test]
fn the_camera_of_several_viewers_is_the_first_and_a_shot_may_have_none() {
    assert_eq!(camera_setting(&json!({"viewers": [{}, {}]})), "viewers.0");
    assert_eq!(camera_setting(&json!({"viewers": [], "camera": "a.json"})), "camera");
    let shot = loaded(&Edits::default());
    let none = CameraEdit::of_shot(&json!({"viewers": []}), &shot.scene);
    assert_eq!(none, Err(CameraEditError::NoCamera));
}

#[test]
fn cameras_that_differ_in_the_sign_of_nothing_are_told_apart_and_say_so() {
    let with_up = |x: f64| {
        let mut camera = zoom();
        camera["name"] = json!("zoom");
        camera["keys"][0]["up"] = json!([x, 0.0, 1.0]);
        edit_with(&camera)
    };
    assert_eq!(with_up(0.0), with_up(0.0));
    assert_ne!(with_up(-0.0), with_up(0.0));
    assert_eq!(with_up(0.0).json()["keys"][0].get("up"), None);
    let said = with_up(-0.0).json()["keys"][0]["up"][0].as_f64().unwrap();
    assert_eq!(said.to_bits(), (-0.0f64).to_bits());
}

#[test]
fn an_edited_camera_is_saved_in_the_shot_and_loads_the_same() {
    let (shot, files) = own_shot();
    let text = String::from_utf8(files.read(&shot).unwrap()).unwrap();
    let edit = own().set_key(20.0, placement(), Some(LensValue::FovYDeg(33.3))).unwrap();
    let mut edits = Edits::default();
    edits.set("camera", edit.json());
    let saved = saved_text(&text, &edits).unwrap();
    let files = files.with(&shot, saved.into_bytes());
    let again = load(&LoadOptions { shot, ..LoadOptions::default() }, &files).unwrap();
    assert_eq!(again.scene.viewers[0], edit.path());
    assert_eq!(again.resolved, loaded(&edits).resolved);
}
