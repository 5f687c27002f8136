//! Scripts replayed in memory: no display is needed.

use std::path::Path;

use serde_json::{Value, json};

use super::picture::{
    CLOTH_LEAST, SHOT, WITNESS, WITNESS_CLOTH_LEAST, blue, differing, screenshot,
};
use super::{preview, preview_on, report, succeeded};

#[test]
fn keys_and_pointer_do_what_the_help_says() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let script = json!([
        {"wait-for-frames": {"first": 0, "last": 2}},
        {"screenshot": {"to": at("before.png")}},
        // On from frame 0, then the witness alone.
        {"press": {"key": "Right"}},
        {"drag": {"from": [700, 300], "to": [820, 320], "button": "primary"}},
        {"press": {"key": "V"}},
        {"wait": {"seconds": 0.2}},
        {"screenshot": {"to": at("after.png")}},
        {"report": {"to": at("report.json")}},
        {"press": {"key": "3"}},
        {"wait": {"seconds": 0.2}},
        {"screenshot": {"to": at("alone.png")}}
    ]);
    succeeded(&preview(folder.path(), &script).output().unwrap());
    let [before, after, alone] =
        ["before.png", "after.png", "alone.png"].map(|name| screenshot(&at(name)));
    assert!(blue(&before, SHOT) > CLOTH_LEAST && blue(&before, WITNESS) > WITNESS_CLOTH_LEAST);
    assert_eq!(report(&at("report.json"))["current"], 1);
    assert!(differing(&before, &after, WITNESS) > 10_000, "the drag has not turned the witness");
    // Edge size has other colours than the view factor.
    assert!(blue(&after, SHOT) < blue(&before, SHOT) / 4);
    assert!(differing(&after, &alone, SHOT) > 20_000);
}

#[test]
fn what_is_kept_as_a_is_seen_through_its_own_camera() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let script = json!([
        {"wait-for-frames": {"first": 0, "last": 0}},
        {"act": {"simulate": {"on": false}}},
        {"act": "keep-as-a"},
        {"act": {"compare": {"wipe": 0.5}}},
        {"screenshot": {"to": at("before.png")}},
        {"act": {"move-camera": {"eye": [1.5, -4.0, 1.4], "target": [0.0, 0.0, 1.0]}}},
        {"act": "set-key"},
        "wait-until-idle",
        {"screenshot": {"to": at("after.png")}}
    ]);
    succeeded(&preview(folder.path(), &script).output().unwrap());
    let [before, after] = ["before.png", "after.png"].map(|name| screenshot(&at(name)));
    // A is left of the middle, B right of it; the line between them lies in neither, nor does what is
    // noted at its lower end.
    let [x0, y0, x1, _] = SHOT;
    let (middle, end) = ((x0 + x1) / 2, y0 + 280);
    let [a, b] = [[x0, y0 + 60, middle - 10, end], [middle + 10, y0 + 60, x1, end]];
    assert_eq!(differing(&before, &after, a), 0, "A is not seen as it was");
    assert!(differing(&before, &after, b) > 1000, "B's camera has not moved");
}

#[test]
fn right_at_twice_the_scale() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("large.png");
    let script = json!([
        {"wait-for-frames": {"first": 0, "last": 0}},
        {"act": {"set-panel": {"panel": "parameters", "open": false}}},
        {"act": {"set-panel": {"panel": "costs", "open": false}}},
        {"screenshot": {"to": to}}
    ]);
    let mut command = preview(folder.path(), &script);
    succeeded(&command.args(["--size", "2560x1440", "--scale", "2"]).output().unwrap());
    let image = image::open(&to).unwrap().to_rgba8();
    assert_eq!([image.width(), image.height()], [2560, 1440]);
    assert!(blue(&image, [0, 120, 1270, 1200]) > 4 * CLOTH_LEAST);
    assert!(blue(&image, [1290, 120, 2550, 1200]) > 4 * WITNESS_CLOTH_LEAST);
}

#[test]
fn a_script_that_cannot_be_done_says_which_step_and_why() {
    let folder = tempfile::tempdir().unwrap();
    let script = json!([{"wait": {"seconds": 0}}, {"press": {"key": "Nonsense"}}]);
    let output = preview(folder.path(), &script).arg("--halted").output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("step 2") && said.contains("\"Nonsense\" is no key"), "{said}");
    let output = preview(folder.path(), &json!([{"jump": 1}])).output().unwrap();
    assert_eq!(output.status.code(), Some(3));
}

