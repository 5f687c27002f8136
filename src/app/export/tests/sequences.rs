//! Folders of pictures, and how an export that goes on is looked at and cancelled.

use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use super::reel::*;
use crate::app::export::*;

#[test]
fn a_sequence_is_a_folder_of_the_frames_as_the_shot_counts_them() {
    let folder = folder();
    let to = folder.path().join("new/pictures");
    let what = ExportKind::Sequence { first: 1, last: 6, stride: 2 };
    assert_eq!(done(request(what, &to), Reel::new(8)), 3);
    assert_eq!(names(&to), ["1002.shot.png", "1004.shot.png", "1006.shot.png"]);
}

#[test]
fn every_change_of_progress_wakes_whoever_looks_on() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 2, stride: 1 };
    let woken = Arc::new(AtomicU32::new(0));
    let counter = woken.clone();
    let wake = Arc::new(move || {
        counter.fetch_add(1, Ordering::AcqRel);
    });
    let supply = Box::new(Reel::new(3));
    let job = start(request(what, folder.path()), supply, AdapterChoice::Software, wake);
    end_of(&job);
    // What is expected, three frames, the end; the last call may still be on its way.
    thread::sleep(Duration::from_millis(50));
    assert_eq!(woken.load(Ordering::Acquire), 5);
}

#[test]
fn a_cancelled_sequence_keeps_its_whole_frames_and_says_how_many() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 199, stride: 1 };
    let job = begin(request(what, folder.path()), Reel::new(200));
    wait_until(&job, |progress| progress.done >= 2);
    job.cancel();
    let progress = end_of(&job);
    let ExportState::Cancelled(what) = &progress.state else { panic!("{progress:?}") };
    assert!(what.contains(&format!("{} of 200 frames", progress.done)), "{what}");
    let names = names(folder.path());
    assert_eq!(names.len() as u32, progress.done);
    assert!(names.iter().all(|name| size_of(&folder.path().join(name)) == (160, 90)));
    job.cancel();
    assert_eq!(job.progress(), progress, "what has ended stays as it is");
}

#[test]
fn a_dropped_job_stops() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 4_999, stride: 1 };
    let reel = Reel { delay: Duration::from_millis(10), ..Reel::new(5_000) };
    let job = begin(request(what, folder.path()), reel);
    wait_until(&job, |progress| progress.done >= 1);
    drop(job);
    // The frame in work, on a busy machine.
    thread::sleep(Duration::from_secs(1));
    let count = names(folder.path()).len();
    thread::sleep(Duration::from_millis(500));
    assert_eq!(names(folder.path()).len(), count);
}

#[test]
fn a_missing_frame_is_named_as_the_shot_counts_and_the_frames_before_it_stay() {
    let folder = folder();
    let what = ExportKind::Sequence { first: 0, last: 5, stride: 1 };
    let why = why_not(request(what, folder.path()), Reel::new(3));
    assert_eq!(why, "frame 1004 cannot be exported: it is not simulated yet");
    assert_eq!(names(folder.path()).len(), 3);
}
