//! A new key in the text of a group.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use serde_json::Value;

use super::layout::indentation;
use super::put::Document;

impl Document<'_> {
    /// With a new key in a group: behind the last that `order` names before it, first if there is
    /// none, last where the order does not say. On a line of its own where the others are.
    pub fn inserted(
        &self,
        group: &ast::Object<'_>,
        order: &[&str],
        name: &str,
        value: &Value,
    ) -> String {
        let gap = Gap::behind(self.text, group, anchor(group, order, name));
        let key = format!("{}: ", Value::from(name));
        let entry = match own_line(self.text, group) {
            Some(indent) => {
                let column = indent.chars().count() + key.chars().count();
                let value = self.layout.value(value, indent, column);
                format!("{}{indent}{key}{value}{}", self.layout.newline(), gap.comma_after())
            }
            None => {
                let indent = indentation(self.text, group.start());
                let column = self.column(gap.at) + key.chars().count();
                let entry = format!("{key}{}", self.layout.value(value, indent, column));
                match gap.side {
                    Side::Empty => entry,
                    Side::First => format!("{entry}, "),
                    Side::BehindComma | Side::Last => format!(" {entry}{}", gap.comma_after()),
                }
            }
        };
        // On lines of their own entries begin after what the line before remarks on its own.
        let is_on_line = own_line(self.text, group).is_some();
        let at = if is_on_line { end_of_remark(self.text, gap.at) } else { gap.at };
        let before = &self.text[..gap.at];
        format!(
            "{before}{}{}{entry}{}",
            gap.comma_before(),
            &self.text[gap.at..at],
            &self.text[at..]
        )
    }
}

/// Where a new entry goes.
struct Gap {
    /// Behind a brace, an entry, or its comma (bytes).
    at: usize,
    side: Side,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    /// The group has no entries.
    Empty,
    First,
    /// The new entry takes the comma's part, be it a trailing one or that before the next.
    BehindComma,
    Last,
}

impl Gap {
    fn behind(text: &str, group: &ast::Object<'_>, anchor: Option<&ast::ObjectProp<'_>>) -> Self {
        let first = if group.properties.is_empty() { Side::Empty } else { Side::First };
        match anchor {
            None => Self { at: group.start() + 1, side: first },
            Some(anchor) => match comma_behind(text, anchor.end()) {
                Some(comma) => Self { at: comma + 1, side: Side::BehindComma },
                None => Self { at: anchor.end(), side: Side::Last },
            },
        }
    }

    fn comma_before(&self) -> &'static str {
        if self.side == Side::Last { "," } else { "" }
    }

    fn comma_after(&self) -> &'static str {
        if matches!(self.side, Side::First | Side::BehindComma) { "," } else { "" }
    }
}

/// The entry that a new key comes behind.
fn anchor<'d, 'a>(
    group: &'d ast::Object<'a>,
    order: &[&str],
    name: &str,
) -> Option<&'d ast::ObjectProp<'a>> {
    let rank = |name: &str| order.iter().position(|known| *known == name);
    let Some(own) = rank(name) else { return group.properties.last() };
    let ranked = group.properties.iter().filter_map(|p| Some((rank(p.name.as_str())?, p)));
    ranked.filter(|&(rank, _)| rank < own).max_by_key(|&(rank, _)| rank).map(|(_, p)| p)
}

/// The comma that follows an entry, past comments.
pub(super) fn comma_behind(text: &str, mut at: usize) -> Option<usize> {
    loop {
        let rest = &text[at..];
        at += rest.len() - rest.trim_start().len();
        let rest = &text[at..];
        at += match remark_length(rest) {
            Some(length) => length,
            None => return rest.starts_with(',').then_some(at),
        };
    }
}

/// Behind the comments that follow on the same line.
pub(super) fn end_of_remark(text: &str, at: usize) -> usize {
    let mut end = at;
    loop {
        let rest = &text[end..];
        let blank = rest.len() - rest.trim_start_matches([' ', '\t']).len();
        match remark_length(&rest[blank..]) {
            Some(length) if !rest[blank..blank + length].contains('\n') => end += blank + length,
            _ => return end,
        }
    }
}

/// Of the comment that a text begins with, without the end of its line.
fn remark_length(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find(['\n', '\r']).unwrap_or(text.len()));
    }
    text.strip_prefix("/*")?.find("*/").map(|end| end + 4)
}

/// The indentation of a group's entries, if its first stands on a line of its own.
fn own_line<'t>(text: &'t str, group: &ast::Object<'_>) -> Option<&'t str> {
    let first = group.properties.first()?.start();
    let line = text[..first].rfind('\n')? + 1;
    let indent = &text[line..first];
    (line > group.start() && indent.trim().is_empty()).then_some(indent)
}
