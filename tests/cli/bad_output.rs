//! Outputs that cannot be written are known before the work starts; what is there is not touched.

use super::small_shot::SmallShot;

#[test]
fn a_run_cannot_be_written_over_or_below_a_file() {
    let shot = SmallShot::new();
    let (before, cloth) = (shot.names(""), shot.text("cloth.obj"));
    for out in ["cloth.obj", "cloth.obj/run", "cloth.obj/a/run"] {
        let named = format!("cannot create \"{out}\"");
        let outcome = shot.run(&format!("simulate shot.json --out {out}")).fails(1, &[&named]);
        assert!(!outcome.stderr.contains("frame 0"), "{}", outcome.stderr);
    }
    assert_eq!((shot.names(""), shot.text("cloth.obj")), (before, cloth));
}

#[test]
fn a_folder_that_holds_something_else_is_not_written_to() {
    let shot = SmallShot::new();
    std::fs::create_dir(shot.path("mine")).unwrap();
    shot.write("mine/notes.txt", "keep me");
    for arguments in ["", "--overwrite"] {
        shot.run(&format!("simulate shot.json --out mine {arguments}"))
            .fails(3, &["\"mine\" is not empty and not a run folder", "another folder"]);
    }
    assert_eq!(shot.names("mine"), ["notes.txt"]);
    std::fs::create_dir(shot.path("empty")).unwrap();
    shot.run("simulate shot.json --out empty --frames 0").succeeds();
}

#[test]
fn pictures_cannot_be_written_over_or_below_a_file_or_into_a_missing_folder() {
    let shot = SmallShot::new();
    let before = shot.names("");
    std::fs::create_dir(shot.path("a.png")).unwrap();
    for (line, named) in [
        ("render shot.json --out cloth.obj", "cannot create \"cloth.obj\""),
        ("render shot.json --out cloth.obj/a", "cannot create \"cloth.obj/a\""),
        ("sheet shot.json --out cloth.obj/a.png", "cannot write \"cloth.obj/a.png\": not a dir"),
        ("sheet shot.json --out no/a.png", "cannot write \"no/a.png\": entity not found"),
        ("sheet shot.json --out a.png", "cannot write \"a.png\": it is a folder"),
    ] {
        let outcome = shot.run(line).fails(1, &[named]);
        assert!(!outcome.stderr.contains("frame 0"), "{}", outcome.stderr);
    }
    std::fs::remove_dir(shot.path("a.png")).unwrap();
    assert_eq!(shot.names(""), before);
}

#[test]
fn a_folder_that_is_no_run_cannot_be_drawn() {
    let shot = SmallShot::new();
    std::fs::create_dir(shot.path("mine")).unwrap();
    for line in ["render mine --out pictures", "sheet mine --out sheet.png"] {
        shot.run(line).fails(3, &["\"mine\" is not a run folder", "run.json"]);
    }
    shot.write("mine/run.json", "{\"shotsilk_run\": 99}");
    shot.run("sheet mine --out sheet.png").fails(3, &["run format 99", "formats 1 to 1"]);
    shot.write("mine/run.json", "{\"shotsilk_run\": ");
    shot.run("sheet mine --out sheet.png").fails(3, &["mine/run.json", "line 1"]);
    assert!(!shot.path("pictures").exists() && !shot.path("sheet.png").exists());
}

#[test]
fn a_damaged_state_is_named() {
    let shot = SmallShot::new();
    shot.run("simulate shot.json --out run --frames 1").succeeds();
    let path = shot.path("run/frames/000001.sfr");
    let mut bytes = std::fs::read(&path).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let parts = ["cannot read \"run/frames/000001.sfr\"", "checksum", "damaged"];
    shot.run("render run --out pictures").fails(3, &parts);
    std::fs::write(&path, &bytes[..40]).unwrap();
    shot.run("render run --out pictures").fails(3, &["000001.sfr", "too short"]);
    assert!(!shot.path("pictures").exists());
}
