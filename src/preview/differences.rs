//! In which settings two versions of a shot differ.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::camera_edit::is_camera_setting;
use super::edits::is_same;
use super::{Edits, Parameter, value};

/// A setting that two versions have otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// As the panel of settings calls it, or its path in the shot; `camera` for all that a camera
    /// consists of.
    pub name: String,
    /// Its value in A and in B, in short.
    pub values: [String; 2],
}

/// Cameras differ in too many numbers to be listed.
const CAMERA: &str = "camera";
/// Longer values are left out (characters).
const VALUE_MAX: usize = 24;

/// What a version says: the shot, and the edits over it.
#[derive(Clone, Copy)]
pub struct Said<'a> {
    /// [`LoadedShot::written`](crate::scene::LoadedShot).
    pub written: &'a Value,
    pub edits: &'a Edits,
}

/// The differences of two versions of one shot in what can be tuned or has been edited, in order of
/// path.
pub fn tuned_differences(a: Said<'_>, b: Said<'_>, parameters: &[Parameter]) -> Vec<Difference> {
    let edited = a.edits.iter().chain(b.edits.iter()).map(|(path, _)| path);
    let paths: BTreeSet<&str> = edited.chain(parameters.iter().map(|p| &*p.path)).collect();
    let is_other = |of_a: Option<&Value>, of_b: Option<&Value>| match (of_a, of_b) {
        (Some(of_a), Some(of_b)) => !is_same(of_a, of_b),
        _ => of_a.is_some() || of_b.is_some(),
    };
    let difference = |path: &str| {
        if is_camera_setting(path) {
            let values = [String::new(), String::new()];
            return is_other(a.edits.get(path), b.edits.get(path))
                .then(|| Difference { name: CAMERA.to_owned(), values });
        }
        let [of_a, of_b] = [a, b].map(|said| value(said.written, said.edits, path));
        is_other(of_a.as_ref(), of_b.as_ref()).then(|| Difference {
            name: name(path, parameters),
            values: [of_a, of_b].map(|value| in_short(value.as_ref())),
        })
    };
    paths.into_iter().filter_map(difference).collect()
}

/// As the panel of settings calls it; what stands under its first heading needs no heading.
fn name(path: &str, parameters: &[Parameter]) -> String {
    match parameters.iter().find(|parameter| parameter.path == path) {
        Some(found) if found.group == parameters[0].group => found.label.to_owned(),
        Some(found) => format!("{}: {}", found.group, found.label),
        None => path.to_owned(),
    }
}

/// The differences of two resolved shots, in order of path. What all garments have in common is said
/// once, without a garment's number.
pub fn differences(a: &Value, b: &Value) -> Vec<Difference> {
    let mut leaves = Vec::new();
    collect(String::new(), Some(a), Some(b), &mut leaves);
    let mut of_garments: BTreeMap<String, Vec<[String; 2]>> = BTreeMap::new();
    for (path, values) in &leaves {
        if let Some(common) = in_garment(path) {
            of_garments.entry(common.to_owned()).or_default().push(values.clone());
        }
    }
    let garment_count = b["garments"].as_array().map_or(0, Vec::len);
    let is_common = |values: &Vec<[String; 2]>| {
        values.len() == garment_count && values.iter().all(|pair| *pair == values[0])
    };
    let mut found: BTreeMap<String, [String; 2]> = BTreeMap::new();
    for (path, values) in leaves {
        match in_garment(&path) {
            Some(common) if is_common(&of_garments[common]) => {
                found.insert(common.to_owned(), values);
            }
            // What the shot says of all garments, they say themselves.
            None if of_garments.contains_key(&path) => {}
            _ => {
                found.insert(path, values);
            }
        }
    }
    found.into_iter().map(|(name, values)| Difference { name, values }).collect()
}

/// A garment's path without which garment it is.
fn in_garment(path: &str) -> Option<&str> {
    path.strip_prefix("garments.")?.split_once('.').map(|(_, rest)| rest)
}

