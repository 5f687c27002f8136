//! Cameras of shots.

use glam::DVec3;

use super::{CAMERA, ONE_GARMENT, SHOT, files, load_text, message};
use crate::scene::{LoadOptions, load};
use crate::shot::{Lens, Track};

/// The message for a camera with one thing replaced, given on the command line.
fn camera_message(from: &str, to: &str) -> String {
    assert!(CAMERA.contains(from), "{from}");
    let source = files()
        .with("w/a.json", SHOT.as_bytes())
        .with("other.json", CAMERA.replace(from, to).into_bytes());
    let camera = Some("other.json".into());
    let options = LoadOptions { shot: "w/a.json".into(), camera, ..LoadOptions::default() };
    load(&options, &source).expect_err("the camera is bad").to_string()
}

#[test]
fn bad_cameras_are_answered_with_the_place() {
    for (from, to, expected) in [
        ("\"frame\": 9", "\"frame\": 0", "other.json:5:19: keys.1.frame is 0, but must be greater"),
        ("640", "0", "resolution.0 is 0, but must be at least 1"),
        ("[0, -4, 0]", "[0, 0, 0]", "keys.0.target: eye and target are the same point"),
        ("\"frame\": 9", "\"up\": [0, 1, 0], \"frame\": 9", "keys.1.up: up is parallel"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 180", "keys.0.fov_y_deg is 180, but must be"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 0", "keys.0.fov_y_deg is 0, but must be"),
        ("\"fov_y_deg\": 40", "\"focal_mm\": 35", "keys.0 needs aperture_mm with focal_mm"),
        ("\"fov_y_deg\": 40", "\"aperture_mm\": [3, 2]", "keys.0 needs fov_y_deg or focal_mm"),
        ("\"near\": 0.1", "\"near\": 0", "near is 0, but must be greater than 0"),
        ("\"near\": 0.1", "\"near\": 50", "far is 50, but must be greater than 50"),
        ("\"fps\": 24", "\"fps\": 25", "other.json:2:12: the camera path has 25 frames a second"),
        ("\"fov_y_deg\": 40", "\"fov_y_deg\": 40, \"cut\": true", "the first key is no cut"),
        ("\"far\": 50", "\"far\": 50, \"zoom\": 1", "unknown key \"zoom\""),
        ("\"far\": 50", "\"far\": 50, \"matrices\": []", "has both keys and matrices"),
    ] {
        let error = camera_message(from, to);
        assert!(error.contains(expected), "{to}: {error}");
    }
}

#[test]
fn the_frame_rate_of_the_command_line_ends_the_dispute() {
    let shot = SHOT.replacen("\"view\": {", "\"fps\": 30, \"view\": {", 1);
    let source = files().with("w/a.json", shot.into_bytes());
    let mut options = LoadOptions { shot: "w/a.json".into(), ..LoadOptions::default() };
    assert!(load(&options, &source).is_err());
    options.fps = Some(24.0);
    assert_eq!(load(&options, &source).unwrap().scene.fps, 24.0);
}

#[test]
fn baked_cameras_must_be_rigid_and_keep_their_cuts() {
    let baked = |second: &str| {
        format!(
            r#"{{"shotsilk": 1, {ONE_GARMENT}, "viewers": [{{"resolution": [10, 10], "focal_mm": 35,
            "aperture_mm": [36, 24], "matrices": [
            {{"world_from_camera": [1,0,0,5, 0,0,-1,6, 0,1,0,7, 0,0,0,1]}},
            {{"frame": 1, "matrix": {second}, "fov_y_deg": 30, "cut": true}}]}}]}}"#
        )
    };
    let rows = "[[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]";
    let viewers = load_text(&baked(rows), &[]).unwrap().scene.viewers;
    let Track::Matrices { samples, cuts } = &viewers[0].track else { panic!("{viewers:?}") };
    assert_eq!(cuts, &[1]);
    assert_eq!(samples[0].0.transform_point3(DVec3::Y), DVec3::new(5.0, 6.0, 8.0));
    assert!(matches!(samples[0].1, Lens::FilmBack { focal_mm: 35.0, .. }));
    assert!(matches!(samples[1].1, Lens::FieldOfView { .. }));
    let mirrored = message(&baked("[[-1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]"), &[]);
    assert!(mirrored.contains("matrices.1: the matrix is no rotation"), "{mirrored}");
}
