//! How values are written.

use serde_json::{Number, Value};

/// Longest line on which a group or a list of groups is kept together (characters).
pub(super) const LINE_MAX: usize = 110;

/// What is no longer than this is kept together wherever it stands (characters).
const SHORT_MAX: usize = 40;

/// Indentation where the file shows none.
const INDENT: &str = "    ";

/// A file's own habits.
pub(super) struct Layout {
    indent: String,
    newline: &'static str,
}

impl Layout {
    /// `first_key`: where the root's first key starts (bytes).
    pub fn of(text: &str, first_key: Option<usize>) -> Self {
        let indent = first_key.map(|at| indentation(text, at)).filter(|i| !i.is_empty());
        let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
        Self { indent: indent.unwrap_or(INDENT).to_owned(), newline }
    }

    pub fn newline(&self) -> &'static str {
        self.newline
    }

    /// The value from a column on, in a line of an indentation: on one line if it fits, else one
    /// part a line.
    pub fn value(&self, value: &Value, indent: &str, column: usize) -> String {
        let line = one_line(value);
        let length = line.chars().count();
        if length <= SHORT_MAX || column + length <= LINE_MAX {
            return line;
        }
        let inner = format!("{indent}{}", self.indent);
        let column = inner.chars().count();
        let (parts, [open, close]) = match value {
            Value::Array(elements) => {
                let part = |e: &Value| self.value(e, &inner, column);
                (elements.iter().map(part).collect::<Vec<_>>(), ["[", "]"])
            }
            Value::Object(members) => {
                let part = |(name, e): (&String, &Value)| {
                    let key = format!("{}: ", Value::from(name.as_str()));
                    let rest = self.value(e, &inner, column + key.chars().count());
                    key + &rest
                };
                (members.iter().map(part).collect(), ["{", "}"])
            }
            _ => return line,
        };
        let between = format!(",{}{inner}", self.newline);
        let lines = parts.join(&between);
        format!("{open}{0}{inner}{lines}{0}{indent}{close}", self.newline)
    }
}

/// What stands before the first thing on the line of an offset.
pub(super) fn indentation(text: &str, offset: usize) -> &str {
    let line = text[..offset].rfind('\n').map_or(0, |newline| newline + 1);
    let rest = &text[line..];
    &rest[..rest.len() - rest.trim_start_matches([' ', '\t']).len()]
}

fn one_line(value: &Value) -> String {
    match value {
        Value::Array(elements) => {
            format!("[{}]", elements.iter().map(one_line).collect::<Vec<_>>().join(", "))
        }
        Value::Object(members) => {
            let member = |(name, e): (&String, &Value)| {
                format!("{}: {}", Value::from(name.as_str()), one_line(e))
            };
            format!("{{{}}}", members.iter().map(member).collect::<Vec<_>>().join(", "))
        }
        Value::Number(number) => number_text(number),
        other => other.to_string(),
    }
}

/// The shortest text that reads back as the number: 4 for 4.0, but -0.0, which no whole number is.
fn number_text(number: &Number) -> String {
    let text = number.to_string();
    match text.strip_suffix(".0") {
        Some(whole) if whole != "-0" => whole.to_owned(),
        _ => text,
    }
}
