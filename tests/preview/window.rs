//! A real window under Xvfb, with the software adapter.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};

use super::picture::{
    CLOTH_LEAST, SHOT, WITNESS, WITNESS_CLOTH_LEAST, blue, cloth, differing, screenshot,
};
use super::{preview, report, succeeded};

/// A display that nobody sees; it goes with this.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp", "-ac"])
            // It would begin anew whenever the last program leaves, and refuse others meanwhile.
            .arg("-noreset")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts: install the package xvfb");
        let mut number = String::new();
        let out = server.stdout.take().expect("its output is piped");
        BufReader::new(out).read_line(&mut number).expect("it says its number");
        Self { server, name: format!(":{}", number.trim()) }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

#[test]
fn the_own_shot_is_opened_played_scrubbed_tuned_keyed_undone_and_exported_in_a_window() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let script = json!([
        {"wait-for-frames": {"first": 0, "last": 20}},
        {"act": "play"},
        {"wait-until-shown": {"frame": 20}},
        {"act": "pause"},
        {"act": {"go-to": {"frame": 20}}},
        {"screenshot": {"to": at("played.png")}},
        {"act": {"go-to": {"frame": 4}}},
        {"screenshot": {"to": at("scrubbed.png")}},
        {"report": {"to": at("before.json")}},
        {"act": {"set": {"path": "view.nu_out", "value": 0.1}}},
        {"wait-for-frames": {"first": 5, "last": 7}},
        {"report": {"to": at("tuned.json")}},
        {"act": {"move-camera": {"eye": [1.5, -4.0, 1.4], "target": [0.0, 0.0, 1.0]}}},
        {"act": "set-key"},
        {"wait-for-frames": {"first": 5, "last": 5}},
        {"screenshot": {"to": at("keyed.png")}},
        {"report": {"to": at("keyed.json")}},
        {"act": "undo"},
        {"act": "undo"},
        {"wait-for-frames": {"first": 0, "last": 20}},
        {"act": {"simulate": {"on": false}}},
        {"screenshot": {"to": at("undone.png")}},
        {"report": {"to": at("undone.json")}},
        {"act": {"export": {"export": {
            "kind": "still", "viewport": "both", "width": 480, "burn-in": true,
            "to": at("still.png")
        }}}},
        "wait-until-idle",
        {"act": "quit"}
    ]);
    let display = Display::start();
    let mut command = preview(folder.path(), &script);
    command.args(["--replay-in", "window"]).env("DISPLAY", &display.name);
    command.env_remove("WAYLAND_DISPLAY");
    succeeded(&command.output().unwrap());

    let [played, scrubbed, keyed, undone] =
        ["played.png", "scrubbed.png", "keyed.png", "undone.png"].map(|name| screenshot(&at(name)));
    // The key shows a side that frame 4 was not made for: it is as pale as what the witness sees.
    for (image, least) in [
        (&played, CLOTH_LEAST),
        (&scrubbed, CLOTH_LEAST),
        (&keyed, WITNESS_CLOTH_LEAST),
        (&undone, CLOTH_LEAST),
    ] {
        assert!(cloth(image, SHOT) > least, "no cloth in the shot's view");
        assert!(cloth(image, WITNESS) > WITNESS_CLOTH_LEAST, "no cloth in the witness's view");
    }
    assert!(differing(&played, &scrubbed, SHOT) > 1000);
    assert!(differing(&scrubbed, &keyed, SHOT) > 5000, "the key has not moved the camera");
    assert_eq!(differing(&scrubbed, &undone, SHOT), 0, "undone, the picture is another");

    let [before, tuned, keyed, undone] =
        ["before.json", "tuned.json", "keyed.json", "undone.json"].map(|name| report(&at(name)));
    assert_eq!(before["current"], 4);
    let statuses = tuned["statuses"].as_str().unwrap();
    assert!(statuses.starts_with("sssssmmm"), "{statuses}");
    assert!(keyed["edits"]["camera"]["keys"].as_array().unwrap().len() > 5);
    assert_eq!(undone["edits"], json!({}));
    assert_eq!(
        undone["keys"].as_array().unwrap()[..=20],
        before["keys"].as_array().unwrap()[..=20]
    );
    let still = image::open(at("still.png")).unwrap().to_rgba8();
    assert!(blue(&still, [0, 0, still.width(), still.height()]) > 1000);
}

#[test]
fn a_window_destroyed_from_outside_ends_the_program_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let script = json!([{"wait-for-frames": {"first": 0, "last": 2}}, {"wait": {"seconds": 60}}]);
    let display = Display::start();
    let mut command = preview(folder.path(), &script);
    command.args(["--replay-in", "window"]).env("DISPLAY", &display.name);
    command.env_remove("WAYLAND_DISPLAY").stderr(Stdio::piped());
    let program = command.spawn().unwrap();
    let closed = Command::new("sh")
        .arg("-c")
        .arg("xdotool search --sync --name ' - Shotsilk' windowclose")
        .env("DISPLAY", &display.name)
        .status();
    assert!(closed.expect("xdotool closes windows: install the package xdotool").success());
    let output = program.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("the window was destroyed from outside"), "{said}");
    assert!(!said.contains("panicked"), "{said}");
}

#[test]
fn real_keys_reach_the_program_and_closing_ends_it_at_once() {
    let report = report_after("xdotool search --name Shotsilk windowfocus && xdotool key End");
    assert_eq!(report["current"], 100, "the key End has not reached the program");
}

#[test]
fn a_drag_that_is_over_before_the_next_redraw_is_not_lost() {
    let drag = "xdotool mousemove 100 662 sleep 0.1 mousedown 1 mousemove 640 662 mouseup 1";
    let report = report_after(drag);
    let current = report["current"].as_u64().unwrap();
    assert!((45..=55).contains(&current), "scrubbed to the middle, it stands at {current}");
}

/// Where the program stands in its window after something has been done there again and again: the first
/// times come before the window listens; without a window manager nobody else gives it the focus.
fn report_after(done: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("report.json");
    let script = json!([
        {"wait-for-frames": {"first": 0, "last": 3}},
        {"wait": {"seconds": 4}},
        {"report": {"to": to}}
    ]);
    let display = Display::start();
    let mut command = preview(folder.path(), &script);
    command.args(["--replay-in", "window"]).env("DISPLAY", &display.name);
    command.env_remove("WAYLAND_DISPLAY");
    let mut program = command.spawn().unwrap();
    let again = format!("for i in $(seq 1 200); do {done}; sleep 0.1; done");
    let doing = Command::new("sh")
        .arg("-c")
        .arg(again)
        .env("DISPLAY", &display.name)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let mut doing = doing.expect("xdotool does what a user would: install the package xdotool");
    let status = program.wait().unwrap();
    let _ = doing.kill();
    let _ = doing.wait();
    assert!(status.success(), "{status}");
    report(&to)
}
