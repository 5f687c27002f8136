//! The program as its users meet it: the built binary, its exit codes, messages and files.
//!
//! Tests write small shots into temporary folders; those of the reference scenes are skipped where
//! the scenes are not there.

mod bad_camera;
mod bad_mesh;
mod bad_motion;
mod bad_output;
mod bad_shot;
mod chart;
mod compare;
mod contact_sheet;
#[path = "../support/frame_bits.rs"]
mod frame_bits;
mod program;
mod reference;
mod render;
mod resume;
mod same_bits;
#[cfg(unix)]
mod signals;
mod simulate;
mod small_shot;
mod usage;
