#[path = "tests/elsewhere.rs"]
mod elsewhere;
#[path = "tests/remarks.rs"]
mod remarks;

use proptest::prelude::*;
use serde_json::json;

use super::*;
use crate::own_shot::own_shot;
use crate::preview::{ParameterKind, parameters};
use crate::scene::{FileSource, LoadOptions, LoadedShot, load};

fn edits<const N: usize>(list: [(&str, Value); N]) -> Edits {
    let mut edits = Edits::default();
    list.into_iter().for_each(|(path, value)| edits.set(path, value));
    edits
}

fn own_text() -> String {
    let (shot, files) = own_shot();
    String::from_utf8(files.read(&shot).unwrap()).unwrap()
}

fn own_loaded(text: &str, edits: &Edits) -> LoadedShot {
    let (shot, files) = own_shot();
    let files = files.with(&shot, text.as_bytes().to_vec());
    let options = LoadOptions { shot, sets: edits.overrides(), ..LoadOptions::default() };
    load(&options, &files).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// What a text says, whatever its layout.
fn said(text: &str) -> Value {
    jsonc_parser::parse_to_serde_value(text, &crate::scene::SYNTAX).unwrap()
}

/// All comments, in order.
fn remarks(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.split_once("//")).map(|(_, remark)| remark).collect()
}

#[test]
fn a_saved_value_changes_nothing_else_in_the_text() {
    let text = own_text();
    let saved =
        saved_text(&text, &edits([("contact.friction_obstacle", json!(0.1 + 0.2))])).unwrap();
    assert_eq!(
        saved,
        text.replace("\"friction_obstacle\": 0.3", "\"friction_obstacle\": 0.30000000000000004")
    );
    assert_eq!(saved_text(&text, &Edits::default()).unwrap(), text);
}

#[test]
fn new_keys_stand_where_the_format_has_them_in_the_layout_of_the_file() {
    let text = own_text();
    let saved = saved_text(
        &text,
        &edits([
            ("view.nu_out", json!(0.1)),
            ("garments.0.sizing.refine_angle", json!(0.4)),
            ("garments.0.view.nu_back", json!(1.0)),
            ("air.velocity", json!([6.0, 0.0, 0.5])),
        ]),
    );
    let expected = text
        .replace(
            "\"frames\": 100,\n",
            "\"frames\": 100,\n    \"air\": {\"velocity\": [6, 0, 0.5]},\n",
        )
        .replace(
            "\"friction_obstacle\": 0.3},\n",
            "\"friction_obstacle\": 0.3},\n    \"view\": {\"nu_out\": 0.1},\n",
        )
        .replace("{\"edge_length_min\"", "{\"refine_angle\": 0.4, \"edge_length_min\"")
        .replace(
            "0.15},\n        \"two",
            "0.15},\n        \"view\": {\"nu_back\": 1},\n        \"two",
        );
    assert_eq!(saved.unwrap(), expected);
}

#[test]
fn entries_keep_their_remarks_and_the_file_its_line_ends_and_commas() {
    let shot = "\u{feff}{\r\n\t\"shotsilk\": 1, // the version\r\n\t\"fps\": 25 /* a */ // b\r\n}";
    let saved = saved_text(shot, &edits([("view.nu_out", json!(0.1))])).unwrap();
    let expected = "\u{feff}{\r\n\t\"shotsilk\": 1, // the version\r\n\t\"fps\": 25, /* a */ // b\
        \r\n\t\"view\": {\"nu_out\": 0.1}\r\n}";
    assert_eq!(saved, expected);
    for (before, after) in [
        ("{\"shotsilk\": 1,}", "{\"shotsilk\": 1, \"fps\": 30,}"),
        ("{\"shotsilk\": 1}", "{\"shotsilk\": 1, \"fps\": 30}"),
        ("{ // x\n  \"shotsilk\": 1 }", "{ // x\n  \"shotsilk\": 1,\n  \"fps\": 30 }"),
        ("{\"shotsilk\": 1 // x\n}", "{\"shotsilk\": 1, \"fps\": 30 // x\n}"),
        ("{\"view\": {}, \"shotsilk\": 1}", "{\"view\": {}, \"shotsilk\": 1, \"fps\": 30}"),
        (
            "{\n  // y\n  \"view\": {}, // v\n\n  // z\n  \"shotsilk\": 1\n}",
            "{\n  // y\n  \"view\": {}, // v\n\n  // z\n  \"shotsilk\": 1,\n  \"fps\": 30\n}",
        ),
    ] {
        assert_eq!(saved_text(before, &edits([("fps", json!(30.0))])).unwrap(), after);
    }
    let saved = saved_text("{\"shotsilk\": 1, \"air\": { }}", &edits([("air.density", json!(2))]));
    assert_eq!(saved.unwrap(), "{\"shotsilk\": 1, \"air\": {\"density\": 2 }}");
    let first = "{\"shotsilk\": 1, \"air\": {\n  // d\n  \"tangential_drag\": 1\n}}";
    let saved = saved_text(first, &edits([("air.density", json!(2))])).unwrap();
    let expected =
        "{\"shotsilk\": 1, \"air\": {\n  \"density\": 2,\n  // d\n  \"tangential_drag\": 1\n}}";
    assert_eq!(saved, expected);
}

