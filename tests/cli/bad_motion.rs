//! Motions that are none.

use super::small_shot::{SmallShot, refused_after};

const SAMPLES: &str = "NumFrames: 2\nbody[0] position\n0 0 0\n0 0 1\n\nbody[0] orientation\n\
    1 0 0 0\n1 0 0 0\n";

#[test]
fn keys_must_be_finite_and_in_order() {
    for (to, parts) in [
        ("[0, 0, 1e400]", &["shot.json:12:", "1e400"][..]),
        ("[0, 0, NaN]", &["shot.json:12:"]),
        ("[0, 0, null]", &["shot.json:12:", "null", "a number"]),
    ] {
        refused_after("shot.json", "[0, 0, 0.5]", to, parts);
    }
    let parts = ["motion \"rise\": key 1 at 0 s does not come after the one before it, at 0 s"];
    refused_after("shot.json", "\"time\": 1", "\"time\": 0", &parts);
}

#[test]
fn finite_keys_must_give_a_finite_curve() {
    let far = |x: &str| format!("\"transform\": {{\"translate\": [{x}, 0, 0]}}");
    let (low, high) = (far("-1e308"), far("1e308"));
    let keys = format!(
        "{{\"time\": 0, {low}}}, {{\"time\": 0.5}}, {{\"time\": 0.9, {high}}}, {{\"time\": 1"
    );
    let parts = ["motion \"rise\": the motion through key 1 is not finite"];
    refused_after("shot.json", "{\"time\": 0}, {\"time\": 1", &keys, &parts);
}

#[test]
fn a_motion_file_is_checked_line_by_line() {
    let shot = SmallShot::new();
    shot.replace("shot.json", "{\"keys\": [", "{\"file\": \"solid.mot\"}, \"other\": {\"keys\": [");
    shot.is_refused(&["shot.json:11:", "cannot read \"solid.mot\""]);
    for (from, to, parts) in [
        ("0 0 1\n", "0 nan 1\n", &["solid.mot:4: expected x y z", "\"0 nan 1\""][..]),
        ("NumFrames: 2", "NumFrames: 0", &["solid.mot:1: expected NumFrames", "\"NumFrames: 0\""]),
        ("1 0 0 0\n1 0", "0 0 0 0\n1 0", &["solid.mot:7: expected a quaternion"]),
        ("1 0 0 0\n1 0 0 0\n", "1 0 0 0\n", &["solid.mot:", "expected w x y z"]),
    ] {
        assert!(SAMPLES.contains(from), "{from}");
        shot.write("solid.mot", &SAMPLES.replacen(from, to, 1));
        let before = shot.names("");
        shot.run("simulate shot.json --out run").fails(3, parts);
        assert_eq!(shot.names(""), before);
    }
    shot.write("solid.mot", SAMPLES);
    shot.run("simulate shot.json --out run --frames 1").succeeds();
}
