//! Everything the program is built from may be given away with it. The same lists, for
//! cargo-deny, are in `deny.toml`; this test needs neither network nor other tools.

use std::process::Command;

use serde_json::Value;

/// Licences that ask for no more than to be named.
const ALLOWED: [&str; 11] = [
    "MIT",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "Zlib",
    "Unicode-3.0",
    "Unlicense",
    "CC0-1.0",
    "0BSD",
    "BSL-1.0",
];

/// Licences of one package only, and why.
const EXCEPTIONS: [(&str, &str); 2] = [
    // Fonts that are drawn with, not linked to.
    ("epaint_default_fonts", "OFL-1.1"),
    ("epaint_default_fonts", "Ubuntu-font-1.0"),
];

/// A licence expression: alternatives of licences that hold together.
///
/// `A OR (B AND C)`; `WITH` names an exception that only adds rights, so it is of no consequence;
/// `/` is an old way to write `OR`.
struct Expression<'a> {
    words: Vec<&'a str>,
    position: usize,
}

impl<'a> Expression<'a> {
    fn new(text: &'a str) -> Self {
        let mut words = Vec::new();
        for part in text.split([' ', '/']).filter(|part| !part.is_empty()) {
            let word = part.trim_start_matches('(').trim_end_matches(')');
            let opening = part.len() - part.trim_start_matches('(').len();
            let closing = part.len() - part.trim_end_matches(')').len();
            words.extend(std::iter::repeat_n("(", opening));
            words.push(word);
            words.extend(std::iter::repeat_n(")", closing));
        }
        Self { words, position: 0 }
    }

    fn met_by(mut self, allows: &dyn Fn(&str) -> bool) -> bool {
        let met = self.any(allows);
        assert_eq!(self.position, self.words.len(), "words left over in {:?}", self.words);
        met
    }

    fn any(&mut self, allows: &dyn Fn(&str) -> bool) -> bool {
        let mut met = self.all(allows);
        // "MIT/Apache-2.0" has no word between.
        while !matches!(self.peek(), None | Some(")")) {
            self.accept("OR");
            met |= self.all(allows);
        }
        met
    }

    fn all(&mut self, allows: &dyn Fn(&str) -> bool) -> bool {
        let mut met = self.one(allows);
        while self.accept("AND") {
            met &= self.one(allows);
        }
        met
    }

    fn one(&mut self, allows: &dyn Fn(&str) -> bool) -> bool {
        if self.accept("(") {
            let met = self.any(allows);
            assert!(self.accept(")"), "a bracket is open in {:?}", self.words);
            return met;
        }
        let licence = self.next();
        if self.accept("WITH") {
            self.next();
        }
        allows(licence)
    }

    fn peek(&self) -> Option<&'a str> {
        self.words.get(self.position).copied()
    }

    fn next(&mut self) -> &'a str {
        let word = self.peek().unwrap_or_else(|| panic!("{:?} ends early", self.words));
        self.position += 1;
        word
    }

    fn accept(&mut self, word: &str) -> bool {
        let accepted = self.peek() == Some(word);
        self.position += usize::from(accepted);
        accepted
    }
}

/// What `cargo metadata` says about everything in the lock file; if only this system's packages
/// have been fetched, about those.
fn packages() -> Vec<Value> {
    let everything = metadata(&[]);
    let text = everything.or_else(|| metadata(&["--filter-platform", &host()]));
    let text = text.expect("cargo metadata needs the packages fetched: cargo fetch --locked");
    let metadata: Value = serde_json::from_slice(&text).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

fn metadata(arguments: &[&str]) -> Option<Vec<u8>> {
    let output = Command::new(env!("CARGO"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["metadata", "--offline", "--locked", "--format-version", "1"])
        .args(arguments)
        .output()
        .expect("cargo runs");
    output.status.success().then_some(output.stdout)
}

fn host() -> String {
    let output = Command::new("rustc").arg("-vV").output().expect("rustc runs");
    let text = String::from_utf8(output.stdout).unwrap();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.expect("rustc names its host").to_owned()
}

#[test]
fn every_package_may_be_given_away() {
    let refused: Vec<String> = packages()
        .iter()
        .filter_map(|package| {
            let name = package["name"].as_str().unwrap();
            let licence = package["license"].as_str().unwrap_or("none stated");
            let allows = |id: &str| ALLOWED.contains(&id) || EXCEPTIONS.contains(&(name, id));
            let met = package["license"].is_string() && Expression::new(licence).met_by(&allows);
            (!met).then(|| format!("{name}: {licence}"))
        })
        .collect();
    assert!(refused.is_empty(), "licences that are not allowed: {refused:#?}");
}

#[test]
fn expressions_are_read_as_they_are_meant() {
    let met = |text| Expression::new(text).met_by(&|id| ["MIT", "Zlib"].contains(&id));
    for text in [
        "MIT",
        "GPL-3.0 OR MIT",
        "MIT/Apache-2.0",
        "Apache-2.0/MIT",
        "MIT AND Zlib",
        "(GPL-3.0 OR MIT) AND (Zlib)",
        "MIT AND GPL-3.0 OR Zlib",
        "GPL-3.0 OR (MIT AND (Zlib OR GPL-2.0))",
        "MIT WITH LLVM-exception",
    ] {
        assert!(met(text), "{text}");
    }
    for text in [
        "GPL-3.0",
        "MIT AND GPL-3.0",
        "MIT AND (GPL-3.0 OR GPL-2.0)",
        "(MIT OR Apache-2.0) AND OFL-1.1",
        "GPL-3.0 WITH MIT",
    ] {
        assert!(!met(text), "{text}");
    }
}

#[test]
fn cargo_deny_has_the_same_list() {
    let text = include_str!("../deny.toml");
    for licence in ALLOWED {
        assert!(text.contains(&format!("\"{licence}\"")), "deny.toml lacks {licence}");
    }
    for (package, licence) in EXCEPTIONS {
        assert!(text.contains(package) && text.contains(licence), "deny.toml lacks {licence}");
    }
}