/// Every value that is in one and not, or otherwise, in the other; `None` is one that is not there.
fn collect(
    path: String,
    a: Option<&Value>,
    b: Option<&Value>,
    leaves: &mut Vec<(String, [String; 2])>,
) {
    if a == b {
        return;
    }
    if path == "viewers" || path == CAMERA {
        leaves.push((CAMERA.to_owned(), [String::new(), String::new()]));
        return;
    }
    let below = |name: &str| match path.is_empty() {
        true => name.to_owned(),
        false => format!("{path}.{name}"),
    };
    match (a, b) {
        (Some(Value::Object(of_a)), Some(Value::Object(of_b))) => {
            let names = of_a.keys().chain(of_b.keys().filter(|name| !of_a.contains_key(*name)));
            for name in names {
                collect(below(name), of_a.get(name), of_b.get(name), leaves);
            }
        }
        (Some(Value::Array(of_a)), Some(Value::Array(of_b)))
            if of_a.iter().chain(of_b).any(Value::is_object) =>
        {
            for index in 0..of_a.len().max(of_b.len()) {
                collect(below(&index.to_string()), of_a.get(index), of_b.get(index), leaves);
            }
        }
        _ => leaves.push((path, [a, b].map(in_short))),
    }
}

fn in_short(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "-".to_owned(),
        Some(value) => {
            let text = value.to_string();
            if text.chars().count() > VALUE_MAX { "...".to_owned() } else { text }
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::preview::ParameterKind;

    fn difference(name: &str, a: &str, b: &str) -> Difference {
        Difference { name: name.to_owned(), values: [a.to_owned(), b.to_owned()] }
    }

    #[test]
    fn what_has_been_edited_is_called_as_in_the_panel() {
        let parameter = |path: &str, group: &str, label| Parameter {
            path: path.to_owned(),
            label,
            unit: "",
            kind: ParameterKind::Integer { min: 0, max: 1 },
            default: None,
            help: String::new(),
            group: group.to_owned(),
        };
        let parameters = [
            parameter("view.nu_out", "View", "Detail out of frame"),
            parameter("fabrics.silk.bend", "Fabric: silk", "Bend stiffness"),
        ];
        let written = json!({"view": {"nu_out": 0.1}, "fabrics": {"silk": {"bend": 1}}});
        let edits = |values: &[(&str, Value)]| {
            let mut edits = Edits::none();
            values.iter().for_each(|(path, value)| edits.set(path, value.clone()));
            edits
        };
        let a = edits(&[("view.nu_out", json!(0.2)), ("fps", json!(24.0))]);
        let b = edits(&[
            ("fabrics.silk.bend", json!(3)),
            ("fps", json!(24)),
            ("camera", json!({"keys": []})),
        ]);
        let [a, b] = [&a, &b].map(|edits| Said { written: &written, edits });
        let expected = [
            difference("camera", "", ""),
            difference("Fabric: silk: Bend stiffness", "1", "3"),
            difference("Detail out of frame", "0.2", "0.1"),
        ];
        assert_eq!(tuned_differences(a, b, &parameters), expected);
        assert_eq!(tuned_differences(a, a, &parameters), []);
    }

    #[test]
    fn what_all_garments_have_is_said_once_and_a_camera_in_one_word() {
        let shot = |nu_out: f64, eye: f64| {
            let garment = json!({"view": {"nu_out": nu_out, "nu_back": 0.5}});
            let written = if nu_out == 0.1 { json!(null) } else { json!(nu_out) };
            json!({
                "view": {"nu_out": written},
                "garments": [garment, garment],
                "viewers": [{"keys": [{"eye": [eye, 0, 0]}]}],
            })
        };
        assert_eq!(differences(&shot(0.1, 0.0), &shot(0.1, 0.0)), []);
        let found = differences(&shot(0.1, 0.0), &shot(0.2, 1.0));
        assert_eq!(found, [difference("camera", "", ""), difference("view.nu_out", "0.1", "0.2")]);
    }

    #[test]
    fn what_one_garment_has_is_said_of_it() {
        let shot = |of_second: f64| json!({"garments": [{"view": {"nu_out": 0.1}}, {"view": {"nu_out": of_second}}]});
        let found = differences(&shot(0.1), &shot(0.3));
        assert_eq!(found, [difference("garments.1.view.nu_out", "0.1", "0.3")]);
    }

    #[test]
    fn lists_are_values_and_what_is_missing_or_long_is_said_in_short() {
        let (a, b) = (
            json!({"air": {"velocity": [1, 0, 0]}, "text": "a", "gone": 1}),
            json!({"air": {"velocity": [2, 0, 0]}, "text": "b".repeat(60)}),
        );
        let expected = [
            difference("air.velocity", "[1,0,0]", "[2,0,0]"),
            difference("gone", "1", "-"),
            difference("text", "\"a\"", "..."),
        ];
        assert_eq!(differences(&a, &b), expected);
    }
}
