//! Models of bending drawn: what they cost, and how far off they are.

use std::error::Error;

use plotters::prelude::*;

/// A model of bending, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingCandidate {
    pub name: String,
    /// CPU time to assemble a matrix (microseconds per node).
    pub assembly_us: f64,
    /// Worst error of the cantilever's H/W, as a share; one per layout of the mesh.
    pub errors: Vec<f64>,
}

/// (px).
const SIZE: (u32, u32) = (620, 460);

/// Errors below this are drawn as this (%).
const LEAST_PERCENT: f64 = 0.1;
const MOST_PERCENT: f64 = 100.0;

/// What the validation asks for (%).
const LIMIT_PERCENT: f64 = 2.0;

const INK: RGBColor = RGBColor(44, 46, 52);
const MARK: RGBColor = RGBColor(0, 92, 175);
const LIMIT: RGBColor = RGBColor(140, 142, 150);

/// A point per layout over the model's cost, as SVG.
///
/// # Errors
/// If the drawing library refuses.
pub fn bending_svg(candidates: &[BendingCandidate]) -> Result<String, Box<dyn Error>> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let most = candidates.iter().map(|c| c.assembly_us).fold(0.0, f64::max);
        let across = 0.0..if most > 0.0 { 1.5 * most } else { 1.0 };
        let title = "Cantilever on five layouts of mesh: error of H/W against cost";
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .caption(title, ("sans-serif", 14, &INK))
            .x_label_area_size(36)
            .y_label_area_size(60)
            .build_cartesian_2d(across.clone(), (LEAST_PERCENT..MOST_PERCENT).log_scale())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_desc("assembly (CPU microseconds a node)")
            .y_desc("worst error at Gamma 5, 20, 100 (%)")
            .label_style(("sans-serif", 12, &INK))
            .draw()?;
        let limit = [(across.start, LIMIT_PERCENT), (across.end, LIMIT_PERCENT)];
        chart.draw_series(DashedLineSeries::new(limit, 5, 4, LIMIT.stroke_width(1)))?;
        for candidate in candidates {
            let shown = |error: &f64| (100.0 * error).clamp(LEAST_PERCENT, MOST_PERCENT);
            let points: Vec<(f64, f64)> =
                candidate.errors.iter().map(|e| (candidate.assembly_us, shown(e))).collect();
            chart.draw_series(points.iter().map(|&at| Circle::new(at, 4, MARK.filled())))?;
            if let Some(&top) = points.iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
                let style = ("sans-serif", 13).into_font().color(&INK);
                chart.draw_series([
                    EmptyElement::at(top) + Text::new(candidate.name.clone(), (8, -6), style)
                ])?;
            }
        }
        area.present()?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_candidate_is_named_and_every_layout_marked() {
        let of = |name: &str, errors: &[f64]| BendingCandidate {
            name: name.into(),
            assembly_us: 2.0,
            errors: errors.to_vec(),
        };
        let svg = bending_svg(&[of("hinges", &[0.3, 0.1]), of("moments", &[0.0])]).unwrap();
        assert!(svg.contains("hinges") && svg.contains("moments"));
        assert_eq!(svg.matches("<circle").count(), 3);
    }
}
