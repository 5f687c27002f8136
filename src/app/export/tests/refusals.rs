//! What cannot be exported, in words.

use std::fs;

use super::reel::*;
use crate::app::export::*;

#[test]
fn what_is_in_the_way_of_an_export_is_said() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let still = request(ExportKind::Still { frame: 1 }, &to);
    assert_eq!(in_the_way(&still, FIRST_FRAME), None);
    fs::write(&to, "").unwrap();
    assert!(in_the_way(&still, FIRST_FRAME).unwrap().contains("a.png"));
    let sequence = request(ExportKind::Sequence { first: 1, last: 3, stride: 1 }, folder.path());
    // Another view's pictures, and other frames.
    for name in ["1001.witness.png", "1000.shot.png", "1005.shot.png"] {
        fs::write(folder.path().join(name), "").unwrap();
    }
    assert_eq!(in_the_way(&sequence, FIRST_FRAME), None);
    fs::write(folder.path().join("1003.shot.png"), "").unwrap();
    assert!(in_the_way(&sequence, FIRST_FRAME).unwrap().contains("holds 1 of"));
    // They cannot be written over, which is said by who tries to.
    let still = request(ExportKind::Still { frame: 1 }, folder.path());
    assert_eq!(in_the_way(&still, FIRST_FRAME), None);
    let sequence = request(ExportKind::Sequence { first: 1, last: 3, stride: 1 }, &to);
    assert_eq!(in_the_way(&sequence, FIRST_FRAME), None);
}

#[test]
fn bad_requests_are_refused_in_words_and_leave_nothing() {
    let folder = folder();
    let to = folder.path().join("a.png");
    let still = request(ExportKind::Still { frame: 0 }, &to);
    for width in [0, WIDTH_MIN - 1, WIDTH_MAX + 1] {
        let why = why_not(ExportRequest { width, ..still.clone() }, Reel::new(1));
        assert!(why.contains(&format!("{width} px wide")), "{why}");
    }
    let cases = [
        (ExportKind::Still { frame: 0 }, folder.path().join("a.jpg"), ".png"),
        (ExportKind::Sheet { frames: vec![] }, to.clone(), "at least one frame"),
        (ExportKind::Sequence { first: 3, last: 2, stride: 1 }, to.clone(), "after the last"),
        (ExportKind::Sequence { first: 0, last: 2, stride: 0 }, to.clone(), "step"),
    ];
    for (what, path, wanted) in cases {
        let why = why_not(request(what.clone(), &path), Reel::new(1));
        assert!(why.contains(wanted), "{what:?}: {why}");
    }
    let huge = ExportRequest {
        view: ExportView::Both(witness()),
        width: 4_096,
        ..request(ExportKind::Sheet { frames: (0..100).collect() }, &to)
    };
    assert!(why_not(huge, Reel::new(1)).contains("400 million are possible"));
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_adapter_that_is_not_there_is_named() {
    let folder = folder();
    let still = request(ExportKind::Still { frame: 0 }, &folder.path().join("a.png"));
    let adapter = AdapterChoice::Named("no such card".to_owned());
    let job = start(still, Box::new(Reel::new(1)), adapter, Arc::new(|| ()));
    let ExportState::Failed(why) = end_of(&job).state else { panic!() };
    assert!(why.contains("no such card"), "{why}");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_supply_that_panics_ends_the_export_in_words() {
    let job = job::start("a.png".into(), Arc::new(|| ()), |_| panic!("the supply is gone"));
    let ExportState::Failed(why) = end_of(&job).state else { panic!() };
    assert!(why.contains("the supply is gone"), "{why}");
}
