//! Methods of untangling drawn: the crossings left over the rounds.

use std::error::Error;

use plotters::coord::Shift;
use plotters::prelude::*;

/// What a method made of a tangle.
#[derive(Clone, Debug, PartialEq)]
pub struct UntanglingCurve {
    pub tangle: String,
    pub method: String,
    /// Edges through faces, at the start and after each round.
    pub crossings: Vec<usize>,
}

/// Of one panel (px).
const PANEL: (u32, u32) = (420, 300);
const COLUMNS: usize = 2;

const INK: RGBColor = RGBColor(44, 46, 52);
/// Of methods in their order: told apart by eyes of every kind, and in grey.
const COLOURS: [RGBColor; 3] = [RGBColor(0, 92, 175), RGBColor(0, 128, 96), RGBColor(216, 108, 0)];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A panel per tangle, in the order in which they first come, a line per method, as SVG.
///
/// # Errors
/// If the drawing library refuses.
pub fn untangling_svg(curves: &[UntanglingCurve]) -> Result<String, Box<dyn Error>> {
    let tangles = super::distinct(curves.iter().map(|c| c.tangle.as_str()));
    let methods = super::distinct(curves.iter().map(|c| c.method.as_str()));
    let rows = tangles.len().div_ceil(COLUMNS).max(1);
    let mut text = String::new();
    {
        let size = (PANEL.0 * COLUMNS as u32, PANEL.1 * rows as u32);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE)?;
        for (tangle, area) in tangles.iter().zip(area.split_evenly((rows, COLUMNS))) {
            let own: Vec<&UntanglingCurve> =
                curves.iter().filter(|c| c.tangle == *tangle).collect();
            draw(&area, tangle, &own, &methods)?;
        }
        area.present()?;
    }
    Ok(text)
}

fn draw(
    area: &Area<'_>,
    tangle: &str,
    curves: &[&UntanglingCurve],
    methods: &[&str],
) -> Result<(), Box<dyn Error>> {
    let last = curves.iter().map(|c| c.crossings.len()).max().unwrap_or(0).max(2) - 1;
    let most = curves.iter().flat_map(|c| &c.crossings).max().copied().unwrap_or(0).max(1);
    // Above the curves there is room for the legend.
    let top = most + most / 2;
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .caption(tangle, ("sans-serif", 14, &INK))
        .x_label_area_size(34)
        .y_label_area_size(54)
        .build_cartesian_2d(0..last, 0..top)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("rounds")
        .y_desc("edges through faces")
        .label_style(("sans-serif", 12, &INK))
        .draw()?;
    for curve in curves {
        let number = methods.iter().position(|m| *m == curve.method).unwrap_or(0);
        let colour = COLOURS[number % COLOURS.len()];
        let line = curve.crossings.iter().copied().enumerate();
        chart
            .draw_series(LineSeries::new(line, colour.stroke_width(2)))?
            .label(curve.method.clone())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 14, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(("sans-serif", 12, &INK))
        .background_style(WHITE.mix(0.8))
        .draw()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tangle_has_a_panel_and_every_method_a_line_in_it() {
        let curve = |tangle: &str, method: &str, crossings: &[usize]| UntanglingCurve {
            tangle: tangle.into(),
            method: method.into(),
            crossings: crossings.to_vec(),
        };
        let svg = untangling_svg(&[
            curve("bump", "contours", &[9, 4, 0]),
            curve("bump", "apart", &[9, 12]),
            curve("corner", "contours", &[]),
        ]);
        let svg = svg.unwrap();
        let count = |text: &str| svg.matches(&format!("\n{text}\n")).count();
        assert_eq!([count("bump"), count("corner")], [1, 1]);
        assert_eq!([count("contours"), count("apart")], [2, 1]);
    }
}
