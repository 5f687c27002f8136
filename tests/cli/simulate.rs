//! What `simulate` leaves in a run folder.

use shotsilk::run::STATS_COLUMNS;

use super::small_shot::SmallShot;

/// As agreed with whoever reads the statistics: these come first, in this order.
const AGREED_COLUMNS: &str = "frame,time_s,faces,vertices,nodes,wall_s,cpu_s,obstacles_s,\
    proximity_s,dynamics_s,collision_s,sizing_s,view_s,remesh_s,untangle_s,other_s,\
    view_factor_min,view_factor_mean,intersections,steps_taken,largest_stretch";

/// Rounding of nine stages that are added up and written in decimals (s).
const SUM_TOLERANCE: f64 = 1e-9;

fn rows(stats: &str) -> Vec<Vec<String>> {
    stats.lines().skip(1).map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

fn number(row: &[String], column: &str) -> f64 {
    let index = STATS_COLUMNS.iter().position(|c| *c == column).expect("a known column");
    row[index].parse().expect("a number")
}

#[test]
fn a_run_folder_holds_settings_states_and_statistics() {
    let shot = SmallShot::new();
    let outcome = shot.run("simulate shot.json --out run").succeeds();
    assert_eq!(outcome.stdout, "run\n");
    assert_eq!(shot.names("run"), ["frames", "obstacles.bin", "run.json", "stats.csv"]);
    let reader = shot.reader("run");
    assert_eq!(reader.frames(), [0, 1, 2, 3, 4]);
    let info = reader.info();
    assert_eq!((info.shot.as_str(), info.sizing_mode.as_str(), info.fps), ("shot", "view", 24.0));
    assert_eq!((info.garments.as_slice(), info.obstacles.len()), (&["cloth".to_owned()][..], 1));
    assert_eq!(info.settings["garments"][0]["sizing"]["edge_length_min"], 0.1);
    for &number in reader.frames() {
        let frame = reader.frame(number).unwrap();
        assert_eq!(frame.garments[0].check(), Ok(()));
    }
}

#[test]
fn the_statistics_have_the_agreed_columns_and_a_row_a_frame() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --sizing adaptive").succeeds();
    let stats = shot.text("run/stats.csv");
    let header = stats.lines().next().unwrap();
    assert!(header.starts_with(&format!("{AGREED_COLUMNS},")), "{header}");
    let rows = rows(&stats);
    assert_eq!(rows.len(), 5);
    for (index, row) in rows.iter().enumerate() {
        assert_eq!(row.len(), header.split(',').count());
        assert_eq!(number(row, "frame"), index as f64);
        assert!((number(row, "time_s") - index as f64 / 24.0).abs() < 1e-12);
        let first = STATS_COLUMNS.iter().position(|c| *c == "obstacles_s").unwrap();
        let last = STATS_COLUMNS.iter().position(|c| *c == "other_s").unwrap();
        let stages: f64 = STATS_COLUMNS[first..=last].iter().map(|c| number(row, c)).sum();
        assert!((stages - number(row, "wall_s")).abs() < SUM_TOLERANCE);
        assert!(number(row, "faces") >= 8.0 || index > 0);
        assert_eq!(number(row, "view_factor_min"), 1.0);
    }
    assert_eq!(number(&rows[0], "steps_taken"), 0.0);
    assert!(number(&rows[1], "steps_taken") >= 8.0);
}

#[test]
fn a_range_of_frames_writes_these_and_no_others() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out part --frames 2..3").succeeds();
    assert_eq!(shot.names("part/frames"), ["000002.sfr", "000003.sfr"]);
    let frames: Vec<String> = rows(&shot.text("part/stats.csv")).remove(0);
    assert_eq!(frames[0], "2");
    shot.run("simulate shot.json --out whole --frames 3").succeeds();
    assert_eq!(shot.reader("whole").frames(), [0, 1, 2, 3]);
    let frame = |run: &str| shot.reader(run).frame(3).unwrap();
    assert_eq!(frame("part").garments, frame("whole").garments);
}

