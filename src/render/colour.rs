//! Colours as screens take them and as eyes compare them.
//!
//! Oklab is Ottosson's space in which equal distances look about equally different; its constants
//! are published with it ("A perceptual color space for image processing", 2020).

use glam::Vec3;

/// An opaque colour as screens take it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Srgb(pub [u8; 3]);

/// Lightness L in 0..1, and the opponent axes green to red and blue to yellow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oklab {
    pub lightness: f32,
    pub a: f32,
    pub b: f32,
}

impl Srgb {
    /// Linear light, 0..1.
    pub fn linear(self) -> Vec3 {
        Vec3::from_array(self.0.map(|byte| linear_from_srgb(f32::from(byte) / 255.0)))
    }

    pub fn oklab(self) -> Oklab {
        Oklab::from_linear(self.linear())
    }

    pub fn with_alpha(self, alpha: u8) -> [u8; 4] {
        let [r, g, b] = self.0;
        [r, g, b, alpha]
    }
}

impl Oklab {
    /// From lightness, chroma (about 0..0.3) and hue angle.
    pub fn from_chroma(lightness: f32, chroma: f32, hue_deg: f32) -> Self {
        let (sin, cos) = hue_deg.to_radians().sin_cos();
        Self { lightness, a: chroma * cos, b: chroma * sin }
    }

    pub fn from_linear(rgb: Vec3) -> Self {
        let l = rgb.dot(Vec3::new(0.412_221_46, 0.536_332_55, 0.051_445_995)).cbrt();
        let m = rgb.dot(Vec3::new(0.211_903_5, 0.680_699_5, 0.107_396_96)).cbrt();
        let s = rgb.dot(Vec3::new(0.088_302_46, 0.281_718_85, 0.629_978_7)).cbrt();
        let lms = Vec3::new(l, m, s);
        Self {
            lightness: lms.dot(Vec3::new(0.210_454_26, 0.793_617_8, -0.004_072_047)),
            a: lms.dot(Vec3::new(1.977_998_5, -2.428_592_2, 0.450_593_7)),
            b: lms.dot(Vec3::new(0.025_904_037, 0.782_771_77, -0.808_675_77)),
        }
    }

    /// Linear light; components outside 0..1 are colours no screen shows.
    pub fn linear(self) -> Vec3 {
        let Self { lightness, a, b } = self;
        let cube = |x: f32| x * x * x;
        let l = cube(lightness + 0.396_337_78 * a + 0.215_803_76 * b);
        let m = cube(lightness - 0.105_561_346 * a - 0.063_854_17 * b);
        let s = cube(lightness - 0.089_484_18 * a - 1.291_485_5 * b);
        Vec3::new(
            4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s,
            -1.268_438 * l + 2.609_757_4 * m - 0.341_319_4 * s,
            -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
        )
    }

    /// The nearest colour a screen shows, component by component.
    pub fn srgb(self) -> Srgb {
        let byte = |x: f32| (srgb_from_linear(x.clamp(0.0, 1.0)) * 255.0).round() as u8;
        Srgb(self.linear().to_array().map(byte))
    }

    /// How different two colours look: their Euclidean distance.
    pub fn distance(self, other: Self) -> f32 {
        Vec3::new(self.lightness - other.lightness, self.a - other.a, self.b - other.b).length()
    }

    /// Colourfulness.
    pub fn chroma(self) -> f32 {
        self.a.hypot(self.b)
    }

    pub fn lerp(self, other: Self, share: f32) -> Self {
        let mix = |x: f32, y: f32| x + (y - x) * share;
        Self {
            lightness: mix(self.lightness, other.lightness),
            a: mix(self.a, other.a),
            b: mix(self.b, other.b),
        }
    }
}

fn linear_from_srgb(x: f32) -> f32 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

fn srgb_from_linear(x: f32) -> f32 {
    if x <= 0.003_130_8 { x * 12.92 } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_has_lightness_one_and_no_chroma() {
        let white = Srgb([255; 3]).oklab();
        assert!((white.lightness - 1.0).abs() < 1e-3 && white.chroma() < 1e-3, "{white:?}");
    }

    #[test]
    fn a_colour_survives_the_way_to_oklab_and_back() {
        for colour in [[0, 0, 0], [255, 0, 0], [12, 200, 99], [3, 4, 250], [128, 128, 128]] {
            assert_eq!(Srgb(colour).oklab().srgb(), Srgb(colour));
        }
    }
}
