//! How different two pictures look when one takes the other's place
//! ([`FLIP20`](crate::papers::FLIP20)): 0 is the same, 1 is as black for white.
//!
//! Colours are blurred as the eye blurs them at a distance and compared in a space that is even to
//! the eye; edges and points are compared apart, and raise the colour's difference.

use std::array;
use std::f64::consts::{PI, SQRT_2};

use glam::{DMat3, DVec3};
use image::RgbaImage;
use rayon::prelude::*;

use crate::render::Srgb;

/// Pixels in a degree of the field of view: a 0.7 m wide display of 3840 pixels seen from 0.7 m, as
/// in the paper.
const PIXELS_PER_DEGREE: f64 = 0.7 * 3840.0 / 0.7 * PI / 180.0;

/// Per pixel, row by row from the top, 0..1.
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    pub values: Vec<f64>,
}

impl FlipMap {
    /// Opacity is of no consequence.
    ///
    /// # Panics
    /// If the pictures differ in size.
    pub fn new(a: &RgbaImage, b: &RgbaImage) -> Self {
        assert_eq!(a.dimensions(), b.dimensions(), "pictures of one size are compared");
        let width = a.width() as usize;
        let [a, b] = [a, b].map(|picture| Appearance::of(picture, width));
        let difference = |k: usize| {
            let colour = colour_difference(a.lab[k], b.lab[k]);
            let edges = (a.edges[k] - b.edges[k]).abs();
            let points = (a.points[k] - b.points[k]).abs();
            let feature = (edges.max(points) / SQRT_2).clamp(0.0, 1.0).powf(FEATURE_EXPONENT);
            colour.powf(1.0 - feature)
        };
        Self { values: (0..a.lab.len()).into_par_iter().map(difference).collect() }
    }

    /// 0 for a picture without pixels.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len().max(1) as f64
    }
}

const FEATURE_EXPONENT: f64 = 0.5;
const COLOUR_EXPONENT: f64 = 0.7;
/// The colour difference at this share of the largest becomes `KNEE_VALUE`.
const KNEE_SHARE: f64 = 0.4;
const KNEE_VALUE: f64 = 0.95;

