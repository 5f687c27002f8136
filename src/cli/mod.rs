//! The command line, one subcommand a file.

pub mod interrupt;
pub mod log;
pub mod progress;
pub mod schema;
