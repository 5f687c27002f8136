//! How far from its place on the image the cloth is that a camera sees.

use glam::DVec2;
use rayon::prelude::*;

use super::cloth_map::{ClothMap, ClothPoint};
use super::raster::{Raster, Sighting, What};
use super::spread::{Spread, share_above};
use crate::shot::View;

/// Per pixel of the reference's raster; lengths in pixels of the shot's own resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    /// Of the cloth that the reference shows there; `None` where it shows none.
    pub shift: Vec<Option<DVec2>>,
    /// By how much the change since the frame before differs from the reference's own; `None` also
    /// where that cannot be seen.
    pub popping: Vec<Option<DVec2>>,
}

/// The same points of the cloth in the reference and in another run.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    pub reference: &'a ClothMap,
    pub other: &'a ClothMap,
}

/// Shorter shifts are none (px). The way from a pixel to the cloth and back rounds by some 1e-13 px,
/// or 1e-10 px a kilometre from the origin; nothing that a simulation does is as small.
const SHIFT_MIN_PX: f64 = 1e-9;

impl Displacement {
    /// Finds what each pixel of `raster` shows of `now.reference` in `now.other`, whether it can be
    /// seen there or not, and projects it by the same view. With the frame `before`, seen by the
    /// view of now so that neither camera nor cut matters, also how the difference has changed.
    ///
    /// A point that is not in front of the camera in the other run has no image: it counts as
    /// displaced by the picture's diagonal.
    pub fn new(raster: &Raster, now: Pair<'_>, before: Option<Pair<'_>>, view: &View) -> Self {
        let width = raster.size()[0] as usize;
        let to_shot = pixel_size(view, raster);
        let pairs: Vec<_> = raster
            .pixels()
            .par_iter()
            .enumerate()
            .map(|(index, seen)| {
                let point = cloth_point(now.reference, (*seen)?)?;
                let centre = DVec2::new((index % width) as f64, (index / width) as f64) + 0.5;
                let shift = shift_from(centre * to_shot, now.other, point, view);
                let was = before.and_then(|pair| {
                    let place = view.point_in_image(pair.reference.point_in_world(point))?;
                    shift_from(place, pair.other, point, view)
                });
                Some((shift, was))
            })
            .collect();
        let diagonal = DVec2::from_array(view.resolution.map(f64::from));
        let popping = |&pair: &Option<(Option<DVec2>, Option<DVec2>)>| {
            let (now, before) = pair?;
            Some(measurable(now? - before?))
        };
        Self {
            shift: pairs.iter().map(|p| p.map(|(now, _)| now.unwrap_or(diagonal))).collect(),
            popping: pairs.iter().map(popping).collect(),
        }
    }

    /// Pixels with cloth.
    pub fn cloth_pixel_count(&self) -> usize {
        self.shift.iter().flatten().count()
    }

    /// Of the lengths (px).
    pub fn spread(&self) -> Spread {
        Spread::of(self.shift.iter().flatten().map(|s| s.length()))
    }

    /// Share of the cloth's pixels that are displaced by more than a length (px).
    pub fn share_above(&self, limit: f64) -> f64 {
        let lengths: Vec<f64> = self.shift.iter().flatten().map(|s| s.length()).collect();
        share_above(limit, &lengths)
    }

    /// Of the lengths (px).
    pub fn popping_spread(&self) -> Spread {
        Spread::of(self.popping.iter().flatten().map(|s| s.length()))
    }
}

/// Pixels of the shot's own resolution in one of the raster, in x and y.
pub(super) fn pixel_size(view: &View, raster: &Raster) -> DVec2 {
    let [shot, raster] = [view.resolution, raster.size()].map(|s| DVec2::from(s.map(f64::from)));
    shot / raster
}

/// The point of the cloth that is seen, if it is cloth.
fn cloth_point(map: &ClothMap, seen: Sighting) -> Option<ClothPoint> {
    match seen.what {
        What::Cloth { garment, face } => {
            Some(map.cloth_point(garment as usize, face, seen.barycentric))
        }
        What::Obstacle { .. } => None,
    }
}

fn shift_from(place: DVec2, map: &ClothMap, point: ClothPoint, view: &View) -> Option<DVec2> {
    Some(measurable(view.point_in_image(map.point_in_world(point))? - place))
}

/// The shift, or none where it is too short to be told from rounding.
fn measurable(shift: DVec2) -> DVec2 {
    if shift.length() < SHIFT_MIN_PX { DVec2::ZERO } else { shift }
}
