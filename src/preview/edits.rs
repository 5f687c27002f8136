//! What the user has changed about the shot file, by path.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Number, Value};

/// Settings that differ from the file's, by their path in the shot (`view.nu_out`,
/// `garments.0.view.nu_back`, `camera`). Values are JSON in the file's own units; two are the same edits
/// if they give the same settings bit for bit.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(transparent)]
pub struct Edits(BTreeMap<String, Value>);

impl Edits {
    /// What the file says.
    pub const fn none() -> Self {
        Self(BTreeMap::new())
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn get(&self, path: &str) -> Option<&Value> {
        self.0.get(path)
    }

    pub fn set(&mut self, path: &str, value: Value) {
        self.0.insert(path.to_owned(), value);
    }

    /// Back to what the file says.
    pub fn reset(&mut self, path: &str) {
        self.0.remove(path);
    }

    /// Those that others do not say likewise.
    pub fn beyond(&self, others: &Edits) -> Self {
        let is_other = |(path, value): &(&String, &Value)| {
            others.get(path).is_none_or(|other| !is_same(other, value))
        };
        let own = self.0.iter().filter(is_other);
        Self(own.map(|(path, value)| (path.clone(), value.clone())).collect())
    }

    /// In order of path.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(path, value)| (path.as_str(), value))
    }

    /// As overrides of the command line, `path=value`.
    pub fn overrides(&self) -> Vec<String> {
        self.iter().map(|(path, value)| edit_as_override(path, value)).collect()
    }
}

pub(super) fn edit_as_override(path: &str, value: &Value) -> String {
    format!("{path}={value}")
}

impl PartialEq for Edits {
    fn eq(&self, other: &Self) -> bool {
        let is_same_edit = |((a_path, a), (b_path, b)): (_, _)| a_path == b_path && is_same(a, b);
        self.0.len() == other.0.len() && self.iter().zip(other.iter()).all(is_same_edit)
    }
}

/// The same, in whichever way numbers are written and members ordered: what is told apart when settings
/// are read is told apart here.
pub(super) fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => is_same_number(a, b),
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let is_member = |(name, value)| b.get(name).is_some_and(|other| is_same(value, other));
            a.len() == b.len() && a.iter().all(is_member)
        }
        _ => a == b,
    }
}

/// Whole numbers to the last digit, all others to the bit: 0 is not -0.0.
fn is_same_number(a: &Number, b: &Number) -> bool {
    match a.is_f64() || b.is_f64() {
        true => a.as_f64().map(f64::to_bits) == b.as_f64().map(f64::to_bits),
        false => a == b,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn edits_are_overrides_in_order_of_path_and_can_be_taken_back() {
        let mut edits = Edits::default();
        edits.set("view.nu_out", json!(0.1));
        edits.set("air.velocity", json!([1.0, 0.0, 0.0]));
        assert_eq!(edits.overrides(), ["air.velocity=[1.0,0.0,0.0]", "view.nu_out=0.1"]);
        edits.reset("air.velocity");
        assert_eq!(edits.overrides(), ["view.nu_out=0.1"]);
    }

    #[test]
    fn edits_differ_in_the_sign_of_nothing_and_in_the_last_digit_but_not_in_how_numbers_are_written()
     {
        let of = |value: Value| {
            let mut edits = Edits::default();
            edits.set("camera", json!({"keys": [{"frame": 0, "eye": value}]}));
            edits
        };
        assert_ne!(of(json!([0.0, 1.0])), of(json!([-0.0, 1.0])));
        assert_ne!(of(json!([0.1])), of(json!([0.1 + f64::EPSILON])));
        assert_ne!(of(json!([0.0])), of(json!([0.0, 0.0])));
        assert_eq!(of(json!([0, 1.0])), of(json!([0.0, 1])));
        let mut other = of(json!([0.0]));
        other.set("fps", json!(24));
        assert_ne!(other, of(json!([0.0])));
        assert_ne!(of(json!([0.0])), other);
        assert!(of(json!([1])).beyond(&of(json!([1.0]))).is_empty());
        assert_eq!(of(json!([-0.0])).beyond(&of(json!([0.0]))), of(json!([-0.0])));
    }
}
