//! Overrides from the command line: `path.to.field=value`.

use serde_json::Value as Json;

use super::{Known, Node, Value};
use crate::scene::error::{LoadError, Place, Problem};

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
        let known = Known::of(schema);
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
