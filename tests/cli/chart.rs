//! `chart`: a suite as a table and a file.

use crate::program::run;

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
