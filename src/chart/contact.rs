//! Ways of keeping cloth out of cloth drawn: what they cost and what they leave of the motion.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

/// What one way of contact made of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPoint {
    pub scene: String,
    pub method: String,
    /// Of the step, in contact thicknesses.
    pub speed: f64,
    /// CPU time (us).
    pub us_per_node: f64,
    /// Share of the motion.
    pub motion_kept: f64,
}

/// Of one panel (px).
const PANEL: (u32, u32) = (460, 270);
const COLUMNS: usize = 2;
/// Above the panels, for the names of the methods (px).
const LEGEND: u32 = 30;

const INK: RGBColor = RGBColor(44, 46, 52);
/// Of methods in their order: told apart by eyes of every kind, and in grey.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 92, 175), RGBColor(216, 108, 0), RGBColor(0, 128, 96), RGBColor(150, 150, 156)];

/// Of a dot (px).
const DOT: i32 = 3;

/// The axes begin and end so much beyond their dots.
const ROOM: f64 = 1.25;

/// Slower steps are drawn as if they were as fast (contact thicknesses a step): nearly at rest.
const SPEED_MIN: f64 = 0.01;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A row per scene, in the order in which they first come, a dot per step and method: the motion left
/// over what it costs, and over the speed; as SVG.
///
/// # Errors
/// If the drawing library refuses.
pub fn contact_svg(points: &[ContactPoint]) -> Result<String, Box<dyn Error>> {
    let scenes = super::distinct(points.iter().map(|p| p.scene.as_str()));
    let methods = super::distinct(points.iter().map(|p| p.method.as_str()));
    let rows = scenes.len().max(1);
    let mut text = String::new();
    {
        let size = (PANEL.0 * COLUMNS as u32, LEGEND + PANEL.1 * rows as u32);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE)?;
        let (legend, panels) = area.split_vertically(LEGEND);
        draw_legend(&legend, &methods)?;
        let panels = panels.split_evenly((rows, COLUMNS));
        let cost = Axis::over(points, "CPU time (us a node and step)", |p| p.us_per_node);
        let speed = |p: &ContactPoint| p.speed.max(SPEED_MIN);
        let speed = Axis::over(points, "speed (contact thicknesses a step)", speed);
        for (scene, row) in scenes.iter().zip(panels.chunks(COLUMNS)) {
            let own: Vec<&ContactPoint> = points.iter().filter(|p| p.scene == *scene).collect();
            draw(&row[0], scene, &own, &methods, &cost)?;
            draw(&row[1], scene, &own, &methods, &speed)?;
        }
        area.present()?;
    }
    Ok(text)
}

fn draw_legend(area: &Area<'_>, methods: &[&str]) -> Result<(), Box<dyn Error>> {
    let width = (COLUMNS as u32 * PANEL.0) as i32 / methods.len().max(1) as i32;
    for (number, method) in methods.iter().enumerate() {
        let left = 14 + width * number as i32;
        area.draw(&Circle::new((left, 18), DOT + 1, colour(number).filled()))?;
        let style = ("sans-serif", 13, &INK).into_text_style(area);
        area.draw_text(method, &style, (left + 10, 11))?;
    }
    Ok(())
}

/// What panels show along, the same in all.
struct Axis<V> {
    name: &'static str,
    value: V,
    range: Range<f64>,
}

impl<V: Fn(&ContactPoint) -> f64> Axis<V> {
    fn over(points: &[ContactPoint], name: &'static str, value: V) -> Self {
        let mut range = f64::INFINITY..0.0;
        for x in points.iter().map(&value).filter(|x| is_shown(*x)) {
            range = range.start.min(x)..range.end.max(x);
        }
        if range.end <= 0.0 {
            range = 1.0..1.0;
        }
        Self { name, value, range: range.start / ROOM..range.end * ROOM }
    }
}

fn draw(
    area: &Area<'_>,
    scene: &str,
    points: &[&ContactPoint],
    methods: &[&str],
    axis: &Axis<impl Fn(&ContactPoint) -> f64>,
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .caption(scene, ("sans-serif", 14, &INK))
        .x_label_area_size(34)
        .y_label_area_size(54)
        .build_cartesian_2d(axis.range.clone().log_scale(), 0.0..1.05)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc(axis.name)
        .y_desc("motion kept")
        .y_labels(6)
        .x_labels(6)
        .x_label_formatter(&|x| figure(*x))
        .label_style(("sans-serif", 12, &INK))
        .draw()?;
    // The first lies on top.
    for (number, method) in methods.iter().enumerate().rev() {
        let own = points.iter().filter(|p| p.method == *method && is_shown((axis.value)(p)));
        let dot = |p: &&ContactPoint| {
            let at = ((axis.value)(p), p.motion_kept.clamp(0.0, 1.0));
            Circle::new(at, DOT, colour(number).mix(0.7).filled())
        };
        chart.draw_series(own.map(dot))?;
    }
    Ok(())
}

/// A logarithm begins above nothing.
fn is_shown(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

fn colour(method: usize) -> RGBColor {
    COLOURS[method % COLOURS.len()]
}

/// Two digits are enough on an axis.
fn figure(value: f64) -> String {
    let digits = if value.abs() < 1.0 { 2 } else { 1 };
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_two_panels_and_every_step_a_dot_of_each_method_in_both() {
        let point = |scene: &str, method: &str, us_per_node: f64| ContactPoint {
            scene: scene.into(),
            method: method.into(),
            speed: 0.3,
            us_per_node,
            motion_kept: 0.7,
        };
        let svg = contact_svg(&[
            point("drop", "search", 1.0),
            point("drop", "bounds", 3.0),
            point("ring", "search", 2.0),
        ]);
        let svg = svg.unwrap();
        let count = |text: &str| svg.matches(&format!("\n{text}\n")).count();
        assert_eq!([count("drop"), count("ring"), count("search"), count("bounds")], [2, 2, 1, 1]);
        // Two in the legend.
        assert_eq!(svg.matches("<circle").count(), 2 + 2 * 3);
    }

    #[test]
    fn figures_on_axes_are_short() {
        assert_eq!([0.02, 0.1, 1.0, 20.0].map(figure), ["0.02", "0.1", "1", "20"]);
    }
}
