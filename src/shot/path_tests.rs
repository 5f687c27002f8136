use std::path::Path;

use glam::{DQuat, DVec2};

use super::*;
use crate::shot::tests::{key, path};

fn assert_near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) < 1e-7, "{a} and {b} differ");
}

/// Reads the format of the shared camera files as far as they use it.
fn keys_from_json(text: &str) -> Vec<CameraKey> {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let json: serde_json::Value =
        serde_json::from_str(&lines.collect::<Vec<_>>().join("\n")).unwrap();
    let vector =
        |v: &serde_json::Value| DVec3::from_array([0, 1, 2].map(|i| v[i].as_f64().unwrap()));
    let read = |k: &serde_json::Value| {
        let fov_y = k["fov_y_deg"].as_f64().unwrap().to_radians();
        CameraKey {
            lens: Lens::FieldOfView { fov_y },
            cut: k["cut"].as_bool().unwrap_or(false),
            ..key(k["frame"].as_f64().unwrap(), vector(&k["eye"]), vector(&k["target"]))
        }
    };
    json["keys"].as_array().unwrap().iter().map(read).collect()
}

#[test]
fn the_solo_dancer_path_has_the_values_expected_of_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/cameras");
    let [json, csv] = ["solo-dancer.camera.json", "solo-dancer.expected.csv"]
        .map(|name| std::fs::read_to_string(folder.join(name)));
    let (Ok(json), Ok(csv)) = (json, csv) else {
        eprintln!("skipped: no camera files in {}", folder.display());
        return;
    };
    let shot = path(keys_from_json(&json));
    let Track::Keys(keys) = &shot.track else { unreachable!() };
    assert_eq!(shot.check(), Ok(()));
    assert_eq!(shot.cuts(), [91.0, 131.0]);
    for row in csv.lines().skip(1) {
        let v: Vec<f64> = row.split(',').map(|v| v.parse().unwrap()).collect();
        let at = interpolated(run_at(keys, Side::At, v[0]), v[0]);
        let Lens::FieldOfView { fov_y } = at.lens else { unreachable!() };
        assert_near(at.eye, DVec3::new(v[1], v[2], v[3]));
        assert_near(at.target, DVec3::new(v[4], v[5], v[6]));
        assert!((fov_y.to_degrees() - v[7]).abs() < 1e-6, "{fov_y} at frame {}", v[0]);
        assert_near(shot.view(v[0]).eye, at.eye);
    }
}

fn cut_path() -> CameraPath {
    let mut keys = vec![
        key(0.0, DVec3::X, DVec3::ZERO),
        key(4.0, DVec3::X * 2.0, DVec3::ZERO),
        key(10.0, DVec3::Y, DVec3::ZERO),
        key(12.0, DVec3::Y * 3.0, DVec3::ZERO),
    ];
    keys[2].cut = true;
    path(keys)
}

#[test]
fn a_cut_holds_the_old_view_until_the_frame_and_shows_the_new_one_from_it() {
    let shot = cut_path();
    for frame in [4.0, 7.0, 9.999] {
        assert_near(shot.view(frame).eye, DVec3::X * 2.0);
    }
    assert_near(shot.view_before(10.0).eye, DVec3::X * 2.0);
    assert_near(shot.view(10.0).eye, DVec3::Y);
    assert_near(shot.view_before(11.0).eye, DVec3::Y * 2.0);
    assert_near(shot.view(100.0).eye, DVec3::Y * 3.0);
    assert_near(shot.view(-3.0).eye, DVec3::X);
}

#[test]
fn the_line_of_the_eye_is_broken_at_cuts() {
    let runs = cut_path().eyes(8..=11);
    assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
}

#[test]
fn the_axes_are_orthonormal_and_back_points_away_from_the_target() {
    let view = cut_path().view(2.5);
    assert_near(view.right.cross(view.up), view.back);
    assert_near(view.back, DVec3::X);
    assert_near(view.up, DVec3::Z);
}

