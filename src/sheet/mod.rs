//! Contact sheets: chosen frames of a run on one page, shot and witness view side by side.

mod figure;
mod layout;
mod page;

pub use figure::{FigurePart, figure};
pub use layout::{Layout, Place, chosen_frames};
pub use page::compose;

use image::RgbaImage;

use crate::render::ColourBy;

/// One frame's pair of pictures. All pictures of a sheet have the size of the first.
#[derive(Clone, Debug)]
pub struct SheetItem {
    pub shot: RgbaImage,
    pub witness: RgbaImage,
    pub caption: Caption,
}

/// What is said about a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// As the shot counts: with its `first_frame`.
    pub frame: i64,
    pub face_count: usize,
    /// What the frame took to simulate (wall seconds); `None` leaves it unsaid.
    /// They are never the same twice.
    pub wall_seconds: Option<f64>,
    /// Weighted by area; `None` if nobody watches.
    pub view_factor_mean: Option<f64>,
}

/// How a sheet is set.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetOptions {
    /// The shot's name.
    pub title: String,
    /// What else holds for all frames: garments, range, settings. May be empty.
    pub subtitle: String,
    pub colour_by: ColourBy,
    /// Width of a picture (px); larger ones are scaled down, smaller ones stay.
    pub thumbnail_width: u32,
    /// Pairs in a row; `None` chooses by the sheet's shape.
    pub pairs_per_row: Option<u32>,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            subtitle: String::new(),
            colour_by: crate::render::PictureOptions::default().colour_by,
            thumbnail_width: 320,
            pairs_per_row: None,
        }
    }
}

impl Caption {
    /// The frame's name.
    fn heading(&self) -> String {
        format!("frame {}", self.frame)
    }

    /// The frame's figures, most important first.
    fn figures(&self) -> Vec<String> {
        let mut figures = vec![format!("{} faces", grouped(self.face_count))];
        if let Some(seconds) = self.wall_seconds {
            figures.push(duration(seconds));
        }
        if let Some(mean) = self.view_factor_mean {
            figures.push(format!("mean view factor {mean:.2}"));
        }
        figures
    }
}

/// Thousands apart: 12,345.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Three significant digits, in the unit people would say.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 0.0995 => format!("{:.0} ms", s * 1e3),
        s if s < 9.995 => format!("{s:.2} s"),
        s if s < 99.95 => format!("{s:.1} s"),
        s => format!("{:.0} min {:02.0} s", (s / 60.0).floor(), (s % 60.0).floor()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_caption_says_its_figures_as_people_do() {
        let caption = Caption {
            frame: 1024,
            face_count: 1_234_567,
            wall_seconds: Some(3.4159),
            view_factor_mean: Some(0.4142),
        };
        assert_eq!(caption.heading(), "frame 1024");
        assert_eq!(caption.figures(), ["1,234,567 faces", "3.42 s", "mean view factor 0.41"]);
        assert_eq!(duration(0.0421), "42 ms");
        assert_eq!(duration(125.9), "2 min 05 s");
        assert_eq!(grouped(999), "999");
    }
}
