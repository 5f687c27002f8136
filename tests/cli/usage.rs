//! Command lines that make no sense end with 2 before anything is read or written; help and schema
//! go to stdout.

use std::process::Stdio;

use super::program;
use super::small_shot::SmallShot;

#[test]
fn wrong_command_lines_are_refused_with_what_would_have_been_right() {
    let shot = SmallShot::new();
    let before = shot.names("");
    for (line, parts) in [
        ("simulat shot.json", &["'simulat'", "'simulate'"][..]),
        ("simulate shot.json", &["--out"]),
        ("simulate shot.json --output run", &["'--output'", "'--out'"]),
        ("simulate shot.json --out run --frames 3..1", &["'3..1'", "frame 3 is after the last, 1"]),
        ("simulate shot.json --out run --frames 1-3", &["\"1-3\" is not a frame number"]),
        ("simulate shot.json --out run --sizing fine", &["'fine'", "uniform, adaptive, view"]),
        ("simulate shot.json --out run --threads 0", &["\"0\" is not a whole number from 1"]),
        ("simulate shot.json --out run --edge-length -0.1", &["-0.1 m is not a length above 0"]),
        ("simulate shot.json --out run --edge-length 0.1", &["needs --sizing uniform"]),
        ("simulate shot.json --out run --fps -24", &["-24 frames a second are not a rate above"]),
        ("simulate shot.json --out run --fps NaN", &["NaN frames a second"]),
        ("simulate shot.json --out run --set view.nu_out", &["path.to.field=value"]),
        ("simulate shot.json --out run --resume --overwrite", &["'--resume'", "'--overwrite'"]),
        ("simulate . --out run", &["\".\" is a folder", "a shot is a file"]),
        ("render shot.json --out a --view side", &["'side'", "shot, witness, both"]),
        ("render shot.json --out a --every 0", &["\"0\" is not a whole number from 1"]),
        ("render shot.json --out a --width 1", &["\"1\" is not a whole number from 16 to 16384"]),
        ("render shot.json --out a --witness 1,2,3", &["'1,2,3'", "':'"]),
        ("sheet shot.json --out a.png --columns 0", &["\"0\" is not a whole number from 1 to 64"]),
        ("sheet shot.json --out a.png --log xml", &["'xml'", "text, json"]),
    ] {
        shot.run(line).fails(2, parts);
    }
    assert_eq!(shot.names(""), before);
}

#[test]
fn a_shot_ends_with_its_camera_and_asks_for_frames_where_nothing_ends() {
    let shot = SmallShot::new();
    shot.replace("shot.json", "\"frames\": 4,", "");
    shot.run("simulate shot.json --out of-camera").succeeds();
    assert_eq!(shot.reader("of-camera").last_frame(), Some(4));
    shot.run("simulate shot.json --out longer --set frames=9").succeeds();
    assert_eq!(shot.reader("longer").last_frame(), Some(4));
    shot.replace("shot.json", "\"camera\": \"main.camera.json\",", "");
    shot.run("simulate shot.json --out run").fails(2, &["\"shot.json\"", "--frames"]);
    assert!(!shot.path("run").exists());
}

#[test]
fn every_command_explains_itself() {
    let shot = SmallShot::new();
    let help = shot.run("--help").succeeds().stdout;
    for command in ["simulate", "render", "sheet", "schema"] {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
        let usage = shot.run(&format!("{command} --help")).succeeds().stdout;
        assert!(usage.contains("Usage: shotsilk"), "{usage}");
    }
    assert!(shot.run("--version").succeeds().stdout.starts_with("shotsilk "));
}

#[test]
fn the_schema_is_json_and_a_reader_may_leave_early() {
    let shot = SmallShot::new();
    let schema: serde_json::Value =
        serde_json::from_str(&shot.run("schema").succeeds().stdout).unwrap();
    assert!(schema["properties"]["garments"].is_object());
    let mut child = program::command(shot.folder(), "schema")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert!(output.status.success());
}

#[test]
fn logs_are_lines_objects_or_silent() {
    let shot = SmallShot::new();
    let line = "simulate shot.json --frames 1 --out";
    let text = shot.run(&format!("{line} text")).succeeds().stderr;
    assert!(text.starts_with("frame 0 (1 of 2): "), "{text}");
    assert_eq!(shot.run(&format!("{line} quiet --quiet")).succeeds().stderr, "");
    let json = shot.run(&format!("{line} json --log json")).succeeds().stderr;
    let events: Vec<serde_json::Value> =
        json.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(events.len(), 3, "two frames and the sum");
    assert!(events[..2].iter().all(|event| event["total"] == 2));
    assert!(events[2]["message"].as_str().unwrap().starts_with("1 frames; faces"));
}
