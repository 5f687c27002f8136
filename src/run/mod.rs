//! The folder a simulation writes: settings, exact states, statistics.
//!
//! ```text
//! run.json           what was simulated, by which program, from which input
//! obstacles.bin      the obstacles at rest
//! frames/000012.sfr  the state at the end of a frame: enough to draw it and to go on from it
//! stats.csv          a row per frame
//! obj/               on request, the same states for other programs
//! ```
//! Every file but `stats.csv` is written under a temporary name and renamed when whole, so that a
//! file with its proper name is complete. The bytes are documented in `docs/run-folder.md`.

mod bytes;
mod error;
mod frame_file;
mod info;
mod inputs;
mod lock;
mod obj;
mod place;
mod read;
mod resume;
mod sealed;
mod state;
mod stats;
mod write;

pub use error::{RunError, StateError};
pub use frame_file::{read_frame_file, write_frame_file};
pub use info::{RUN_FORMAT, RunInfo};
pub use inputs::{InputHasher, cpu_features};
pub use read::RunReader;
pub use resume::{Remainder, ResumedRun};
pub use stats::STATS_COLUMNS;
pub use write::{RunWriter, WriteOptions};

#[cfg(test)]
mod tests;
