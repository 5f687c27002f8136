//! What a command leaves behind: its files, and the line on stdout.

use std::io::{self, Write};

use anyhow::{Context, Result};

pub use crate::output::{PendingFile, PendingFolder};

/// Prints a result. A reader that has gone away has read enough.
///
/// # Errors
/// If it cannot be written for another reason, such as a full disk.
pub fn print(result: impl std::fmt::Display) -> Result<()> {
    match writeln!(io::stdout(), "{result}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to stdout")
        }
        _ => Ok(()),
    }
}
