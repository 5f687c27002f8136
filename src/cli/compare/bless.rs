//! `--bless`: what was made becomes what is expected. Pictures only, and none is removed.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use super::pictures::{Match, matches};
use crate::cli::output::{self, PendingFile};

/// Copies B's pictures over those of A and prints what became of each.
///
/// # Errors
/// If one cannot be read or written; those before it are copied.
pub fn accept(a: &Path, b: &Path) -> Result<()> {
    let mut lines = Vec::new();
    for Match { name, a: old, b: new } in matches(a, b)? {
        let Some(new) = new else {
            lines.push(format!("{name}: left as it is, not in {:?}", b.display()));
            continue;
        };
        let to = old.unwrap_or_else(|| a.join(&name));
        let outcome = copy(&new, &to)?;
        lines.push(format!("{name}: {outcome}"));
    }
    output::print(lines.join("\n"))
}

fn copy(from: &Path, to: &Path) -> Result<&'static str> {
    let cannot = || format!("cannot read {:?}", from.display());
    let bytes = fs::read(from).with_context(cannot).map_err(super::bad_input)?;
    image::load_from_memory_with_format(&bytes, image::ImageFormat::Png)
        .with_context(cannot)
        .map_err(super::bad_input)?;
    match fs::read(to) {
        Ok(old) if old == bytes => return Ok("the same"),
        _ => {}
    }
    let outcome = if to.exists() { "replaced" } else { "added" };
    PendingFile::create(to)?.write(&bytes)?;
    Ok(outcome)
}
