//! One result held against another: two runs as the shot camera sees them ([`RunPair`]), or two
//! pictures ([`PictureDifference`]); limits ([`Tolerance`]), and what came of it ([`Comparison`]).

mod flip;
mod formats;
mod judge;
mod metric;
mod picture;
mod report;
mod runs;
mod shade;
mod tolerance;

pub use flip::FlipMap;
pub use judge::{Judge, Judged};
pub use metric::{Metric, Value, visible_error_values};
pub use picture::{PictureDifference, side_by_side};
pub use report::{Comparison, Excess, Fault, Item, Kind, Verdict, short};
pub use runs::{RunPair, RunsError, frames_of_either};
pub use shade::error_page;
pub use tolerance::{Tolerance, ToleranceError};