#[test]
fn a_shot_that_cannot_be_read_is_said_in_the_window_and_leaves_it_usable() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("bad.json"), "{\"shotsilk\": 1, \"fps\": \"many\"}").unwrap();
    let script = json!([
        {"wait": {"seconds": 0.5}},
        {"report": {"to": at("bad-report.json")}},
        {"act": "dismiss-all"},
        {"act": "open-own"},
        {"wait-for-frames": {"first": 0, "last": 0}},
        {"report": {"to": at("good-report.json")}}
    ]);
    let mut command = preview(folder.path(), &script);
    succeeded(&command.arg(at("bad.json")).output().unwrap());
    let said = report(&at("bad-report.json"))["messages"][0].as_str().unwrap().to_owned();
    assert!(said.contains("bad.json:1:24") && said.contains("expected a number"), "{said}");
    assert!(report(&at("good-report.json"))["statuses"].as_str().unwrap().starts_with('r'));
}

#[test]
fn a_script_whose_shot_cannot_be_read_ends_as_with_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no/shot.json");
    let scripts = [
        json!([]),
        json!([{"act": "play"}]),
        json!([{"wait-for-frames": {"first": 0, "last": 1}}]),
        json!([{"wait": {"seconds": 0.2}}, {"act": "quit"}]),
    ];
    for script in scripts {
        let output = preview(folder.path(), &script).arg(&missing).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{script}: {said}");
        assert!(said.contains("cannot read") && said.contains("no/shot.json"), "{said}");
    }
}

/// With further fields of the export.
fn still(to: &Path, more: Value) -> Value {
    let mut export = json!({
        "kind": "still", "viewport": "shot", "width": 64, "burn-in": false, "to": to
    });
    export.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    json!({"act": {"export": {"export": export}}})
}

#[test]
fn a_script_ends_when_its_exports_are_done_and_fails_if_one_of_them_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("still.png");
    let first = json!({"wait-for-frames": {"first": 0, "last": 0}});
    let halt = json!({"act": {"simulate": {"on": false}}});
    let last = json!({"act": "go-to-end"});
    let good = still(&to, json!({}));
    succeeded(&preview(folder.path(), &json!([first, halt, good])).output().unwrap());
    assert!(image::open(&to).is_ok());
    std::fs::remove_file(&to).unwrap();
    let narrow = still(&to, json!({"width": 1}));
    for (steps, why) in [
        (json!([first, halt, narrow]), "cannot be 1 px wide"),
        (json!([first, halt, last, good]), "is not simulated yet"),
        (json!([first, halt, last, good, {"wait": {"seconds": 0.1}}]), "is not simulated yet"),
    ] {
        let output = preview(folder.path(), &steps).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{steps}: {said}");
        assert!(said.contains("not exported") && said.contains(why), "{said}");
        assert!(!to.exists(), "{steps}");
    }
}

#[test]
fn a_script_writes_over_files_only_if_it_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("still.png");
    let still = |more| still(&to, more);
    let first = json!({"wait-for-frames": {"first": 0, "last": 0}});
    let halt = json!({"act": {"simulate": {"on": false}}});
    let run = |steps: &[Value]| preview(folder.path(), &json!(steps)).output().unwrap();
    let idle = json!("wait-until-idle");
    succeeded(&run(&[first.clone(), halt.clone(), still(json!({})), idle.clone()]));
    std::fs::write(&to, "another").unwrap();
    for steps in [
        vec![first.clone(), halt.clone(), still(json!({})), idle.clone()],
        // Even if it does not look whether it is done.
        vec![first.clone(), halt.clone(), still(json!({}))],
    ] {
        let output = run(&steps);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("still.png") && said.contains("\"overwrite\": true"), "{said}");
        assert_eq!(std::fs::read(&to).unwrap(), b"another");
    }
    succeeded(&run(&[first, halt, still(json!({"overwrite": true})), idle]));
    assert!(image::open(&to).is_ok());
}

#[test]
fn without_an_adapter_or_a_display_it_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let script = json!([]);
    let none = preview_on("no such card", folder.path(), &script).output().unwrap();
    assert_eq!(none.status.code(), Some(4));
    let mut command = preview(folder.path(), &script);
    command.args(["--replay-in", "window"]).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    if cfg!(target_os = "linux") {
        assert_eq!(output.status.code(), Some(1));
        assert!(said.contains("there is no display"), "{said}");
    }
}
