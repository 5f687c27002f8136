//! What two meshes of the same cloth have in common, and what a camera makes of the difference.
//!
//! Points of the flat cloth are found in any mesh of it ([`Locator`], [`ClothMap`]); a [`Raster`]
//! tells which of them a camera sees; [`Shown::measure`] gives the [`VisibleError`] of one run
//! against another.

mod cloth_map;
mod displacement;
mod locate;
mod raster;
mod silhouette;
mod spread;
mod unseen;
mod visible;

pub use cloth_map::{ClothMap, ClothMismatch, ClothPoint};
pub use displacement::{Displacement, Pair};
pub use locate::{Located, Locator, MaterialPoint};
pub use raster::{Raster, Sighting, What};
pub use silhouette::SilhouetteDifference;
pub use spread::Spread;
pub use unseen::Unseen;
pub use visible::{FLOOR_SHARE_MAX, Measured, Shown, VISIBLE_SHIFT_PX, VisibleError};

#[cfg(test)]
mod testing;
