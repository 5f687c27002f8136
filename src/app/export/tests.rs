//! Whole exports: they draw with the software adapter and fail without one.

mod films;
mod places;
mod reel;
mod refusals;
mod runs;
mod sequences;
mod stills;
