//! How long the interface takes: its own work, and the way from an input to the picture that shows it.

use std::time::{Duration, Instant};

use serde::Serialize;

/// Measurements kept; older ones go.
const KEPT: usize = 4096;

/// See the module.
#[derive(Debug, Default)]
pub struct Pace {
    /// Time in panels, actions and lists of what to draw, drawing excluded (ms).
    work: Vec<f64>,
    /// Time in drawing and showing (ms).
    drawing: Vec<f64>,
    /// From an input's arrival to the redraw that shows it (ms).
    input_to_redraw: Vec<f64>,
    /// When the oldest input came that no redraw has shown.
    waiting_since: Option<Instant>,
}

/// Medians and worst cases (ms).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PaceReport {
    pub redraws: usize,
    pub work_ms_median: f64,
    pub work_ms_p95: f64,
    pub drawing_ms_median: f64,
    pub inputs: usize,
    pub input_to_redraw_ms_median: f64,
    pub input_to_redraw_ms_p95: f64,
}

impl Pace {
    /// An input has come that will change what is shown.
    pub fn note_input(&mut self) {
        self.waiting_since.get_or_insert_with(Instant::now);
    }

    /// A redraw is finished.
    pub fn note_redraw(&mut self, work: Duration, drawing: Duration) {
        keep(&mut self.work, work.as_secs_f64() * 1e3);
        keep(&mut self.drawing, drawing.as_secs_f64() * 1e3);
        if let Some(since) = self.waiting_since.take() {
            keep(&mut self.input_to_redraw, since.elapsed().as_secs_f64() * 1e3);
        }
    }

    pub fn report(&self) -> PaceReport {
        PaceReport {
            redraws: self.work.len(),
            work_ms_median: quantile(&self.work, 0.5),
            work_ms_p95: quantile(&self.work, 0.95),
            drawing_ms_median: quantile(&self.drawing, 0.5),
            inputs: self.input_to_redraw.len(),
            input_to_redraw_ms_median: quantile(&self.input_to_redraw, 0.5),
            input_to_redraw_ms_p95: quantile(&self.input_to_redraw, 0.95),
        }
    }

    /// Begins anew.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}

fn keep(values: &mut Vec<f64>, value: f64) {
    if values.len() == KEPT {
        values.remove(0);
    }
    values.push(value);
}

/// 0 of no values.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let index = (share * (sorted.len().saturating_sub(1)) as f64).round() as usize;
    sorted.get(index).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_counts_from_its_arrival_to_the_next_redraw() {
        let mut pace = Pace::default();
        pace.note_input();
        std::thread::sleep(Duration::from_millis(5));
        pace.note_redraw(Duration::from_millis(2), Duration::from_millis(3));
        pace.note_redraw(Duration::from_millis(4), Duration::from_millis(1));
        let report = pace.report();
        assert_eq!((report.redraws, report.inputs), (2, 1));
        assert!(report.input_to_redraw_ms_median >= 5.0);
        assert!((report.work_ms_p95 - 4.0).abs() < 1e-9);
    }

    #[test]
    fn nothing_measured_is_zero() {
        assert_eq!(Pace::default().report(), PaceReport::default());
    }
}
