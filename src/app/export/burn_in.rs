//! The strip under a picture that says what it shows.

use image::{Rgba, RgbaImage, imageops};

use crate::render::{Align, Face, Srgb, draw_text, fitted_text, text_width};
use crate::shot::Lens;

/// What a strip says.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strip {
    pub shot: String,
    /// Who looks.
    pub view: &'static str,
    /// As the shot counts: with its `first_frame`.
    pub frame: i64,
    pub lens: Lens,
    pub settings_hash: String,
}

pub(super) const PAPER: Srgb = Srgb([22, 23, 26]);
const INK: Srgb = Srgb([232, 233, 236]);
const FAINT: Srgb = Srgb([182, 186, 194]);

/// Height of letters (px) on pictures of usual widths, and its share of the width.
const TEXT_PX_MIN: f32 = 9.0;
const TEXT_PX_MAX: f32 = 22.0;
const TEXT_SHARE: f32 = 1.0 / 70.0;
/// Lengths as multiples of the letters' height.
const STRIP_HEIGHT: f32 = 2.0;
const SIDE: f32 = 0.9;
const GAP: f32 = 1.6;
const BASELINE: f32 = 1.34;
/// Between two things that are said.
const SEPARATOR: &str = "  \u{b7}  ";
/// Digits of a hash that tell settings apart.
const HASH_DIGITS: usize = 12;

/// Height of the strip under a picture of a width (px): an even number, as video wants it.
pub(super) fn strip_height(width: u32) -> u32 {
    (STRIP_HEIGHT * text_px(width) / 2.0).round() as u32 * 2
}

fn text_px(width: u32) -> f32 {
    (width as f32 * TEXT_SHARE).clamp(TEXT_PX_MIN, TEXT_PX_MAX)
}

/// The picture with the strip under it: frame in the middle, shot and view at the left, lens and hash
/// at the right. Where it is too narrow the frame is said before all else.
pub(super) fn with_strip(picture: &RgbaImage, strip: &Strip) -> RgbaImage {
    let (width, height) = picture.dimensions();
    let mut page =
        RgbaImage::from_pixel(width, height + strip_height(width), Rgba(PAPER.with_alpha(255)));
    imageops::replace(&mut page, picture, 0, 0);
    let px = text_px(width);
    let baseline = height as f32 + BASELINE * px;
    let frame = (Face::Mono, px);
    let label = (Face::Sans, 1.06 * px);
    let number = format!("{:04}", strip.frame);
    let middle = 0.5 * width as f32;
    let room = middle - 0.5 * text_width(frame.0, &number, frame.1) - (SIDE + GAP) * px;
    draw_text(&mut page, frame, (middle, baseline), Align::Centre, INK, &number);
    let left = left_text(strip, label, room);
    draw_text(&mut page, label, (SIDE * px, baseline), Align::Left, FAINT, &left);
    let right = right_text(strip, label, room);
    draw_text(&mut page, label, (width as f32 - SIDE * px, baseline), Align::Right, FAINT, &right);
    page
}

/// The shot, shortened where it is long, and the view, if both have room.
fn left_text(strip: &Strip, font: (Face, f32), room: f32) -> String {
    /// A shot's name is not shortened below this many letters' heights to make room for the view.
    const NAME_ROOM_MIN: f32 = 4.0;
    let view = format!("{SEPARATOR}{}", strip.view);
    let name_room = room - text_width(font.0, &view, font.1);
    if name_room >= NAME_ROOM_MIN * font.1 {
        return fitted_text(font, &strip.shot, name_room) + &view;
    }
    let name = fitted_text(font, &strip.shot, room);
    if name == "\u{2026}" { String::new() } else { name }
}

/// Lens and hash, or what has room of them.
fn right_text(strip: &Strip, font: (Face, f32), room: f32) -> String {
    let hash: String = strip.settings_hash.chars().take(HASH_DIGITS).collect();
    let mut said = vec![lens_text(strip.lens), hash];
    while !said.is_empty() && text_width(font.0, &said.join(SEPARATOR), font.1) > room {
        said.pop();
    }
    said.join(SEPARATOR)
}

/// As camera reports say it: the focal length where the film back is known, else the vertical
/// field of view.
fn lens_text(lens: Lens) -> String {
    match lens {
        Lens::FilmBack { focal_mm, .. } => format!("{} mm", tenths(focal_mm)),
        Lens::FieldOfView { fov_y } => format!("vfov {}\u{b0}", tenths(fov_y.to_degrees())),
    }
}

fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    fn strip() -> Strip {
        Strip {
            shot: "sh010 layered outfit".to_owned(),
            view: "shot camera",
            frame: 1013,
            lens: Lens::FieldOfView { fov_y: 40f64.to_radians() },
            settings_hash: "0123456789abcdef0123".to_owned(),
        }
    }

    #[test]
    fn the_picture_above_the_strip_is_untouched() {
        let picture = RgbaImage::from_fn(640, 360, |x, y| Rgba([x as u8, y as u8, 7, 255]));
        let page = with_strip(&picture, &strip());
        assert_eq!(page.dimensions(), (640, 360 + strip_height(640)));
        assert!(imageops::crop_imm(&page, 0, 0, 640, 360).to_image() == picture);
        // Left, middle and right have letters.
        for (columns, count) in [(10..200, 40), (300..340, 12), (440..630, 40)] {
            let is_inked = |x: u32| (360..page.height()).any(|y| page.get_pixel(x, y).0[0] > 60);
            let inked = columns.clone().filter(|&x| is_inked(x)).count();
            assert!(inked > count, "{columns:?}: {inked}");
        }
    }

    #[test]
    fn a_strip_is_even_and_as_high_for_every_frame() {
        for width in [16, 100, 641, 1280, 4096, 16_384] {
            assert_eq!(strip_height(width) % 2, 0);
            let picture = RgbaImage::new(width, 2);
            let heights = [-5, 7, 123_456]
                .map(|frame| with_strip(&picture, &Strip { frame, ..strip() }).height() - 2);
            assert_eq!(heights, [strip_height(width); 3]);
        }
    }

    #[test]
    fn what_has_no_room_is_left_out_or_shortened_and_nothing_overlaps() {
        let font = (Face::Sans, 10.0);
        let texts = |room| (left_text(&strip(), font, room), right_text(&strip(), font, room));
        let wide =
            ("sh010 layered outfit  \u{b7}  shot camera", "vfov 40\u{b0}  \u{b7}  0123456789ab");
        assert_eq!(texts(400.0), (wide.0.to_owned(), wide.1.to_owned()));
        for room in [200.0, 120.0, 60.0, 20.0, 3.0, -10.0f32] {
            let (left, right) = texts(room);
            for text in [left, right] {
                assert!(text_width(font.0, &text, font.1) <= room.max(0.0), "{room}: {text:?}");
            }
        }
    }

    #[test]
    fn a_lens_is_said_in_millimetres_where_its_film_back_is_known() {
        let aperture_mm = DVec2::new(36.0, 24.0);
        let lens = |focal_mm| Lens::FilmBack { focal_mm, aperture_mm, offset_mm: DVec2::ZERO };
        assert_eq!(lens_text(lens(35.0)), "35 mm");
        assert_eq!(lens_text(lens(52.349)), "52.3 mm");
        assert_eq!(lens_text(Lens::FieldOfView { fov_y: 0.5 }), "vfov 28.6\u{b0}");
    }
}
