//! Shot files and overrides that are not as they must be: place, thing, value, limit; exit code 3.

use super::small_shot::{SmallShot, refused_after};

#[test]
fn a_missing_shot_is_named() {
    let shot = SmallShot::new();
    let before = shot.names("");
    shot.run("simulate no/such.json --out run").fails(3, &["cannot read \"no/such.json\""]);
    assert_eq!(shot.names(""), before);
}

#[test]
fn missing_files_are_named_with_the_line_that_asks_for_them() {
    for (from, place) in [
        ("main.camera.json", "shot.json:5:15"),
        ("cotton.json", "shot.json:6:36"),
        ("cloth.obj", "shot.json:8:17"),
        ("solid.obj", "shot.json:14:28"),
    ] {
        refused_after("shot.json", from, "none", &[place, "cannot read \"none\""]);
    }
}

#[test]
fn malformed_json_is_answered_with_line_and_column() {
    refused_after("shot.json", "\"fps\": 24,", "\"fps\": ,", &["shot.json:3:12: "]);
    refused_after("cotton.json", "0.15,", "0.15", &["cotton.json:2:20: "]);
    refused_after("main.camera.json", "\"far\": 50", "\"far\": 5O", &["main.camera.json:2:"]);
    let shot = SmallShot::new();
    shot.write("shot.json", "");
    shot.is_refused(&["shot.json:1:1: the file holds no value"]);
    shot.write("shot.json", "{\"frames\": 3}");
    shot.is_refused(&["shot.json: this is neither a shot (no \"shotsilk\": 1) nor"]);
}

#[test]
fn values_of_the_wrong_kind_and_wrong_names_are_answered_with_the_place() {
    for (from, to, parts) in [
        ("\"fps\": 24", "\"fps\": \"fast\"", &["shot.json:3:12", "\"fast\"", "a number"][..]),
        ("\"fps\": 24", "\"fsp\": 24", &["shot.json:3:5", "\"fsp\"", "\"fps\""]),
        ("\"fps\": 24", "\"frames\": 4", &["shot.json:4:5", "\"frames\" appears twice"]),
        ("\"fabric\": \"cotton\"", "\"fabric\": \"coton\"", &["shot.json:8:40", "\"cotton\""]),
        ("\"motion\": \"rise\"", "\"motion\": \"raise\"", &["shot.json:14:51", "\"rise\""]),
        ("\"shotsilk\": 1", "\"shotsilk\": 2", &["shot.json:2:17", "version 2", "version 1"]),
        (
            "\"fps\": 24",
            "\"view\": {\"nu_out\": null}",
            &["shot.json:3:24", "a number, found null"],
        ),
        (
            "\"edge_length_min\": 0.1",
            "\"aspect_min\": null",
            &["shot.json:9:34", "a number, found null"],
        ),
    ] {
        refused_after("shot.json", from, to, parts);
    }
}

#[test]
fn numbers_out_of_range_are_answered_with_their_limit() {
    for (from, to, parts) in [
        ("\"fps\": 24", "\"fps\": 0", &["shot.json:3:12", "fps is 0", "greater than 0"][..]),
        ("0.1, \"edge", "-0.1, \"edge", &["shot.json:9:39", "edge_length_min is -0.1", "than 0"]),
        ("0.1, \"edge", "0.6, \"edge", &["shot.json:9:39", "is 0.6", "at most 0.5"]),
        ("\"fps\"", "\"view\": {\"nu_out\": 0}, \"fps\"", &["view.nu_out is 0", "at most 1"]),
        ("\"fps\"", "\"view\": {\"nu_back\": 1.5}, \"fps\"", &["view.nu_back is 1.5", "at most 1"]),
        ("\"fps\"", "\"contact\": {\"thickness\": -1}, \"fps\"", &["contact.thickness is -1"]),
        ("\"fps\"", "\"first_frame\": 9223372036854775807, \"fps\"", &["first_frame is 9223372"]),
        ("[6, 8]", "[6, 9]", &["shot.json:15:31", "handles.0.nodes.1 is 9", "less than 9"]),
        ("[6, 8]", "[]", &["handles.0.nodes is empty"]),
    ] {
        refused_after("shot.json", from, to, parts);
    }
    refused_after("cotton.json", "0.15", "0", &["cotton.json:2:16: density is 0", "than 0"]);
}

#[test]
fn overrides_are_checked_like_the_file_and_named() {
    let shot = SmallShot::new();
    for (set, parts) in [
        ("view.nu_ot=1", &["there is no setting \"view.nu_ot\"", "\"view.nu_out\""][..]),
        ("nu_out=1", &["did you mean \"view.nu_out\"?"]),
        ("view.nu_out=0", &["view.nu_out is 0", "greater than 0 and at most 1"]),
        ("fps=fast", &["expected a number, found \"fast\""]),
        ("garments=5", &["expected a list, found 5"]),
        ("view=5", &["expected an object, found 5"]),
        ("garments.0.two_sided=5", &["expected true or false, found 5"]),
        ("gravity=[0,0", &["Unterminated array"]),
        ("gravity=[0,0,1e999]", &["1e999"]),
        ("handles.0.nodes.0=-1", &["expected a whole number, 0 or more, found -1"]),
        ("handles.4.end_time=1", &["\"handles\"", "4", "less than 1"]),
    ] {
        let named = format!("--set {set}: ");
        let parts: Vec<&str> = [named.as_str()].into_iter().chain(parts.iter().copied()).collect();
        shot.is_refused_with(&format!("--set {set}"), &parts);
    }
}

#[test]
fn an_empty_scene_is_refused() {
    let shot = SmallShot::new();
    let nothing = "the shot needs at least one garment";
    shot.is_refused_with("--set garments=[] --set handles=[]", &["--set garments=[]", nothing]);
    shot.write("shot.json", "{\"shotsilk\": 1, \"frames\": 2}");
    shot.is_refused(&["shot.json:1:1", nothing]);
}
