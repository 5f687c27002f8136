//! What can be told from a screenshot.

use std::path::Path;

use image::RgbaImage;

use super::SIZE;

/// The two viewports, left and right of each other above the panels: x and y from and to (px).
pub const SHOT: [u32; 4] = [0, 60, 485, 480];
pub const WITNESS: [u32; 4] = [495, 90, 975, 480];

/// Cloth that the camera sees covers at least so much of the shot's viewport, and of the witness's, which
/// shows the camera's whole way as well and the cloth from behind (px).
pub const CLOTH_LEAST: usize = 1500;
pub const WITNESS_CLOTH_LEAST: usize = 150;

pub fn screenshot(path: &Path) -> RgbaImage {
    let image = image::open(path).unwrap().to_rgba8();
    assert_eq!([image.width(), image.height()], SIZE);
    image
}

/// Pixels of cloth in the colours of the view factor, in part of a picture: nothing else there is
/// coloured as strongly, save that paler cloth is no more than skin is.
pub fn cloth(image: &RgbaImage, [x0, y0, x1, y1]: [u32; 4]) -> usize {
    let is_cloth = |x, y| {
        let [r, g, b, _] = image.get_pixel(x, y).0;
        r.max(g).max(b) - r.min(g).min(b) > 55
    };
    (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y))).filter(|&(x, y)| is_cloth(x, y)).count()
}

/// Pixels as blue as the view factor 1 is, in part of a picture.
pub fn blue(image: &RgbaImage, [x0, y0, x1, y1]: [u32; 4]) -> usize {
    let is_blue = |x, y| {
        let [r, g, b, _] = image.get_pixel(x, y).0.map(i32::from);
        b > 90 && b > r + 50 && b > g + 25
    };
    (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y))).filter(|&(x, y)| is_blue(x, y)).count()
}

/// Pixels that differ visibly between two pictures, in part of them.
pub fn differing(a: &RgbaImage, b: &RgbaImage, [x0, y0, x1, y1]: [u32; 4]) -> usize {
    let differs = |x, y| {
        let (p, q) = (a.get_pixel(x, y).0, b.get_pixel(x, y).0);
        p.iter().zip(q).any(|(&p, q)| p.abs_diff(q) > 24)
    };
    (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y))).filter(|&(x, y)| differs(x, y)).count()
}
