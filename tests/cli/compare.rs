//! `compare`: runs and pictures held against one another.

use std::fs;

use image::{Rgba, RgbaImage};
use serde_json::Value;

use super::small_shot::SmallShot;

/// A shot with a run of uniform cloth, and a coarser one of the same shot.
fn two_runs() -> SmallShot {
    let shot = SmallShot::new();
    for (run, edge_length) in [("fine", 0.1), ("coarse", 0.4)] {
        let line = format!("--sizing uniform --edge-length {edge_length}");
        shot.run(&format!("simulate shot.json {line} --out {run}")).succeeds();
    }
    shot
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("it is JSON")
}

/// A picture of one colour with a stripe so many pixels from the left.
fn picture(shot: &SmallShot, name: &str, stripe: u32) {
    let colour = |x, _| if x / 4 == stripe / 4 { Rgba([220, 40, 40, 255]) } else { Rgba([90; 4]) };
    let path = shot.path(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    RgbaImage::from_fn(40, 30, colour).save(path).unwrap();
}

#[test]
fn a_run_does_not_differ_from_itself_and_a_coarser_one_does() {
    let shot = two_runs();
    let same = json(&shot.run("compare fine fine --json -").succeeds().stdout);
    assert_eq!(same["items"].as_array().unwrap().len(), 5);
    let largest = same["largest"].as_object().unwrap();
    assert!(largest.len() > 5 && largest.values().all(|value| *value == 0.0), "{same}");

    let other = json(&shot.run("compare fine coarse --json -").succeeds().stdout);
    assert!(other["largest"]["rms_px"].as_f64().unwrap() > 0.1, "{other}");
    assert_eq!(other["items"][0].get("popping_rms_px"), None, "frame 0 has none before");
    assert!(other["items"][1]["popping_rms_px"].is_number());
}

#[test]
fn a_limit_that_is_exceeded_is_exit_code_6_and_every_output_is_whole() {
    let shot = two_runs();
    shot.write("strict.json", r#"{"rms_px": 0.001}"#);
    shot.write("loose.json", r#"{"rms_px": 1000, "silhouette_share": 1}"#);
    shot.run("compare fine coarse --tolerance loose.json").succeeds();
    let line = "compare fine coarse --tolerance strict.json --frames 2..3 --scale 0.5 \
                --diff d.png --json d.json --junit d.xml --csv d.csv";
    let outcome = shot.run(line);
    assert_eq!(outcome.code, Some(6), "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("differs from \"fine\" in 2 of 2 frames"),
        "{}",
        outcome.stderr
    );
    assert!(outcome.stdout.contains("allowed is 0.001"), "{}", outcome.stdout);
    assert_eq!(json(&shot.text("d.json"))["passed"], Value::Bool(false));
    assert_eq!(shot.text("d.xml").matches("<failure").count(), 2);
    assert_eq!(shot.text("d.csv").lines().count(), 3);
    let page = image::image_dimensions(shot.path("d.png")).unwrap();
    assert_eq!(page, (3 * 160 + 2 * 8, 90));
}

#[test]
fn a_limit_that_means_nothing_is_told_of_and_refused_if_there_is_no_other() {
    let shot = two_runs();
    picture(&shot, "a.png", 8);
    shot.write("both.json", r#"{"share": 0, "rms_px": 1000}"#);
    shot.write("share.json", r#"{"levels": 4, "share": 0}"#);
    shot.write("rms.json", r#"{"rms_px": 0}"#);
    for (pair, idle) in [("fine coarse", "share"), ("a.png a.png", "rms_px")] {
        let said = shot.run(&format!("compare {pair} --tolerance both.json")).succeeds().stderr;
        assert!(said.contains(&format!("\"both.json\" limits {idle}, which")), "{said}");
    }
    shot.run("compare fine coarse --tolerance share.json")
        .fails(3, &["\"share.json\"", "limits only what runs do not have: share"]);
    shot.run("compare a.png a.png --tolerance rms.json")
        .fails(3, &["limits only what pictures do not have: rms_px"]);
}

#[test]
fn the_progress_of_a_comparison_is_its_own() {
    let shot = two_runs();
    let said = shot.run("compare fine coarse --frames 1 --log json").succeeds().stderr;
    let event = json(said.lines().last().unwrap());
    assert_eq!((&event["frame"], &event["message"]), (&1.into(), &"frame done".into()));
    let (seconds, run) = (event["seconds"].as_f64().unwrap(), shot.reader("fine"));
    assert!(seconds > 0.0 && seconds != run.frame(1).unwrap().report.stages.total());
}

#[test]
fn a_floor_as_high_as_the_error_is_chaos() {
    let shot = two_runs();
    shot.write("strict.json", r#"{"rms_px": 0.001}"#);
    let line = "compare fine coarse --floor coarse --tolerance strict.json --frames 2..4 --json -";
    let outcome = shot.run(line);
    assert_eq!(outcome.code, Some(6), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("nothing was judged"), "{}", outcome.stderr);
    let all = json(&outcome.stdout);
    assert_eq!(all["passed"], Value::Bool(false));
    assert!(all["items"].as_array().unwrap().iter().all(|i| i["judged"] == Value::Bool(false)));
    let line = "compare fine coarse --floor fine --tolerance strict.json --frames 2..4";
    let outcome = shot.run(line);
    assert_eq!(outcome.code, Some(6));
    assert!(
        outcome.stderr.contains("differs from \"fine\" in 3 of 3 frames"),
        "{}",
        outcome.stderr
    );
}

#[test]
fn a_run_that_is_within_passes_whatever_its_floor() {
    let shot = two_runs();
    shot.write("strict.json", r#"{"rms_px": 0.001}"#);
    for tolerance in ["", "--tolerance strict.json"] {
        let line = format!("compare fine fine --floor coarse --json - {tolerance}");
        let all = json(&shot.run(&line).succeeds().stdout);
        assert!(all["items"].as_array().unwrap().iter().all(|i| i["judged"] == Value::Bool(true)));
    }
}

#[test]
fn a_frame_that_only_one_run_has_is_a_difference() {
    let shot = two_runs();
    shot.run("simulate shot.json --sizing uniform --edge-length 0.1 --frames 2 --out short")
        .succeeds();
    shot.run("compare fine short --frames 1..2").succeeds();
    for (line, fault, count) in [
        ("compare fine short", "only in A", "2 of 5"),
        ("compare short fine", "only in B", "2 of 5"),
        ("compare fine short --frames 2..3", "only in A", "1 of 2"),
        ("compare fine short --frames 3..4", "only in A", "2 of 2"),
    ] {
        let outcome = shot.run(line);
        assert_eq!(outcome.code, Some(6), "{}", outcome.stderr);
        assert!(outcome.stdout.contains(fault), "{}", outcome.stdout);
        assert!(outcome.stderr.contains(&format!("{count} frames")), "{}", outcome.stderr);
    }
    fs::remove_file(shot.path("short/frames/000001.sfr")).unwrap();
    let outcome = shot.run("compare fine short --frames 0..2");
    assert_eq!(outcome.code, Some(6), "a gap within the range: {}", outcome.stderr);
    shot.run("compare short short --frames 0..2").fails(3, &["no frame 1"]);
}

#[test]
fn frames_that_the_floor_lacks_are_judged_until_chaos_comes() {
    let shot = two_runs();
    shot.write("strict.json", r#"{"rms_px": 0.001}"#);
    shot.run("simulate shot.json --sizing uniform --edge-length 0.4 --frames 2 --out short")
        .succeeds();
    let judged = |frames: &str| -> Vec<bool> {
        let line = format!(
            "compare fine coarse --floor short --tolerance strict.json --frames {frames} --json -"
        );
        let outcome = shot.run(&line);
        assert_eq!(outcome.code, Some(6), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("they have no floor"), "{}", outcome.stderr);
        let items = json(&outcome.stdout)["items"].as_array().unwrap().clone();
        items.iter().map(|item| item["judged"].as_bool().unwrap()).collect()
    };
    assert_eq!(judged("3..4"), [true, true]);
    assert_eq!(judged("2..4"), [false, false, false]);
}

#[test]
fn another_camera_is_said_and_other_cloth_or_time_is_refused() {
    let shot = two_runs();
    let camera = shot.text("main.camera.json").replace("-3, 1.5", "-2, 1.5");
    shot.write("other.camera.json", &camera);
    let simulate = "simulate shot.json --sizing uniform --frames 1 --out";
    shot.run(&format!("{simulate} moved --camera other.camera.json")).succeeds();
    let outcome = shot.run("compare fine moved --frames 1").succeeds();
    assert!(outcome.stderr.contains("was made for another camera"), "{}", outcome.stderr);

    shot.run(&format!("{simulate} slow --fps 12")).succeeds();
    shot.run("compare fine slow").fails(3, &["\"slow\" has 12 frames a second, \"fine\" has 24"]);
    shot.run(&format!("{simulate} renamed --set garments.0.name=cape")).succeeds();
    shot.run("compare fine renamed").fails(3, &["cape", "not of one shot"]);
    shot.run("compare fine coarse --frames 2..9").fails(3, &["no frame 5"]);
}

#[test]
fn pictures_are_compared_alone_and_by_the_folder() {
    let shot = SmallShot::new();
    for (name, stripe) in [("a/1.png", 8), ("a/2.png", 8), ("b/1.png", 8), ("b/2.png", 12)] {
        picture(&shot, name, stripe);
    }
    shot.write("limits.json", r#"{"levels": 4, "share": 0.1}"#);
    shot.run("compare a/1.png b/1.png --tolerance limits.json").succeeds();
    let line = "compare a/1.png b/2.png --tolerance limits.json --diff d.png";
    let outcome = shot.run(line);
    assert_eq!(outcome.code, Some(6), "{}", outcome.stderr);
    assert!(outcome.stdout.contains("share is 0.2000"), "{}", outcome.stdout);
    assert_eq!(image::image_dimensions(shot.path("d.png")).unwrap(), (3 * 40 + 2 * 8, 30));

    let folders = json(&shot.run("compare a b --json -").succeeds().stdout);
    assert_eq!(folders["items"][0]["flip"], 0.0);
    assert!(folders["items"][1]["flip"].as_f64().unwrap() > 0.01);
    picture(&shot, "a/3.png", 8);
    assert_eq!(shot.run("compare a b").code, Some(6), "a picture that is gone is a difference");
}

#[test]
fn blessing_copies_pictures_and_nothing_else() {
    let shot = SmallShot::new();
    for (name, stripe) in [("a/1.png", 8), ("a/2.png", 8), ("b/1.png", 8), ("b/2.png", 12)] {
        picture(&shot, name, stripe);
    }
    picture(&shot, "a/old.png", 4);
    picture(&shot, "b/new.png", 4);
    shot.write("b/tolerance.json", "{}");
    let said = shot.run("compare a b --bless").succeeds().stdout;
    let expected =
        ["1.png: the same", "2.png: replaced", "new.png: added", "old.png: left as it is"];
    for (line, expected) in said.lines().zip(expected) {
        assert!(line.starts_with(expected), "{said}");
    }
    assert_eq!(shot.names("a"), ["1.png", "2.png", "new.png", "old.png"]);
    assert_eq!(fs::read(shot.path("a/2.png")).unwrap(), fs::read(shot.path("b/2.png")).unwrap());
}

#[test]
fn what_cannot_be_compared_is_bad_input_and_leaves_nothing() {
    let shot = two_runs();
    picture(&shot, "a.png", 8);
    shot.write("bad.png", "no picture");
    shot.write("bad.json", r#"{"rms": 1}"#);
    let before = shot.names("");
    for (line, part) in [
        ("compare fine none", "\"none\""),
        ("compare fine a.png", "only like is compared with like"),
        ("compare a.png bad.png --json d.json", "\"bad.png\""),
        ("compare a.png a.png --tolerance bad.json", "bad.json:1:2: unknown key \"rms\""),
        ("compare a.png bad.png --bless", "\"bad.png\""),
    ] {
        shot.run(line).fails(3, &[part]);
    }
    for (line, part) in [
        ("compare fine coarse --bless", "not runs"),
        ("compare a.png a.png --frames 3", "--frames needs two runs"),
    ] {
        shot.run(line).fails(2, &[part]);
    }
    assert_eq!(shot.names(""), before);
}
