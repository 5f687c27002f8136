//! The same shot and settings give the same bits, every time and for any number of threads.

use shotsilk::run::RunReader;
use shotsilk::sim::Frame;

use super::frame_bits::bits;
use super::small_shot::SmallShot;

/// Every frame has the same bits.
#[track_caller]
pub fn assert_same(a: &RunReader, b: &RunReader) {
    assert_eq!(a.frames(), b.frames());
    assert_eq!(a.info().input_hash, b.info().input_hash);
    for &number in a.frames() {
        let (a, b) = (a.frame(number).unwrap(), b.frame(number).unwrap());
        assert!(bits(&a) == bits(&b), "frame {number} is another one");
    }
}

/// The same rows, but for the seconds.
#[track_caller]
pub fn assert_same_statistics(a: &str, b: &str) {
    let untimed = |stats: &str| -> Vec<String> {
        let columns: Vec<&str> = stats.lines().next().unwrap().split(',').collect();
        let is_timing = |column: &str| column.ends_with("_s") && column != "time_s";
        let fields = |row: &str| {
            let kept = columns.iter().zip(row.split(',')).filter(|(column, _)| !is_timing(column));
            kept.map(|(_, field)| field).collect::<Vec<_>>().join(",")
        };
        stats.lines().map(fields).collect()
    };
    assert_eq!(untimed(a), untimed(b));
}

#[test]
fn a_second_run_and_other_thread_counts_give_the_same_bits() {
    let shot = SmallShot::new();
    shot.turn_the_camera();
    for (run, threads) in [("once", 2), ("again", 2), ("one", 1), ("seven", 7)] {
        let line = format!("simulate shot.json --out {run} --threads {threads} --frames 12");
        shot.run(&line).succeeds();
    }
    let reader = |run| shot.reader(run);
    // There is something to differ in: contacts, edits, and cloth that the camera sees less of.
    let once: Vec<Frame> = (1..=12).map(|n| reader("once").frame(n).unwrap()).collect();
    let counts = || once.iter().map(|frame| frame.report.counts);
    assert!(counts().any(|c| c.contacts > 0) && counts().any(|c| c.impacts > 0));
    assert!(counts().any(|c| c.splits > 0) && counts().any(|c| c.collapses > 0));
    assert!(once.iter().any(|frame| frame.report.view_factor_min < 1.0));
    for run in ["again", "one", "seven"] {
        assert_same(&reader("once"), &reader(run));
        let stats = |run: &str| shot.text(&format!("{run}/stats.csv"));
        assert_same_statistics(&stats("once"), &stats(run));
    }
}

#[test]
fn settings_and_file_contents_change_the_hash_and_the_place_of_the_shot_does_not() {
    let (here, there) = (SmallShot::new(), SmallShot::new());
    let hash = |shot: &SmallShot, run: &str, arguments: &str| {
        shot.run(&format!("simulate shot.json --out {run} --frames 0 {arguments}")).succeeds();
        shot.reader(run).info().input_hash.clone()
    };
    let original = hash(&here, "a", "");
    assert_eq!(hash(&there, "a", ""), original);
    assert_ne!(hash(&here, "b", "--set view.nu_out=0.02"), original);
    assert_ne!(hash(&here, "c", "--sizing adaptive"), original);
    here.replace("cloth.obj", "v 0.5 0.5 1", "v 0.5 0.5 1.01");
    assert_ne!(hash(&here, "d", ""), original);
}
