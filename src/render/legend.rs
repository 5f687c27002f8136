//! What the colours mean: a bar with ticks.

use image::RgbaImage;

use super::colour::Srgb;
use super::colour_by::ColourBy;
use super::text::{Align, Face, blend, draw_text};

const INK: Srgb = Srgb([44, 46, 52]);
const PANEL: Srgb = Srgb([250, 250, 251]);
/// How much of the panel covers the picture behind it.
const PANEL_SHARE: f32 = 0.80;

/// Lengths as multiples of the text's height.
const BAR_LENGTH: f32 = 17.0;
const BAR_HEIGHT: f32 = 0.85;
const TICK_LENGTH: f32 = 0.35;
const SIDE: f32 = 1.9;
const LINE_HEIGHT: f32 = 1.35;

/// Width and height (px) of the legend for text of a height.
pub fn legend_size(text_px: f32) -> [u32; 2] {
    let width = (BAR_LENGTH + 2.0 * SIDE) * text_px;
    let height = (2.0 * LINE_HEIGHT + BAR_HEIGHT + TICK_LENGTH + 0.7) * text_px;
    [width.ceil() as u32, height.ceil() as u32]
}

/// Draws the legend with its upper left corner at a point (px). Plain cloth has none.
pub fn draw_legend(image: &mut RgbaImage, by: ColourBy, (left, top): (i64, i64), text_px: f32) {
    let Some(table) = by.table() else { return };
    let bar_left = left as f32 + SIDE * text_px;
    let bar_top = top as f32 + (LINE_HEIGHT + 0.25) * text_px;
    let (length, height) = ((BAR_LENGTH * text_px).round(), (BAR_HEIGHT * text_px).round());
    let font = (Face::Sans, text_px * 1.15);
    draw_text(image, font, (bar_left, bar_top - 0.45 * text_px), Align::Left, INK, by.title());

    let (x0, y0) = (bar_left.round() as i64, bar_top.round() as i64);
    for x in 0..length as i64 {
        let colour = table.colour(x as f64 / f64::from(length - 1.0));
        fill(image, (x0 + x, y0), (1, height as i64), colour, 1.0);
    }
    for tick in by.ticks() {
        let x = x0 + (tick.coordinate * f64::from(length - 1.0)).round() as i64;
        let bottom = y0 + height as i64;
        fill(image, (x, bottom), (1, (TICK_LENGTH * text_px).round() as i64), INK, 0.8);
        let baseline = bottom as f32 + (TICK_LENGTH + 1.0) * text_px;
        draw_text(
            image,
            (Face::Sans, text_px * 1.05),
            (x as f32, baseline),
            Align::Centre,
            INK,
            &tick.label,
        );
    }
}

/// Draws the legend on a panel in the lower left corner, if the picture has room for it.
pub(super) fn draw_in_corner(image: &mut RgbaImage, by: ColourBy, text_px: f32) {
    let [width, height] = legend_size(text_px).map(i64::from);
    let margin = text_px.round() as i64;
    let top = i64::from(image.height()) - height - margin;
    if by.table().is_none() || top < margin || width + 2 * margin > i64::from(image.width()) {
        return;
    }
    fill(image, (margin, top), (width, height), PANEL, PANEL_SHARE);
    draw_legend(image, by, (margin, top), text_px);
}

/// Mixes a colour into a rectangle.
fn fill(image: &mut RgbaImage, (x, y): (i64, i64), (w, h): (i64, i64), colour: Srgb, share: f32) {
    for py in y..y + h {
        for px in x..x + w {
            blend(image, (px, py), colour, share);
        }
    }
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::super::colour_by::LogRange;
    use super::super::text::text_width;
    use super::*;

    fn all() -> [ColourBy; 5] {
        [
            ColourBy::ViewFactor(LogRange { start: 1.0, end: 0.01 }),
            ColourBy::EdgeSize(LogRange { start: 0.01, end: 0.5 }),
            ColourBy::Strain { limit: 0.1 },
            ColourBy::speed(4.9),
            ColourBy::speed(0.012),
        ]
    }

    #[test]
    fn labels_do_not_touch() {
        let text_px = 12.0;
        for by in all() {
            let ends: Vec<[f32; 2]> = by
                .ticks()
                .iter()
                .map(|tick| {
                    let half = 0.5 * text_width(Face::Sans, &tick.label, text_px * 1.05);
                    let x = tick.coordinate as f32 * BAR_LENGTH * text_px;
                    [x - half, x + half]
                })
                .collect();
            assert!(ends.windows(2).all(|w| w[0][1] + 2.0 < w[1][0]), "{by:?}: {ends:?}");
        }
    }

    #[test]
    fn the_bar_begins_and_ends_with_the_tables_ends() {
        for by in all() {
            let mut image = RgbaImage::from_pixel(300, 80, Rgba([255; 4]));
            draw_legend(&mut image, by, (0, 0), 12.0);
            let row = (0..300).map(|x| *image.get_pixel(x, 24)).collect::<Vec<_>>();
            let table = by.table().unwrap();
            for end in [0.0, 1.0] {
                let colour = Rgba(table.colour(end).with_alpha(255));
                assert!(row.contains(&colour), "{by:?} lacks its end {end}");
            }
        }
    }
}
