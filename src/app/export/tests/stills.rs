//! Single pictures, and pages of several.

use super::reel::*;
use crate::app::export::*;
use crate::shot::CameraPath;

#[test]
fn a_still_is_a_picture_of_the_view_with_the_strip_under_it() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let bare = request(ExportKind::Still { frame: 3 }, &to);
    assert_eq!(done(bare.clone(), Reel::new(4)), 1);
    assert_eq!(size_of(&to), (160, 90));
    let picture = image::open(&to).unwrap().into_rgba8();

    done(ExportRequest { burn_in: BurnIn::Strip, ..bare.clone() }, Reel::new(4));
    let page = image::open(&to).unwrap().into_rgba8();
    assert!(page.height() > 90);
    assert!(image::imageops::crop_imm(&page, 0, 0, 160, 90).to_image() == picture);

    done(ExportRequest { view: ExportView::Witness(witness()), ..bare.clone() }, Reel::new(4));
    assert_eq!(size_of(&to), (160, 160), "the witness has a shape of its own");
    done(ExportRequest { view: ExportView::Both(witness()), ..bare }, Reel::new(4));
    assert_eq!(size_of(&to), (328, 90));
    assert_eq!(names(folder.path()), ["still.png"]);
}

#[test]
fn without_a_shot_camera_the_witness_can_be_exported_and_nothing_else() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let reel = || Reel { camera: None, ..Reel::new(2) };
    let bare = request(ExportKind::Still { frame: 1 }, &to);
    let seen = ExportRequest {
        view: ExportView::Witness(witness()),
        burn_in: BurnIn::Strip,
        ..bare.clone()
    };
    assert_eq!(done(seen, reel()), 1);
    assert_eq!(size_of(&to).0, 160);
    for view in [ExportView::Shot, ExportView::Both(witness())] {
        let why = why_not(ExportRequest { view, ..bare.clone() }, reel());
        assert!(why.contains("the shot has no camera"), "{why}");
    }
    let run = request(ExportKind::Run { first: 0, last: 1 }, &folder.path().join("run"));
    assert_eq!(done(run, reel()), 2);
}

#[test]
fn the_witness_needs_no_camera_that_can_be_used_and_its_strip_names_its_own_lens() {
    let folder = folder();
    let to = folder.path().join("still.png");
    let bare = request(ExportKind::Still { frame: 1 }, &to);
    let seen = ExportRequest {
        view: ExportView::Witness(witness()),
        width: 640,
        burn_in: BurnIn::Strip,
        ..bare.clone()
    };
    let unusable = CameraPath { near: -1.0, ..driving_camera() };
    let strip = |camera: Option<CameraPath>| {
        done(seen.clone(), Reel { camera, ..Reel::new(2) });
        let page = image::open(&to).unwrap().into_rgba8();
        image::imageops::crop_imm(&page, 0, 640, 640, page.height() - 640).to_image()
    };
    let [none, broken, other] = [None, Some(unusable.clone()), Some(driving_camera())].map(strip);
    assert!(none.height() > 0 && none == broken && none == other);
    let why = why_not(bare, Reel { camera: Some(unusable), ..Reel::new(2) });
    assert!(why.contains("the shot's camera cannot be used"), "{why}");
}

#[test]
fn a_contact_sheet_shows_both_views_of_its_frames() {
    let folder = folder();
    let to = folder.path().join("sheet.png");
    let what = ExportKind::Sheet { frames: vec![0, 4, 7] };
    let shot_only = request(what, &to);
    let both = ExportRequest { view: ExportView::Both(witness()), ..shot_only.clone() };
    assert_eq!(done(both, Reel::new(8)), 3);
    let (width, height) = size_of(&to);
    assert!(width > 2 * 160 && height > 90, "{width} x {height}");
    assert!(why_not(shot_only, Reel::new(8)).contains("needs a witness"));
}

#[test]
fn a_legend_is_drawn_once_on_a_pair_and_not_into_the_pictures_of_a_sheet() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let drawn = |what: ExportKind, legend_px: Option<f32>| {
        let mut export =
            ExportRequest { view: ExportView::Both(witness()), width: 320, ..request(what, &to) };
        export.options.legend_px = legend_px;
        done(export, Reel::new(2));
        image::open(&to).unwrap().into_rgba8()
    };
    let [with, without] = [Some(9.0), None].map(|l| drawn(ExportKind::Still { frame: 1 }, l));
    let half = |image: &image::RgbaImage, x: u32| {
        image::imageops::crop_imm(image, x, 0, 320, 180).to_image()
    };
    assert!(half(&with, 0) != half(&without, 0) && half(&with, 328) == half(&without, 328));
    let sheet = || ExportKind::Sheet { frames: vec![0, 1] };
    // Captions of the two are equal: these frames took no time.
    assert!(drawn(sheet(), Some(9.0)) == drawn(sheet(), None));
}