/// A picture as the eye takes it.
struct Appearance {
    /// Blurred; CIELAB with the Hunt effect.
    lab: Vec<DVec3>,
    /// Strength of edges and of points in the lightness.
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Appearance {
    fn of(picture: &RgbaImage, width: usize) -> Self {
        let pixels = picture.as_raw().par_chunks_exact(4);
        let opponent: Vec<DVec3> = pixels
            .map(|p| opponent_from_linear(Srgb([p[0], p[1], p[2]]).linear().as_dvec3()))
            .collect();
        let planes: [Vec<f64>; 3] =
            array::from_fn(|k| opponent.par_iter().map(|colour| colour[k]).collect());
        let [edges, points] = features(&planes[0], width);
        let [light, red_green, blue_yellow] = planes;
        let light = blurred(&light, width, &[(1.0, 0.0047)]);
        let red_green = blurred(&red_green, width, &[(1.0, 0.0053)]);
        let blue_yellow = blurred(&blue_yellow, width, &[(34.1, 0.04), (13.5, 0.025)]);
        let lab = |k: usize| {
            let colour = DVec3::new(light[k], red_green[k], blue_yellow[k]);
            hunt_lab(linear_from_opponent(colour).clamp(DVec3::ZERO, DVec3::ONE))
        };
        Self { lab: (0..light.len()).into_par_iter().map(lab).collect(), edges, points }
    }
}

/// CIE XYZ of linear sRGB.
const XYZ_FROM_LINEAR: DMat3 = DMat3::from_cols(
    DVec3::new(0.412_390_799_265_959_34, 0.212_639_005_871_510_27, 0.019_330_818_715_591_82),
    DVec3::new(0.357_584_339_383_878, 0.715_168_678_767_756, 0.119_194_779_794_625_98),
    DVec3::new(0.180_480_788_401_834_3, 0.072_192_315_360_733_71, 0.950_532_152_249_660_7),
);

fn white() -> DVec3 {
    XYZ_FROM_LINEAR * DVec3::ONE
}

/// Lightness, red to green, blue to yellow: linear in light (YCxCz).
fn opponent_from_linear(rgb: DVec3) -> DVec3 {
    let [x, y, z] = (XYZ_FROM_LINEAR * rgb / white()).to_array();
    DVec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

fn linear_from_opponent(colour: DVec3) -> DVec3 {
    let y = (colour.x + 16.0) / 116.0;
    let relative = DVec3::new(y + colour.y / 500.0, y, y - colour.z / 200.0);
    XYZ_FROM_LINEAR.inverse() * (relative * white())
}

/// CIELAB, its colourfulness lowered in the dark.
fn hunt_lab(rgb: DVec3) -> DVec3 {
    let delta: f64 = 6.0 / 29.0;
    let curve = |t: f64| {
        if t > delta.powi(3) { t.cbrt() } else { t / (3.0 * delta * delta) + 4.0 / 29.0 }
    };
    let [x, y, z] = (XYZ_FROM_LINEAR * rgb / white()).to_array().map(curve);
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    DVec3::new(lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z))
}

/// HyAB distance, raised and spread over 0..1.
fn colour_difference(a: DVec3, b: DVec3) -> f64 {
    let distance = |a: DVec3, b: DVec3| {
        let d = a - b;
        (d.x.abs() + d.y.hypot(d.z)).powf(COLOUR_EXPONENT)
    };
    let largest = distance(hunt_lab(DVec3::Y), hunt_lab(DVec3::Z));
    let (found, knee) = (distance(a, b), KNEE_SHARE * largest);
    if found < knee {
        return found * KNEE_VALUE / knee;
    }
    let above = (found - knee) / (largest - knee);
    (KNEE_VALUE + above * (1.0 - KNEE_VALUE)).min(1.0)
}

/// Blurred by a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b) with x in degrees, scaled to
/// weigh 1: the eye's contrast sensitivity.
fn blurred(plane: &[f64], width: usize, gaussians: &[(f64, f64)]) -> Vec<f64> {
    // The radius holds for all three channels: that of the widest Gaussian in use.
    let widest: f64 = 0.04;
    let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let kernels: Vec<(f64, Vec<f64>)> = gaussians
        .iter()
        .map(|&(a, b)| {
            let kernel = symmetric(radius, |x| {
                let degrees = x / PIXELS_PER_DEGREE;
                (-PI * PI * degrees * degrees / b).exp()
            });
            let sum: f64 = kernel.iter().sum();
            (a * (PI / b).sqrt() * sum * sum, kernel.iter().map(|w| w / sum).collect())
        })
        .collect();
    let total: f64 = kernels.iter().map(|(weight, _)| weight).sum();
    let mut result = vec![0.0; plane.len()];
    for (weight, kernel) in &kernels {
        let part = filtered(plane, width, kernel, kernel);
        result.par_iter_mut().zip(part).for_each(|(sum, part)| *sum += part * weight / total);
    }
    result
}

/// Edges and points: lengths of the first and second derivative of the lightness, blurred.
fn features(lightness: &[f64], width: usize) -> [Vec<f64>; 2] {
    let sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as usize;
    let unit: Vec<f64> = lightness.par_iter().map(|y| (y + 16.0) / 116.0).collect();
    let bell = |x: f64| (-x * x / (2.0 * sigma * sigma)).exp();
    let smooth = balanced(symmetric(radius, bell));
    [
        balanced(symmetric(radius, |x| -x * bell(x))),
        balanced(symmetric(radius, |x| (x * x / (sigma * sigma) - 1.0) * bell(x))),
    ]
    .map(|kernel| {
        let across = filtered(&unit, width, &kernel, &smooth);
        let down = filtered(&unit, width, &smooth, &kernel);
        across.par_iter().zip(down).map(|(&x, y)| x.hypot(y)).collect()
    })
}

/// A function at -radius..=radius.
fn symmetric(radius: usize, function: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * radius).map(|i| function(i as f64 - radius as f64)).collect()
}

