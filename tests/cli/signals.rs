//! Interrupted from the keyboard or by the system.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use super::program;
use super::same_bits::assert_same;
use super::small_shot::SmallShot;

/// When most are told to stop.
const AT: &str = "frame 3 ";

/// Starts a command, sends a signal once its stderr has a text, and returns its exit code and stderr.
fn interrupted(shot: &SmallShot, line: &str, signal: &str, at: &str) -> (Option<i32>, String) {
    let mut child = program::command(shot.folder(), line)
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let mut stderr = BufReader::new(child.stderr.take().expect("stderr is piped"));
    let mut text = String::new();
    while !text.contains(at) {
        assert!(stderr.read_line(&mut text).unwrap() > 0, "ended before {at}: {text}");
    }
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.expect("kill is installed").success());
    stderr.read_to_string(&mut text).unwrap();
    (child.wait().unwrap().code(), text)
}

#[test]
fn a_simulation_that_is_told_to_stop_leaves_a_whole_run() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let shot = SmallShot::new();
        let line = "simulate shot.json --out run --frames 1000000";
        let (found, text) = interrupted(&shot, line, signal, AT);
        assert_eq!(found, Some(code), "{text}");
        assert!(text.contains("interrupted; what is written so far is whole"), "{text}");
        let reader = shot.reader("run");
        let stats = shot.text("run/stats.csv");
        assert!(stats.ends_with('\n'));
        let rows: Vec<u32> = stats
            .lines()
            .skip(1)
            .map(|row| row.split(',').next().unwrap().parse().unwrap())
            .collect();
        assert!(rows.len() > 3);
        assert_eq!(rows, reader.frames());
        for number in rows {
            assert_eq!(reader.frame(number).unwrap().garments[0].check(), Ok(()));
        }
        let names = shot.names("run/frames");
        assert!(names.iter().all(|name| name.ends_with(".sfr")), "{names:?}");
        assert_eq!(shot.names("run"), ["frames", "obstacles.bin", "run.json", "stats.csv"]);
    }
}

#[test]
fn a_simulation_that_was_told_to_stop_goes_on_with_the_same_bits() {
    for signal in ["-INT", "-TERM"] {
        let shot = SmallShot::new();
        let line = "simulate shot.json --out run --frames 1000000";
        let (_, text) = interrupted(&shot, line, signal, AT);
        assert!(text.contains("the same command with --resume goes on from there"), "{text}");
        let last = shot.reader("run").last_frame().unwrap() + 2;
        shot.run(&format!("simulate shot.json --out run --frames {last} --resume")).succeeds();
        shot.run(&format!("simulate shot.json --out straight --frames {last}")).succeeds();
        assert_same(&shot.reader("run"), &shot.reader("straight"));
    }
}

/// The frame would take days: nobody waits for its end.
#[test]
fn a_frame_in_work_is_dropped_and_the_run_goes_on_without_it() {
    let shot = SmallShot::new();
    let line = "simulate shot.json --out run --set steps_per_frame=1000000000";
    let (code, text) = interrupted(&shot, line, "-TERM", "frame 0 ");
    assert_eq!(code, Some(143), "{text}");
    assert!(text.contains("the same command with --resume goes on from there"), "{text}");
    assert_eq!(shot.names("run/frames"), ["000000.sfr"]);
    assert_eq!(shot.text("run/stats.csv").lines().count(), 2);
    let again = format!("{line} --resume");
    let (code, text) = interrupted(&shot, &again, "-INT", "going on after frame 0");
    assert_eq!(code, Some(130), "{text}");
    assert_eq!(shot.names("run/frames"), ["000000.sfr"]);
}

#[test]
fn pictures_that_are_told_to_stop_leave_nothing() {
    for line in [
        "sheet shot.json --out sheet.png --frames 1000000",
        "render shot.json --out pictures/deep --frames 1000000",
    ] {
        let shot = SmallShot::new();
        let before = shot.names("");
        let (code, text) = interrupted(&shot, line, "-INT", AT);
        assert_eq!(code, Some(130), "{text}");
        assert_eq!(shot.names(""), before);
    }
}
