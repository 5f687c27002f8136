//! The settings that exist, as the JSON Schema of the shot file knows them.

use serde_json::Value as Json;

use crate::scene::error::{Problem, nearest};

/// Levels of settings below which a suggestion is not searched for.
const SUGGESTION_DEPTH: usize = 4;

/// The settings that exist, by the JSON Schema of the shot file.
pub(crate) struct Known<'a> {
    schema: &'a Json,
}

impl<'a> Known<'a> {
    /// `schema` is that of [`shot_schema`](crate::scene::shot_schema).
    pub fn of(schema: &'a Json) -> Self {
        Self { schema }
    }

    /// What the format says about the setting at a path, in one line.
    pub fn help(&self, path: &str) -> Option<String> {
        // A property's own sentence stands before that of the type it refers to.
        let at = self.at(path).ok()?;
        let mut options = at.into_iter().flat_map(|schema| self.alternatives(schema));
        let text = options.find_map(|option| option["description"].as_str())?;
        Some(text.replace('`', "").split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// The keys of the group at a path, in the order of the format; "" is the shot itself. Empty
    /// for what has no keys of its own, such as a map by name.
    pub fn keys(&self, path: &str) -> Vec<&'a str> {
        let at = self.at(path).unwrap_or_default();
        at.into_iter().flat_map(|schema| self.names(schema)).collect()
    }

    /// True if lists may stand at a path.
    pub fn is_list(&self, path: &str) -> bool {
        let at = self.at(path).unwrap_or_default();
        let mut options = at.into_iter().flat_map(|schema| self.alternatives(schema));
        options.any(|option| option.get("items").is_some())
    }

    /// # Errors
    /// If there is no such setting.
    pub fn check(&self, path: &str) -> Result<(), Problem> {
        self.at(path).map(|_| ())
    }

    /// The schemas which a value at a path may follow.
    fn at(&self, path: &str) -> Result<Vec<&'a Json>, Problem> {
        let mut at = vec![self.schema];
        if path.is_empty() {
            return Ok(at);
        }
        for segment in path.split('.') {
            let next: Vec<_> = at.iter().flat_map(|s| self.children(s, segment)).collect();
            if next.is_empty() {
                let siblings = at.iter().flat_map(|s| self.names(s));
                let slip = nearest(segment, siblings).map(|name| path.replacen(segment, &name, 1));
                let nearest = slip.or_else(|| self.elsewhere(segment));
                return Err(Problem::UnknownSetting { path: path.to_owned(), nearest });
            }
            at = next;
        }
        Ok(at)
    }

    /// The schemas that a value may follow: itself, what it refers to, its alternatives.
    fn alternatives(&self, schema: &'a Json) -> Vec<&'a Json> {
        let mut found = vec![schema];
        if let Some(name) = schema["$ref"].as_str().and_then(|r| r.strip_prefix("#/$defs/")) {
            found.extend(self.alternatives(&self.schema["$defs"][name]));
        }
        for key in ["anyOf", "oneOf", "allOf"] {
            for option in schema[key].as_array().into_iter().flatten() {
                found.extend(self.alternatives(option));
            }
        }
        found
    }

    fn children(&self, schema: &'a Json, segment: &str) -> Vec<&'a Json> {
        let is_index = segment.parse::<usize>().is_ok();
        let child = |option: &'a Json| {
            let named = option["properties"].get(segment);
            let keyed = option.get("additionalProperties").filter(|rest| rest.is_object());
            let item = option.get("items").filter(|_| is_index);
            named.or(keyed).or(item)
        };
        self.alternatives(schema).into_iter().filter_map(child).collect()
    }

    fn names(&self, schema: &'a Json) -> Vec<&'a str> {
        let properties = |option: &'a Json| option["properties"].as_object();
        let groups = self.alternatives(schema).into_iter().filter_map(properties);
        groups.flat_map(|group| group.keys().map(String::as_str)).collect()
    }

    /// The shortest path to a setting of that name.
    fn elsewhere(&self, name: &str) -> Option<String> {
        let mut level = vec![(String::new(), self.schema)];
        for _ in 0..SUGGESTION_DEPTH {
            let mut below = Vec::new();
            for (path, schema) in level {
                for key in self.names(schema) {
                    let path = format!("{path}{key}");
                    if key == name {
                        return Some(path);
                    }
                    let children = self.children(schema, key);
                    for &child in &children {
                        below.push((format!("{path}."), child));
                        let items = self.children(child, "0");
                        below.extend(items.into_iter().map(|i| (format!("{path}.0."), i)));
                    }
                }
            }
            level = below;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shot_schema;

    #[test]
    fn the_schema_tells_help_keys_and_lists() {
        let schema = shot_schema();
        let known = Known::of(&schema);
        let help = known.help("garments.0.view.nu_out").unwrap();
        assert!(help.starts_with("View factor far outside the frame."), "{help}");
        let help = known.help("fabrics.silk.thicken").unwrap();
        assert!(help.starts_with("Layers of the same fabric"), "{help}");
        assert_eq!(known.help("garments.0.weight"), None);
        assert_eq!(known.keys("air"), ["density", "velocity", "tangential_drag"]);
        assert_eq!(known.keys("")[..3], ["shotsilk", "import", "fps"]);
        assert_eq!(known.keys("fabrics"), [""; 0]);
        for (path, is_list) in [("garments", true), ("camera.keys", true), ("motions", false)] {
            assert_eq!(known.is_list(path), is_list, "{path}");
        }
    }
}
