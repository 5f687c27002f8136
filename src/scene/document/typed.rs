//! From the tree to types.

use serde::de::DeserializeOwned;

use super::{Node, Value};
use crate::scene::error::{LoadError, Place, Problem};

/// A value of a type from JSON with comments.
///
/// # Errors
/// As [`Node::parse`] and [`Node::deserialize`].
pub(crate) fn from_json<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, LoadError> {
    Node::parse(file, text)?.deserialize()
}

impl Node {
    /// The tree as a value of a type.
    ///
    /// # Errors
    /// What the type does not accept, with the place of the offending key or value.
    pub fn deserialize<T: DeserializeOwned>(&self) -> Result<T, LoadError> {
        serde_json::from_value(self.json()).map_err(|_| self.error::<T>())
    }

    /// The tree without places.
    pub fn json(&self) -> serde_json::Value {
        match &self.value {
            Value::Null => serde_json::Value::Null,
            Value::Bool(value) => (*value).into(),
            Value::Number(number) => number.clone().into(),
            Value::String(string) => string.as_str().into(),
            Value::Array(elements) => elements.iter().map(Node::json).collect(),
            Value::Object(members) => {
                members.iter().map(|m| (m.name.clone(), m.node.json())).collect()
            }
        }
    }

    /// Reads the tree once more, as text, to learn where it goes wrong.
    fn error<T: DeserializeOwned>(&self) -> LoadError {
        let mut written = Written::default();
        written.node(self);
        let Err(error) = serde_json::from_str::<T>(&written.text) else {
            return Problem::Shape("a value has the wrong form".into()).at(self.place.clone());
        };
        let message = error.to_string();
        // The text is one line; the position is of no meaning to the reader.
        let what = in_words(message.split(" at line 1 column").next().unwrap_or(&message));
        let place = written.place(error.column().saturating_sub(1)).unwrap_or(&self.place);
        Problem::Shape(what).at(place.clone())
    }
}

/// What the type names of this program are to whoever writes a shot.
const KINDS: [(&str, &str); 8] = [
    ("f64", "a number"),
    ("u8", "a whole number from 0 to 255"),
    ("u32", "a whole number, 0 or more"),
    ("usize", "a whole number, 0 or more"),
    ("i64", "a whole number"),
    ("a sequence", "a list"),
    ("a map", "an object"),
    ("a boolean", "true or false"),
];

/// A message of the deserialiser in words of the format.
fn in_words(message: &str) -> String {
    if let Some(name) = message.strip_prefix("missing field ") {
        return format!("the key {} is missing", quoted(name));
    }
    let Some((found, expected)) = message.split_once(", expected ") else {
        return quoted(message);
    };
    let expected = match KINDS.iter().find(|(theirs, _)| *theirs == expected) {
        Some((_, ours)) => (*ours).to_owned(),
        None if expected.starts_with("struct ") => "an object".to_owned(),
        None => quoted(&expected.replace("an array of length", "a list of")),
    };
    let [of_keys, of_values] = ["unknown field ", "unknown variant "];
    if let Some(name) = found.strip_prefix(of_keys) {
        return format!("unknown key {}, expected {expected}", quoted(name));
    }
    if let Some(name) = found.strip_prefix(of_values) {
        return format!("unknown value {}, expected {expected}", quoted(name));
    }
    let found = match found.split_once(' ') {
        Some(("invalid", rest)) => found_in_words(rest),
        _ => quoted(found),
    };
    format!("expected {expected}, found {found}")
}

/// What was found, of "type: integer `3`", "value: string "a"", "length 2".
fn found_in_words(found: &str) -> String {
    if let Some(length) = found.strip_prefix("length ") {
        return format!("one of {length}");
    }
    let value = found.split_once(": ").map_or(found, |(_, value)| value);
    match value.split_once(' ') {
        None if value == "map" => "an object".to_owned(),
        None if value == "sequence" => "a list".to_owned(),
        Some(("integer" | "floating" | "boolean", _)) => {
            value.split('`').nth(1).unwrap_or(value).to_owned()
        }
        Some(("string", text)) => text.to_owned(),
        _ => value.to_owned(),
    }
}

/// Names between the quotation marks that all messages of this program have.
fn quoted(text: &str) -> String {
    text.replace('`', "\"")
}

/// The tree as one line of JSON, with the stretch of it that each key and value takes. Reading it
/// back gives errors an offset in this line, and so the place where the value was first written.
#[derive(Default)]
struct Written {
    text: String,
    /// Start, end and place; a part stands after the whole it belongs to.
    stretches: Vec<(usize, usize, Place)>,
}

