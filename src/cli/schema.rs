//! `shotsilk schema`: the JSON Schema of the shot file, for editors.

use crate::scene::shot_schema;

/// The schema, for people to read; the camera file is `CameraFile` under `$defs`.
pub fn run() -> String {
    serde_json::to_string_pretty(&shot_schema()).expect("a schema is plain data")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_of_the_schema_has_a_description() {
        let schema: serde_json::Value = serde_json::from_str(&run()).unwrap();
        let definitions = schema["$defs"].as_object().unwrap();
        assert!(definitions.contains_key("CameraFile"));
        for (owner, part) in definitions.iter().chain([(&"ShotFile".to_owned(), &schema)]) {
            for (name, setting) in part["properties"].as_object().into_iter().flatten() {
                let description = setting["description"].as_str().unwrap_or_default();
                assert!(!description.is_empty(), "{owner}.{name} is not described");
            }
        }
    }
}
