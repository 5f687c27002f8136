use serde_json::json;

use super::*;
use crate::own_shot::own_shot;
use crate::preview::Edits;
use crate::scene::{LoadOptions, LoadedShot, load};

fn loaded(edits: &Edits) -> LoadedShot {
    let (shot, files) = own_shot();
    let options = LoadOptions { shot, sets: edits.overrides(), ..LoadOptions::default() };
    load(&options, &files).unwrap_or_else(|error| panic!("{error}"))
}

fn of_own_shot() -> Vec<Parameter> {
    let shot = loaded(&Edits::default());
    parameters(&shot.written, &shot.scene)
}

/// Both ends, and `null` where that is a value.
fn extremes(kind: ParameterKind) -> Vec<Value> {
    match kind {
        ParameterKind::Number { min, max, off: Off::Never, .. } => vec![json!(min), json!(max)],
        ParameterKind::Number { min, max, off: Off::Null, .. } => {
            vec![json!(min), json!(max), Value::Null]
        }
        ParameterKind::Integer { min, max } => vec![json!(min), json!(max)],
        ParameterKind::Vector3 { min, max, .. } => {
            vec![json!(vec![min; 3]), json!([max, min, 0.5])]
        }
    }
}

#[test]
fn every_value_of_a_range_is_accepted_as_an_override_and_is_then_in_force() {
    let unedited = loaded(&Edits::default());
    for parameter in of_own_shot() {
        let path = &parameter.path;
        for given in extremes(parameter.kind) {
            let mut edits = Edits::default();
            edits.set(path, given.clone());
            let shot = loaded(&edits);
            assert_eq!(value(&shot.written, &Edits::default(), path), Some(given.clone()));
            assert_eq!(value(&unedited.written, &edits, path), Some(given));
        }
    }
}

#[test]
fn both_ends_of_all_ranges_are_accepted_together() {
    for end in [0, 1] {
        let mut edits = Edits::default();
        for parameter in of_own_shot() {
            edits.set(&parameter.path, extremes(parameter.kind).swap_remove(end));
        }
        loaded(&edits);
    }
}

#[test]
fn every_parameter_is_explained_once_and_has_a_default() {
    let parameters = of_own_shot();
    for parameter in &parameters {
        assert!(!parameter.help.is_empty() && !parameter.help.contains('\n'), "{parameter:?}");
        assert!(!parameter.label.is_empty() && parameter.default.is_some(), "{parameter:?}");
        let same = parameters.iter().filter(|p| p.path == parameter.path).count();
        assert_eq!(same, 1, "{}", parameter.path);
    }
    let groups: Vec<&str> =
        parameters.chunk_by(|a, b| a.group == b.group).map(|g| g[0].group.as_str()).collect();
    assert_eq!(groups, ["View", "Sizing: skirt", "Time and air", "Contact", "Fabric: twill"]);
}

#[test]
fn defaults_of_the_list_are_those_of_a_shot_that_says_nothing() {
    let shot = loaded(&Edits::default());
    let view = &shot.resolved["garments"][0]["view"];
    for parameter in of_own_shot().iter().filter(|p| p.group == "View") {
        let name = parameter.path.trim_start_matches("view.");
        assert_eq!(parameter.default.as_ref(), view.get(name), "{name}");
    }
    assert_eq!(default_value("steps_per_frame"), Some(json!(8)));
    assert_eq!(default_value("contact.thickness"), Some(json!(0.005)));
    assert_eq!(default_value("garments.0.sizing.refine_angle"), Some(json!(0.3)));
    assert_eq!(default_value("fabrics.twill.damping"), Some(json!(0.0)));
    assert_eq!((default_value("frames"), default_value("no.such")), (None, None));
}

#[test]
fn a_value_is_that_of_the_edit_then_of_the_shot_then_the_default() {
    let written = loaded(&Edits::default()).written;
    let mut edits = Edits::default();
    assert_eq!(value(&written, &edits, "fabrics.twill.damping"), Some(json!(0.002)));
    assert_eq!(value(&written, &edits, "fabrics.twill.bending_mult"), Some(json!(1.0)));
    assert_eq!(value(&written, &edits, "view.nu_out"), Some(json!(0.01)));
    edits.set("view", json!({"nu_out": 0.3}));
    edits.set("garments.0.sizing.edge_length_max", Value::Null);
    assert_eq!(value(&written, &edits, "view.nu_out"), Some(json!(0.3)));
    assert_eq!(value(&written, &edits, "view.nu_back"), Some(json!(0.2)));
    let longest = value(&written, &edits, "garments.0.sizing.edge_length_max");
    assert_eq!(longest, Some(Value::Null));
}

#[test]
fn a_garment_has_the_views_of_the_shot_until_it_says_otherwise() {
    let mut edits = Edits::default();
    edits.set("garments.0.view.nu_back", json!(0.6));
    edits.set("view.nu_out", json!(0.07));
    let shot = loaded(&edits);
    let own = parameters(&shot.written, &shot.scene);
    let own: Vec<&str> =
        own.iter().filter(|p| p.group == "View: skirt").map(|p| p.path.as_str()).collect();
    assert_eq!(own, ["garments.0.view.nu_back"]);
    let in_force = |path| value(&shot.written, &Edits::default(), path);
    assert_eq!(in_force("garments.0.view.nu_back"), Some(json!(0.6)));
    assert_eq!(in_force("view.nu_back"), Some(json!(0.2)));
    assert_eq!(in_force("garments.0.view.nu_out"), Some(json!(0.07)));
    assert_eq!(shot.scene.garments[0].view.nu_out, 0.07);
}

#[test]
fn several_garments_have_views_of_their_own_and_fabrics_are_listed_once() {
    let shot = loaded(&Edits::default());
    let mut scene = shot.scene;
    let mut written = shot.written;
    scene.garments.push(scene.garments[0].clone());
    scene.garments.push(scene.garments[0].clone());
    let garments = written["garments"].as_array_mut().unwrap();
    garments.push(garments[0].clone());
    garments.push(json!({"fabric": "wool v1.2"}));
    let parameters = parameters(&written, &scene);
    let count = |start: &str| parameters.iter().filter(|p| p.path.starts_with(start)).count();
    assert_eq!((count("garments.1.view."), count("garments.2.sizing.")), (8, 6));
    assert_eq!((count("fabrics.twill."), count("fabrics.")), (5, 5));
}

#[test]
fn ranges_of_edge_lengths_meet_between_what_the_garment_has() {
    let mut edits = Edits::default();
    edits.set("garments.0.sizing.edge_length_min", json!(0.08));
    let shot = loaded(&edits);
    let parameters = parameters(&shot.written, &shot.scene);
    let range = |name: &str| match parameters.iter().find(|p| p.path.ends_with(name)).unwrap().kind
    {
        ParameterKind::Number { min, max, .. } => [min, max],
        _ => unreachable!(),
    };
    assert_eq!(range("edge_length_min"), [1e-3, 0.08]);
    assert_eq!(range("edge_length_max"), [0.08, 2.0]);
}
