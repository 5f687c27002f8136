//! Two pictures.

use image::{Rgba, RgbaImage};

use super::flip::FlipMap;
use super::metric::{Metric, Value};
use crate::render::ColourTable;

/// How two pictures of one size differ.
#[derive(Clone, Debug)]
pub struct PictureDifference {
    /// Share of the pixels of which a channel is off by more than the levels allowed.
    pub share: f64,
    pub flip: FlipMap,
}

impl PictureDifference {
    /// # Panics
    /// If the pictures differ in size.
    pub fn new(a: &RgbaImage, b: &RgbaImage, levels: u8) -> Self {
        let flip = FlipMap::new(a, b);
        let differs = |(p, q): &(&Rgba<u8>, &Rgba<u8>)| {
            p.0.iter().zip(q.0).any(|(x, y)| x.abs_diff(y) > levels)
        };
        let count = a.pixels().zip(b.pixels()).filter(differs).count();
        Self { share: count as f64 / flip.values.len().max(1) as f64, flip }
    }

    pub fn values(&self) -> Vec<Value> {
        vec![(Metric::Share, Some(self.share)), (Metric::Flip, Some(self.flip.mean()))]
    }

    /// Pale where the pictures look the same, dark where they do not.
    pub fn picture(&self, width: u32) -> RgbaImage {
        let height = self.flip.values.len() as u32 / width.max(1);
        RgbaImage::from_fn(width, height, |x, y| {
            let value = self.flip.values[(y * width + x) as usize];
            Rgba(ColourTable::EdgeSize.colour(value).with_alpha(255))
        })
    }
}

/// Pictures of one height next to each other, a gap between them.
pub fn side_by_side(pictures: &[&RgbaImage]) -> RgbaImage {
    let gaps = GAP_PX * (pictures.len() as u32).saturating_sub(1);
    let width = pictures.iter().map(|p| p.width()).sum::<u32>() + gaps;
    let height = pictures.iter().map(|p| p.height()).max().unwrap_or(0);
    let mut page = RgbaImage::from_pixel(width, height, Rgba([255; 4]));
    let mut left = 0;
    for picture in pictures {
        image::imageops::replace(&mut page, *picture, i64::from(left), 0);
        left += picture.width() + GAP_PX;
    }
    page
}

const GAP_PX: u32 = 8;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_of_the_pixels_differs_by_nine_levels() {
        let a = RgbaImage::from_pixel(10, 10, Rgba([100, 100, 100, 255]));
        let mut b = a.clone();
        (0..10).for_each(|x| b.put_pixel(x, 3, Rgba([100, 109, 100, 255])));
        assert_eq!(PictureDifference::new(&a, &b, 8).share, 0.1);
        assert_eq!(PictureDifference::new(&a, &b, 9).share, 0.0);
    }

    #[test]
    fn pictures_stand_side_by_side() {
        let [a, b] = [3, 5].map(|width| RgbaImage::from_pixel(width, 4, Rgba([0, 0, 0, 255])));
        let page = side_by_side(&[&a, &b]);
        assert_eq!(page.dimensions(), (3 + GAP_PX + 5, 4));
        assert_eq!(page.get_pixel(3 + GAP_PX, 0).0, [0, 0, 0, 255]);
        assert_eq!(side_by_side(&[]).dimensions(), (0, 0));
    }
}
