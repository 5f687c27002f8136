//! Camera files that are not as they must be.

use super::small_shot::{SmallShot, refused_after};

#[track_caller]
fn camera_is_refused(from: &str, to: &str, parts: &[&str]) {
    refused_after("main.camera.json", from, to, parts);
}

#[test]
fn keys_must_ascend() {
    for (frame, limit) in [("0", "is 0, but must be greater than 0"), ("-3", "is -3, but must be")]
    {
        let parts = ["main.camera.json:5:19: keys.1.frame", limit];
        camera_is_refused("\"frame\": 4", &format!("\"frame\": {frame}"), &parts);
    }
}

#[test]
fn an_image_needs_pixels() {
    let parts = ["main.camera.json:2:31: resolution.0 is 0", "at least 1"];
    camera_is_refused("[320, 180]", "[0, 180]", &parts);
    camera_is_refused("[320, 180]", "[320, -180]", &["main.camera.json:2:", "found -180"]);
    let parts = ["pixel_aspect is 0", "greater than 0"];
    camera_is_refused("\"near\"", "\"pixel_aspect\": 0, \"near\"", &parts);
}

#[test]
fn a_camera_must_look_somewhere() {
    let same = ["main.camera.json:4:", "keys.0.target", "eye and target are the same point"];
    camera_is_refused("\"eye\": [0.5, -3, 1.5]", "\"eye\": [0.5, 0.5, 0.7]", &same);
    let up = "\"up\": [0, 3.5, -0.8], \"eye\": [0.5, -3, 1.5]";
    let parallel = ["keys.0.up", "up is parallel to the view direction"];
    camera_is_refused("\"eye\": [0.5, -3, 1.5]", up, &parallel);
    camera_is_refused("\"near\": 0.1", "\"near\": 50", &["far is 50", "greater than 50"]);
    let wide = ["keys.0.fov_y_deg is 180", "less than 180"];
    camera_is_refused("\"fov_y_deg\": 40", "\"fov_y_deg\": 180", &wide);
}

#[test]
fn frame_rates_that_disagree_are_settled_on_the_command_line() {
    let shot = SmallShot::new();
    shot.replace("main.camera.json", "\"fps\": 24", "\"fps\": 25");
    let parts = ["main.camera.json:2:12", "25 frames a second", "scene has 24", "--fps"];
    shot.is_refused(&parts);
    shot.run("simulate shot.json --out run --fps 25 --frames 1").succeeds();
    assert_eq!(shot.reader("run").info().fps, 25.0);
    shot.run("sheet run --out sheet.png --every 1").succeeds();
}

#[test]
fn a_camera_on_the_command_line_is_checked_as_well() {
    let shot = SmallShot::new();
    shot.is_refused_with("--camera none.json", &["cannot read \"none.json\""]);
    shot.write("other.json", "{\"keys\": []}");
    shot.is_refused_with(
        "--camera other.json",
        &["other.json:1:1", "the key \"resolution\" is missing"],
    );
    shot.is_refused_with("--camera cloth.obj", &["cloth.obj:1:"]);
}