#[test]
fn a_film_back_of_another_aspect_is_fitted_horizontally() {
    let lens = Lens::FilmBack {
        focal_mm: 18.0,
        aperture_mm: DVec2::new(36.0, 24.0),
        offset_mm: DVec2::new(9.0, 0.0),
    };
    let [low, high] = lens.gate(2.0);
    assert_eq!((low, high), (DVec2::new(-0.5, -0.5), DVec2::new(1.5, 0.5)));
}

#[test]
fn anamorphic_pixels_widen_the_gate_and_not_its_height() {
    let mut shot = cut_path();
    let square = shot.view(0.0);
    shot.pixel_aspect = 2.0;
    let wide = shot.view(0.0);
    assert_eq!(wide.gate_max.y, square.gate_max.y);
    assert!((wide.gate_max.x - 2.0 * square.gate_max.x).abs() < 1e-15);
}

fn baked_path() -> CameraPath {
    let lens = Lens::FieldOfView { fov_y: 0.6 };
    let sample = |angle: f64, x: f64| {
        let turned = DQuat::from_rotation_z(angle);
        (DMat4::from_rotation_translation(turned, DVec3::X * x), lens)
    };
    let samples = vec![sample(0.0, 0.0), sample(1.0, 1.0), sample(3.0, 5.0), sample(2.0, 6.0)];
    CameraPath { track: Track::Matrices { samples, cuts: vec![2] }, ..path(Vec::new()) }
}

#[test]
fn a_baked_path_turns_at_even_speed_between_frames() {
    let view = baked_path().view(0.25);
    assert_near(view.eye, DVec3::X * 0.25);
    assert_near(view.right, DQuat::from_rotation_z(0.25) * DVec3::X);
    assert_near(view.back, DVec3::Z);
}

#[test]
fn a_baked_path_holds_until_a_cut_and_outside_its_frames() {
    let shot = baked_path();
    assert_near(shot.view(1.5).eye, DVec3::X);
    assert_near(shot.view_before(2.0).eye, DVec3::X);
    assert_near(shot.view(2.0).eye, DVec3::X * 5.0);
    assert_near(shot.view_before(3.0).eye, DVec3::X * 6.0);
    assert_near(shot.view(40.0).eye, DVec3::X * 6.0);
    assert_near(shot.view(-1.0).eye, DVec3::ZERO);
}

#[test]
fn keys_and_their_baked_matrices_show_the_same() {
    let shot = cut_path();
    let world_from_camera = |frame: u32| {
        let v = shot.view(f64::from(frame));
        let axes = [v.right.extend(0.0), v.up.extend(0.0), v.back.extend(0.0), v.eye.extend(1.0)];
        let [x, y, z, w] = axes;
        (DMat4::from_cols(x, y, z, w), Lens::FieldOfView { fov_y: 40f64.to_radians() })
    };
    let track =
        Track::Matrices { samples: (0..=12).map(world_from_camera).collect(), cuts: vec![10] };
    let baked = CameraPath { track, ..shot.clone() };
    assert_eq!(baked.check(), Ok(()));
    for frame in 0..=12 {
        let (a, b) = (shot.view(f64::from(frame)), baked.view(f64::from(frame)));
        assert_near(a.eye, b.eye);
        assert_near(a.right, b.right);
        assert_near(a.up, b.up);
    }
    assert_near(shot.view_before(10.0).eye, baked.view_before(10.0).eye);
}

#[test]
fn the_lens_at_a_frame_is_the_one_the_view_looks_through() {
    let (eye, target) = (DVec3::new(0.0, -2.0, 1.0), DVec3::ZERO);
    let with_fov = |frame: f64, fov_y: f64| CameraKey {
        lens: Lens::FieldOfView { fov_y },
        ..key(frame, eye, target)
    };
    let path = path(vec![with_fov(0.0, 0.5), with_fov(10.0, 0.9)]);
    for frame in [0.0, 3.5, 10.0, 20.0] {
        let view = path.view(frame);
        assert_eq!(path.lens(frame).gate(960.0 / 540.0), [view.gate_min, view.gate_max]);
    }
    assert_eq!(path.lens(10.0), Lens::FieldOfView { fov_y: 0.9 });
}
