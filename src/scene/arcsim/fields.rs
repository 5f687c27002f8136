//! Taking an object apart, and noticing what nobody took.

use serde::Serialize;

use crate::scene::document::{Member, Node, Value};
use crate::scene::error::{LoadError, Place, Problem};

/// An object's members; those never taken are reported.
pub(super) struct Fields<'a> {
    place: &'a Place,
    members: &'a [Member],
    taken: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    /// # Errors
    /// If the value is no object; `what` says of what.
    pub fn new(node: &'a Node, what: &str) -> Result<Self, LoadError> {
        match &node.value {
            Value::Object(members) => Ok(Self { place: &node.place, members, taken: Vec::new() }),
            _ => {
                let what = format!("{what} must be an object, but is {}", node.kind());
                Err(Problem::Shape(what).at(node.place.clone()))
            }
        }
    }

    pub fn place(&self) -> Place {
        self.place.clone()
    }

    pub fn take(&mut self, name: &'static str) -> Option<&'a Node> {
        self.taken.push(name);
        self.members.iter().find(|m| m.name == name).map(|m| &m.node)
    }

    pub fn take_or(&mut self, name: &'static str, default: impl Serialize) -> Node {
        self.take(name).cloned().unwrap_or_else(|| json(self.place, default))
    }

    /// Takes what this program leaves out on purpose, and says so.
    pub fn leave(&mut self, name: &'static str, why: &str, warnings: &mut Vec<String>) {
        if let Some(node) = self.take(name) {
            warnings.push(format!("{}: {name:?} {why}", node.place));
        }
    }

    pub fn finish(self, warnings: &mut Vec<String>) {
        for member in self.members.iter().filter(|m| !self.taken.contains(&m.name.as_str())) {
            let (place, name) = (&member.place, &member.name);
            warnings.push(format!("{place}: {name:?} is unknown and not used"));
        }
    }
}

/// The elements of a list; a single value is a list of one.
pub(super) fn list(node: &Node) -> &[Node] {
    match &node.value {
        Value::Array(elements) => elements,
        _ => std::slice::from_ref(node),
    }
}

/// Plain data as if it had been written at a place.
pub(super) fn json(place: &Place, value: impl Serialize) -> Node {
    let text = serde_json::to_string(&value).expect("plain data");
    Node::from_argument(&text, place).expect("what serde writes is JSON")
}

pub(super) fn object<'n>(
    place: &Place,
    members: impl IntoIterator<Item = (&'n str, Node)>,
) -> Node {
    let member = |(name, node): (&str, Node)| Member {
        name: name.to_owned(),
        place: node.place.clone(),
        node,
    };
    let members = members.into_iter().map(member).collect();
    Node { place: place.clone(), value: Value::Object(members) }
}

pub(super) fn array(place: &Place, elements: Vec<Node>) -> Node {
    Node { place: place.clone(), value: Value::Array(elements) }
}
