//! `sheet`: one page for a run or a shot, drawn by the software adapter.

use super::small_shot::SmallShot;

/// Pictures on the sheets drawn here (px).
const WIDTH: u32 = 96;

#[test]
fn a_sheet_has_room_for_a_pair_of_pictures_for_every_nth_frame() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run").succeeds();
    let sheet = |line: &str| {
        let line = format!("sheet {line} --thumbnail-width {WIDTH} --columns 1");
        assert_eq!(shot.run(&line).succeeds().stdout, "sheet.png\n");
        image::image_dimensions(shot.path("sheet.png")).unwrap()
    };
    let (width, height) = sheet("run --out sheet.png --every 1");
    assert!((2 * WIDTH..4 * WIDTH).contains(&width), "{width}");
    assert!(height > 5 * WIDTH * 180 / 320, "{height}");
    let (_, lower) = sheet("run --out sheet.png --every 4");
    assert!(lower < height, "{lower} and {height}");
    assert_eq!(sheet("shot.json --out sheet.png --every 4"), (width, lower));
}

#[test]
fn without_a_shot_the_programs_own_is_drawn_wherever_it_runs() {
    let shot = SmallShot::new();
    shot.run("sheet --out own.png --frames 1 --every 1 --thumbnail-width 96").succeeds();
    assert!(image::open(shot.path("own.png")).is_ok());
    let settings = "--frames 0 --camera main.camera.json --fps 24 --set first_frame=7";
    shot.run(&format!("simulate --out own {settings}")).succeeds();
    let reader = shot.reader("own");
    assert_eq!((reader.info().first_frame, reader.frames()), (7, &[0][..]));
}

#[test]
fn sheets_of_equal_runs_are_equal_but_for_the_seconds() {
    let shot = SmallShot::new();
    shot.write("none.json", r#"{"share": 0}"#);
    for name in ["a", "b"] {
        shot.run(&format!("simulate shot.json --out {name}")).succeeds();
        for (file, option) in [("timed", ""), ("bare", "--no-seconds")] {
            let line = format!("sheet {name} --out {name}.{file}.png --every 2 {option}");
            shot.run(&format!("{line} --thumbnail-width {WIDTH}")).succeeds();
        }
    }
    let bytes = |name: &str| std::fs::read(shot.path(name)).unwrap();
    assert!(bytes("a.bare.png") == bytes("b.bare.png"));
    assert!(bytes("a.bare.png") != bytes("a.timed.png"), "the seconds are there by default");
    shot.run("compare a.bare.png b.bare.png --tolerance none.json").succeeds();
}

#[test]
fn an_earlier_sheet_stays_until_the_new_one_is_whole() {
    let shot = SmallShot::new();
    shot.write("sheet.png", "an earlier one");
    shot.run("sheet shot.json --out sheet.png --sizing uniform --set gravity=[0,0,-1e300]")
        .fails(5, &["frame 1"]);
    assert_eq!(shot.text("sheet.png"), "an earlier one");
    shot.run(&format!("sheet shot.json --out sheet.png --thumbnail-width {WIDTH}")).succeeds();
    assert!(image::open(shot.path("sheet.png")).is_ok());
}

#[test]
fn a_sheet_is_a_png_file() {
    let shot = SmallShot::new();
    shot.run("sheet shot.json --out sheet.jpg").fails(2, &["'sheet.jpg'", ".png"]);
    shot.run("sheet shot.json --out sheet.PNG --frames 1").succeeds();
    assert!(shot.path("sheet.PNG").is_file());
}

#[test]
fn a_run_takes_no_settings_and_has_the_frames_it_has() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --frames 2").succeeds();
    for change in ["--set fps=3", "--sizing uniform", "--edge-length 0.1"] {
        let line = format!("sheet run --out a.png {change}");
        shot.run(&line).fails(2, &["simulated already", change.split(' ').next().unwrap()]);
    }
    shot.run("sheet run --out a.png --frames 7..9")
        .fails(2, &["\"run\"", "none of the frames 7..9"]);
    assert!(!shot.path("a.png").exists());
}
