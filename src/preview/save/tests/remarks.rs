//! Remarks in groups and lists that are edited as wholes, as a camera is.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::super::*;
use super::{edits, said};

const SHOT: &str = r#"{
  "shotsilk": 1,
  "camera": { // the operator's
    /* 16:9 */ "resolution": [1280, 720], "fov_y_deg": 31.50, // wide
    "keys": [ // by hand
      // She enters.
      {"frame": 0, "eye": [0.0, -3, 1], "target": [0, 0, 1]}, // far
      {"frame": 20, "eye": [1, -3, 1], "target": [0, 0, 1]}, /* nearer */

      // She turns:
      // a jump.
      {"frame": 40, "eye": [2, -3, 1], "target": [0, 0, 1], "cut": true} // near
      // Nothing after it.
    ]
  } // the shot's
}
"#;

fn camera() -> Value {
    said(SHOT)["camera"].clone()
}

fn saved(camera: Value) -> String {
    saved_text(SHOT, &edits([("camera", camera)])).unwrap()
}

#[test]
fn a_key_that_is_moved_in_space_keeps_its_remarks_and_all_others_their_text() {
    let mut camera = camera();
    camera["keys"][1]["eye"] = json!([1.0, -3.5, 1.0]);
    let expected = SHOT.replace("\"eye\": [1, -3, 1]", "\"eye\": [1, -3.5, 1]");
    assert_eq!(saved(camera), expected);
}

#[test]
fn a_key_that_is_moved_in_time_takes_its_remarks_along() {
    let mut camera = camera();
    camera["keys"][1]["frame"] = json!(30.0);
    assert_eq!(saved(camera), SHOT.replace("\"frame\": 20", "\"frame\": 30"));
}

#[test]
fn a_key_goes_with_its_own_remarks() {
    let mut first = camera();
    first["keys"].as_array_mut().unwrap().remove(0);
    let line = "      // She enters.\n      {\"frame\": 0, \"eye\": [0.0, -3, 1], \"target\": \
                [0, 0, 1]}, // far\n";
    assert_eq!(saved(first), SHOT.replace(line, ""));
    let mut last = camera();
    last["keys"].as_array_mut().unwrap().remove(2);
    let without = saved(last);
    assert!(without.contains("\"target\": [0, 0, 1]} /* nearer */\n      // Nothing after it.\n"));
    assert!(!without.contains("She turns"));
}

#[test]
fn a_new_key_stands_on_a_line_of_its_own() {
    let key = json!({"frame": 10, "eye": [0.5, -3, 1], "target": [0, 0, 1]});
    let line = "\n      {\"frame\": 10, \"eye\": [0.5, -3, 1], \"target\": [0, 0, 1]},";
    let mut camera = camera();
    camera["keys"].as_array_mut().unwrap().insert(1, key);
    assert_eq!(saved(camera), SHOT.replace(" // far", &format!(" // far{line}")));
}

#[test]
fn members_come_and_go_beside_those_that_stay() {
    let mut camera = camera();
    camera["keys"][1]["cut"] = json!(true);
    camera["keys"][2].as_object_mut().unwrap().remove("cut");
    camera["fov_y_deg"] = json!(40);
    let expected = SHOT
        .replace("[0, 0, 1]}, /* nearer */", "[0, 0, 1], \"cut\": true}, /* nearer */")
        .replace("[0, 0, 1], \"cut\": true} // near", "[0, 0, 1]} // near")
        .replace("31.50", "40");
    assert_eq!(saved(camera), expected);
}

#[test]
fn a_remark_to_the_end_of_its_line_takes_nothing_into_itself() {
    let shot = "{\"shotsilk\": 1, \"camera\": {\"keys\": [{\"frame\": 0}, // a\n {\"frame\": 1}, \
                {\"frame\": 2}]}}";
    let camera = json!({"keys": [{"frame": 0}, {"frame": 2}]});
    let saved = saved_text(shot, &edits([("camera", camera.clone())])).unwrap();
    assert_eq!(said(&saved)["camera"], camera, "{saved}");
    assert!(saved.contains("// a\n"), "{saved}");
}

#[test]
fn a_remark_that_closes_leaves_what_follows_on_its_line() {
    let shot = "{\"shotsilk\": 1, \"camera\": {\"keys\": [{\"frame\": 0}, /* http://a.b */ \
                {\"frame\": 1}, /* // */ {\"frame\": 2}]}}";
    let camera = json!({"keys": [{"frame": 0}, {"frame": 1.5}, {"frame": 2}]});
    let saved = saved_text(shot, &edits([("camera", camera)])).unwrap();
    assert_eq!(saved, shot.replace("{\"frame\": 1}", "{\"frame\": 1.5}"));
}

#[test]
fn numbers_that_differ_in_a_sign_or_in_the_last_digit_are_written() {
    let mut camera = camera();
    camera["keys"][0]["eye"][0] = json!(-0.0);
    assert_eq!(saved(camera), SHOT.replace("[0.0, -3, 1]", "[-0.0, -3, 1]"));
    let shot = "{\"shotsilk\": 1, \"camera\": {\"seed\": 9007199254740993, \"fps\": 24}}";
    let camera = json!({"seed": 9_007_199_254_740_992_u64, "fps": 24.0});
    let saved = saved_text(shot, &edits([("camera", camera)])).unwrap();
    assert_eq!(saved, shot.replace("0993", "0992"));
}