#[test]
fn a_camera_is_written_a_key_a_line() {
    let key = |frame: f64| json!({"frame": frame, "eye": [-3.64, 1.41, 1.25], "target": [0.0, 0.0, 0.88], "fov_y_deg": 31.5});
    let camera = json!({"resolution": [1280, 720], "keys": [key(0.0), key(50.0)]});
    let shot = "{\n  \"shotsilk\": 1,\n  \"camera\": \"main.camera.json\" // the shot's\n}\n";
    let saved = saved_text(shot, &edits([("camera", camera)])).unwrap();
    let expected = r#"{
  "shotsilk": 1,
  "camera": {
    "resolution": [1280, 720],
    "keys": [
      {"frame": 0, "eye": [-3.64, 1.41, 1.25], "target": [0, 0, 0.88], "fov_y_deg": 31.5},
      {"frame": 50, "eye": [-3.64, 1.41, 1.25], "target": [0, 0, 0.88], "fov_y_deg": 31.5}
    ]
  } // the shot's
}
"#;
    assert_eq!(saved, expected);
}

#[test]
fn what_does_not_fit_the_file_is_refused_in_words() {
    let shot = r#"{"shotsilk": 1, "camera": "a.json", "garments": [{"mesh": "a.obj"}]}"#;
    let message = |text: &str, path: &str, value: Value| {
        saved_text(text, &edits([(path, value)])).expect_err(path).to_string()
    };
    for (path, expected) in [
        ("camera.near", "cannot write \"camera.near\": \"camera\" is a string in the shot file"),
        ("garments.1.two_sided", "the list \"garments\" has no element \"1\""),
        ("garments.x.two_sided", "there is no setting"),
        ("obstacles.0.motion", "the list \"obstacles\" has no element \"0\""),
        ("view.nu_uot", "did you mean \"view.nu_out\"?"),
    ] {
        let message = message(shot, path, json!(1));
        assert!(message.contains(expected), "{message}");
    }
    assert!(message(r#"{"cloths": []}"#, "fps", json!(1)).contains("save a new shot"));
    assert!(message("[1]", "fps", json!(1)).contains("not a shot"));
    assert!(message("{", "fps", json!(1)).contains("no JSON"));
}

/// A value within a parameter's range, a fraction of the way along it.
fn between(kind: ParameterKind, fraction: f64) -> Value {
    let along = |min: f64, max: f64| min + (max - min) * fraction;
    match kind {
        ParameterKind::Number { min, max, .. } => json!(along(min, max)),
        ParameterKind::Integer { min, max } => json!(along(min as f64, max as f64) as i64),
        ParameterKind::Vector3 { min, max, .. } => json!([along(min, max), 0.0, -0.25]),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn saving_and_loading_gives_what_the_overrides_give(
        choices in prop::collection::vec((any::<prop::sample::Index>(), 0.0..=1.0f64), 1..6),
    ) {
        let text = own_text();
        let shot = own_loaded(&text, &Edits::default());
        let parameters = parameters(&shot.written, &shot.scene);
        let mut edits = Edits::default();
        for (choice, fraction) in &choices {
            let parameter = choice.get(&parameters);
            edits.set(&parameter.path, between(parameter.kind, *fraction));
        }
        let saved = saved_text(&text, &edits).unwrap();
        prop_assert_eq!(own_loaded(&saved, &Edits::default()).resolved, own_loaded(&text, &edits).resolved);
        prop_assert_eq!(remarks(&saved), remarks(&text));
        // Saved twice is saved once, and lines that hold no edited value are as they were.
        prop_assert_eq!(saved_text(&saved, &edits).unwrap(), saved.clone());
        let kept = text.lines().filter(|line| saved.contains(*line)).count();
        prop_assert!(kept + choices.len() >= text.lines().count());
    }

    #[test]
    fn any_file_takes_a_new_setting_and_keeps_its_remarks(
        lines in prop::sample::subsequence(
            vec![
                "\"fps\": 24", "\"frames\": 10", "\"air\": {\"density\": 2}", "\"contact\": {}",
                "\"dynamics\": {\n // inside\n \"iterations\": 2 /* i */ }", "\"fabrics\": {}",
            ],
            0..6,
        ).prop_shuffle(),
        remark in prop::sample::select(vec!["", " // behind", " /* both */ // behind", "\n\n  // under\n"]),
        is_one_line in any::<bool>(),
        has_trailing_comma in any::<bool>(),
        path in prop::sample::select(vec![
            "view.nu_out", "air.density", "air.tangential_drag", "contact.thickness",
            "dynamics.tolerance", "fabrics.silk.damping", "steps_per_frame", "fps",
        ]),
    ) {
        let (start, end) = if is_one_line { ("", " ") } else { ("\n  ", "\n") };
        // A remark to the end of a line needs that end.
        let remark = if is_one_line { "/* r */" } else { remark };
        let entries: Vec<&str> = std::iter::once("\"shotsilk\": 1").chain(lines).collect();
        let comma = |last: usize| if last + 1 < entries.len() || has_trailing_comma { "," } else { "" };
        let body: String = entries.iter().enumerate()
            .map(|(k, entry)| format!("{start}{entry}{}{remark}", comma(k))).collect();
        let text = format!("{{{body}{end}}}");
        let saved = saved_text(&text, &edits([(path, json!(3))])).unwrap();
        let mut expected = said(&text);
        let group = path.split('.').rev().fold(json!(3), |inner, name| json!({name: inner}));
        merge(&mut expected, group);
        prop_assert_eq!(said(&saved), expected, "{}", saved);
        prop_assert_eq!(remarks(&saved), remarks(&text), "{}", saved);
    }
}

fn merge(below: &mut Value, over: Value) {
    match (below, over) {
        (Value::Object(below), Value::Object(over)) => {
            over.into_iter().for_each(|(name, value)| {
                merge(below.entry(name).or_insert(Value::Null), value);
            })
        }
        (below, over) => *below = over,
    }
}
