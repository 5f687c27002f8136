//! What the user has changed about the shot file, by path.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Settings that differ from the file's, by their path in the shot (`view.nu_out`,
/// `garments.0.view.nu_back`, `camera`). Values are JSON in the file's own units.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Edits(BTreeMap<String, Value>);

impl Edits {
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
        let is_other = |(path, value): &(&String, &Value)| others.get(path) != Some(*value);
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
}
