//! The colour maps: one table each, which shader, legend and charts share.
//!
//! A map is a path through Oklab, walked at constant speed, so that equal steps of the coordinate
//! look equally different. The diverging maps fall in lightness from a pale neutral middle to both
//! ends; the sequential ones fall all the way: all are readable in grey and with colour-blind eyes.

use std::sync::LazyLock;

use super::colour::{Oklab, Srgb};

/// Colours of a table, from coordinate 0 to coordinate 1.
pub const COLOURS_PER_TABLE: usize = 256;

/// Points at which a path is measured before it is divided into equal steps.
const PATH_POINTS: usize = 4096;
/// Half the width of the round turn in the middle of a diverging path: a sharp one looks like an
/// edge in the data.
const TURN: f32 = 0.07;

/// A colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourTable {
    /// Blue through pale grey to red.
    ViewFactor,
    /// Pale yellow through green and blue to dark violet.
    EdgeSize,
    /// Violet through pale grey to orange brown.
    Strain,
    /// Pale sand through orange and crimson to dark plum.
    Speed,
}

impl ColourTable {
    pub const ALL: [Self; 4] = [Self::ViewFactor, Self::EdgeSize, Self::Strain, Self::Speed];

    pub fn colours(self) -> &'static [Srgb; COLOURS_PER_TABLE] {
        &TABLES[self.row()]
    }

    /// The colour at a coordinate in 0..1; outside, that of the nearer end.
    pub fn colour(self, coordinate: f64) -> Srgb {
        let last = (COLOURS_PER_TABLE - 1) as f64;
        self.colours()[(coordinate.clamp(0.0, 1.0) * last).round() as usize]
    }

    /// Where the table stands in the texture.
    pub(super) fn row(self) -> usize {
        match self {
            Self::ViewFactor => 0,
            Self::EdgeSize => 1,
            Self::Strain => 2,
            Self::Speed => 3,
        }
    }

    /// The path before it is divided into equal steps; `s` in 0..1.
    fn path(self, s: f32) -> Oklab {
        let pale = Oklab::from_chroma(0.90, 0.008, 95.0);
        match self {
            Self::ViewFactor => {
                let blue = Oklab::from_chroma(0.54, 0.165, 258.0);
                let red = Oklab::from_chroma(0.54, 0.165, 25.0);
                diverging(blue, pale, red, s)
            }
            Self::Strain => {
                let violet = Oklab::from_chroma(0.50, 0.12, 300.0);
                let orange = Oklab::from_chroma(0.50, 0.115, 52.0);
                diverging(violet, pale, orange, s)
            }
            Self::EdgeSize => {
                let hue_deg = 105.0 + 190.0 * s;
                let chroma = 0.084 + 0.018 * (s * std::f32::consts::PI).sin();
                Oklab::from_chroma(0.92 - 0.60 * s, chroma, hue_deg)
            }
            // The other way around the circle of hues than the edge size: warm, so that the two are
            // not mistaken for one another.
            Self::Speed => {
                let hue_deg = 92.0 - 132.0 * s;
                let chroma = 0.07 + 0.03 * s + 0.075 * (s * std::f32::consts::PI).sin();
                Oklab::from_chroma(0.92 - 0.60 * s, chroma, hue_deg)
            }
        }
    }
}

/// Straight arms from a neutral middle, joined by a round turn in lightness.
fn diverging(start: Oklab, middle: Oklab, end: Oklab, s: f32) -> Oklab {
    let signed = 2.0 * s - 1.0;
    let arm = if signed < 0.0 { start } else { end };
    let rounded = |x: f32| (x * x + TURN * TURN).sqrt() - TURN;
    let mut colour = middle.lerp(arm, signed.abs());
    let fall = rounded(signed.abs()) / rounded(1.0);
    colour.lightness = middle.lightness + (arm.lightness - middle.lightness) * fall;
    colour
}

static TABLES: LazyLock<[[Srgb; COLOURS_PER_TABLE]; ColourTable::ALL.len()]> =
    LazyLock::new(|| ColourTable::ALL.map(|table| evenly_spaced(|s| table.path(s))));

/// Walks a path in steps of equal length.
fn evenly_spaced(path: impl Fn(f32) -> Oklab) -> [Srgb; COLOURS_PER_TABLE] {
    let at = |i: usize| i as f32 / (PATH_POINTS - 1) as f32;
    let mut travelled = vec![0.0f32];
    for i in 1..PATH_POINTS {
        travelled.push(travelled[i - 1] + path(at(i - 1)).distance(path(at(i))));
    }
    let total = travelled[PATH_POINTS - 1];
    std::array::from_fn(|k| {
        let wanted = total * k as f32 / (COLOURS_PER_TABLE - 1) as f32;
        let i = travelled.partition_point(|&d| d < wanted).min(PATH_POINTS - 1);
        path(at(i)).srgb()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a sixteenth: long enough that rounding to bytes does not matter.
    fn coarse_steps(table: ColourTable) -> Vec<f32> {
        let at = |i: i32| table.colour(f64::from(i) / 16.0).oklab();
        (0..16).map(|i| at(i).distance(at(i + 1))).collect()
    }

    #[test]
    fn equal_steps_look_equally_different() {
        for table in ColourTable::ALL {
            let steps = coarse_steps(table);
            let mean = steps.iter().sum::<f32>() / steps.len() as f32;
            for (i, step) in steps.iter().enumerate() {
                assert!((step / mean - 1.0).abs() < 0.12, "{table:?} step {i}: {step} of {mean}");
            }
        }
    }

    #[test]
    fn lightness_falls_along_each_arm() {
        for table in [ColourTable::ViewFactor, ColourTable::Strain] {
            let lightness: Vec<f32> =
                (0..=32).map(|i| table.colour(f64::from(i) / 32.0).oklab().lightness).collect();
            let top = (0..lightness.len()).max_by(|&a, &b| lightness[a].total_cmp(&lightness[b]));
            let top = top.unwrap();
            assert!(lightness[..=top].is_sorted() && lightness[top..].is_sorted_by(|a, b| a >= b));
            assert!((14..=18).contains(&top), "{table:?}: the palest colour is at {top} of 32");
        }
        for table in [ColourTable::EdgeSize, ColourTable::Speed] {
            let lightness = |i| table.colour(f64::from(i) / 32.0).oklab().lightness;
            assert!((0..32).all(|i| lightness(i) > lightness(i + 1)), "{table:?}");
        }
    }

    #[test]
    fn no_colour_is_clipped_by_the_screen() {
        for table in ColourTable::ALL {
            for i in 0..=200 {
                let rgb = table.path(i as f32 / 200.0).linear();
                let inside = rgb.min_element() > -2e-3 && rgb.max_element() < 1.0 + 2e-3;
                assert!(inside, "{table:?} at {i}: {rgb}");
            }
        }
    }

    #[test]
    fn the_view_factor_runs_from_blue_through_neutral_to_red() {
        let [blue, middle, red] = [0.0, 0.5, 1.0].map(|t| ColourTable::ViewFactor.colour(t));
        assert!(blue.0[2] > blue.0[0] + 80 && red.0[0] > red.0[2] + 80, "{blue:?} {red:?}");
        assert!(middle.oklab().chroma() < 0.02, "{middle:?}");
    }
}
