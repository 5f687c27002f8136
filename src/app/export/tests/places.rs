//! Where exports go: the same for all kinds.

use std::fs;
use std::path::Path;

use super::reel::*;
use crate::app::export::*;

/// One of each kind, of two frames where it may have several, by a name that suits it.
fn kinds() -> [(ExportKind, &'static str); 5] {
    [
        (ExportKind::Still { frame: 0 }, "still.png"),
        (ExportKind::Sheet { frames: vec![0, 1] }, "sheet.png"),
        (ExportKind::Video { first: 0, last: 1 }, "film.mp4"),
        (ExportKind::Sequence { first: 0, last: 1, stride: 1 }, "pictures"),
        (ExportKind::Run { first: 0, last: 1 }, "run"),
    ]
}

fn of_both(what: ExportKind, to: &Path) -> ExportRequest {
    let view = ExportView::Both(witness());
    ExportRequest { view, ffmpeg: fake_ffmpeg("whole"), ..request(what, to) }
}

#[test]
fn folders_that_are_missing_are_made_whatever_the_kind() {
    for (what, name) in kinds() {
        let folder = folder();
        let to = folder.path().join("no/such").join(name);
        done(of_both(what, &to), Reel::new(2));
        assert!(to.exists(), "{name}");
        assert_eq!(names(&folder.path().join("no/such")), [name]);
    }
}

#[test]
fn folders_that_an_export_made_go_with_it_when_it_fails() {
    // A run folder stays, as that of any run that is broken off.
    for (what, name) in kinds().into_iter().take(4) {
        let folder = folder();
        let to = folder.path().join("no/such").join(name);
        let why = why_not(of_both(what, &to), Reel::new(0));
        assert!(why.contains("not simulated yet"), "{name}: {why}");
        assert!(names(folder.path()).is_empty(), "{name}");
    }
}

#[test]
fn a_path_through_a_file_is_refused_with_the_name_of_the_file() {
    for (what, name) in kinds() {
        let folder = folder();
        let occupied = folder.path().join("file");
        fs::write(&occupied, "x").unwrap();
        let why = why_not(of_both(what, &occupied.join("sub").join(name)), Reel::new(2));
        assert!(why.contains(&format!("{:?} is a file", occupied.display())), "{name}: {why}");
        assert_eq!(fs::read(&occupied).unwrap(), b"x");
        assert_eq!(names(folder.path()), ["file"]);
    }
}

#[test]
fn what_is_no_folder_or_is_one_where_a_file_should_be_is_named_and_stays() {
    for (what, name) in kinds() {
        let folder = folder();
        let to = folder.path().join(name);
        let wanted = match what {
            ExportKind::Sequence { .. } | ExportKind::Run { .. } => {
                fs::write(&to, "x").unwrap();
                format!("{:?} is a file", to.display())
            }
            _ => {
                fs::create_dir(&to).unwrap();
                format!("cannot write {:?}: it is a folder", to.display())
            }
        };
        let why = why_not(of_both(what, &to), Reel::new(2));
        assert!(why.contains(&wanted), "{name}: {why}");
        assert_eq!(names(folder.path()), [name]);
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_nobody_may_write_is_named_with_the_reason() {
    use std::os::unix::fs::PermissionsExt;
    for (what, name) in kinds() {
        let folder = folder();
        let locked = folder.path().join("locked");
        fs::create_dir(&locked).unwrap();
        fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
        if fs::write(locked.join("probe"), "").is_ok() {
            println!("skipped: this user may write everywhere");
            return;
        }
        let why = why_not(of_both(what, &locked.join(name)), Reel::new(2));
        let says = |words: &str| why.to_lowercase().contains(words);
        assert!(says("locked") && says("permission denied"), "{name}: {why}");
    }
}

#[test]
fn a_folder_that_holds_a_run_is_left_alone_in_words_for_who_exports() {
    let folder = folder();
    let to = folder.path().join("run");
    let run = || request(ExportKind::Run { first: 0, last: 1 }, &to);
    done(run(), Reel::new(2));
    let why = why_not(run(), Reel::new(2));
    assert!(why.contains("holds a run already: choose another folder"), "{why}");
    assert!(!why.contains("--"), "{why}");
}
