//! A group or list in place of another, with the remarks of what stays.

use std::borrow::Cow;

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::tokens::Token;
use jsonc_parser::{
    CollectOptions, CommentCollectionStrategy, Scanner, ScannerOptions, parse_to_ast,
    parse_to_serde_value,
};
use serde_json::{Map, Value};

use super::entries::{Entries, Entry};
use super::layout::{LINE_MAX, indentation};
use super::put::Document;
use crate::preview::camera_edit::is_implied;
use crate::preview::edits::is_same;
use crate::scene::SYNTAX;

/// What tells a group in a list from the others there: camera keys are known by their frames.
const IDENTITY: &str = "frame";

/// Something that is to stand in the new group or list.
struct Wanted<'v> {
    /// None in a list.
    name: Option<&'v str>,
    value: &'v Value,
    /// Which of the old entries it is, if it is one.
    old: Option<usize>,
}

impl Document<'_> {
    /// The text of a value in place of a node. What says the same already stays as it is written. Of
    /// members and elements that stay the remarks stay with them; those of others go with these.
    pub(super) fn kept(&self, node: &ast::Value<'_>, value: &Value) -> String {
        let old = &self.text[node.start()..node.end()];
        let said = says(old);
        let value = &said.as_ref().map_or(Cow::Borrowed(value), |said| with_stated(said, value));
        if said.is_some_and(|said| is_same(&said, value)) {
            return old.to_owned();
        }
        let merged = Entries::of(self.text, node).and_then(|entries| {
            let wanted = match (node, value.as_ref()) {
                (ast::Value::Object(_), Value::Object(members)) => {
                    wanted_members(&entries.list, members)
                }
                (ast::Value::Array(_), Value::Array(elements)) => {
                    self.wanted_elements(&entries.list, elements)
                }
                _ => return None,
            };
            let any_stays = wanted.iter().any(|wanted| wanted.old.is_some());
            any_stays.then(|| self.merged(node, &entries, &wanted))
        });
        let is_short = |text: &String| text.lines().all(|line| line.chars().count() <= LINE_MAX);
        merged.filter(|text| is_short(text) || has_remark(old)).unwrap_or_else(|| {
            let indent = indentation(self.text, node.start());
            self.layout.value(value, indent, self.column(node.start()))
        })
    }

    fn merged(
        &self,
        node: &ast::Value<'_>,
        entries: &Entries<'_, '_>,
        wanted: &[Wanted<'_>],
    ) -> String {
        let newline = self.layout.newline();
        let indent = entries.indent.unwrap_or(indentation(self.text, node.start()));
        let mut merged = Pieces { text: String::new(), is_remark_open: false, newline, indent };
        merged.push_blank(entries.head);
        for (number, Wanted { name, value, old }) in wanted.iter().enumerate() {
            let old = old.map(|place| &entries.list[place]);
            match old {
                Some(entry) => {
                    merged.push_blank(entry.before);
                    merged.push(&[entry.key, &self.kept(entry.node, value)]);
                }
                None => {
                    let key = name.map_or(String::new(), |name| format!("{}: ", Value::from(name)));
                    let own_line = [newline, indent].concat();
                    merged.push_blank(match entries.indent {
                        Some(_) => &own_line,
                        None if number == 0 => "",
                        None => " ",
                    });
                    let column = indent.chars().count() + key.chars().count();
                    merged.push(&[&key, &self.layout.value(value, indent, column)]);
                }
            }
            if number + 1 < wanted.len() || entries.ends_with_comma {
                merged.push(&[","]);
            }
            merged.push_blank(old.map_or("", |entry| &entry.after));
        }
        merged.push_blank(entries.tail);
        merged.text
    }

    /// Elements that are known by their identity, or are the same but for it; others by their places.
    fn wanted_elements<'v>(
        &self,
        entries: &[Entry<'_, '_>],
        elements: &'v [Value],
    ) -> Vec<Wanted<'v>> {
        let new = |value| Wanted { name: None, value, old: None };
        let mut wanted: Vec<Wanted<'v>> = elements.iter().map(new).collect();
        if elements.iter().all(|element| element.get(IDENTITY).is_some()) {
            let text = |entry: &Entry<'_, '_>| &self.text[entry.node.start()..entry.node.end()];
            let said: Vec<_> = entries.iter().map(|entry| says(text(entry))).collect();
            pair(&said, &mut wanted, has_same_identity);
            pair(&said, &mut wanted, is_same_but_for_identity);
        } else {
            for (place, wanted) in wanted.iter_mut().enumerate().take(entries.len()) {
                wanted.old = Some(place);
            }
        }
        wanted
    }
}

