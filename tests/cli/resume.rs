//! A run that was killed, damaged or interrupted goes on with the bits of one that never stopped.

use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::program;
use super::same_bits::{assert_same, assert_same_statistics};
use super::small_shot::SmallShot;

/// Contacts, remeshing, and a handle that takes hold while the cloth falls: the rest of a command
/// line.
const LIVELY: &str =
    "--frames 9 --obj --set handles=[{\"nodes\":[6,8]},{\"nodes\":[0],\"start_time\":0.1}]";

/// (s). A file that is not there by then never will be.
const PATIENCE: Duration = Duration::from_secs(120);

/// Starts a command and kills it as soon as a file is there, and `delay` has passed; a command that
/// ends earlier has ended.
fn kill_when_there(shot: &SmallShot, line: &str, file: &str, delay: Duration) {
    let mut child = program::start(shot.folder(), line);
    let started = Instant::now();
    while !shot.path(file).exists() && child.try_wait().unwrap().is_none() {
        assert!(started.elapsed() < PATIENCE, "{file} does not come");
        std::hint::spin_loop();
    }
    sleep(delay);
    child.kill().unwrap();
    child.wait().unwrap();
}

#[track_caller]
fn assert_same_run(shot: &SmallShot, run: &str, straight: &str) {
    for folder in ["", "/frames", "/obj"] {
        let names = |run: &str| shot.names(&format!("{run}{folder}"));
        assert_eq!(names(run), names(straight));
    }
    assert_same(&shot.reader(run), &shot.reader(straight));
    assert_same_statistics(
        &shot.text(&format!("{run}/stats.csv")),
        &shot.text(&format!("{straight}/stats.csv")),
    );
    for name in shot.names(&format!("{straight}/obj")) {
        let obj = |run: &str| shot.text(&format!("{run}/obj/{name}"));
        assert!(obj(run) == obj(straight), "{name}");
    }
}

#[test]
fn killed_again_and_again_it_goes_on_with_other_threads_to_the_same_bits() {
    let shot = SmallShot::new();
    shot.turn_the_camera();
    shot.run(&format!("simulate shot.json --out straight {LIVELY}")).succeeds();
    let kills = [
        ("run.json", 0),
        ("obstacles.bin", 0),
        ("frames/000000.sfr.partial", 0),
        ("frames/000001.sfr", 0),
        ("obj/0003_00.obj", 0),
        ("frames/000003.sfr", 5),
        ("frames/000005.sfr.partial", 0),
        ("frames/000006.sfr", 11),
    ];
    let mut resume = "";
    for (index, (file, delay)) in kills.into_iter().enumerate() {
        let threads = [1, 2, 7][index % 3];
        let line = format!("simulate shot.json --out run --threads {threads} {LIVELY} {resume}");
        kill_when_there(&shot, &line, &format!("run/{file}"), Duration::from_millis(delay));
        resume = "--resume";
    }
    shot.run(&format!("simulate shot.json --out run --threads 7 {LIVELY} --resume")).succeeds();
    assert_same_run(&shot, "run", "straight");
}

#[test]
fn with_a_solid_that_deforms_it_goes_on_to_the_same_bits() {
    let shot = SmallShot::new();
    shot.deform_the_solid();
    shot.run(&format!("simulate shot.json --out straight {LIVELY}")).succeeds();
    let points = |frame: u32| shot.reader("straight").frame(frame).unwrap().obstacle_points;
    assert!(points(2) != points(1) && points(9) != points(8), "nothing deforms");
    let frames = (1..=9).map(|n| shot.reader("straight").frame(n).unwrap().report.counts);
    assert!(frames.map(|counts| counts.contacts).sum::<u64>() > 0, "nothing touches");
    let line = format!("simulate shot.json --out run {LIVELY}");
    for (threads, file) in [(1, "frames/000002.sfr"), (7, "frames/000006.sfr.partial")] {
        let resume = if threads == 1 { "" } else { "--resume" };
        let line = format!("{line} --threads {threads} {resume}");
        kill_when_there(&shot, &line, &format!("run/{file}"), Duration::ZERO);
    }
    shot.run(&format!("{line} --threads 2 --resume")).succeeds();
    assert_same_run(&shot, "run", "straight");
}

#[test]
fn damaged_frames_are_named_and_computed_again() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out straight").succeeds();
    shot.run("simulate shot.json --out run --frames 3").succeeds();
    let path = shot.path("run/frames/000003.sfr");
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let outcome = shot.run("simulate shot.json --out run --resume").succeeds();
    for part in ["WARN cannot read \"run/frames/000003.sfr\"", "going on after frame 2", "(1 of 2)"]
    {
        assert!(outcome.stderr.contains(part), "{part:?} is not in {}", outcome.stderr);
    }
    assert_eq!(outcome.stdout, "run\n");
    assert_same(&shot.reader("run"), &shot.reader("straight"));
}

