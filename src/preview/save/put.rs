//! One value into the text of a shot file.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, parse_to_ast};
use serde_json::Value;

use super::SaveError;
use super::layout::{Layout, indentation};
use crate::scene::{Known, SYNTAX};

/// The list of an imported scene which a shot changes element by element.
const MERGED_LIST: &str = "garments";

/// More garments than any shot has: a number beyond it is a slip, not to be filled up with nothing.
const GARMENT_COUNT_MAX: usize = 10_000;

/// A shot file's text and what it says.
pub(super) struct Document<'a> {
    pub text: &'a str,
    pub root: ast::Object<'a>,
    pub layout: Layout,
}

/// A value that is to be written, and under which path.
struct Edit<'a> {
    path: &'a str,
    segments: Vec<&'a str>,
    value: &'a Value,
}

impl<'a> Document<'a> {
    /// # Errors
    /// If the text is no object in JSON with comments.
    pub fn parse(text: &'a str) -> Result<Self, SaveError> {
        let parsed = parse_to_ast(text, &CollectOptions::default(), &SYNTAX)
            .map_err(|error| SaveError::Syntax(error.to_string()))?;
        match parsed.value {
            Some(ast::Value::Object(root)) => {
                let layout = Layout::of(text, root.properties.first().map(Ranged::start));
                Ok(Self { text, root, layout })
            }
            _ => Err(SaveError::NotAShot),
        }
    }

    pub fn has_key(&self, name: &str) -> bool {
        member(&self.root, name).is_some()
    }

    /// The text with the value at the path.
    ///
    /// # Errors
    /// If the path does not fit the file.
    pub fn with(&self, known: &Known<'_>, path: &str, value: &Value) -> Result<String, SaveError> {
        let edit = Edit { path, segments: path.split('.').collect(), value };
        let mut group = &self.root;
        let mut depth = 0;
        loop {
            let Some(found) = member(group, edit.segments[depth]) else {
                let value = self.nested(known, &edit, depth + 1)?;
                let order = known.keys(&edit.segments[..depth].join("."));
                return Ok(self.inserted(group, &order, edit.segments[depth], &value));
            };
            depth += 1;
            let mut node = &found.value;
            while let (ast::Value::Array(list), true) = (node, depth < edit.segments.len()) {
                let index = element_number(edit.segments[depth]);
                match index.and_then(|index| list.elements.get(index)) {
                    Some(element) => node = element,
                    None => return self.appended(list, known, &edit, depth),
                }
                depth += 1;
            }
            match node {
                _ if depth == edit.segments.len() => return Ok(self.replaced(node, value)),
                ast::Value::Object(inner) => group = inner,
                other => {
                    let parent = edit.segments[..depth].join(".");
                    let path = path.to_owned();
                    return Err(SaveError::NoGroup { path, parent, found: kind(other) });
                }
            }
        }
    }

    fn replaced(&self, node: &ast::Value<'_>, value: &Value) -> String {
        self.spliced(node.start()..node.end(), &self.kept(node, value))
    }

    /// What has to stand at `segments[..depth]`, which the file does not have, for the path to lead
    /// to the value.
    fn nested(&self, known: &Known<'_>, edit: &Edit<'_>, depth: usize) -> Result<Value, SaveError> {
        let Some(&segment) = edit.segments.get(depth) else { return Ok(edit.value.clone()) };
        let inner = self.nested(known, edit, depth + 1)?;
        let list = edit.segments[..depth].join(".");
        let index = element_number(segment).filter(|_| known.is_list(&list));
        match index {
            Some(index) if self.merges(&list) && index < GARMENT_COUNT_MAX => {
                Ok(padded(index, inner))
            }
            Some(_) => Err(self.no_list(edit, depth)),
            None => Ok(Value::Object([(segment.to_owned(), inner)].into_iter().collect())),
        }
    }

    /// With an element more, for the index that `segments[depth]` names.
    fn appended(
        &self,
        list: &ast::Array<'_>,
        known: &Known<'_>,
        edit: &Edit<'_>,
        depth: usize,
    ) -> Result<String, SaveError> {
        let index = element_number(edit.segments[depth]);
        let Some(index) = index.filter(|&index| {
            index < GARMENT_COUNT_MAX && self.merges(&edit.segments[..depth].join("."))
        }) else {
            return Err(self.no_element(edit, depth));
        };
        let inner = self.nested(known, edit, depth + 1)?;
        let more = padded(index - list.elements.len(), inner);
        let indent = indentation(self.text, list.start());
        let more = self.layout.value(&more, indent, self.column(list.start()));
        let more = more.trim_start_matches('[').trim_end_matches(']');
        Ok(match list.elements.last() {
            Some(last) => self.spliced(last.end()..last.end(), &format!(", {}", more.trim_start())),
            None => self.spliced(list.start() + 1..list.start() + 1, more),
        })
    }

    /// A list of the imported scene: its elements need not be in the file.
    fn merges(&self, list: &str) -> bool {
        list == MERGED_LIST && self.has_key("import")
    }

    /// The list is in the file, but short.
    fn no_element(&self, edit: &Edit<'_>, depth: usize) -> SaveError {
        let (path, list) = (edit.path.to_owned(), edit.segments[..depth].join("."));
        SaveError::NoElement { path, list, index: edit.segments[depth].to_owned() }
    }

    /// The list is not in the file: at best in the scene that it imports.
    fn no_list(&self, edit: &Edit<'_>, depth: usize) -> SaveError {
        let (path, list) = (edit.path.to_owned(), edit.segments[..depth].join("."));
        if self.has_key("import") && list != MERGED_LIST {
            return SaveError::ImportedList { path, list };
        }
        self.no_element(edit, depth)
    }

    /// How far from the start of its line an offset is (characters).
    pub fn column(&self, offset: usize) -> usize {
        let line = self.text[..offset].rfind('\n').map_or(0, |newline| newline + 1);
        self.text[line..offset].chars().count()
    }

    fn spliced(&self, range: std::ops::Range<usize>, new: &str) -> String {
        format!("{}{new}{}", &self.text[..range.start], &self.text[range.end..])
    }
}

fn member<'d, 'a>(object: &'d ast::Object<'a>, name: &str) -> Option<&'d ast::ObjectProp<'a>> {
    object.properties.iter().find(|property| property.name.as_str() == name)
}

fn element_number(segment: &str) -> Option<usize> {
    segment.parse().ok()
}

/// Elements that leave the imported scene's as they are, then one.
fn padded(index: usize, last: Value) -> Value {
    let empty = std::iter::repeat_n(Value::Object(serde_json::Map::new()), index);
    empty.chain([last]).collect()
}

fn kind(value: &ast::Value<'_>) -> &'static str {
    match value {
        ast::Value::NullKeyword(_) => "null",
        ast::Value::BooleanLit(_) => "true or false",
        ast::Value::NumberLit(_) => "a number",
        ast::Value::StringLit(_) => "a string",
        ast::Value::Array(_) => "a list",
        ast::Value::Object(_) => "an object",
    }
}