/// Finds for all that are none yet the old entries that they are, each once.
fn pair(said: &[Option<Value>], wanted: &mut [Wanted<'_>], is_it: fn(&Value, &Value) -> bool) {
    let mut is_taken = vec![false; said.len()];
    wanted.iter().filter_map(|wanted| wanted.old).for_each(|place| is_taken[place] = true);
    for wanted in wanted.iter_mut().filter(|wanted| wanted.old.is_none()) {
        let fits = |place: &usize| {
            let said = said[*place].as_ref().filter(|_| !is_taken[*place]);
            said.is_some_and(|said| is_it(said, wanted.value))
        };
        wanted.old = (0..said.len()).find(fits);
        wanted.old.into_iter().for_each(|place| is_taken[place] = true);
    }
}

fn has_same_identity(old: &Value, new: &Value) -> bool {
    let number = |value: &Value| value.get(IDENTITY).and_then(Value::as_f64);
    number(old).zip(number(new)).is_some_and(|(old, new)| old == new)
}

/// As a key that was moved in time alone.
fn is_same_but_for_identity(old: &Value, new: &Value) -> bool {
    let mut new = with_stated(old, new).into_owned();
    if let (Some(new), Some(old)) = (new.get_mut(IDENTITY), old.get(IDENTITY)) {
        *new = old.clone();
    }
    is_same(old, &new)
}

/// A camera's key with what its author stated though it goes without saying, where it still holds.
fn with_stated<'v>(old: &Value, new: &'v Value) -> Cow<'v, Value> {
    let (Some(said), Some(members)) = (old.as_object(), new.as_object()) else {
        return Cow::Borrowed(new);
    };
    let is_stated =
        |&(name, value): &(&String, &Value)| !members.contains_key(name) && is_implied(name, value);
    let stated: Vec<_> = said.iter().filter(is_stated).collect();
    if stated.is_empty() || !members.contains_key(IDENTITY) {
        return Cow::Borrowed(new);
    }
    let mut members = members.clone();
    members.extend(stated.into_iter().map(|(name, value)| (name.clone(), value.clone())));
    Cow::Owned(Value::Object(members))
}

/// Those that stay in the order of the file, each new one behind the one that it comes behind.
fn wanted_members<'v>(
    entries: &[Entry<'_, '_>],
    members: &'v Map<String, Value>,
) -> Vec<Wanted<'v>> {
    let mut wanted: Vec<Wanted<'v>> = Vec::new();
    for (place, entry) in entries.iter().enumerate() {
        let member = entry.name.and_then(|name| members.get_key_value(name));
        wanted.extend(member.map(|(name, value)| Wanted {
            name: Some(name),
            value,
            old: Some(place),
        }));
    }
    let mut before = None;
    for (name, value) in members {
        if !wanted.iter().any(|wanted| wanted.name == Some(name)) {
            let behind = wanted.iter().position(|wanted| wanted.name == before);
            let at = behind.map_or(0, |place| place + 1);
            wanted.insert(at, Wanted { name: Some(name), value, old: None });
        }
        before = Some(name);
    }
    wanted
}

/// A text that is put together.
struct Pieces<'t> {
    text: String,
    /// It ends in a remark that only the end of the line closes.
    is_remark_open: bool,
    newline: &'t str,
    indent: &'t str,
}

impl Pieces<'_> {
    /// Brackets, blanks and remarks.
    fn push_blank(&mut self, piece: &str) {
        let begins_line = piece.trim_start_matches([' ', '\t']).starts_with(['\n', '\r']);
        if begins_line {
            self.is_remark_open = false;
        }
        self.push(&[piece]);
        self.is_remark_open |= ends_in_line_remark(piece);
    }

    fn push(&mut self, pieces: &[&str]) {
        if self.is_remark_open && pieces.iter().any(|piece| !piece.is_empty()) {
            self.text += self.newline;
            self.text += self.indent;
            self.is_remark_open = false;
        }
        self.text.extend(pieces.iter().copied());
    }
}

/// `None` for what is no JSON.
fn says(text: &str) -> Option<Value> {
    parse_to_serde_value(text, &SYNTAX).ok()
}

/// Whether brackets, blanks and remarks end in a remark that goes on to the end of its line.
fn ends_in_line_remark(piece: &str) -> bool {
    let mut scanner = Scanner::new(piece, &ScannerOptions::default());
    let mut is_open = false;
    // What is no JSON ends it: then the last remark decides.
    while let Ok(Some(token)) = scanner.scan() {
        is_open = matches!(token, Token::CommentLine(_)) && scanner.token_end() == piece.len();
    }
    is_open
}

fn has_remark(text: &str) -> bool {
    let options = CollectOptions {
        comments: CommentCollectionStrategy::Separate,
        ..CollectOptions::default()
    };
    let parsed = parse_to_ast(text, &options, &SYNTAX);
    parsed.is_ok_and(|parsed| parsed.comments.is_some_and(|comments| !comments.is_empty()))
}
