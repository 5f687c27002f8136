//! A study drawn: error over frames, and error against cost.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::study::{FrameFigures, Study, Subject};
use crate::compare::{Metric, short};

/// Size of a chart (px).
const SIZE: (u32, u32) = (900, 620);
const SPEED_SIZE: (u32, u32) = (620, 460);

/// Errors below this are drawn as this (px): a thousandth of a pixel is nothing.
const LEAST_PX: f64 = 1e-3;

const INK: RGBColor = RGBColor(44, 46, 52);
const FLOOR: RGBColor = RGBColor(140, 142, 150);
/// Of subjects in their order: told apart by eyes of every kind, and in grey.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 92, 175), RGBColor(216, 108, 0), RGBColor(0, 128, 96), RGBColor(150, 60, 140)];
/// A label beside a point reaches to so many times its cost.
const LABEL_WIDTH: f64 = 6.0;
/// Opacity of what is not judged.
const PALE: f64 = 0.28;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Outcome = Result<(), Box<dyn Error>>;

impl Study {
    /// Displacement and popping over frames, as SVG.
    ///
    /// # Errors
    /// If the drawing library refuses.
    pub fn error_svg(&self) -> Result<String, Box<dyn Error>> {
        drawn(SIZE, |area| {
            let (upper, lower) = area.split_vertically(SIZE.1 * 6 / 10);
            let title = format!(
                "{}: visible error against the reference (solid: rms, thin: 95th percentile; pale: chaos, not judged)",
                self.shot
            );
            self.draw_panel(
                &upper,
                &title,
                "displacement (px)",
                &[(Metric::RmsPx, 2), (Metric::P95Px, 1)],
            )?;
            self.draw_panel(
                &lower,
                "Change from frame to frame beyond the reference's own",
                "popping, rms (px)",
                &[(Metric::PoppingRmsPx, 2)],
            )
        })
    }

    /// Mean displacement against CPU time, as SVG.
    ///
    /// # Errors
    /// If the drawing library refuses.
    pub fn speed_svg(&self) -> Result<String, Box<dyn Error>> {
        drawn(SPEED_SIZE, |area| self.draw_speed(area))
    }

    fn draw_panel(
        &self,
        area: &Area<'_>,
        title: &str,
        unit: &str,
        lines: &[(Metric, u32)],
    ) -> Outcome {
        let of =
            |f: &FrameFigures| lines.iter().filter_map(|(m, _)| f.value(*m)).collect::<Vec<_>>();
        let all = self.subjects.iter().flat_map(|s| s.frames.iter());
        let frames = span(all.clone().map(|f| f.frame as f64));
        let has_floor = lines.iter().any(|(m, _)| *m == Metric::RmsPx);
        let floors = all.clone().filter(|_| has_floor).filter_map(FrameFigures::floor_rms_px);
        let values = decades(all.flat_map(of).chain(floors));
        // A decade above the curves for the legend.
        let values = values.start..values.end * 10.0;
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .caption(title, ("sans-serif", 14, &INK))
            .x_label_area_size(32)
            .y_label_area_size(56)
            .build_cartesian_2d(frames, values.log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_desc("frame")
            .y_desc(unit)
            .y_label_formatter(&|v| plain(*v))
            .x_label_formatter(&|v| whole(*v))
            .label_style(("sans-serif", 12, &INK))
            .draw()?;
        let floor: Vec<(f64, f64)> =
            self.subjects.first().filter(|_| has_floor).map_or(Vec::new(), |s| {
                s.frames.iter().filter_map(|f| Some(point(f.frame, f.floor_rms_px()?))).collect()
            });
        if !floor.is_empty() {
            let style = FLOOR.stroke_width(2);
            chart
                .draw_series(DashedLineSeries::new(floor, 5, 4, style))?
                .label(format!("floor: two references {:e} m apart", self.reference.perturbation))
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
        }
        for (subject, colour) in self.subjects.iter().zip(COLOURS) {
            for &(metric, width) in lines {
                for (points, is_judged) in stretches(subject, metric) {
                    let style = colour.mix(if is_judged { 1.0 } else { PALE }).stroke_width(width);
                    chart.draw_series(LineSeries::new(points, style))?;
                }
            }
            let key = colour.stroke_width(2);
            chart
                .draw_series(LineSeries::new(Vec::<(f64, f64)>::new(), key))?
                .label(subject.name.clone())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], key));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .label_font(("sans-serif", 12, &INK))
            .draw()?;
        Ok(())
    }

    fn draw_speed(&self, area: &Area<'_>) -> Outcome {
        let places: Vec<(&Subject, RGBColor, f64, f64)> = self
            .subjects
            .iter()
            .zip(COLOURS)
            .filter_map(|(s, colour)| Some((s, colour, s.cpu_seconds, s.mean(Metric::RmsPx)?)))
            .map(|(s, colour, cpu, rms)| (s, colour, cpu.max(1e-4), rms.max(LEAST_PX)))
            .collect();
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .caption(
                format!("{}: cost against visible error, means over judged frames", self.shot),
                ("sans-serif", 14, &INK),
            )
            .x_label_area_size(36)
            .y_label_area_size(60)
            .build_cartesian_2d(
                decades(places.iter().flat_map(|p| [p.2, LABEL_WIDTH * p.2])).log_scale(),
                decades(places.iter().map(|p| p.3)).log_scale(),
            )?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_desc("CPU time (s a frame)")
            .y_desc("displacement, rms (px)")
            .x_label_formatter(&|v| plain(*v))
            .y_label_formatter(&|v| plain(*v))
            .label_style(("sans-serif", 12, &INK))
            .draw()?;
        // Above and below in turn: neighbours would write over one another.
        let heights = [-16, 6].into_iter().cycle();
        for ((subject, colour, cpu, rms), height) in places.into_iter().zip(heights) {
            let text = format!("{} ({:.0} faces)", subject.name, subject.face_count);
            chart.draw_series([EmptyElement::at((cpu, rms))
                + Circle::new((0, 0), 5, colour.filled())
                + Text::new(text, (9, height), ("sans-serif", 13).into_font().color(&INK))])?;
        }
        Ok(())
    }
}

