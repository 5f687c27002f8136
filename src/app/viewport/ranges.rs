//! What colours reach over: they change with the frames that are seen, never with a setting alone, so
//! that a frame that stays keeps its colours.

use std::sync::Arc;

use super::Same;
use crate::preview::Scenery;
use crate::render::{ColourBy, LogRange, SeenRanges};
use crate::sim::Frame;

/// What the colour scales that follow the frames have seen since something was opened.
#[derive(Clone, Debug)]
pub struct Ranges {
    values: SeenRanges,
    /// The view factors that were in use when the first frame was seen.
    first_factors: Option<LogRange>,
    /// The smallest view factor of the frames that were looked at last, A's and B's.
    least_factor: f64,
    /// The frames that were looked at last.
    seen: Vec<Same<Frame>>,
}

impl Default for Ranges {
    fn default() -> Self {
        Self {
            values: SeenRanges::default(),
            first_factors: None,
            least_factor: 1.0,
            seen: Vec::new(),
        }
    }
}

impl Ranges {
    /// Takes in the frames that are shown together; while there are none, all stays as it was.
    pub fn see<'f>(&mut self, frames: impl Iterator<Item = &'f Arc<Frame>>, scenery: &Scenery) {
        let shown: Vec<_> = frames.cloned().map(Same).collect();
        if shown.is_empty() || shown == self.seen {
            return;
        }
        self.first_factors.get_or_insert_with(|| factors_in_use(scenery));
        for Same(frame) in shown.iter().filter(|frame| !self.seen.contains(frame)) {
            self.values.see(frame);
        }
        let factors = shown.iter().map(|Same(frame)| frame.report.view_factor_min);
        // 0 is of frames that tell none.
        self.least_factor = factors.filter(|&least| least > 0.0).fold(1.0, f64::min);
        self.seen = shown;
    }

    /// From the first settings' range to what the frames have: one that other settings made may lie
    /// beyond it.
    pub fn view_factor(&self, scenery: &Scenery) -> ColourBy {
        let first = self.first_factors.unwrap_or_else(|| factors_in_use(scenery));
        ColourBy::ViewFactor(LogRange { end: first.end.min(self.least_factor), ..first })
    }

    pub fn edge_size(&self) -> ColourBy {
        self.values.edge_size()
    }

    pub fn speed(&self) -> ColourBy {
        self.values.speed()
    }
}

fn factors_in_use(scenery: &Scenery) -> LogRange {
    match ColourBy::view_factor(&scenery.view_settings) {
        ColourBy::ViewFactor(range) => range,
        by => unreachable!("{by:?} is no view factor"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::fixture::{frame, square};
    use crate::scene::ViewSettings;

    fn seen(number: u32, view_factor_min: f64) -> Arc<Frame> {
        let mut frame = Frame { number, ..frame([square(0.0, 0.1)]) };
        frame.report.view_factor_min = view_factor_min;
        Arc::new(frame)
    }

    fn scenery(nu_out: f64) -> Scenery {
        let view = ViewSettings { nu_front: 1.0, nu_back: 0.5, nu_out, ..Default::default() };
        Scenery {
            name: String::new(),
            fps: 24.0,
            first_frame: 0,
            last: 1,
            camera: None,
            surfaces: Vec::new(),
            view_settings: vec![view],
            settings_hash: String::new(),
        }
    }

    fn range(start: f64, end: f64) -> ColourBy {
        ColourBy::ViewFactor(LogRange { start, end })
    }

    #[test]
    fn frames_that_are_shown_together_have_the_range_of_both_and_alone_their_own() {
        let (a, b, untold) = (seen(1, 0.02), seen(1, 0.3), seen(1, 0.0));
        let mut ranges = Ranges::default();
        for (shown, least) in [
            (vec![&b, &a], 0.02),
            (vec![&a, &b], 0.02),
            (vec![], 0.02),
            (vec![&b], 0.3),
            (vec![&b, &untold], 0.3),
            (vec![&untold], 1.0),
        ] {
            ranges.see(shown.iter().copied(), &scenery(0.4));
            assert_eq!(ranges.least_factor, least, "{}", shown.len());
        }
    }

    #[test]
    fn a_setting_changes_no_colour_until_a_frame_goes_beyond_the_range() {
        let (coarse, fine) = (seen(1, 0.1), seen(1, 0.02));
        let (first, other) = (scenery(0.1), scenery(0.02));
        let mut ranges = Ranges::default();
        assert_eq!(ranges.view_factor(&first), range(1.0, 0.1));
        ranges.see([&coarse].into_iter(), &first);
        assert_eq!(ranges.view_factor(&other), range(1.0, 0.1));
        ranges.see([&fine].into_iter(), &other);
        assert_eq!(ranges.view_factor(&other), range(1.0, 0.02));
        ranges.see([&coarse].into_iter(), &scenery(0.5));
        assert_eq!(ranges.view_factor(&scenery(0.5)), range(1.0, 0.1));
    }
}
