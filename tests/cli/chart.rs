//! `chart`: a suite as a table and a file.

use std::time::{Duration, Instant};

use crate::program::{self, run};
use crate::small_shot::SmallShot;

#[test]
fn rows_that_hold_are_a_table_and_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let outcome =
        run(folder.path(), "chart --suite validation --only patch-test --out a/b").succeeds();
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert!(lines[0].starts_with("name") && lines.len() > 2, "{}", outcome.stdout);
    let bytes = std::fs::read(folder.path().join("a/b/validation.json")).unwrap();
    let rows: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(rows.as_array().unwrap().len(), lines.len() - 1);
    for row in rows.as_array().unwrap() {
        let keys: Vec<&String> = row.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["name", "expected", "measured", "error", "tolerance"]);
        assert!(row["name"].as_str().unwrap().starts_with("patch-test/"));
    }
}

#[test]
fn what_a_killed_chart_has_left_is_swept_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join("a").join(name);
    std::fs::create_dir(at("")).unwrap();
    let line = "chart --suite validation --threads 1 --out a";
    let mut child = program::start(folder.path(), line);
    let left = || -> Vec<String> {
        let names = at("").read_dir().unwrap().map(|e| e.unwrap().file_name());
        names.map(|name| name.into_string().unwrap()).collect()
    };
    let started = Instant::now();
    while left().is_empty() {
        assert!(started.elapsed() < Duration::from_secs(120), "it writes nothing");
        std::thread::sleep(Duration::from_millis(1));
    }
    // What it probes the folder with is gone by then.
    std::thread::sleep(Duration::from_millis(300));
    let quick = format!("{line} --only free-fall");
    let own = left();
    run(folder.path(), &quick).succeeds();
    assert!(own.iter().all(|name| at(name).exists()), "another program is writing: {own:?}");
    child.kill().unwrap();
    child.wait().unwrap();
    std::fs::write(at("notes.txt"), "mine").unwrap();
    run(folder.path(), &quick).succeeds();
    let mut names = left();
    names.sort_unstable();
    assert_eq!(names, ["notes.txt", "validation.json"]);
}

#[test]
fn the_number_of_threads_does_not_change_a_figure() {
    let folder = tempfile::tempdir().unwrap();
    let files = [1, 2, 7].map(|threads| {
        let line = format!(
            "chart --suite validation --only free-fall --threads {threads} --out {threads}"
        );
        run(folder.path(), &line).succeeds();
        std::fs::read(folder.path().join(threads.to_string()).join("validation.json")).unwrap()
    });
    assert!(files[0] == files[1] && files[0] == files[2]);
}

#[test]
fn a_pattern_that_chooses_nothing_is_a_usage_error_that_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "chart --suite validation --only no-such-row --out a")
        .fails(2, &["no-such-row"]);
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn a_shot_is_charted_against_a_reference_run_and_finished_runs_are_used_again() {
    let shot = SmallShot::new();
    let line = "chart shot.json --suite visible-error --frames 2 --out study";
    let outcome = shot.run(line).succeeds();
    for subject in ["view", "adaptive", "uniform"] {
        assert!(outcome.stdout.contains(subject), "{}", outcome.stdout);
    }
    let files =
        ["csv", "json", "svg"].map(|kind| shot.text(&format!("study/visible-error.{kind}")));
    assert_eq!(files[0].lines().count(), 1 + 3 * 3);
    let study: serde_json::Value = serde_json::from_str(&files[1]).unwrap();
    let reference = &study["reference"];
    assert_eq!(reference["steps_per_frame"], 16);
    let unconverged = reference["unconverged_steps"].as_u64().unwrap();
    let shown = format!("{unconverged} unconverged steps");
    assert!(outcome.stdout.contains(&shown), "{}", outcome.stdout);
    assert_eq!(outcome.stderr.contains("used up their 50 Newton"), unconverged > 0);
    let (wanted, mean) = (&reference["edge_length_wanted"], &reference["edge_length_mean"]);
    let ratio = mean.as_f64().unwrap() / wanted.as_f64().unwrap();
    assert!((ratio.ln()).abs() < 0.4, "{wanted} {mean}");
    assert!(files[2].starts_with("<svg") && files[2].contains("visible error"));
    let runs = ["adaptive", "perturbed", "reference", "uniform", "view"];
    assert!(runs.iter().all(|run| shot.path(&format!("study/{run}/run.json")).is_file()));

    let again = shot.run(line).succeeds();
    assert_eq!(again.stderr.matches("using the run").count(), 5, "{}", again.stderr);
    assert_eq!(shot.text("study/visible-error.csv"), files[0]);
}

#[test]
fn a_stress_is_charted_from_mild_to_severe_as_map_and_tables() {
    let folder = tempfile::tempdir().unwrap();
    let outcome = run(folder.path(), "chart --suite stability --only wind --out a").succeeds();
    assert!(outcome.stdout.contains("| wind |"), "{}", outcome.stdout);
    assert!(outcome.stderr.contains("5 of 5: wind 100 m/s"), "{}", outcome.stderr);
    let text =
        |kind: &str| std::fs::read_to_string(folder.path().join(format!("a/stability.{kind}")));
    let [csv, table, svg] = ["csv", "md", "svg"].map(|kind| text(kind).unwrap());
    assert_eq!(csv.lines().count(), 1 + 5);
    assert_eq!(table, outcome.stdout);
    assert!(svg.starts_with("<svg") && svg.contains("25 m/s"));
    run(folder.path(), "chart --suite stability --only gravity --out b").fails(2, &["gravity"]);
    assert!(!folder.path().join("b").exists());
}

#[test]
fn a_suite_takes_only_the_arguments_that_mean_something_to_it() {
    let shot = SmallShot::new();
    let before = shot.names("");
    for (arguments, part) in [
        ("shot.json --suite visible-error --sizing view", "visible-error has no use for --sizing"),
        ("shot.json --suite visible-error --only a", "--only"),
        ("shot.json --suite validation", "validation has no use for a shot"),
        ("--suite validation --frames 3", "--frames"),
        ("--suite validation --set fps=25", "--set"),
        ("--suite stability --frames 3", "stability has no use for --frames"),
        ("--suite bending --only a", "bending has no use for --only"),
        ("--suite bending --shaded", "--shaded"),
    ] {
        shot.run(&format!("chart --out a {arguments}")).fails(2, &[part]);
        assert_eq!(shot.names(""), before);
    }
}