fn drawn(
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Outcome,
) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE)?;
        draw(&area)?;
        area.present()?;
    }
    Ok(text)
}

/// Unbroken stretches of frames that are judged, or are not; each begins where the one before ends.
fn stretches(subject: &Subject, metric: Metric) -> Vec<(Vec<(f64, f64)>, bool)> {
    let mut all: Vec<(Vec<(f64, f64)>, bool)> = Vec::new();
    for figures in &subject.frames {
        let Some(value) = figures.value(metric) else { continue };
        let (place, is_judged) = (point(figures.frame, value), !figures.judged.is_chaos);
        match all.last_mut() {
            Some((points, judged)) if *judged == is_judged => points.push(place),
            last => {
                let joint = last.and_then(|(points, _)| points.last().copied());
                all.push((joint.into_iter().chain([place]).collect(), is_judged));
            }
        }
    }
    all
}

fn point(frame: i64, value: f64) -> (f64, f64) {
    (frame as f64, value.max(LEAST_PX))
}

/// From the least to the largest, never without extent.
fn span(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (min, max) = values.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
    if min < max { min..max } else { 0.0..1.0 }
}

/// Whole powers of ten around values above [`LEAST_PX`].
fn decades(values: impl Iterator<Item = f64>) -> Range<f64> {
    let range = span(values.filter(|v| v.is_finite()).map(|v| v.max(LEAST_PX).log10()));
    let start = (range.start + 1e-9).floor();
    let end = (range.end - 1e-9).ceil().max(start + 1.0);
    // A little wider, so that the first and the last power have their labels.
    0.99 * 10f64.powf(start)..1.01 * 10f64.powf(end)
}

/// Only frames have a label, not the places between them.
fn whole(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value:.0}") } else { String::new() }
}

/// Without zeros that say nothing.
fn plain(value: f64) -> String {
    let text = short(value);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::super::study::Reference;
    use super::*;
    use crate::compare::Judged;
    use crate::resample::{Spread, VisibleError};

    fn figures(frame: i64, rms: f64, floor: f64) -> FrameFigures {
        let error = |rms| VisibleError {
            displacement: Spread { rms, p95: 2.0 * rms, largest: 3.0 * rms },
            ..VisibleError::default()
        };
        let is_chaos = floor > 0.25 * rms;
        let judged = Judged { error: error(rms), floor: Some(error(floor)), is_chaos };
        FrameFigures { frame, judged, flip: None }
    }

    fn study(frames: Vec<FrameFigures>) -> Study {
        let reference = Reference {
            edge_length_wanted: 0.01,
            edge_length_mean: 0.01,
            steps_per_frame: 16,
            newton_iterations: 50,
            perturbation: 1e-6,
            unconverged_steps: 0,
            face_count: 1000,
            cpu_seconds: 1.0,
        };
        let view = Subject { name: "view".into(), cpu_seconds: 0.1, face_count: 99.0, frames };
        Study { shot: "test".into(), reference, subjects: vec![view] }
    }

    #[test]
    fn lines_break_where_chaos_begins_but_leave_no_gap() {
        let frames = vec![
            figures(1, 1.0, 0.1),
            figures(2, 2.0, 0.1),
            figures(3, 1.0, 0.9),
            figures(4, 1.0, 0.9),
        ];
        let study = study(frames);
        let parts = stretches(&study.subjects[0], Metric::RmsPx);
        let judged: Vec<bool> = parts.iter().map(|p| p.1).collect();
        assert_eq!(judged, [true, false]);
        assert!(parts.windows(2).all(|w| w[0].0.last() == w[1].0.first()));
        assert_eq!(study.subjects[0].mean(Metric::RmsPx), Some(1.5));
    }

    #[test]
    fn the_legend_says_how_far_apart_the_references_start() {
        let mut study = study(vec![figures(0, 1.0, 0.1)]);
        study.reference.perturbation = 2e-5;
        let svg = study.error_svg().unwrap();
        assert!(svg.contains("two references 2e-5 m apart"), "{svg}");
    }

    #[test]
    fn a_study_without_frames_or_without_error_is_drawn_too() {
        for frames in [vec![], vec![figures(0, 0.0, 0.0)], vec![figures(7, 1.0, 0.5)]] {
            let study = study(frames);
            for svg in [study.error_svg().unwrap(), study.speed_svg().unwrap()] {
                assert!(svg.starts_with("<svg") && !svg.contains("NaN"), "{svg}");
            }
        }
    }
}
