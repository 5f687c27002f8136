//! Where everything stands on a sheet, before anything is drawn.

use std::ops::RangeInclusive;

/// A rectangle on the sheet (px).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// The sheet's measures (px).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    pub width: u32,
    pub height: u32,
    pub pairs_per_row: u32,
    /// Title, subtitle and legend.
    pub header_height: u32,
    /// Names of the columns, above the first row.
    pub column_head_height: u32,
    thumbnail: [u32; 2],
}

/// Around the sheet.
pub(super) const MARGIN: u32 = 32;
/// Between the two pictures of a pair: they belong together.
const PAIR_GAP: u32 = 4;
/// Between pairs in a row.
const COLUMN_GAP: u32 = 32;
/// Between a row's captions and the next row.
const ROW_GAP: u32 = 22;
/// Under a pair.
pub(super) const CAPTION_HEIGHT: u32 = 26;
/// Width over height of a sheet that fills a screen.
const ASPECT: f64 = 1.6;
/// Nobody reads longer rows.
const PAIRS_PER_ROW_MAX: u32 = 6;

impl Layout {
    /// For a number of pairs of pictures of one size (px), at least one pair.
    pub fn new(
        pair_count: u32,
        thumbnail: [u32; 2],
        header_height: u32,
        pairs_per_row: Option<u32>,
    ) -> Self {
        let pair_count = pair_count.max(1);
        let with =
            |pairs_per_row| Self::with_rows_of(pairs_per_row, pair_count, thumbnail, header_height);
        match pairs_per_row {
            Some(wanted) => with(wanted.clamp(1, pair_count)),
            None => (1..=PAIRS_PER_ROW_MAX.min(pair_count))
                .map(with)
                .min_by(|a, b| a.strangeness(pair_count).total_cmp(&b.strangeness(pair_count)))
                .expect("there is at least one pair"),
        }
    }

    fn with_rows_of(
        pairs_per_row: u32,
        pair_count: u32,
        thumbnail: [u32; 2],
        header_height: u32,
    ) -> Self {
        let column_head_height = 22;
        let mut layout = Self {
            width: 0,
            height: 0,
            pairs_per_row,
            header_height,
            column_head_height,
            thumbnail,
        };
        layout.width =
            2 * MARGIN + pairs_per_row * layout.pair_width() + (pairs_per_row - 1) * COLUMN_GAP;
        let rows = pair_count.div_ceil(pairs_per_row);
        layout.height =
            2 * MARGIN + header_height + column_head_height + rows * layout.row_height() - ROW_GAP;
        layout
    }

    /// How far the sheet is from a screen's shape, and how much of its last row is empty.
    fn strangeness(&self, pair_count: u32) -> f64 {
        let aspect = f64::from(self.width) / f64::from(self.height);
        let rows = pair_count.div_ceil(self.pairs_per_row);
        let empty = f64::from(rows * self.pairs_per_row - pair_count)
            / f64::from(rows * self.pairs_per_row);
        (aspect / ASPECT).ln().abs() + 0.8 * empty
    }

    fn pair_width(&self) -> u32 {
        2 * self.thumbnail[0] + PAIR_GAP
    }

    fn row_height(&self) -> u32 {
        self.thumbnail[1] + CAPTION_HEIGHT + ROW_GAP
    }

    /// Left edge of a column of pairs.
    pub fn column_x(&self, column: u32) -> u32 {
        MARGIN + column * (self.pair_width() + COLUMN_GAP)
    }

    /// Shot and witness picture of a pair.
    pub fn pictures(&self, pair: u32) -> [Place; 2] {
        let [width, height] = self.thumbnail;
        let x = self.column_x(pair % self.pairs_per_row);
        let y = MARGIN
            + self.header_height
            + self.column_head_height
            + pair / self.pairs_per_row * self.row_height();
        [0, width + PAIR_GAP].map(|dx| Place { x: x + dx, y, width, height })
    }

    /// The strip under a pair.
    pub fn caption(&self, pair: u32) -> Place {
        let [shot, _] = self.pictures(pair);
        Place { y: shot.y + shot.height, width: self.pair_width(), height: CAPTION_HEIGHT, ..shot }
    }
}

/// Every n-th frame of a range, from its first; the last one is always among them.
pub fn chosen_frames(range: RangeInclusive<u32>, every: u32) -> Vec<u32> {
    let last = *range.end();
    let mut frames: Vec<u32> = range.step_by(every.max(1) as usize).collect();
    if frames.last().is_some_and(|&f| f != last) {
        frames.push(last);
    }
    frames
}

#[cfg(test)]
mod tests {
    use super::*;

    fn overlap(a: Place, b: Place) -> bool {
        a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height
    }

    #[test]
    fn nothing_overlaps_or_leaves_the_sheet() {
        for count in [1, 2, 3, 7, 12, 25, 60] {
            let layout = Layout::new(count, [320, 180], 80, None);
            let places: Vec<Place> = (0..count)
                .flat_map(|i| {
                    let [shot, witness] = layout.pictures(i);
                    [shot, witness, layout.caption(i)]
                })
                .collect();
            for (i, a) in places.iter().enumerate() {
                assert!(a.x + a.width + MARGIN <= layout.width, "{count}: {a:?}");
                assert!(a.y + a.height + MARGIN <= layout.height, "{count}: {a:?}");
                assert!(a.y >= MARGIN + layout.header_height);
                assert!(places[i + 1..].iter().all(|b| !overlap(*a, *b)), "{count}: {a:?}");
            }
        }
    }

    #[test]
    fn many_frames_make_a_sheet_of_a_reasonable_shape() {
        for count in [6, 12, 25, 60] {
            for thumbnail in [[320, 180], [240, 240], [180, 320]] {
                let layout = Layout::new(count, thumbnail, 80, None);
                let aspect = f64::from(layout.width) / f64::from(layout.height);
                assert!((0.6..2.8).contains(&aspect), "{count} of {thumbnail:?}: {aspect}");
            }
        }
    }

    #[test]
    fn rows_can_be_ordered_and_are_no_longer_than_needed() {
        assert_eq!(Layout::new(9, [320, 180], 80, Some(3)).pairs_per_row, 3);
        assert_eq!(Layout::new(2, [320, 180], 80, Some(5)).pairs_per_row, 2);
        assert_eq!(Layout::new(0, [320, 180], 80, None).pairs_per_row, 1);
    }

    #[test]
    fn every_nth_frame_is_chosen_and_the_last_one() {
        assert_eq!(chosen_frames(1..=10, 4), [1, 5, 9, 10]);
        assert_eq!(chosen_frames(0..=8, 4), [0, 4, 8]);
        assert_eq!(chosen_frames(3..=3, 0), [3]);
    }
}
