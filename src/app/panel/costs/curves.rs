//! Curves and bars over frames, and the steps of their scale.

use egui::{Color32, Stroke};
use egui_plot::{Bar, BarChart, Line};

use crate::preview::Cost;
use crate::sim::StageSeconds;

/// What is shown of frames.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub enum Quantity {
    #[default]
    Faces,
    Seconds,
    Cumulative,
    Stages,
}

/// One for each stage, apart in lightness as well as in hue.
const STAGE_COLOURS: [Color32; 9] = [
    Color32::from_rgb(120, 124, 132),
    Color32::from_rgb(94, 160, 214),
    Color32::from_rgb(62, 98, 168),
    Color32::from_rgb(226, 150, 74),
    Color32::from_rgb(178, 208, 120),
    Color32::from_rgb(96, 186, 150),
    Color32::from_rgb(196, 96, 120),
    Color32::from_rgb(150, 110, 190),
    Color32::from_rgb(84, 86, 92),
];

/// A line for each run of frames that there are.
pub fn lines(costs: &[Option<Cost>], quantity: Quantity, colour: Color32) -> Vec<Line<'static>> {
    let line = |points: Vec<[f64; 2]>| Line::new("", points).color(colour).width(1.6);
    runs(&values(costs, quantity)).into_iter().map(line).collect()
}

/// The quantity of each frame that there is.
fn values(costs: &[Option<Cost>], quantity: Quantity) -> Vec<Option<f64>> {
    let mut sum = 0.0;
    let mut value = |cost: Cost| {
        sum += cost.wall;
        match quantity {
            Quantity::Faces => cost.faces as f64,
            Quantity::Seconds | Quantity::Stages => cost.wall,
            Quantity::Cumulative => sum,
        }
    };
    costs.iter().map(|cost| cost.map(&mut value)).collect()
}

/// Points of frames that follow one another; one that stands alone is drawn over its whole width.
fn runs(values: &[Option<f64>]) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut before = None;
    for (frame, value) in values.iter().enumerate() {
        if let Some(value) = *value {
            if before.is_none() {
                runs.push(Vec::new());
            }
            runs.last_mut().expect("pushed just now").push([frame as f64, value]);
        }
        before = *value;
    }
    for run in &mut runs {
        if let [[frame, value]] = run[..] {
            *run = vec![[frame - 0.5, value], [frame + 0.5, value]];
        }
    }
    runs
}

/// With their colours.
pub fn stage_names() -> Vec<(Color32, &'static str)> {
    let names = StageSeconds::default().entries().map(|(name, _)| name);
    STAGE_COLOURS.into_iter().zip(names).collect()
}

/// Seconds of each stage upon those before it; `strength` is that of the colours, 0..1.
pub fn stages(costs: &[Option<Cost>], strength: f32) -> Vec<BarChart> {
    stage_names()
        .into_iter()
        .enumerate()
        .map(|(stage, (colour, name))| {
            let colour = colour.gamma_multiply(strength);
            let bars = costs.iter().enumerate().filter_map(|(frame, cost)| {
                let entries = cost.as_ref()?.stages.entries();
                let below: f64 = entries[..stage].iter().map(|(_, seconds)| seconds).sum();
                let bar = Bar::new(frame as f64, entries[stage].1).base_offset(below).width(0.9);
                Some(bar.fill(colour).stroke(Stroke::NONE))
            });
            BarChart::new(name, bars.collect()).color(colour)
        })
        .collect()
}

/// Between lines of a scale over a span: 1, 2 or 5 times a power of ten, so that there are no more than
/// have room for their numbers.
pub fn round_step(span: f64, lines: f64) -> f64 {
    let least = span / lines;
    let decade = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|factor| factor * decade);
    steps.into_iter().find(|&step| step >= least).unwrap_or(10.0 * decade)
}

/// Digits behind the point that tell the lines of a scale apart.
pub fn decimals(step: f64) -> usize {
    /// More than a clock can tell.
    const DIGITS_MAX: f64 = 6.0;
    (-step.log10().floor()).clamp(0.0, DIGITS_MAX) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_has_round_steps_and_no_more_than_it_should() {
        for (span, step) in [(3.0, 1.0), (3.1, 2.0), (4300.0, 2000.0), (0.07, 0.05), (29.0, 10.0)] {
            let found = round_step(span, 3.0);
            assert!((found / step - 1.0).abs() < 1e-9, "{span}: {found}");
        }
        for k in 1..2000 {
            let span = 1e-3 * 1.01f64.powi(k);
            for most in [1.0, 2.0, 3.0] {
                let lines = span / round_step(span, most);
                assert!((0.4 * most..=most + 1e-9).contains(&lines), "{span}: {lines}");
            }
        }
    }

    #[test]
    fn numbers_of_a_scale_differ_in_what_is_written() {
        for (step, digits) in [(2000.0, 0), (1.0, 0), (0.5, 1), (0.2, 1), (0.05, 2), (0.002, 3)] {
            assert_eq!(decimals(step), digits, "{step}");
        }
    }

    #[test]
    fn a_line_breaks_where_frames_are_missing_and_one_alone_is_seen() {
        let values = [Some(1.0), Some(2.0), None, None, Some(5.0), None];
        let expected = vec![vec![[0.0, 1.0], [1.0, 2.0]], vec![[3.5, 5.0], [4.5, 5.0]]];
        assert_eq!(runs(&values), expected);
        assert!(runs(&[None]).is_empty() && runs(&[]).is_empty());
    }
}