/// A shot whose author states what goes without saying.
const STATED: &str = r#"{
  "shotsilk": 1,
  "camera": {
    "resolution": [1280, 720], "fov_y_deg": 31.5,
    "keys": [
      {"frame": 0, "eye": [0, -3, 1], "up": [0, 0, 1], "target": [0, 0, 1], "cut": false}, // a
      {"frame": 20, "cut": false, "eye": [1, -3, 1], "target": [0, 0, 1]}, // b
      {"frame": 40, "eye": [2, -3, 1], "target": [0, 0, 1], "cut": true} // c
    ]
  }
}
"#;

/// What an edit of the camera says: nothing that goes without saying.
fn unstated() -> Value {
    let mut camera = said(STATED)["camera"].clone();
    for key in camera["keys"].as_array_mut().unwrap() {
        key.as_object_mut().unwrap().retain(|name, value| name != "up" && *value != json!(false));
    }
    camera
}

#[test]
fn what_a_key_states_though_it_goes_without_saying_stays_while_it_holds() {
    let saved = |camera: Value| saved_text(STATED, &edits([("camera", camera)])).unwrap();
    assert_eq!(saved(unstated()), STATED);
    let mut moved = unstated();
    moved["keys"][0]["eye"] = json!([0.5, -3.0, 1.0]);
    moved["keys"][1]["frame"] = json!(30.0);
    let expected = STATED
        .replace("\"eye\": [0, -3, 1]", "\"eye\": [0.5, -3, 1]")
        .replace("\"frame\": 20", "\"frame\": 30");
    assert_eq!(saved(moved), expected);
    let mut cut = unstated();
    cut["keys"][0]["up"] = json!([0.0, 1.0, 1.0]);
    cut["keys"][1]["cut"] = json!(true);
    cut["keys"][2].as_object_mut().unwrap().remove("cut");
    let expected = STATED
        .replace("[0, 0, 1], \"cut\": true} // c", "[0, 0, 1]} // c")
        .replace("\"up\": [0, 0, 1]", "\"up\": [0, 1, 1]")
        .replace("\"frame\": 20, \"cut\": false", "\"frame\": 20, \"cut\": true");
    assert_eq!(saved(cut), expected);
    // A key of its own states nothing.
    let mut more = unstated();
    let key = json!({"frame": 10, "eye": [0.5, -3, 1], "target": [0, 0, 1]});
    more["keys"].as_array_mut().unwrap().insert(1, key);
    let line = "\n      {\"frame\": 10, \"eye\": [0.5, -3, 1], \"target\": [0, 0, 1]},";
    assert_eq!(saved(more), STATED.replace(" // a", &format!(" // a{line}")));
}

#[test]
fn a_direction_that_differs_in_a_sign_goes_not_without_saying() {
    let text = STATED.replace("\"up\": [0, 0, 1]", "\"up\": [-0.0, 0, 1]");
    let saved = saved_text(&text, &edits([("camera", unstated())])).unwrap();
    assert_eq!(said(&saved)["camera"]["keys"][0].get("up"), None, "{saved}");
}

/// Keys of a camera as the text of a shot has them, each with a remark of its own.
fn text_of(frames: &[u32], style: &[usize]) -> String {
    let one = |(number, frame): (usize, &u32)| {
        let comma = if number + 1 < frames.len() { "," } else { "" };
        let key = format!("{{\"frame\": {frame}, \"eye\": [{frame}, 0, 1]}}");
        match style[number % style.len()] {
            0 => format!("\n    {key}{comma} // of {frame};\n"),
            1 => format!("\n    // of {frame};\n    {key}{comma}"),
            2 => format!(" /* of {frame}; */ {key}{comma}"),
            _ => format!("\n    {key} /* of {frame}; */ {comma}\n"),
        }
    };
    let keys: String = frames.iter().enumerate().map(one).collect();
    format!("{{\n  \"shotsilk\": 1,\n  \"camera\": {{\n    \"keys\": [{keys}\n    ]\n  }}\n}}\n")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_is_edited_the_text_says_it_and_what_stays_keeps_its_remark(
        before in prop::sample::subsequence((0..12u32).collect::<Vec<_>>(), 1..8),
        after in prop::sample::subsequence((0..12u32).collect::<Vec<_>>(), 1..8),
        raised in 0..12u32,
        style in prop::collection::vec(0..4usize, 1..4),
    ) {
        let text = text_of(&before, &style);
        let height = |frame: u32| if frame == raised { 2.5 } else { 1.0 };
        let keys: Vec<Value> = after.iter()
            .map(|&frame| json!({"frame": frame, "eye": [frame, 0, height(frame)]})).collect();
        let saved = saved_text(&text, &edits([("camera", json!({"keys": keys}))])).unwrap();
        let (found, wanted) = (said(&saved), json!({"shotsilk": 1, "camera": {"keys": keys}}));
        let numbers = |value: &Value| value.to_string().replace(".0", "");
        prop_assert_eq!(numbers(&found), numbers(&wanted), "{}", saved);
        for frame in before.iter().filter(|frame| after.contains(frame)) {
            let remark = format!("of {frame};");
            prop_assert_eq!(saved.matches(&remark).count(), 1, "{}\n{}", remark, saved);
        }
    }
}
