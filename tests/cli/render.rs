//! `render`: pictures of a run or a shot, drawn by the software adapter.

use super::small_shot::SmallShot;

#[test]
fn a_run_is_drawn_in_the_shots_resolution_from_both_views() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --set first_frame=1001").succeeds();
    let outcome = shot.run("render run --out new/pictures --every 3").succeeds();
    assert_eq!(outcome.stdout, "new/pictures\n");
    let expected = ["1001.shot.png", "1001.witness.png", "1004.shot.png", "1004.witness.png"];
    assert_eq!(shot.names("new/pictures")[..4], expected);
    for name in shot.names("new/pictures") {
        let picture = image::open(shot.path("new/pictures").join(&name)).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (320, 180));
        let first = picture.get_pixel(0, 0);
        assert!(picture.pixels().any(|pixel| pixel != first), "{name} is empty");
    }
}

#[test]
fn a_shot_is_simulated_and_drawn_without_leaving_a_run() {
    let shot = SmallShot::new();
    let before = shot.names("");
    shot.run("render shot.json --out pictures --frames 1..2 --view shot --width 160 --legend")
        .succeeds();
    assert_eq!(shot.names("pictures"), ["0001.shot.png", "0002.shot.png"]);
    let size = image::image_dimensions(shot.path("pictures/0002.shot.png")).unwrap();
    assert_eq!(size, (160, 90));
    shot.run("render shot.json --out pictures --frames 1..1 --view witness --colour strain")
        .succeeds();
    assert_eq!(shot.names("pictures").len(), 3);
    assert_eq!(shot.names("").len(), before.len() + 1);
}

#[test]
fn a_run_and_its_shot_give_the_same_picture() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run").succeeds();
    shot.run("render run --out a --frames 4..4 --view shot").succeeds();
    shot.run("render shot.json --out b --frames 4..4 --view shot").succeeds();
    let picture = |folder: &str| image::open(shot.path(folder).join("0004.shot.png")).unwrap();
    assert_eq!(picture("a").to_rgb8(), picture("b").to_rgb8());
}

#[test]
fn a_solid_that_deforms_is_drawn_as_it_is_in_the_frame() {
    let shot = SmallShot::new();
    // Out of reach of the cloth, so that this is the same whatever the solid does.
    let aside = "\"transform\": {\"translate\": [-0.4, -0.8, -0.5]}, \"motion\"";
    shot.replace("shot.json", "\"motion\": \"rise\"}]", &format!("{aside}: \"rise\"}}]"));
    let still = shot.text("solid.obj");
    shot.run("simulate shot.json --out still").succeeds();
    let rigid = shot.text("shot.json");
    shot.deform_the_solid();
    shot.run("simulate shot.json --out deforming").succeeds();
    // The shape of frame 4 as a solid of its own.
    let frame = shot.reader("deforming").frame(4).unwrap();
    let points = &frame.obstacle_points[&0];
    let vertices = points.iter().map(|p| format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z));
    let faces = still.lines().filter(|line| line.starts_with('f'));
    let faces = faces.map(|line| format!("{line}\n"));
    shot.write("solid.obj", &vertices.chain(faces).collect::<String>());
    shot.write("shot.json", &rigid);
    shot.run("simulate shot.json --out frozen").succeeds();
    let picture = |run: &str| {
        shot.run(&format!("render {run} --out {run}.p --frames 4..4 --view shot")).succeeds();
        image::open(shot.path(&format!("{run}.p/0004.shot.png"))).unwrap().to_rgb8()
    };
    let [deforming, frozen, still] = ["deforming", "frozen", "still"].map(picture);
    assert!(deforming == frozen, "it is not drawn as it is");
    let differing = deforming.pixels().zip(still.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing > 100, "only {differing} pixels show that it deforms");
}

#[test]
fn another_camera_looks_at_a_run_if_its_frame_rate_agrees() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --frames 1").succeeds();
    let other = shot.text("main.camera.json").replace("[320, 180]", "[64, 48]");
    shot.write("other.json", &other);
    shot.run("render run --out a --camera other.json --frames 1..1").succeeds();
    assert_eq!(image::image_dimensions(shot.path("a/0001.shot.png")).unwrap(), (64, 48));
    shot.write("other.json", &other.replace("\"fps\": 24", "\"fps\": 25"));
    let line = "render run --out b --camera other.json --frames 1..1";
    shot.run(line).fails(3, &["other.json:2:12", "25 frames a second", "24", "--fps"]);
    assert!(!shot.path("b").exists());
    shot.run(&format!("{line} --fps 24")).succeeds();
}

#[test]
fn without_a_camera_nothing_is_simulated_and_nothing_left() {
    let shot = SmallShot::new();
    shot.replace("shot.json", "\"camera\": \"main.camera.json\",", "");
    let before = shot.names("");
    for line in ["render shot.json --out a/b", "sheet shot.json --out a.png"] {
        let outcome = shot.run(line).fails(2, &["the shot \"shot\" has no camera", "--camera"]);
        assert!(!outcome.stderr.contains("frame 0"), "{}", outcome.stderr);
        assert_eq!(shot.names(""), before);
    }
    shot.run("simulate shot.json --out run --frames 1").succeeds();
    shot.run("render run --out pictures").fails(2, &["the shot \"shot\" has no camera"]);
    assert!(!shot.path("pictures").exists());
}

#[test]
fn a_missing_adapter_is_answered_with_the_packages_that_bring_one() {
    let shot = SmallShot::new();
    let before = shot.names("");
    for line in ["render shot.json --out pictures", "sheet shot.json --out sheet.png"] {
        let parts = ["\"no-such-adapter\"", "mesa-vulkan-drivers"];
        shot.run(&format!("{line} --adapter no-such-adapter")).fails(4, &parts);
        assert_eq!(shot.names(""), before);
    }
}

#[test]
fn bad_shots_and_failed_simulations_leave_no_folder() {
    let shot = SmallShot::new();
    let before = shot.names("");
    shot.run("render none.json --out a/b").fails(3, &["\"none.json\""]);
    shot.run("render shot.json --out a --sizing uniform --set gravity=[0,0,-1e300]")
        .fails(5, &["frame 1"]);
    assert_eq!(shot.names(""), before);
}
