//! Overrides from the command line: `path.to.field=value`.

use serde_json::Value as Json;

use super::{Node, Value};
use crate::scene::error::{LoadError, Place, Problem, nearest};

/// Levels of settings below which a suggestion is not searched for.
const SUGGESTION_DEPTH: usize = 4;

/// Applies each override in order.
///
/// # Errors
/// A path that the schema does not know, or that runs past the end of a list or into a plain
/// value.
pub(in crate::scene) fn apply_overrides(
    root: &mut Node,
    arguments: &[String],
    schema: &Json,
) -> Result<(), LoadError> {
    for argument in arguments {
        let place = Place::Set { argument: argument.as_str().into() };
        let (path, value) = match argument.split_once('=') {
            Some((path, value)) if !path.is_empty() => (path.trim(), value.trim()),
            _ => return Err(Problem::NoOverride(argument.clone()).nowhere()),
        };
        let known = Known { schema };
        known.check(path).and_then(|()| set(root, path, value, &place)).map_err(|p| p.at(place))?;
    }
    Ok(())
}

fn set(root: &mut Node, path: &str, value: &str, place: &Place) -> Result<(), Problem> {
    let mut node = root;
    let segments: Vec<&str> = path.split('.').collect();
    for (depth, &segment) in segments.iter().enumerate() {
        let parent = || segments[..depth].join(".");
        match &node.value {
            Value::Object(_) => {
                if node.child(segment).is_none() {
                    let empty = Node { place: place.clone(), value: Value::Object(Vec::new()) };
                    node.insert(segment, empty);
                }
            }
            Value::Array(elements) if node.child(segment).is_none() => {
                return Err(Problem::OutOfRange {
                    thing: format!("the index into {:?}", parent()),
                    value: segment.to_owned(),
                    limit: format!("less than {}", elements.len()),
                });
            }
            Value::Array(_) => {}
            _ => {
                let (path, found) = (path.to_owned(), node.kind());
                return Err(Problem::NoGroup { path, parent: parent(), found });
            }
        }
        node = node.child_mut(segment).expect("the child was found or made above");
    }
    *node = Node::from_argument(value, place)?;
    Ok(())
}

/// The settings that exist, by the JSON Schema of the shot file.
struct Known<'a> {
    schema: &'a Json,
}

impl<'a> Known<'a> {
    fn check(&self, path: &str) -> Result<(), Problem> {
        let mut at = vec![self.schema];
        for segment in path.split('.') {
            let next: Vec<_> = at.iter().flat_map(|s| self.children(s, segment)).collect();
            if next.is_empty() {
                let siblings = at.iter().flat_map(|s| self.names(s));
                let slip = nearest(segment, siblings).map(|name| path.replacen(segment, &name, 1));
                let nearest = slip.or_else(|| self.elsewhere(segment));
                return Err(Problem::UnknownSetting { path: path.to_owned(), nearest });
            }
            at = next;
        }
        Ok(())
    }

    /// The schemas that a value may follow: itself, what it refers to, its alternatives.
    fn alternatives(&self, schema: &'a Json) -> Vec<&'a Json> {
        let mut found = vec![schema];
        if let Some(name) = schema["$ref"].as_str().and_then(|r| r.strip_prefix("#/$defs/")) {
            found.extend(self.alternatives(&self.schema["$defs"][name]));
        }
        for key in ["anyOf", "oneOf", "allOf"] {
            for option in schema[key].as_array().into_iter().flatten() {
                found.extend(self.alternatives(option));
            }
        }
        found
    }

    fn children(&self, schema: &'a Json, segment: &str) -> Vec<&'a Json> {
        let is_index = segment.parse::<usize>().is_ok();
        let child = |option: &'a Json| {
            let named = option["properties"].get(segment);
            let keyed = option.get("additionalProperties").filter(|rest| rest.is_object());
            let item = option.get("items").filter(|_| is_index);
            named.or(keyed).or(item)
        };
        self.alternatives(schema).into_iter().filter_map(child).collect()
    }

    fn names(&self, schema: &'a Json) -> Vec<&'a str> {
        let properties = |option: &'a Json| option["properties"].as_object();
        let groups = self.alternatives(schema).into_iter().filter_map(properties);
        groups.flat_map(|group| group.keys().map(String::as_str)).collect()
    }

    /// The shortest path to a setting of that name.
    fn elsewhere(&self, name: &str) -> Option<String> {
        let mut level = vec![(String::new(), self.schema)];
        for _ in 0..SUGGESTION_DEPTH {
            let mut below = Vec::new();
            for (path, schema) in level {
                for key in self.names(schema) {
                    let path = format!("{path}{key}");
                    if key == name {
                        return Some(path);
                    }
                    let children = self.children(schema, key);
                    for &child in &children {
                        below.push((format!("{path}."), child));
                        let items = self.children(child, "0");
                        below.extend(items.into_iter().map(|i| (format!("{path}.0."), i)));
                    }
                }
            }
            level = below;
        }
        None
    }
}