impl Written {
    fn place(&self, offset: usize) -> Option<&Place> {
        let around = |&&(start, end, _): &&(usize, usize, Place)| start <= offset && offset < end;
        self.stretches.iter().rev().find(around).map(|(_, _, place)| place)
    }

    fn node(&mut self, node: &Node) {
        let index = self.begin(&node.place);
        match &node.value {
            Value::Null => self.text.push_str("null"),
            Value::Bool(value) => self.text.push_str(if *value { "true" } else { "false" }),
            Value::Number(number) => self.text.push_str(&number.to_string()),
            Value::String(string) => self.string(string),
            Value::Array(elements) => {
                self.text.push('[');
                for (k, element) in elements.iter().enumerate() {
                    self.separator(k);
                    self.node(element);
                }
                // The space belongs to the list: a missing element is not the last one's fault.
                self.text.push_str(" ]");
            }
            Value::Object(members) => {
                self.text.push('{');
                for (k, member) in members.iter().enumerate() {
                    self.separator(k);
                    let key = self.begin(&member.place);
                    self.string(&member.name);
                    self.end(key);
                    self.text.push(':');
                    self.node(&member.node);
                }
                self.text.push_str(" }");
            }
        }
        self.end(index);
    }

    fn separator(&mut self, index: usize) {
        if index > 0 {
            self.text.push(',');
        }
    }

    fn string(&mut self, string: &str) {
        self.text.push_str(&serde_json::Value::from(string).to_string());
    }

    fn begin(&mut self, place: &Place) -> usize {
        self.stretches.push((self.text.len(), usize::MAX, place.clone()));
        self.stretches.len() - 1
    }

    fn end(&mut self, index: usize) {
        self.stretches[index].1 = self.text.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Sample {
        size: f64,
        names: Vec<String>,
        #[serde(default)]
        corner: [f64; 2],
    }

    #[test]
    fn numbers_are_the_nearest_doubles() {
        for number in [0.1 + 0.2, 5.9469658000000004e-6, 1.0 / 3.0, 9.5e-300, -23.191698e-6] {
            let text = format!("{number:?}");
            assert_eq!(Node::parse("x", &text).unwrap().deserialize::<f64>().unwrap(), number);
        }
    }

    #[test]
    fn type_errors_are_in_words_of_the_format() {
        for (text, words) in [
            (r#"{"size": "big", "names": []}"#, r#"expected a number, found "big""#),
            (r#"{"size": {}, "names": []}"#, "expected a number, found an object"),
            (r#"{"size": null, "names": []}"#, "expected a number, found null"),
            (r#"{"size": 1, "names": 2.5}"#, "expected a list, found 2.5"),
            (r#"{"size": 1, "names": true}"#, "expected a list, found true"),
            (r#"{"size": 1, "names": [[]]}"#, "expected a string, found a list"),
            (r#"{"size": 1}"#, r#"the key "names" is missing"#),
            (r#"{"nams": 1}"#, r#"unknown key "nams", expected one of "size", "names", "corner""#),
            (r#"{"size": 1, "names": [], "corner": [1]}"#, "expected a list of 2, found one of 1"),
            (r#"{"size": 1, "names": [], "corner": 1}"#, "expected a list of 2, found 1"),
        ] {
            let error = from_json::<Sample>("x", text).unwrap_err();
            assert!(error.problem.to_string().starts_with(words), "{text}: {error}");
        }
        let error = from_json::<[u8; 1]>("x", "[256]").unwrap_err().problem.to_string();
        assert_eq!(error, "expected a whole number from 0 to 255, found 256");
    }

    #[test]
    fn type_errors_point_at_the_key_or_value_at_fault() {
        for (text, place) in [
            ("{\"size\": 1,\n\"names\": [\"a\",\n 3]}", "x:3:2"),
            ("{\"size\": \"big\",\n\"names\": []}", "x:1:10"),
            ("{\"size\": 1,\n \"nams\": []}", "x:2:2"),
            ("\n{\"size\": 1}", "x:2:1"),
            ("{\"size\": 1, \"names\": [],\n\"corner\": [1]}", "x:2:11"),
        ] {
            let error = Node::parse("x", text).unwrap().deserialize::<Sample>().unwrap_err();
            assert_eq!(error.place.as_ref().unwrap().to_string(), place, "{error}");
        }
    }
}