/// Positive weights add up to 1, negative ones to -1.
fn balanced(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|w| **w > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|w| **w < 0.0).sum::<f64>();
    kernel.iter().map(|&w| if w < 0.0 { w / negative } else { w / positive }).collect()
}

/// A plane under a filter for rows and one for columns; at its borders it goes on as it ends.
fn filtered(plane: &[f64], width: usize, along: &[f64], down: &[f64]) -> Vec<f64> {
    let height = plane.len() / width.max(1);
    let place = |at: usize, tap: usize, radius: usize, count: usize| {
        (at + tap).saturating_sub(radius).min(count - 1)
    };
    let mut rows = vec![0.0; plane.len()];
    rows.par_chunks_mut(width.max(1)).zip(plane.par_chunks(width.max(1))).for_each(
        |(result, row)| {
            let radius = along.len() / 2;
            for (x, value) in result.iter_mut().enumerate() {
                let taps = along.iter().enumerate();
                *value = taps.map(|(tap, w)| w * row[place(x, tap, radius, width)]).sum();
            }
        },
    );
    let mut result = vec![0.0; plane.len()];
    result.par_chunks_mut(width.max(1)).enumerate().for_each(|(y, result)| {
        let radius = down.len() / 2;
        for (tap, w) in down.iter().enumerate() {
            let from = place(y, tap, radius, height) * width;
            for (value, row) in result.iter_mut().zip(&rows[from..from + width]) {
                *value += w * row;
            }
        }
    });
    result
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

    fn plain(colour: [u8; 3]) -> RgbaImage {
        let [r, g, b] = colour;
        RgbaImage::from_pixel(40, 30, Rgba([r, g, b, 255]))
    }

    /// A disc and a slope, the first shifted by so many pixels.
    fn scene(shift: f64) -> RgbaImage {
        RgbaImage::from_fn(64, 48, |x, y| {
            let (dx, dy) = (f64::from(x) - 30.0 - shift, f64::from(y) - 24.0);
            let inside = dx.hypot(dy) < 12.0;
            let [r, g, b] = if inside { [200, 80, 40] } else { [40 + 2 * x as u8, 90, 120] };
            Rgba([r, g, b, 255])
        })
    }

    #[test]
    fn the_same_picture_does_not_differ() {
        assert_eq!(FlipMap::new(&scene(0.0), &scene(0.0)).mean(), 0.0);
    }

    #[test]
    fn opposite_colours_differ_most_and_the_order_does_not_matter() {
        let (black, white) = (plain([0; 3]), plain([255; 3]));
        let mean = FlipMap::new(&black, &white).mean();
        assert!(mean > 0.95 && mean <= 1.0, "{mean}");
        let [a, b] = [scene(0.0), scene(3.0)];
        assert!((FlipMap::new(&a, &b).mean() - FlipMap::new(&b, &a).mean()).abs() < 1e-12);
    }

    /// The values are those of `flip_evaluator` 1.7, by the paper's authors.
    #[test]
    fn shifted_pictures_differ_as_the_authors_program_says() {
        for (shift, expected) in [(1.0, 0.031_809), (3.0, 0.069_096), (8.0, 0.133_702)] {
            let found = FlipMap::new(&scene(0.0), &scene(shift)).mean();
            assert!((found - expected).abs() < 1e-4, "{shift} px: {found}, not {expected}");
        }
    }

    #[test]
    fn opponent_colours_lead_back_to_the_light_they_come_from() {
        let colour = DVec3::new(0.2, 0.7, 0.4);
        assert!(linear_from_opponent(opponent_from_linear(colour)).distance(colour) < 1e-12);
        assert!((hunt_lab(DVec3::ONE) - DVec3::X * 100.0).length() < 1e-9);
    }
}
