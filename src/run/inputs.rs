//! What a run's bits depend on: a hash over its input, and the processor.

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::sealed::hex;

/// SHA-256 over the resolved settings and the contents of every file read, in order of reading.
/// Names of files are left out: a shot that moves is the same shot.
pub struct InputHasher {
    hash: Sha256,
}

impl InputHasher {
    pub fn new(settings: &Value) -> Self {
        let mut hasher = Self { hash: Sha256::new() };
        let mut text = String::new();
        write_canonical(settings, &mut text);
        hasher.add_file(text.as_bytes());
        hasher
    }

    pub fn add_file(&mut self, contents: &[u8]) {
        // The length keeps the end of one file from passing as the start of the next.
        self.hash.update((contents.len() as u64).to_le_bytes());
        self.hash.update(contents);
    }

    /// Lower-case hexadecimal.
    pub fn finish(self) -> String {
        hex(&self.hash.finalize())
    }
}

/// JSON without spaces and with sorted keys, whatever order the settings were read in.
fn write_canonical(value: &Value, text: &mut String) {
    match value {
        Value::Object(map) => {
            let mut entries: Vec<_> = map.iter().collect();
            entries.sort_by_key(|(key, _)| *key);
            text.push('{');
            for (key, value) in entries {
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push(':');
                write_canonical(value, text);
                text.push(',');
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for item in items {
                write_canonical(item, text);
                text.push(',');
            }
            text.push(']');
        }
        scalar => text.push_str(&scalar.to_string()),
    }
}

/// The architecture, then the instruction sets that linear algebra chooses between.
pub fn cpu_features() -> Vec<String> {
    let mut features = vec![std::env::consts::ARCH.to_owned()];
    features.extend(vector_features().into_iter().map(str::to_owned));
    features
}

#[cfg(target_arch = "x86_64")]
fn vector_features() -> Vec<&'static str> {
    let offered = [
        ("sse4.2", std::is_x86_feature_detected!("sse4.2")),
        ("avx", std::is_x86_feature_detected!("avx")),
        ("avx2", std::is_x86_feature_detected!("avx2")),
        ("fma", std::is_x86_feature_detected!("fma")),
        ("avx512f", std::is_x86_feature_detected!("avx512f")),
    ];
    offered.into_iter().filter(|(_, offered)| *offered).map(|(name, _)| name).collect()
}

#[cfg(target_arch = "aarch64")]
fn vector_features() -> Vec<&'static str> {
    if std::arch::is_aarch64_feature_detected!("neon") { vec!["neon"] } else { Vec::new() }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn vector_features() -> Vec<&'static str> {
    Vec::new()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn hash(settings: &Value, files: &[&[u8]]) -> String {
        let mut hasher = InputHasher::new(settings);
        files.iter().for_each(|contents| hasher.add_file(contents));
        hasher.finish()
    }

    #[test]
    fn the_hash_notices_settings_and_contents_and_where_files_end() {
        let base = hash(&json!({"fps": 24, "a": [1]}), &[b"one", b"two"]);
        assert_eq!(base.len(), 64);
        assert_eq!(base, hash(&json!({"a": [1], "fps": 24}), &[b"one", b"two"]));
        assert_ne!(base, hash(&json!({"fps": 25, "a": [1]}), &[b"one", b"two"]));
        assert_ne!(base, hash(&json!({"fps": 24, "a": [1]}), &[b"one", b"twx"]));
        assert_ne!(base, hash(&json!({"fps": 24, "a": [1]}), &[b"onet", b"wo"]));
    }

    #[test]
    fn the_processor_features_start_with_the_architecture() {
        assert_eq!(cpu_features()[0], std::env::consts::ARCH);
    }
}
