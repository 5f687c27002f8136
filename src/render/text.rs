//! Text on images, in fonts that are built in.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, Glyph, ScaleFont, point};
use image::{Rgba, RgbaImage};

use super::colour::Srgb;

/// A typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// For titles and captions.
    Sans,
    /// Digits of equal width, for tables.
    Mono,
}

/// Which point of the text stands at the given x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    Left,
    Centre,
    Right,
}

static SANS: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).expect("the font is built in")
});
static MONO: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(epaint_default_fonts::HACK_REGULAR).expect("the font is built in")
});

/// Raises faint coverage: thin stems of a light typeface would be washed out at small sizes.
const STEM_GAMMA: f32 = 0.72;

impl Face {
    fn font(self) -> &'static FontRef<'static> {
        match self {
            Self::Sans => &SANS,
            Self::Mono => &MONO,
        }
    }
}

/// Glyphs placed from x = 0 on the baseline, and the width of the whole (px).
fn placed(face: Face, text: &str, size_px: f32) -> (Vec<Glyph>, f32) {
    let font = face.font().as_scaled(size_px);
    let mut glyphs = Vec::new();
    let mut x = 0.0;
    let mut last = None;
    for character in text.chars() {
        let mut glyph = font.scaled_glyph(character);
        if let Some(last) = last {
            x += font.kern(last, glyph.id);
        }
        glyph.position = point(x, 0.0);
        x += font.h_advance(glyph.id);
        last = Some(glyph.id);
        glyphs.push(glyph);
    }
    (glyphs, x)
}

/// How wide a text is (px).
pub fn text_width(face: Face, text: &str, size_px: f32) -> f32 {
    placed(face, text, size_px).1
}

/// The text, shortened with an ellipsis if it is wider than `room` (px).
pub fn fitted_text((face, size_px): (Face, f32), text: &str, room: f32) -> String {
    if text_width(face, text, size_px) <= room {
        return text.to_owned();
    }
    let mut kept = text.to_owned();
    while !kept.is_empty() && text_width(face, &format!("{kept}\u{2026}"), size_px) > room {
        kept.pop();
    }
    format!("{}\u{2026}", kept.trim_end())
}

/// Writes one line with its baseline at `y` (px). What lies outside the image is cut off.
pub fn draw_text(
    image: &mut RgbaImage,
    (face, size_px): (Face, f32),
    (x, y): (f32, f32),
    align: Align,
    colour: Srgb,
    text: &str,
) {
    let (glyphs, width) = placed(face, text, size_px);
    let left = match align {
        Align::Left => x,
        Align::Centre => x - 0.5 * width,
        Align::Right => x - width,
    };
    for mut glyph in glyphs {
        // Whole pixels: equal letters look equal.
        glyph.position = point((left + glyph.position.x).round(), y.round());
        let Some(outline) = face.font().outline_glyph(glyph) else { continue };
        let corner = outline.px_bounds().min;
        outline.draw(|dx, dy, coverage| {
            let (px, py) = (corner.x as i64 + i64::from(dx), corner.y as i64 + i64::from(dy));
            blend(image, (px, py), colour, coverage.clamp(0.0, 1.0).powf(STEM_GAMMA));
        });
    }
}

/// Mixes a colour into a pixel; outside the image nothing happens.
pub(super) fn blend(image: &mut RgbaImage, (x, y): (i64, i64), colour: Srgb, share: f32) {
    let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
    if x >= image.width() || y >= image.height() {
        return;
    }
    let Rgba(pixel) = image.get_pixel_mut(x, y);
    for (channel, target) in pixel.iter_mut().zip(colour.0) {
        let mixed = f32::from(*channel) * (1.0 - share) + f32::from(target) * share;
        *channel = mixed.round() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_written_where_it_is_aligned() {
        let white = || RgbaImage::from_pixel(120, 30, Rgba([255; 4]));
        let inked_columns = |align| {
            let mut image = white();
            let place = (60.0, 20.0);
            draw_text(&mut image, (Face::Sans, 14.0), place, align, Srgb([0; 3]), "frame");
            let ink = |x: &u32| (0..30).any(|y| image.get_pixel(*x, y).0[0] < 128);
            let columns: Vec<u32> = (0..120).filter(ink).collect();
            (columns[0], columns[columns.len() - 1])
        };
        assert!(inked_columns(Align::Left).0 >= 59);
        assert!(inked_columns(Align::Right).1 <= 60);
        let (first, last) = inked_columns(Align::Centre);
        assert!((first + last).abs_diff(120) <= 3);
    }

    #[test]
    fn a_long_text_is_shortened_to_its_room() {
        let text = fitted_text((Face::Sans, 20.0), "a title of far more than sixty pixels", 60.0);
        assert!(text.ends_with('\u{2026}'));
        assert!(text_width(Face::Sans, &text, 20.0) <= 60.0);
    }

    #[test]
    fn text_over_the_edge_is_cut_off() {
        let mut image = RgbaImage::from_pixel(10, 10, Rgba([255; 4]));
        let font = (Face::Mono, 40.0);
        draw_text(&mut image, font, (-20.0, 12.0), Align::Left, Srgb([0; 3]), "wide text");
    }
}
