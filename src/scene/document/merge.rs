//! A shot that wraps an imported scene: what it says replaces what the scene says.

use super::{Node, Value};

/// The list that is merged by index, so that one garment's settings can be changed in place.
const MERGED_LIST: &str = "garments";

impl Node {
    /// Objects merge key by key, `garments` element by element; anything else is replaced.
    pub fn overlay(&mut self, over: Node) {
        let (Value::Object(_), Value::Object(members)) = (&self.value, &over.value) else {
            *self = over;
            return;
        };
        for member in members.clone() {
            match self.child_mut(&member.name) {
                Some(below) if member.name == MERGED_LIST => below.overlay_elements(member.node),
                Some(below) => below.overlay(member.node),
                None => self.insert(&member.name, member.node),
            }
        }
    }

    fn overlay_elements(&mut self, over: Node) {
        match (&mut self.value, over.value) {
            (Value::Array(below), Value::Array(elements)) => {
                for (k, element) in elements.into_iter().enumerate() {
                    match below.get_mut(k) {
                        Some(node) => node.overlay(element),
                        None => below.push(element),
                    }
                }
            }
            (_, value) => *self = Node { place: over.place, value },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrapper_changes_only_what_it_names() {
        let mut below = Node::parse(
            "below",
            r#"{"a": {"x": 1, "y": 2}, "list": [1, 2], "garments": [{"m": 1, "n": 2}]}"#,
        )
        .unwrap();
        let over = r#"{"a": {"y": 3}, "list": [5], "garments": [{"n": 7}, {"m": 8}]}"#;
        below.overlay(Node::parse("over", over).unwrap());
        let merged: serde_json::Value = below.deserialize().unwrap();
        let expected = serde_json::json!({
            "a": {"x": 1, "y": 3}, "list": [5], "garments": [{"m": 1, "n": 7}, {"m": 8}]
        });
        assert_eq!(merged, expected);
        assert!(below.place_of("a.y").to_string().starts_with("over"));
    }
}
