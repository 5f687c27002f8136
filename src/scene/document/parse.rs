//! From text to the tree.

use std::sync::Arc;

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::{Member, Node, Value};
use crate::scene::error::{LoadError, Place, Problem};

/// JSON, comments and trailing commas; nothing looser.
pub(crate) const SYNTAX: ParseOptions = ParseOptions {
    allow_comments: true,
    allow_loose_object_property_names: false,
    allow_trailing_commas: true,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

impl Node {
    /// # Errors
    /// Syntax errors, repeated keys and numbers beyond double precision, with their place.
    pub fn parse(file: &str, text: &str) -> Result<Node, LoadError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = Lines::new(file, text);
        let parsed = parse_to_ast(text, &CollectOptions::default(), &SYNTAX).map_err(|error| {
            Problem::Syntax(error.kind().to_string()).at(lines.place(error.range().start))
        })?;
        match parsed.value {
            Some(value) => lines.node(&value),
            None => Err(Problem::Syntax("the file holds no value".into()).at(lines.place(0))),
        }
    }

    /// A value from the command line: JSON if it is that, else a string.
    ///
    /// # Errors
    /// A list, an object or a quoted string that is begun but is no JSON.
    pub fn from_argument(text: &str, place: &Place) -> Result<Node, Problem> {
        let mut node = match Node::parse("", text) {
            Ok(node) => node,
            Err(error) if text.starts_with(['[', '{', '"']) => return Err(error.problem),
            Err(_) => Node { place: place.clone(), value: Value::String(text.to_owned()) },
        };
        node.move_to(place);
        Ok(node)
    }

    fn move_to(&mut self, place: &Place) {
        self.place = place.clone();
        match &mut self.value {
            Value::Array(elements) => elements.iter_mut().for_each(|e| e.move_to(place)),
            Value::Object(members) => members.iter_mut().for_each(|m| {
                m.place = place.clone();
                m.node.move_to(place);
            }),
            _ => {}
        }
    }
}

/// Byte offsets to lines and columns.
struct Lines<'a> {
    file: Arc<str>,
    text: &'a str,
    /// Offset of each line's first byte.
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(file: &str, text: &'a str) -> Self {
        let starts =
            std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { file: file.into(), text, starts }
    }

    fn place(&self, offset: usize) -> Place {
        let line = self.starts.partition_point(|&start| start <= offset);
        let start = self.starts[line - 1];
        let column = self.text[start..offset.min(self.text.len())].chars().count() + 1;
        Place::Text { file: self.file.clone(), line, column }
    }

    fn node(&self, value: &ast::Value<'_>) -> Result<Node, LoadError> {
        let place = self.place(value.start());
        let value = match value {
            ast::Value::NullKeyword(_) => Value::Null,
            ast::Value::BooleanLit(literal) => Value::Bool(literal.value),
            ast::Value::StringLit(literal) => Value::String(literal.value.to_string()),
            ast::Value::NumberLit(literal) => match number(literal.value) {
                Some(number) => Value::Number(number),
                None => {
                    let what = format!("the number {} is out of range", literal.value);
                    return Err(Problem::Syntax(what).at(place));
                }
            },
            ast::Value::Array(array) => {
                Value::Array(array.elements.iter().map(|e| self.node(e)).collect::<Result<_, _>>()?)
            }
            ast::Value::Object(object) => Value::Object(self.members(object)?),
        };
        Ok(Node { place, value })
    }

    fn members(&self, object: &ast::Object<'_>) -> Result<Vec<Member>, LoadError> {
        let mut members: Vec<Member> = Vec::with_capacity(object.properties.len());
        for property in &object.properties {
            let name = property.name.as_str().to_owned();
            let place = self.place(property.start());
            if members.iter().any(|m| m.name == name) {
                return Err(Problem::RepeatedKey { name }.at(place));
            }
            members.push(Member { name, place, node: self.node(&property.value)? });
        }
        Ok(members)
    }
}

/// The nearest double, which serde_json's own reading does not promise; `None` beyond its range.
fn number(text: &str) -> Option<serde_json::Number> {
    match text.parse::<i64>() {
        Ok(integer) => Some(integer.into()),
        Err(_) => serde_json::Number::from_f64(text.parse().ok()?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_knows_its_line_and_column() {
        let node = Node::parse("a.json", "// é\n{\n  \"é\": [1,\n 2], // last\n}").unwrap();
        assert_eq!(node.place_of("é.1").to_string(), "a.json:4:2");
        assert_eq!(node.place_of("é").to_string(), "a.json:3:8");
        assert_eq!(node.place_of("nothing").to_string(), "a.json:2:1");
    }

    #[test]
    fn syntax_errors_point_at_the_spot() {
        for (text, place) in [
            ("{\n  \"a\": }", "x:2:8"),
            ("", "x:1:1"),
            ("{\"a\": 1,\n \"a\": 2}", "x:2:2"),
            ("[1,\n1e999]", "x:2:1"),
            ("[NaN]", "x:1:2"),
        ] {
            let error = Node::parse("x", text).unwrap_err();
            assert_eq!(error.place.as_ref().unwrap().to_string(), place, "{error}");
        }
    }
}
