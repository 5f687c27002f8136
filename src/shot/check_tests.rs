use glam::DVec2;

use super::*;
use crate::shot::tests::{key, path};

fn two_keys() -> Vec<CameraKey> {
    vec![key(0.0, DVec3::X, DVec3::ZERO), key(5.0, DVec3::Y, DVec3::ZERO)]
}

fn flaw_of_keys(change: impl FnOnce(&mut Vec<CameraKey>)) -> CameraPathError {
    let mut keys = two_keys();
    change(&mut keys);
    path(keys).check().unwrap_err()
}

fn flaw_of_path(change: impl FnOnce(&mut CameraPath)) -> CameraPathError {
    let mut shot = path(two_keys());
    change(&mut shot);
    shot.check().unwrap_err()
}

#[test]
fn a_good_path_passes() {
    assert_eq!(path(two_keys()).check(), Ok(()));
}

#[test]
fn an_image_or_a_depth_range_without_extent_is_refused() {
    use CameraPathError as E;
    assert_eq!(flaw_of_path(|p| p.resolution = [0, 5]), E::Resolution { width: 0, height: 5 });
    assert_eq!(flaw_of_path(|p| p.pixel_aspect = 0.0), E::PixelAspect { value: 0.0 });
    assert_eq!(flaw_of_path(|p| p.near = 0.0), E::Near { near: 0.0 });
    assert!(matches!(flaw_of_path(|p| p.near = f64::NAN), E::Near { .. }));
    assert_eq!(flaw_of_path(|p| p.far = p.near), E::Far { near: 0.05, far: 0.05 });
}

#[test]
fn keys_out_of_order_are_refused() {
    use CameraPathError as E;
    assert_eq!(flaw_of_keys(Vec::clear), E::Empty);
    assert_eq!(flaw_of_keys(|k| k[0].cut = true), E::FirstKeyCut { frame: 0.0 });
    assert_eq!(flaw_of_keys(|k| k[1].frame = 0.0), E::Unsorted { previous: 0.0, frame: 0.0 });
    assert_eq!(flaw_of_keys(|k| k[1].frame = -1.0), E::Unsorted { previous: 0.0, frame: -1.0 });
    assert!(matches!(flaw_of_keys(|k| k[1].frame = f64::NAN), E::NonFiniteFrame { index: 1, .. }));
}

#[test]
fn a_key_that_looks_nowhere_is_refused() {
    use CameraPathError as E;
    assert_eq!(flaw_of_keys(|k| k[1].target = k[1].eye), E::EyeAtTarget { frame: 5.0 });
    assert_eq!(flaw_of_keys(|k| k[1].up = DVec3::Y * -3.0), E::UpAlongSight { frame: 5.0 });
    assert_eq!(flaw_of_keys(|k| k[1].up = DVec3::ZERO), E::UpAlongSight { frame: 5.0 });
    assert_eq!(
        flaw_of_keys(|k| k[1].eye.x = f64::INFINITY),
        E::NonFinite { what: "eye", frame: 5.0 }
    );
}

#[test]
fn an_impossible_lens_is_refused() {
    use CameraPathError as E;
    for fov_y in [0.0, -1.0, std::f64::consts::PI] {
        let flaw = flaw_of_keys(|k| k[1].lens = Lens::FieldOfView { fov_y });
        assert!(matches!(flaw, E::FieldOfView { frame: 5.0, .. }));
    }
    let back = |focal_mm: f64, width: f64| Lens::FilmBack {
        focal_mm,
        aperture_mm: DVec2::new(width, 24.0),
        offset_mm: DVec2::ZERO,
    };
    assert!(matches!(
        flaw_of_keys(|k| k[0].lens = back(0.0, 36.0)),
        E::FilmBack { what: "focal length", .. }
    ));
    assert!(matches!(flaw_of_keys(|k| k[0].lens = back(35.0, -1.0)), E::FilmBack { .. }));
    assert_eq!(flaw_of_keys(|k| k[1].lens = back(35.0, 36.0)), E::MixedLenses { frame: 5.0 });
    let mut keys = two_keys();
    keys[1].lens = back(35.0, 36.0);
    keys[1].cut = true;
    assert_eq!(path(keys).check(), Ok(()));
}

fn flaw_of_matrices(matrices: Vec<DMat4>, cuts: Vec<u32>) -> Result<(), CameraPathError> {
    let lens = Lens::FieldOfView { fov_y: 0.6 };
    let samples = matrices.into_iter().map(|m| (m, lens)).collect();
    CameraPath { track: Track::Matrices { samples, cuts }, ..path(Vec::new()) }.check()
}

#[test]
fn a_matrix_which_scales_shears_or_mirrors_is_refused() {
    let still = DMat4::IDENTITY;
    assert_eq!(flaw_of_matrices(vec![still; 3], vec![1, 2]), Ok(()));
    assert_eq!(flaw_of_matrices(Vec::new(), Vec::new()), Err(CameraPathError::Empty));
    for scale in [DVec3::splat(2.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, 1.001, 1.0)] {
        let flaw = flaw_of_matrices(vec![still, DMat4::from_scale(scale)], Vec::new());
        assert!(matches!(flaw, Err(CameraPathError::NotRigid { frame: 1.0, .. })));
    }
    let nan = DMat4::from_translation(DVec3::splat(f64::NAN));
    assert!(matches!(
        flaw_of_matrices(vec![nan], Vec::new()),
        Err(CameraPathError::NonFinite { what: "matrix", .. })
    ));
}

#[test]
fn cuts_of_a_baked_path_must_ascend_within_it() {
    for cuts in [vec![0], vec![3], vec![2, 1], vec![1, 1]] {
        let flaw = flaw_of_matrices(vec![DMat4::IDENTITY; 3], cuts);
        assert!(matches!(flaw, Err(CameraPathError::CutOutOfOrder { last: 2, .. })));
    }
}

#[test]
fn an_error_names_the_thing_the_value_and_the_limit() {
    let flaw = flaw_of_keys(|k| k[1].lens = Lens::FieldOfView { fov_y: std::f64::consts::PI });
    assert_eq!(
        flaw.to_string(),
        "the vertical field of view at frame 5 is 180 degrees: it must be above 0 and below 180"
    );
}