#[test]
fn obj_files_are_written_on_request_and_named_by_the_shown_frame() {
    let shot = SmallShot::new();
    shot.run(
        "simulate shot.json --out run --frames 1 --obj --obj-obstacles --set first_frame=1001",
    )
    .succeeds();
    let expected = ["1001_00.obj", "1001_obs_00.obj", "1002_00.obj", "1002_obs_00.obj"];
    assert_eq!(shot.names("run/obj"), expected);
    assert_eq!(shot.names("run/frames"), ["000000.sfr", "000001.sfr"]);
    let shown: Vec<String> =
        rows(&shot.text("run/stats.csv")).into_iter().map(|r| r[0].clone()).collect();
    assert_eq!(shown, ["1001", "1002"]);
    let frame = shot.reader("run").frame(1).unwrap();
    let obj = shot.text("run/obj/1002_00.obj");
    let count =
        |keyword: &str| obj.lines().filter(|l| l.split(' ').next() == Some(keyword)).count();
    let mesh = &frame.garments[0];
    assert_eq!(
        (count("v"), count("vt"), count("f")),
        (mesh.node_count(), mesh.vertex_count(), mesh.face_count())
    );
    // The shot can be simulated again from what it wrote.
    shot.replace("shot.json", "cloth.obj", "run/obj/1002_00.obj");
    shot.run("simulate shot.json --out again --frames 0 --set handles=[]").succeeds();
}

#[test]
fn a_run_is_replaced_only_on_request() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --frames 3 --obj").succeeds();
    let before = shot.text("run/stats.csv");
    shot.run("simulate shot.json --out run --frames 1")
        .fails(3, &["\"run\" already holds a run", "--overwrite"]);
    assert_eq!(shot.text("run/stats.csv"), before);
    shot.run("simulate shot.json --out run --frames 1 --overwrite").succeeds();
    assert_eq!(shot.reader("run").frames(), [0, 1]);
    assert_eq!(shot.names("run/obj"), Vec::<String>::new());
}

#[test]
fn every_way_of_sizing_is_recorded_and_uniform_keeps_its_mesh() {
    let shot = SmallShot::new();
    for sizing in ["uniform", "adaptive", "view"] {
        shot.run(&format!("simulate shot.json --out {sizing} --sizing {sizing}")).succeeds();
        assert_eq!(shot.reader(sizing).info().sizing_mode, sizing);
    }
    shot.run("simulate shot.json --out coarse --sizing uniform --edge-length 0.3").succeeds();
    let faces = |run: &str, frame| shot.reader(run).frame(frame).unwrap().face_count();
    assert_eq!(faces("uniform", 0), faces("uniform", 4));
    assert!(faces("coarse", 0) < faces("uniform", 0));
}

#[test]
fn who_sizes_by_view_without_a_camera_is_told() {
    let shot = SmallShot::new();
    shot.replace("shot.json", "\"camera\": \"main.camera.json\",", "");
    let outcome = shot.run("simulate shot.json --out run --frames 1").succeeds();
    assert!(outcome.stderr.contains("WARN there is no camera"), "{}", outcome.stderr);
    let line = "simulate shot.json --out other --frames 1 --sizing adaptive";
    assert!(!shot.run(line).succeeds().stderr.contains("camera"));
    let frame = |run: &str| shot.reader(run).frame(1).unwrap();
    assert_eq!(frame("run").garments, frame("other").garments);
}

#[test]
fn a_simulation_that_fails_says_when_and_why_and_leaves_the_frames_before() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --sizing uniform --set gravity=[0,0,-1e300]")
        .fails(5, &["cannot simulate the shot \"shot\": frame 1", "is not finite"]);
    let reader = shot.reader("run");
    assert_eq!(reader.frames(), [0]);
    reader.frame(0).unwrap();
}
