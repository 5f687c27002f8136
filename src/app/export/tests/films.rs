//! Films, by programs that stand for ffmpeg and by ffmpeg itself.

use std::fs;
use std::time::{Duration, Instant};

use super::reel::*;
use crate::app::export::*;

#[test]
fn a_film_is_piped_to_the_program_in_whole_even_frames() {
    let folder = folder();
    let to = folder.path().join("film.mp4");
    let film = ExportRequest {
        view: ExportView::Both(witness()),
        width: 161,
        burn_in: BurnIn::Strip,
        ffmpeg: fake_ffmpeg("whole"),
        ..request(ExportKind::Video { first: 1, last: 4 }, &to)
    };
    assert_eq!(done(film, Reel::new(6)), 4);
    let said = fs::read_to_string(&to).unwrap();
    let size = said.split_whitespace().skip_while(|&word| word != "-video_size").nth(1).unwrap();
    let sides: Vec<u64> = size.split('x').map(|side| side.parse().unwrap()).collect();
    assert!(sides[0] == 2 * 160 + 8 && sides.iter().all(|side| side % 2 == 0), "{size}");
    let byte_count: u64 = said.lines().nth(1).unwrap().trim().parse().unwrap();
    assert_eq!(byte_count, 4 * 3 * sides[0] * sides[1]);
    for wanted in ["-framerate 24 ", "-c:v libx264 ", "yuv420p", "-f mp4 "] {
        assert!(said.contains(wanted), "{wanted} is missing in {said}");
    }
    assert_eq!(names(folder.path()), ["film.mp4"]);
}

#[test]
fn cancelling_a_film_ends_a_program_that_takes_nothing_and_leaves_no_file() {
    let folder = folder();
    let to = folder.path().join("film.mkv");
    let film = ExportRequest {
        ffmpeg: fake_ffmpeg("stuck"),
        ..request(ExportKind::Video { first: 0, last: 99 }, &to)
    };
    let job = begin(film, Reel::new(100));
    // What a pipe holds without anyone reading.
    wait_until(&job, |progress| progress.done >= 1);
    let asked = Instant::now();
    job.cancel();
    assert!(asked.elapsed() < Duration::from_millis(500), "it waits for nobody");
    let progress = end_of(&job);
    assert!(matches!(progress.state, ExportState::Cancelled(_)), "{progress:?}");
    assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
}

#[test]
fn a_program_that_gives_up_is_quoted_and_one_that_is_missing_is_named_with_its_package() {
    let folder = folder();
    let to = folder.path().join("film.mov");
    let film = request(ExportKind::Video { first: 0, last: 9 }, &to);
    let with = |ffmpeg: PathBuf| ExportRequest { ffmpeg, ..film.clone() };
    let why = why_not(with(fake_ffmpeg("broken")), Reel::new(10));
    assert!(why.contains("the disk of the film is full"), "{why}");
    let why = why_not(with("no-such-program-ffmpeg".into()), Reel::new(10));
    assert!(why.contains("no-such-program-ffmpeg") && why.contains("package ffmpeg"), "{why}");
    let why =
        why_not(request(ExportKind::Video { first: 0, last: 1 }, folder.path()), Reel::new(2));
    assert!(why.contains(".mp4"), "{why}");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_installed_ffmpeg_makes_a_film() {
    if std::process::Command::new(FFMPEG).arg("-version").output().is_err() {
        println!("skipped: ffmpeg is not installed");
        return;
    }
    let folder = folder();
    let to = folder.path().join("film.mp4");
    let film = ExportRequest {
        burn_in: BurnIn::Strip,
        ..request(ExportKind::Video { first: 0, last: 11 }, &to)
    };
    assert_eq!(done(film, Reel::new(12)), 12);
    let bytes = fs::read(&to).unwrap();
    assert!(bytes.len() > 1_000 && &bytes[4..8] == b"ftyp", "{} bytes", bytes.len());
}
