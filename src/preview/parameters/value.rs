//! Which value of a setting is in force.

use serde_json::{Value, json};

use crate::preview::Edits;
use crate::scene::native::{FabricFile, SHOT_VERSION, ShotFile};
use crate::scene::{SizingSettings, ViewSettings};

/// The value in force at a path: the edit if there is one, else what the shot says, else for a
/// garment's view that of the shot's own, else the program's default. `written` is
/// [`LoadedShot::written`](crate::scene::LoadedShot), `edits` those made since.
///
/// `null` is a sizing criterion that is off. `None` is a setting that nobody states and that has no
/// default. Edits count at the path or above it.
pub fn value(written: &Value, edits: &Edits, path: &str) -> Option<Value> {
    if let Some(value) = edited(edits, path).unwrap_or_else(|| at(written, path)) {
        let is_unset = value.is_null() && !null_is_infinite(path);
        if !is_unset {
            return Some(value.clone());
        }
    }
    match segments(path)[..] {
        ["garments", _, "view", name] => value_of_shot_view(written, edits, name),
        _ => default_value(path),
    }
}

/// The program's default for a setting, whatever the shot says.
pub fn default_value(path: &str) -> Option<Value> {
    let group = |group: Value, name: &str| group.get(name).cloned();
    match segments(path)[..] {
        ["view", name] | ["garments", _, "view", name] => {
            group(json!(ViewSettings::default()), name)
        }
        ["garments", _, "sizing", name] => group(json!(SizingSettings::default()), name),
        ["fabrics", _, name] => group(json!(FabricFile::default()), name),
        _ => {
            let bare = json!({"shotsilk": SHOT_VERSION});
            let file: ShotFile = serde_json::from_value(bare).ok()?;
            at(&json!(file), path).filter(|value| !value.is_null()).cloned()
        }
    }
}

/// What the shot itself says at a path, if anything.
pub fn stated_value<'a>(written: &'a Value, path: &str) -> Option<&'a Value> {
    at(written, path).filter(|value| !value.is_null())
}

/// True if the shot itself says something at a path.
pub(super) fn stated(written: &Value, path: &str) -> bool {
    stated_value(written, path).is_some()
}

fn value_of_shot_view(written: &Value, edits: &Edits, name: &str) -> Option<Value> {
    value(written, edits, &format!("view.{name}"))
}

/// What the edit nearest to a path says there, which may be nothing; `None` without such an edit.
fn edited<'a>(edits: &'a Edits, path: &str) -> Option<Option<&'a Value>> {
    if let Some(value) = edits.get(path) {
        return Some(Some(value));
    }
    path.rmatch_indices('.').find_map(|(dot, _)| {
        let (above, rest) = (&path[..dot], &path[dot + 1..]);
        edits.get(above).map(|value| at(value, rest))
    })
}

fn at<'a>(root: &'a Value, path: &str) -> Option<&'a Value> {
    path.split('.').try_fold(root, |value, segment| match value {
        Value::Array(elements) => elements.get(segment.parse::<usize>().ok()?),
        group => group.get(segment),
    })
}

fn segments(path: &str) -> Vec<&str> {
    path.split('.').collect()
}

/// Tolerances and bounds of the sizing; their `null` is infinity, any other leaves a setting out.
fn null_is_infinite(path: &str) -> bool {
    matches!(segments(path)[..], ["garments", _, "sizing", name] if name != "aspect_min")
}