#[test]
fn a_finished_run_says_so_and_stays_as_it_is() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --set first_frame=1001").succeeds();
    let stats = shot.text("run/stats.csv");
    let line = "simulate shot.json --out run --set first_frame=1001 --resume";
    let outcome = shot.run(line).succeeds();
    assert!(outcome.stderr.contains("frames 1001 to 1005 are there"), "{}", outcome.stderr);
    assert_eq!(outcome.stdout, "run\n");
    assert_eq!(shot.text("run/stats.csv"), stats);
    let longer = shot.run(&format!("{line} --frames 6")).succeeds();
    assert!(longer.stderr.contains("going on after frame 1005"), "{}", longer.stderr);
    assert_eq!(shot.reader("run").last_frame(), Some(6));
}

#[test]
fn a_run_of_some_frames_starts_over_until_the_first_of_them_is_there() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out straight --frames 3..6").succeeds();
    // However late the kill comes, the first of the frames is far.
    let line = "simulate shot.json --out run --frames 1000000..1000001";
    kill_when_there(&shot, line, "run/stats.csv", Duration::ZERO);
    assert_eq!(shot.names("run/frames"), [""; 0]);
    let outcome = shot.run("simulate shot.json --out run --frames 3..6 --resume").succeeds();
    assert!(outcome.stderr.contains("starting at frame 0"), "{}", outcome.stderr);
    assert_same(&shot.reader("run"), &shot.reader("straight"));
    shot.run("simulate shot.json --out run --frames 6 --resume")
        .fails(3, &["\"run\" holds frame 3, but not frame 0", "--frames", "--overwrite"]);
    assert_eq!(shot.reader("run").frames(), [3, 4, 5, 6]);
}

#[test]
fn where_there_is_nothing_yet_a_run_is_begun() {
    let shot = SmallShot::new();
    let line = "simulate shot.json --set first_frame=1001 --out";
    shot.run(&format!("{line} straight")).succeeds();
    fs::create_dir(shot.path("empty")).unwrap();
    for run in ["empty", "deep/new"] {
        let outcome = shot.run(&format!("{line} {run} --resume")).succeeds();
        assert!(outcome.stderr.contains("starting at frame 1001"), "{}", outcome.stderr);
        assert_eq!(outcome.stdout, format!("{run}\n"));
        assert_same(&shot.reader(run), &shot.reader("straight"));
    }
}

#[test]
fn what_cannot_be_resumed_is_refused_and_not_touched() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --frames 1").succeeds();
    fs::create_dir(shot.path("mine")).unwrap();
    shot.write("mine/notes.txt", "keep me");
    let before = (shot.names(""), shot.names("run"), shot.text("run/stats.csv"));
    for (arguments, code, parts) in [
        ("--out run --overwrite", 2, &["--resume", "--overwrite"][..]),
        ("--out mine", 3, &["\"mine\" is not a run folder"]),
        ("--out cloth.obj", 3, &["\"cloth.obj\" is not a run folder"]),
        ("--out run --sizing adaptive", 3, &["\"run\" comes from other settings"]),
        ("--out run --set gravity=[0,0,-1]", 3, &["\"run\" comes from other settings"]),
    ] {
        shot.run(&format!("simulate shot.json --resume {arguments}")).fails(code, parts);
    }
    shot.replace("run/run.json", "\"program_version\": \"", "\"program_version\": \"0.0.");
    shot.run("simulate shot.json --out run --resume").fails(3, &["was begun by version 0.0."]);
    assert_eq!((shot.names(""), shot.names("run"), shot.text("run/stats.csv")), before);
    assert_eq!(shot.names("mine"), ["notes.txt"]);
}

#[test]
fn two_programs_do_not_write_one_run() {
    let shot = SmallShot::new();
    let line = "simulate shot.json --out run --frames 1000000";
    let mut child = program::start(shot.folder(), line);
    let started = Instant::now();
    while !shot.path("run/frames/000000.sfr").exists() {
        assert!(started.elapsed() < PATIENCE, "frame 0 does not come");
        sleep(Duration::from_millis(1));
    }
    for arguments in ["--resume", "--overwrite"] {
        shot.run(&format!("{line} {arguments}"))
            .fails(1, &["\"run\" is being written by another program"]);
    }
    child.kill().unwrap();
    child.wait().unwrap();
    shot.run("simulate shot.json --out run --frames 0 --resume").succeeds();
}
