//! Draws a sheet: title and legend on top, pairs of pictures with captions below.

use image::imageops::{self, FilterType};
use image::{Rgba, RgbaImage};

use super::layout::{CAPTION_HEIGHT, Layout, MARGIN, Place};
use super::{Caption, SheetItem, SheetOptions};
use crate::render::{
    Align, Face, Srgb, draw_legend, draw_text, fitted_text, legend_size, text_width,
};

pub(super) const PAPER: Srgb = Srgb([250, 250, 249]);
pub(super) const INK: Srgb = Srgb([30, 32, 36]);
const FAINT: Srgb = Srgb([100, 104, 112]);
const FRAME: Srgb = Srgb([198, 200, 205]);

const TITLE_PX: f32 = 30.0;
const SUBTITLE_PX: f32 = 16.0;
const HEADING_PX: f32 = 17.0;
const FIGURES_PX: f32 = 15.5;
const COLUMN_HEAD_PX: f32 = 14.5;
const LEGEND_TEXT_PX: f32 = 13.5;
/// Between title or legend and the pictures.
const HEADER_GAP: u32 = 18;
/// Between figures of a caption.
const SEPARATOR: &str = "  \u{b7}  ";

/// A sheet of all items, in order. Pictures that differ in shape from the first are fitted to it.
pub fn compose(items: &[SheetItem], options: &SheetOptions) -> RgbaImage {
    let thumbnail = thumbnail_size(items, options.thumbnail_width);
    let legend = legend_size(LEGEND_TEXT_PX);
    let header_height = legend[1] + HEADER_GAP;
    let layout = Layout::new(items.len() as u32, thumbnail, header_height, options.pairs_per_row);
    let mut sheet = RgbaImage::from_pixel(layout.width, layout.height, Rgba(PAPER.with_alpha(255)));
    draw_header(&mut sheet, &layout, options, legend);
    for column in 0..layout.pairs_per_row.min(items.len() as u32) {
        draw_column_head(&mut sheet, &layout, column);
    }
    for (index, item) in items.iter().enumerate() {
        let [shot, witness] = layout.pictures(index as u32);
        draw_picture(&mut sheet, &item.shot, shot);
        draw_picture(&mut sheet, &item.witness, witness);
        draw_caption(&mut sheet, &item.caption, layout.caption(index as u32));
    }
    sheet
}

/// The first picture's shape at the width asked for, never enlarged.
fn thumbnail_size(items: &[SheetItem], width_max: u32) -> [u32; 2] {
    let Some(first) = items.first() else { return [width_max.max(1), 1] };
    let (width, height) = first.shot.dimensions();
    let thumbnail_width = width.min(width_max).max(1);
    let height = f64::from(height) * f64::from(thumbnail_width) / f64::from(width.max(1));
    [thumbnail_width, (height.round() as u32).max(1)]
}

fn draw_header(sheet: &mut RgbaImage, layout: &Layout, options: &SheetOptions, legend: [u32; 2]) {
    let left = MARGIN as f32;
    let top = MARGIN as f32;
    let mut room = (layout.width - 2 * MARGIN) as f32;
    if options.colour_by.table().is_some() && layout.width > legend[0] + 2 * MARGIN {
        // The bar, not the panel's invisible edge, lines up with the pictures.
        let side = (1.9 * LEGEND_TEXT_PX) as u32;
        let x = layout.width - MARGIN - legend[0] + side;
        draw_legend(sheet, options.colour_by, (i64::from(x), i64::from(MARGIN)), LEGEND_TEXT_PX);
        room -= legend[0] as f32;
    }
    let title = fitted_text((Face::Sans, TITLE_PX), &options.title, room);
    draw_text(sheet, (Face::Sans, TITLE_PX), (left, top + 24.0), Align::Left, INK, &title);
    let subtitle = fitted_text((Face::Sans, SUBTITLE_PX), &options.subtitle, room);
    let place = (left, top + 48.0);
    draw_text(sheet, (Face::Sans, SUBTITLE_PX), place, Align::Left, FAINT, &subtitle);
}

fn draw_column_head(sheet: &mut RgbaImage, layout: &Layout, column: u32) {
    let font = (Face::Sans, COLUMN_HEAD_PX);
    for (place, name) in layout.pictures(column).into_iter().zip(["shot camera", "witness"]) {
        let baseline = (place.y - 7) as f32;
        draw_text(sheet, font, (place.x as f32, baseline), Align::Left, FAINT, name);
    }
}

