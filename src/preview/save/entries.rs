//! What a group or a list consists of in the text: its entries, and what belongs to each of them.

use std::ops::Range;

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;

use super::insert::{comma_behind, end_of_remark};
use super::layout::indentation;

/// A group's or a list's, in order; brackets and everything between them is in one of the parts.
pub(super) struct Entries<'d, 'a> {
    pub list: Vec<Entry<'d, 'a>>,
    /// From the opening bracket to the end of its line's remark.
    pub head: &'d str,
    /// Behind the last entry, with the closing bracket.
    pub tail: &'d str,
    pub ends_with_comma: bool,
    /// Of the entries, if the first stands on a line of its own.
    pub indent: Option<&'d str>,
}

/// A member of a group or an element of a list.
pub(super) struct Entry<'d, 'a> {
    /// None in a list.
    pub name: Option<&'d str>,
    pub node: &'d ast::Value<'a>,
    /// Line ends, blanks, and remarks above it.
    pub before: &'d str,
    /// Its name with the colon; empty in a list.
    pub key: &'d str,
    /// Up to the end of its line, without the comma: what is remarked on it.
    pub after: String,
}

impl<'d, 'a> Entries<'d, 'a> {
    /// `None` for a node that has no entries.
    pub fn of(text: &'d str, node: &'d ast::Value<'a>) -> Option<Self> {
        let parts: Vec<(Option<&str>, &ast::Value<'_>, usize)> = match node {
            ast::Value::Object(group) => {
                let part =
                    |p: &'d ast::ObjectProp<'a>| (Some(p.name.as_str()), &p.value, p.start());
                group.properties.iter().map(part).collect()
            }
            ast::Value::Array(list) => {
                list.elements.iter().map(|element| (None, element, element.start())).collect()
            }
            _ => return None,
        };
        let first = parts.first()?.2;
        let head = node.start()..end_of_line_remark(text, node.start() + 1);
        let mut free = head.end;
        let mut ends_with_comma = false;
        let mut list = Vec::new();
        for (name, node, start) in parts {
            let comma = comma_behind(text, node.end());
            ends_with_comma = comma.is_some();
            let end = end_of_line_remark(text, comma.map_or(node.end(), |comma| comma + 1));
            let after = match comma {
                Some(comma) => [&text[node.end()..comma], &text[comma + 1..end]].concat(),
                None => text[node.end()..end].to_owned(),
            };
            let (before, key) = (&text[free..start], &text[start..node.start()]);
            list.push(Entry { name, node, before, key, after });
            free = end;
        }
        let indent = own_line(text, node.start()..first);
        Some(Self {
            list,
            head: &text[head],
            tail: &text[free..node.end()],
            ends_with_comma,
            indent,
        })
    }
}

/// The indentation of an entry that stands on a line of its own behind a bracket.
fn own_line(text: &str, Range { start, end }: Range<usize>) -> Option<&str> {
    let line = text[..end].rfind('\n')? + 1;
    let indent = indentation(text, end);
    (line > start && line + indent.len() == end).then_some(indent)
}

/// Behind the remarks that follow on the same line, if nothing else does.
fn end_of_line_remark(text: &str, at: usize) -> usize {
    let end = end_of_remark(text, at);
    let rest = text[end..].trim_start_matches([' ', '\t']);
    if rest.starts_with(['\n', '\r']) { end } else { at }
}
