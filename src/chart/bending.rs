//! Models of bending drawn: what they cost, and how far off they are.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;

/// A model of bending, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingCandidate {
    pub name: String,
    /// CPU time to assemble a matrix (microseconds per node).
    pub assembly_us: f64,
    /// Worst error of the cantilever's H/W, as a share; one per layout of the mesh.
    pub droop_errors: Vec<f64>,
    /// Worst error of the load at which a strip buckles, as a share; one per layout of the mesh.
    pub onset_errors: Vec<f64>,
}

/// (px).
const SIZE: (u32, u32) = (1000, 460);

/// Errors below this are drawn as this (%).
const LEAST_PERCENT: f64 = 0.1;
const MOST_PERCENT: f64 = 100.0;

const INK: RGBColor = RGBColor(44, 46, 52);
/// Of candidates in their order: told apart by eyes of every kind, and in grey.
const COLOURS: [RGBColor; 4] =
    [RGBColor(150, 60, 140), RGBColor(216, 108, 0), RGBColor(0, 128, 96), RGBColor(0, 92, 175)];
const LIMIT: RGBColor = RGBColor(140, 142, 150);

/// One experiment, drawn for all candidates.
struct Panel {
    title: &'static str,
    unit: &'static str,
    /// What the validation asks for (%).
    limit_percent: f64,
    errors: fn(&BendingCandidate) -> &[f64],
}

const PANELS: [Panel; 2] = [
    Panel {
        title: "Cantilever: H/W on five layouts of mesh",
        unit: "worst error at Gamma 5, 20, 100 (%)",
        limit_percent: 2.0,
        errors: |candidate| &candidate.droop_errors,
    },
    Panel {
        title: "Lateral buckling: onset on five layouts of mesh",
        unit: "worst error at nu 0, 0.35 (%)",
        limit_percent: 5.0,
        errors: |candidate| &candidate.onset_errors,
    },
];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A point per layout over the model's cost, for each experiment, as SVG. Dashed: what the
/// validation asks for.
///
/// # Errors
/// If the drawing library refuses.
pub fn bending_svg(candidates: &[BendingCandidate]) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        for (panel, area) in PANELS.iter().zip(area.split_evenly((1, PANELS.len()))) {
            panel.draw(&area, candidates)?;
        }
        area.present()?;
    }
    Ok(text)
}

impl Panel {
    fn draw(&self, area: &Area<'_>, candidates: &[BendingCandidate]) -> Result<(), Box<dyn Error>> {
        let most = candidates.iter().map(|c| c.assembly_us).fold(0.0, f64::max);
        let across = 0.0..if most > 0.0 { 1.2 * most } else { 1.0 };
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .caption(self.title, ("sans-serif", 14, &INK))
            .x_label_area_size(36)
            .y_label_area_size(60)
            .build_cartesian_2d(across.clone(), (LEAST_PERCENT..MOST_PERCENT).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_desc("assembly (CPU microseconds a node)")
            .y_desc(self.unit)
            .label_style(("sans-serif", 12, &INK))
            .draw()?;
        let limit = [(across.start, self.limit_percent), (across.end, self.limit_percent)];
        chart.draw_series(DashedLineSeries::new(limit, 5, 4, LIMIT.stroke_width(1)))?;
        for (candidate, colour) in candidates.iter().zip(COLOURS.into_iter().cycle()) {
            let shown = |error: &f64| (100.0 * error).clamp(LEAST_PERCENT, MOST_PERCENT);
            let errors = (self.errors)(candidate).iter();
            let points: Vec<(f64, f64)> =
                errors.map(|e| (candidate.assembly_us, shown(e))).collect();
            chart
                .draw_series(points.iter().map(|&at| Circle::new(at, 4, colour.filled())))?
                .label(candidate.name.clone())
                .legend(move |at| Circle::new(at, 4, colour.filled()));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerLeft)
            .label_font(("sans-serif", 13, &INK))
            .draw()?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_candidate_is_named_and_every_layout_marked_in_both_experiments() {
        let of = |name: &str, droop: &[f64], onset: &[f64]| BendingCandidate {
            name: name.into(),
            assembly_us: 2.0,
            droop_errors: droop.to_vec(),
            onset_errors: onset.to_vec(),
        };
        let svg =
            bending_svg(&[of("hinges", &[0.3, 0.1], &[0.2]), of("moments", &[0.0], &[0.04, 0.03])]);
        let svg = svg.unwrap();
        assert_eq!([svg.matches("hinges").count(), svg.matches("moments").count()], [2, 2]);
        let in_legends = 2 * 2;
        assert_eq!(svg.matches("<circle").count(), 6 + in_legends);
    }
}
