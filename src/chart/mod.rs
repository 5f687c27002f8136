//! What a suite of measurements found, as charts and tables; plain data in, text out.

mod bending;
mod contact;
mod reference;
mod stability;
mod study;
mod untangling;
mod visible_error;

pub use bending::{BendingCandidate, bending_svg};
pub use contact::{ContactPoint, contact_svg};
pub use reference::{EdgeLengths, uniform_edge_length};
pub use stability::{StabilityMap, StressRow};
pub use study::{FrameFigures, Reference, Study, Subject};
pub use untangling::{UntanglingCurve, untangling_svg};

/// Each name once, in the order in which they first come.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}
