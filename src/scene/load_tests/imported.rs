//! Scenes of other programs, alone and in a shot around them.

use std::path::Path;

use glam::DVec3;

use super::{files, load_text, message};
use crate::mesh::NodeOrigin;
use crate::scene::{FileSystem, LoadOptions, LoadedShot, load};

#[test]
fn a_scene_keeps_its_own_defaults_and_reports_what_it_leaves_out() {
    let options = LoadOptions { shot: "w/conf/scene.json".into(), ..LoadOptions::default() };
    let loaded = load(&options, &files()).unwrap();
    let scene = loaded.scene;
    assert_eq!((scene.fps, scene.steps_per_frame, scene.last_frame), (25.0, 8, Some(50)));
    assert_eq!((scene.handle_stiffness, scene.contact.thickness), (1e3, 1e-3));
    assert_eq!((scene.gravity, scene.air.density), (DVec3::ZERO, 1.0));
    assert_eq!(scene.garments[0].sizing.refine_velocity, f64::INFINITY);
    assert_eq!(scene.obstacles.len(), 2);
    assert!(!scene.stages.untangling && scene.stages.collision);
    let text = loaded.warnings.join("\n");
    for part in ["\"yield_curv\" is not supported", "\"popfilter\"", "\"edge_flip_threshold\""] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    assert_eq!(loaded.warnings.len(), 3);
}

#[test]
fn a_wrapper_and_overrides_change_an_imported_scene_by_native_names() {
    let wrapper = r#"{"shotsilk": 1, "import": "conf/scene.json", "handle_stiffness": 5,
        "garments": [{"view": {"nu_back": 0.7}}], "camera": "main.camera.json", "fps": 24}"#;
    let sets = ["garments.0.sizing.refine_velocity=2", "garments.0.two_sided=false"];
    let scene = load_text(wrapper, &sets).unwrap().scene;
    let garment = &scene.garments[0];
    assert_eq!((scene.handle_stiffness, scene.fps, scene.viewers.len()), (5.0, 24.0, 1));
    assert_eq!((garment.view.nu_back, garment.sizing.refine_velocity), (0.7, 2.0));
    assert!(!garment.two_sided);
    let error = message(&wrapper.replace("\"nu_back\": 0.7", "\"nu_back\": 7"), &[]);
    assert!(error.starts_with("w/a.json:2:43: garments.0.view.nu_back is 7"), "{error}");
}

/// The reference scenes, if they are there.
fn reference(scene: &str, camera: Option<&str>) -> Option<LoadedShot> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let shot = data.join("arcsim/conf").join(scene);
    if !shot.is_file() {
        eprintln!("skipped: {} is not there", shot.display());
        return None;
    }
    let camera = camera.map(|name| data.join("cameras").join(name));
    let options = LoadOptions { shot, camera, ..LoadOptions::default() };
    Some(load(&options, &FileSystem).unwrap())
}

#[test]
fn the_reference_dress_loads_with_body_and_camera() {
    let Some(loaded) = reference("dress-blue.json", Some("solo-dancer.camera.json")) else {
        return;
    };
    let scene = loaded.scene;
    let garment = &scene.garments[0];
    assert_eq!(garment.mesh.check(), Ok(()));
    let mesh = &garment.mesh;
    assert_eq!((mesh.node_count(), mesh.vertex_count(), mesh.face_count()), (78, 104, 112));
    assert!(!garment.two_sided);
    assert_eq!((scene.motions.len(), scene.obstacles.len()), (16, 16));
    let triangles: usize = scene.obstacles.iter().map(|o| o.surface.triangles.len()).sum();
    assert!((26_000..=26_842).contains(&triangles), "{triangles}");
    assert_eq!((scene.fps, scene.last_frame), (25.0, Some(500)));
    assert_eq!(scene.contact.thickness, 5e-3);
    assert_eq!(scene.obstacles[11].motion.map(|m| scene.motions[m].keys().len()), Some(716));
    // The body stands where the dress is: between head and floor of the dance.
    let pose = scene.obstacle_pose(&scene.obstacles[0], 0.0);
    assert!(pose.translation.length() < 2.0, "{pose:?}");
    assert_eq!(loaded.warnings, Vec::<String>::new());
}

#[test]
fn the_reference_sheets_load_as_two_sided_garments() {
    for (scene, camera, handles) in [
        ("flag.json", Some("flag.camera.json"), 1),
        ("sphere.json", Some("sphere.camera.json"), 1),
        ("sphere-annotated.json", None, 1),
        ("square.json", None, 2),
    ] {
        let Some(loaded) = reference(scene, camera) else { return };
        let garment = &loaded.scene.garments[0];
        assert_eq!(garment.mesh.check(), Ok(()));
        assert!(garment.two_sided, "{scene}");
        assert_eq!(loaded.scene.handles.len(), handles);
        let node = loaded.scene.handles[0].nodes[0];
        let kept = NodeOrigin::Kept { index: node };
        assert!(garment.mesh.node_ids().any(|n| garment.mesh.node_origin(n) == kept));
        assert_eq!(loaded.warnings, [""; 0], "{scene}");
    }
}

#[test]
fn the_square_has_no_velocity_criterion_and_stops_at_its_keys() {
    let Some(loaded) = reference("square.json", None) else { return };
    let scene = loaded.scene;
    assert_eq!(scene.garments[0].sizing.refine_velocity, f64::INFINITY);
    assert!(!scene.stages.strain_limiting);
    let motion = &scene.motions[scene.handles[0].motion.unwrap()];
    assert_eq!(motion.pose(6.5).translation, DVec3::new(0.45, 0.0, 0.0));
}