fn draw_picture(sheet: &mut RgbaImage, picture: &RgbaImage, place: Place) {
    let (x, y) = (i64::from(place.x), i64::from(place.y));
    if picture.dimensions() == (place.width, place.height) {
        imageops::replace(sheet, picture, x, y);
    } else {
        let (w, h) = (place.width, place.height);
        imageops::replace(sheet, &imageops::resize(picture, w, h, FilterType::CatmullRom), x, y);
    }
    // A hairline, so that a pale picture ends somewhere.
    for px in place.x..place.x + place.width {
        for py in [place.y, place.y + place.height - 1] {
            sheet.put_pixel(px, py, Rgba(FRAME.with_alpha(255)));
        }
    }
    for py in place.y..place.y + place.height {
        for px in [place.x, place.x + place.width - 1] {
            sheet.put_pixel(px, py, Rgba(FRAME.with_alpha(255)));
        }
    }
}

/// The frame at the left, as many of its figures as fit at the right.
fn draw_caption(sheet: &mut RgbaImage, caption: &Caption, place: Place) {
    let baseline = (place.y + CAPTION_HEIGHT - 6) as f32;
    let left = place.x as f32;
    let right = (place.x + place.width) as f32;
    let heading = caption.heading();
    draw_text(sheet, (Face::Sans, HEADING_PX), (left, baseline), Align::Left, INK, &heading);
    let room = right - left - text_width(Face::Sans, &heading, HEADING_PX) - 16.0;
    let mut figures = caption.figures();
    while text_width(Face::Sans, &figures.join(SEPARATOR), FIGURES_PX) > room {
        if figures.pop().is_none() {
            break;
        }
    }
    let text = figures.join(SEPARATOR);
    draw_text(sheet, (Face::Sans, FIGURES_PX), (right, baseline), Align::Right, FAINT, &text);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn item(frame: i64, colour: [u8; 4]) -> SheetItem {
        SheetItem {
            shot: RgbaImage::from_pixel(640, 360, Rgba(colour)),
            witness: RgbaImage::from_pixel(640, 360, Rgba([90, 90, 90, 255])),
            caption: Caption {
                frame,
                face_count: 12_345,
                wall_seconds: Some(1.5),
                view_factor_mean: Some(0.5),
            },
        }
    }

    #[test]
    fn every_picture_is_where_the_layout_says() {
        let colours = [[200, 0, 0, 255], [0, 200, 0, 255], [0, 0, 200, 255]];
        let items: Vec<SheetItem> =
            colours.iter().enumerate().map(|(i, &c)| item(i as i64, c)).collect();
        let options = SheetOptions { title: "shot".into(), ..Default::default() };
        let sheet = compose(&items, &options);
        let header = legend_size(LEGEND_TEXT_PX)[1] + HEADER_GAP;
        let layout = Layout::new(3, [320, 180], header, None);
        assert_eq!(sheet.dimensions(), (layout.width, layout.height));
        for (index, &colour) in colours.iter().enumerate() {
            let [shot, witness] = layout.pictures(index as u32);
            for (place, colour) in [(shot, colour), (witness, [90, 90, 90, 255])] {
                let middle = (place.x + place.width / 2, place.y + place.height / 2);
                assert_eq!(sheet.get_pixel(middle.0, middle.1).0, colour);
            }
        }
    }

    #[test]
    fn every_caption_is_written() {
        let sheet = compose(&[item(1001, [255; 4])], &SheetOptions::default());
        let header = legend_size(LEGEND_TEXT_PX)[1] + HEADER_GAP;
        let strip = Layout::new(1, [320, 180], header, None).caption(0);
        let columns = |from: u32, to: u32| {
            (from..to)
                .filter(|&x| {
                    (strip.y..strip.y + strip.height).any(|y| sheet.get_pixel(x, y).0[0] < 150)
                })
                .count()
        };
        let middle = strip.x + strip.width / 2;
        assert!(columns(strip.x, middle) > 20 && columns(middle, strip.x + strip.width) > 60);
    }

    #[test]
    fn a_sheet_without_frames_is_still_a_page() {
        assert!(compose(&[], &SheetOptions::default()).width() > 0);
    }
}
