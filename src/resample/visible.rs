//! What the coarsening cost on screen: a run against a reference, one frame at a time.
//!
//! For every pixel of the reference picture that shows cloth, the point of the flat cloth seen
//! there is looked up in the other run and projected by the same camera. Meshes may differ from
//! run to run and from frame to frame; the cloth must be the same.

use std::sync::Arc;

use super::cloth_map::ClothMismatch;
use super::displacement::{Displacement, Pair, pixel_size};
use super::raster::Raster;
use super::silhouette::SilhouetteDifference;
use super::spread::Spread;
use super::unseen::Unseen;
use crate::scene::Surface;
use crate::shot::View;

/// The error of one frame. Lengths on the image are in pixels of the shot's own resolution; a frame
/// without cloth has no error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VisibleError {
    /// Share of the reference picture that shows cloth.
    pub cloth_share: f64,
    /// Of the cloth that the reference shows (px); hidden cloth of the other run counts.
    pub displacement: Spread,
    /// Share of the cloth's pixels that are displaced by more than [`VISIBLE_SHIFT_PX`].
    pub share_over_1px: f64,
    pub silhouette: SilhouetteDifference,
    /// How far the cloth jumps from frame to frame beyond the reference's own motion (px); `None`
    /// without a frame before.
    pub popping: Option<Spread>,
    /// Where the camera does not see.
    pub unseen: Unseen,
}

/// A shift that is seen (px).
pub const VISIBLE_SHIFT_PX: f64 = 1.0;

/// Frames are judged only until a floor, the error between two reference runs that start a hair
/// apart, is above this share of the error: from there on chaos decides where folds fall.
pub const FLOOR_SHARE_MAX: f64 = 0.25;

/// The error of a frame, and where on the picture it is.
#[derive(Clone, Debug)]
pub struct Measured {
    pub error: VisibleError,
    /// Of the reference.
    pub raster: Raster,
    pub displacement: Displacement,
}

/// Two runs at a frame, and at the one before.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    pub now: Pair<'a>,
    pub before: Option<Pair<'a>>,
    /// The obstacles', in the order of the frames' poses.
    pub surfaces: &'a [Arc<Surface>],
    /// The shot camera.
    pub view: &'a View,
    /// How many pixels are looked at, in width and height; the view fills them.
    pub size: [u32; 2],
}

impl Shown<'_> {
    /// # Errors
    /// If the runs are not of the same cloth.
    pub fn measure(&self) -> Result<Measured, ClothMismatch> {
        let Pair { reference, other } = self.now;
        reference.check_same_cloth(other)?;
        if let Some(before) = self.before {
            reference.check_same_cloth(before.reference)?;
            reference.check_same_cloth(before.other)?;
        }
        let picture =
            |map: &super::ClothMap| Raster::new(map.frame(), self.surfaces, self.view, self.size);
        let raster = picture(reference);
        let displacement = Displacement::new(&raster, self.now, self.before, self.view);
        let masks = [raster.cloth_mask(), picture(other).cloth_mask()];
        let width = self.size[0] as usize;
        let silhouette = SilhouetteDifference::of(&masks[0], &masks[1], width)
            .in_pixels_of(pixel_size(self.view, &raster).element_sum() / 2.0);
        let pixel_count = raster.pixels().len().max(1);
        let error = VisibleError {
            cloth_share: displacement.cloth_pixel_count() as f64 / pixel_count as f64,
            displacement: displacement.spread(),
            share_over_1px: displacement.share_above(VISIBLE_SHIFT_PX),
            silhouette,
            popping: self.before.map(|_| displacement.popping_spread()),
            unseen: Unseen::new(&raster, self.now, self.view),
        };
        Ok(Measured { error, raster, displacement })
    }
}

impl VisibleError {
    /// Whether this error means more than chaos does; `floor` is the same measure between two
    /// reference runs that start a hair apart. One that is no number is judged, too.
    pub fn is_judged(&self, floor: &VisibleError) -> bool {
        let is_too_high = floor.displacement.rms > FLOOR_SHARE_MAX * self.displacement.rms;
        !is_too_high
    }
}

#[cfg(test)]
#[path = "visible_tests.rs"]
mod tests;
