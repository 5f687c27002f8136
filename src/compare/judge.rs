//! Until when a difference means something: chaos takes over at one frame and does not let go.

use super::metric::Value;
use super::report::exceeded;
use super::tolerance::Tolerance;
use crate::resample::VisibleError;

/// An error with its floor, the error between two references that start a hair apart.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    pub error: VisibleError,
    pub floor: Option<VisibleError>,
    /// From some frame on chaos, and not the run, may make the difference.
    pub is_chaos: bool,
}

/// Looks at the frames of a run in order. The first that is off while its floor is too high for its
/// error ends the judging: a later one that looks better does so by chance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Judge {
    tolerance: Option<Tolerance>,
    has_ended: bool,
}

/// Without a tolerance, a displacement (px, rms) up to this is none: nobody sees it, and a start
/// moved by a hair makes as much before any chaos.
const NONE_PX: f64 = 0.01;

impl Judge {
    pub fn new(tolerance: Option<Tolerance>) -> Self {
        Self { tolerance, has_ended: false }
    }

    /// The next frame; `values` are all that is known of it. A frame without a floor is judged
    /// unless chaos came before it.
    pub fn judged(
        &mut self,
        error: VisibleError,
        floor: Option<VisibleError>,
        values: &[Value],
    ) -> Judged {
        let is_drowned = floor.is_some_and(|floor| !error.is_judged(&floor));
        let is_off = match &self.tolerance {
            Some(tolerance) => !exceeded(values, tolerance).is_empty(),
            None => error.displacement.rms > NONE_PX,
        };
        self.has_ended |= is_drowned && is_off;
        Judged { error, floor, is_chaos: self.has_ended }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::visible_error_values;
    use crate::resample::Spread;

    /// Which frames are chaos, of these errors and floors (px).
    fn chaos(tolerance: Option<Tolerance>, frames: &[(f64, Option<f64>)]) -> Vec<bool> {
        let of = |rms| VisibleError {
            displacement: Spread { rms, p95: rms, largest: rms },
            ..VisibleError::default()
        };
        let mut judge = Judge::new(tolerance);
        let frames = frames.iter().map(|&(error, floor)| {
            let error = of(error);
            judge.judged(error, floor.map(of), &visible_error_values(&error)).is_chaos
        });
        frames.collect()
    }

    fn limit(rms_px: f64) -> Option<Tolerance> {
        Some(Tolerance { rms_px: Some(rms_px), ..Tolerance::default() })
    }

    #[test]
    fn what_comes_after_chaos_is_not_judged_however_good_it_looks() {
        let frames = [(4.0, Some(1.0)), (4.0, Some(1.01)), (4.0, Some(0.0)), (0.0, None)];
        for tolerance in [None, limit(1.0)] {
            assert_eq!(chaos(tolerance, &frames), [false, true, true, true]);
        }
    }

    #[test]
    fn a_frame_that_is_within_is_judged_whatever_its_floor() {
        let frames = [(0.0, Some(3.0)), (0.9, Some(3.0)), (1.1, Some(3.0)), (0.9, Some(3.0))];
        assert_eq!(chaos(limit(1.0), &frames), [false, false, true, true]);
        assert_eq!(chaos(None, &[(1e-7, Some(3.0)), (0.1, Some(3.0))]), [false, true]);
    }

    #[test]
    fn an_error_that_is_no_number_is_judged() {
        assert_eq!(chaos(limit(1.0), &[(f64::NAN, Some(1.0))]), [false]);
    }

    #[test]
    fn without_a_floor_everything_is_judged() {
        assert_eq!(chaos(limit(1.0), &[(9.0, None), (f64::NAN, None)]), [false, false]);
    }
}
