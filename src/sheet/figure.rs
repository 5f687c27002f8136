//! Pictures side by side, in rows, each with a line of text under it.

use image::imageops::{self, FilterType};
use image::{Rgba, RgbaImage};

use super::page::{INK, PAPER};
use crate::render::{Align, Face, draw_text};

/// A picture and what is written under it; nothing if that is empty.
#[derive(Clone, Debug, PartialEq)]
pub struct FigurePart {
    pub picture: RgbaImage,
    pub caption: String,
}

/// Around the figure, and between its parts (px).
const MARGIN: u32 = 12;
const GAP: u32 = 8;
/// A line of text under a picture, and its letters (px).
const CAPTION_HEIGHT: u32 = 26;
const CAPTION_PX: f32 = 16.0;

/// So many parts in a row, all as wide and as high as the first one is when it is `width` px wide. A
/// row has room for text only if one of its parts has some.
pub fn figure(parts: &[FigurePart], columns: u32, width: u32) -> RgbaImage {
    let columns = (columns.max(1) as usize).min(parts.len().max(1));
    let size = parts.first().map_or([width, 1], |part| scaled(&part.picture, width));
    let rows: Vec<&[FigurePart]> = parts.chunks(columns).collect();
    let heights: Vec<u32> = rows.iter().map(|row| size[1] + caption_height(row)).collect();
    let total = |count: usize, each: u32| 2 * MARGIN + count as u32 * (each + GAP) - GAP;
    let height = 2 * MARGIN + heights.iter().map(|h| h + GAP).sum::<u32>().saturating_sub(GAP);
    let paper = Rgba(PAPER.with_alpha(255));
    let mut page = RgbaImage::from_pixel(total(columns, size[0]), height.max(1), paper);
    let mut y = MARGIN;
    for (row, height) in rows.iter().zip(heights) {
        for (column, part) in row.iter().enumerate() {
            let x = MARGIN + column as u32 * (size[0] + GAP);
            draw_part(&mut page, part, [x, y], size);
        }
        y += height + GAP;
    }
    page
}

fn scaled(picture: &RgbaImage, width: u32) -> [u32; 2] {
    let [w, h] = [picture.width().max(1), picture.height()].map(f64::from);
    [width.max(1), ((h * f64::from(width) / w).round() as u32).max(1)]
}

fn caption_height(row: &[FigurePart]) -> u32 {
    if row.iter().any(|part| !part.caption.is_empty()) { CAPTION_HEIGHT } else { 0 }
}

fn draw_part(page: &mut RgbaImage, part: &FigurePart, [x, y]: [u32; 2], size: [u32; 2]) {
    let picture = match [part.picture.width(), part.picture.height()] == size {
        true => part.picture.clone(),
        false => imageops::resize(&part.picture, size[0], size[1], FilterType::CatmullRom),
    };
    imageops::replace(page, &picture, i64::from(x), i64::from(y));
    let baseline = (y + size[1] + CAPTION_HEIGHT - 8) as f32;
    let font = (Face::Sans, CAPTION_PX);
    draw_text(page, font, (x as f32, baseline), Align::Left, INK, &part.caption);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(colour: [u8; 4], caption: &str) -> FigurePart {
        FigurePart {
            picture: RgbaImage::from_pixel(200, 100, Rgba(colour)),
            caption: caption.to_owned(),
        }
    }

    #[test]
    fn parts_stand_in_rows_in_their_order() {
        let colours = [[200, 0, 0, 255], [0, 200, 0, 255], [0, 0, 200, 255]];
        let parts: Vec<FigurePart> = colours.iter().map(|&c| part(c, "")).collect();
        let page = figure(&parts, 2, 100);
        assert_eq!(page.dimensions(), (2 * MARGIN + 200 + GAP, 2 * MARGIN + 100 + GAP));
        let places = [[0, 0], [1, 0], [0, 1]];
        for ([column, row], colour) in places.into_iter().zip(colours) {
            let [x, y] = [MARGIN + column * (100 + GAP) + 50, MARGIN + row * (50 + GAP) + 25];
            assert_eq!(page.get_pixel(x, y).0, colour);
        }
    }

    #[test]
    fn text_stands_under_its_picture_and_only_rows_with_text_have_room_for_it() {
        let blank = figure(&[part([255; 4], "")], 1, 200);
        let page = figure(&[part([255; 4], "frame 12")], 1, 200);
        assert_eq!(page.height(), blank.height() + CAPTION_HEIGHT);
        let dark = |y: u32| (0..page.width()).any(|x| page.get_pixel(x, y).0[0] < 128);
        let below = MARGIN + 100;
        assert!((below..below + CAPTION_HEIGHT).any(dark) && !(0..below).any(dark));
    }

    #[test]
    fn a_figure_without_pictures_is_still_a_page() {
        assert!(figure(&[], 3, 100).width() > 0);
    }
}
