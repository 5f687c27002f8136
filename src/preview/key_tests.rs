use serde_json::json;

use super::super::{Anchor, Edits, Plan};
use super::*;
use crate::request::{FrameRange, Request};
use crate::sim::SizingMode;

/// The own shot under a camera whose keys are 0, 40, 60 (a cut), 100 and 120.
fn plan(edit: impl FnOnce(&mut Value), settings: &[(&str, Value)], sizing: SizingMode) -> Plan {
    let key = |frame: u32, x: f64| json!({"frame": frame, "eye": [x, -4.0, 1.0], "target": [0.0, 0.0, 1.0]});
    let mut keys = json!([key(0, 0.0), key(40, 1.0), key(60, -1.0), key(100, 0.5), key(120, 2.0)]);
    keys[2]["cut"] = json!(true);
    let mut camera = json!({"resolution": [960, 540], "fov_y_deg": 30.0, "keys": keys});
    edit(&mut camera);
    let mut edits = Edits::default();
    edits.set("camera", camera);
    settings.iter().for_each(|(path, value)| edits.set(path, value.clone()));
    let request = Request {
        shot: None,
        text: None,
        camera: None,
        sets: vec!["view.anticipation_frames=5".into()],
        fps: None,
        frames: Some(FrameRange { first: 0, last: 150 }),
        sizing,
    };
    Plan::new(&request, &edits).unwrap()
}

/// The first frame whose key differs.
fn first_difference(a: &Plan, b: &Plan) -> Option<usize> {
    a.keys(None).iter().zip(b.keys(None)).position(|(a, b)| *a != b)
}

#[test]
fn a_moved_key_is_seen_from_the_frames_on_whose_window_reaches_the_moved_stretch() {
    let before = plan(|_| {}, &[], SizingMode::View);
    let moved = plan(|c| c["keys"][3]["eye"][2] = json!(2.0), &[], SizingMode::View);
    // The stretch from the cut at 60 moves from frame 61 on; a window of 5 frames counts what is less
    // than 5 ahead.
    assert_eq!(first_difference(&before, &moved), Some(57));
}

#[test]
fn a_key_before_the_moved_one_turns_as_well_unless_its_run_begins_there() {
    let before = plan(|c| c["keys"][2]["cut"] = json!(false), &[], SizingMode::View);
    let moved = plan(
        |c| {
            c["keys"][2]["cut"] = json!(false);
            c["keys"][3]["eye"][0] = json!(0.7);
        },
        &[],
        SizingMode::View,
    );
    // x turns round at the key at 60, so its slope is 0 whatever comes after: nothing before it moves.
    assert_eq!(first_difference(&before, &moved), Some(57));
    let rising = |x: f64| {
        plan(
            |c| {
                c["keys"][2]["cut"] = json!(false);
                c["keys"][2]["eye"][0] = json!(2.0);
                c["keys"][3]["eye"][0] = json!(x);
            },
            &[],
            SizingMode::View,
        )
    };
    // Rising through 60, the slope there follows the key at 100: the stretch from 40 moves.
    assert_eq!(first_difference(&rising(3.0), &rising(4.0)), Some(37));
}

#[test]
fn what_the_camera_does_not_change_keeps_its_keys_and_an_edit_taken_back_returns_them() {
    let before = plan(|_| {}, &[], SizingMode::View);
    let named =
        plan(|c| c["name"] = json!("another"), &[("first_frame", json!(1001))], SizingMode::View);
    assert_eq!(first_difference(&before, &named), None);
    let last = plan(|c| c["keys"][4]["eye"][2] = json!(3.0), &[], SizingMode::View);
    assert_eq!(first_difference(&before, &last), Some(97));
    assert_eq!(first_difference(&before, &plan(|_| {}, &[], SizingMode::View)), None);
}

#[test]
fn nobody_looks_at_an_adaptive_simulation() {
    let before = plan(|_| {}, &[], SizingMode::Adaptive);
    let moved = plan(|c| c["keys"][0]["eye"][2] = json!(2.0), &[], SizingMode::Adaptive);
    assert_eq!(first_difference(&before, &moved), None);
    assert_eq!(first_difference(&before, &plan(|_| {}, &[], SizingMode::View)), Some(0));
}

#[test]
fn other_settings_make_other_frames_from_the_anchor_on_alone() {
    let before = plan(|_| {}, &[], SizingMode::View);
    let windy = plan(|_| {}, &[("air.velocity", json!([1.0, 0.0, 0.0]))], SizingMode::View);
    assert_eq!(first_difference(&before, &windy), Some(0));
    let key = before.keys(None)[30].unwrap();
    let anchor = Anchor { frame: 30, key, keys: Default::default() };
    let keys = windy.keys(Some(&anchor));
    assert_eq!(keys[30], None);
    assert_eq!(keys[31], Some(FrameKey::after(Some(key), windy.steps[31])));
    // Going on with the same settings is no different from never having stopped.
    assert_eq!(before.keys(Some(&anchor))[31..], before.keys(None)[31..]);
}
