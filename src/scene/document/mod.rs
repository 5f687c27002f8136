//! JSON with comments as a tree in which every value knows where it was written, so that errors
//! found long after parsing still point at their line.

mod known;
mod merge;
mod parse;
mod set;
mod typed;

pub(crate) use known::Known;
pub(crate) use parse::SYNTAX;
pub(super) use set::apply_overrides;
pub(crate) use typed::from_json;

use super::error::Place;

/// A JSON value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub place: Place,
    pub value: Value,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Null,
    Bool(bool),
    Number(serde_json::Number),
    String(String),
    Array(Vec<Node>),
    Object(Vec<Member>),
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    pub name: String,
    /// Of the name.
    pub place: Place,
    pub node: Node,
}

impl Node {
    /// A member of an object, an element of an array.
    pub fn child(&self, segment: &str) -> Option<&Node> {
        match &self.value {
            Value::Object(members) => members.iter().find(|m| m.name == segment).map(|m| &m.node),
            Value::Array(elements) => elements.get(segment.parse::<usize>().ok()?),
            _ => None,
        }
    }

    pub fn child_mut(&mut self, segment: &str) -> Option<&mut Node> {
        match &mut self.value {
            Value::Object(members) => {
                members.iter_mut().find(|m| m.name == segment).map(|m| &mut m.node)
            }
            Value::Array(elements) => elements.get_mut(segment.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// The value at a path such as `garments.0.mesh`.
    pub fn at(&self, path: &str) -> Option<&Node> {
        path.split('.').try_fold(self, Node::child)
    }

    /// Where the value at a path stands; if it is not written, the innermost group around it.
    pub fn place_of(&self, path: &str) -> Place {
        let mut node = self;
        for segment in path.split('.') {
            match node.child(segment) {
                Some(child) => node = child,
                None => break,
            }
        }
        node.place.clone()
    }

    /// Sets a member of an object; of no effect on other values.
    pub fn insert(&mut self, name: &str, node: Node) {
        if let Some(existing) = self.child_mut(name) {
            *existing = node;
        } else if let Value::Object(members) = &mut self.value {
            members.push(Member { name: name.to_owned(), place: node.place.clone(), node });
        }
    }

    pub fn as_str(&self) -> Option<&str> {
        match &self.value {
            Value::String(text) => Some(text),
            _ => None,
        }
    }

    /// For messages.
    pub fn kind(&self) -> &'static str {
        match &self.value {
            Value::Null => "null",
            Value::Bool(_) => "true or false",
            Value::Number(_) => "a number",
            Value::String(_) => "a string",
            Value::Array(_) => "a list",
            Value::Object(_) => "an object",
        }
    }
}
