//! Obstacles that deform.

use glam::DVec3;

use super::{BALL, SHOT, files};
use crate::scene::{LoadError, LoadOptions, LoadedShot, load};

/// The shot with an obstacle that deforms.
fn deforming(obstacle: &str) -> Result<LoadedShot, LoadError> {
    let moved = BALL.replace("v 0 0 1", "v 0 0 3");
    let other = BALL.replace("f 2 3 4", "f 2 4 3");
    let rigid = r#"{"mesh": "meshes/ball.obj", "motion": "dance"}"#;
    assert!(SHOT.contains(rigid));
    let source = files()
        .with("w/a.json", SHOT.replacen(rigid, obstacle, 1).into_bytes())
        .with("w/body.0001.obj", BALL.as_bytes())
        .with("w/body.0002.obj", moved.into_bytes())
        .with("w/other.0002.obj", other.into_bytes())
        .with("w/other.0001.obj", BALL.as_bytes());
    load(&LoadOptions { shot: "w/a.json".into(), ..LoadOptions::default() }, &source)
}

#[test]
fn an_obstacle_that_deforms_is_a_list_of_meshes_or_numbered_files() {
    let cases = [
        r#"{"mesh_sequence": {"pattern": "body.%04d.obj", "fps": 4, "first": 1}}"#,
        r#"{"meshes": [{"time": 0, "mesh": "body.0001.obj"},
                       {"time": 0.25, "mesh": "body.0002.obj"}]}"#,
    ];
    for case in cases {
        let scene = deforming(case).unwrap().scene;
        let obstacle = &scene.obstacles[0];
        assert_eq!(obstacle.name, "body.0001");
        let points = scene.moved_points(0.125);
        assert_eq!(points[&0][3], DVec3::Z * 2.0);
        assert_eq!(obstacle.surface.positions[3], DVec3::Z);
    }
}

#[test]
fn a_deforming_obstacle_that_makes_no_sense_is_refused() {
    let message = |obstacle: &str| deforming(obstacle).expect_err("it is bad").to_string();
    let sequence = |rest: &str| message(&format!("{{\"mesh_sequence\": {{{rest}}}}}"));
    let other = sequence(r#""pattern": "other.%04d.obj", "fps": 4, "first": 1"#);
    assert!(other.contains("w/other.0002.obj: ") && other.contains("same triangles"), "{other}");
    let none = sequence(r#""pattern": "body.%04d.obj", "fps": 4, "first": 7"#);
    assert!(none.contains("a file with the first number"), "{none}");
    let missing = sequence(r#""pattern": "body.%04d.obj", "fps": 4, "first": 1, "last": 3"#);
    assert!(missing.contains("body.0003.obj"), "{missing}");
    for (first, last, limit) in
        [(1, 0, "from 1 (first) to 100000"), (2, 100_002, "from 2 (first) to 100001")]
    {
        let rest = format!(
            "\"pattern\": \"body.%04d.obj\", \"fps\": 4, \"first\": {first}, \"last\": {last}"
        );
        let message = sequence(&rest);
        let named = format!("mesh_sequence.last is {last}, but must be {limit}");
        assert!(message.contains(&named), "{message}");
    }
    let wide = sequence(r#""pattern": "body.%99999d.obj", "fps": 4, "first": 1"#);
    assert!(wide.contains("one %d"), "{wide}");
    let still = sequence(r#""pattern": "body.%04d.obj", "fps": 0"#);
    assert!(still.contains("fps"), "{still}");
    let both = message(r#"{"mesh": "meshes/ball.obj", "meshes": []}"#);
    assert!(both.contains("exclude each other"), "{both}");
    assert!(message("{}").contains("a mesh, meshes or a mesh_sequence"));
    assert!(message(r#"{"meshes": []}"#).contains("at least one mesh"));
    let order = message(
        r#"{"meshes": [{"time": 1, "mesh": "body.0001.obj"}, {"time": 1, "mesh": "body.0002.obj"}]}"#,
    );
    assert!(order.contains("does not come after"), "{order}");
}
