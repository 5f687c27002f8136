//! What frames cost, live: faces and seconds over the timeline, as in the papers' figures of speed, with
//! the stages stacked and, when asked for, what the same shot costs whoever looks.

use egui::{Color32, Label, Ui, Vec2};
use egui_plot::{Bar, BarChart, Legend, Line, Plot, PlotPoints, VLine};

use super::Context;
use crate::app::theme;
use crate::preview::{Action, Cost, Timeline};
use crate::sim::StageSeconds;

/// See the module.
#[derive(Default)]
pub struct CostsPanel {
    shows: Quantity,
}

#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Quantity {
    #[default]
    Faces,
    Seconds,
    Cumulative,
    Stages,
}

const QUANTITIES: [(Quantity, &str); 4] = [
    (Quantity::Faces, "faces"),
    (Quantity::Seconds, "seconds a frame"),
    (Quantity::Cumulative, "seconds in all"),
    (Quantity::Stages, "stages"),
];

/// (points).
const PLOT_MIN: Vec2 = Vec2::new(64.0, 24.0);

const OURS: Color32 = Color32::from_rgb(96, 186, 150);
const ADAPTIVE: Color32 = Color32::from_rgb(236, 130, 96);

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

impl CostsPanel {
    pub fn show(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let previewer = context.previewer;
        ui.horizontal(|ui| {
            for (quantity, name) in QUANTITIES {
                ui.selectable_value(&mut self.shows, quantity, name);
            }
            ui.separator();
            if previewer.plan().is_some() {
                adaptive(ui, context, actions);
            }
            summary(ui, context);
        });
        let timeline = previewer.timeline();
        let (ours, theirs) = (costs(timeline), previewer.rival_costs());
        let current = f64::from(previewer.state().playback.current);
        let plot = Plot::new("costs")
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .include_y(0.0)
            .include_x(0.0)
            .include_x(f64::from(timeline.last()))
            .min_size(PLOT_MIN)
            .show_x(false)
            .y_axis_min_width(44.0)
            .y_grid_spacer(egui_plot::uniform_grid_spacer(|input| {
                let span = (input.bounds.1 - input.bounds.0).abs().max(1e-9);
                let step = round_step(span);
                [step, step, step]
            }))
            .legend(Legend::default().background_alpha(0.5));
        let shows = self.shows;
        let response = plot.show(ui, |plot| {
            plot.vline(VLine::new("", current).color(theme::ACCENT));
            match shows {
                Quantity::Stages => stages(&ours).into_iter().for_each(|bars| plot.bar_chart(bars)),
                _ => {
                    plot.line(line("this run", OURS, shows, &ours));
                    if theirs.iter().any(Option::is_some) {
                        plot.line(line("adaptive, whoever looks", ADAPTIVE, shows, theirs));
                    }
                }
            }
            let clicked = plot.response().clicked() || plot.response().dragged();
            plot.pointer_coordinate().filter(|_| clicked)
        });
        if let Some(at) = response.inner {
            let frame = at.x.round().clamp(0.0, f64::from(timeline.last())) as u32;
            actions.push(Action::GoTo { frame });
        }
    }
}

fn adaptive(ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
    let (on, is_running) = context.previewer.rival();
    let name = if is_running { "measuring adaptive ..." } else { "compare with adaptive" };
    let hint = "simulates the shot in the background as finely as cloth and motion ask for, whoever \
                looks; it takes time from the simulation while it runs";
    if ui.selectable_label(on, name).on_hover_text(hint).clicked() {
        actions.push(Action::MeasureAdaptive { on: !on });
    }
}

/// Of the frames that both have: how much faster, how many fewer faces.
fn summary(ui: &mut Ui, context: &Context<'_>) {
    let previewer = context.previewer;
    let ours = costs(previewer.timeline());
    let known: Vec<Cost> = ours.iter().flatten().copied().collect();
    if known.is_empty() {
        return;
    }
    let seconds: f64 = known.iter().map(|cost| cost.wall).sum();
    let faces = known.iter().map(|cost| cost.faces as f64).sum::<f64>() / known.len() as f64;
    let mut words = format!(
        "{} frames, {faces:.0} faces, {:.3} s a frame",
        known.len(),
        seconds / known.len() as f64
    );
    let both: Vec<(Cost, Cost)> =
        ours.iter().zip(previewer.rival_costs()).filter_map(|(a, b)| (*a).zip(*b)).collect();
    let ours_in_all: f64 = both.iter().map(|(a, _)| a.wall).sum();
    if ours_in_all > 0.0 {
        let theirs: f64 = both.iter().map(|(_, b)| b.wall).sum();
        let faces: f64 = both.iter().map(|(a, _)| a.faces as f64).sum();
        let their_faces: f64 = both.iter().map(|(_, b)| b.faces as f64).sum();
        words += &format!(
            "   {:.1} x the speed of adaptive, {:.0} % of its faces over {} frames",
            theirs / ours_in_all,
            100.0 * faces / their_faces.max(1.0),
            both.len()
        );
    }
    ui.add(Label::new(words).truncate()).on_hover_ui(|ui| {
        let pace = context.pace.report();
        ui.label(format!(
            "wall seconds. Interface: {:.1} ms of its own a redraw, {:.0} ms from input to picture \
             (medians of {} redraws)",
            pace.work_ms_median, pace.input_to_redraw_ms_median, pace.redraws
        ));
    });
}

/// Between lines of a scale over a span: 1, 2 or 5 times a power of ten, so that there are three at most
/// and their numbers have room in a low panel.
fn round_step(span: f64) -> f64 {
    let least = span / 3.0;
    let decade = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|factor| factor * decade);
    steps.into_iter().find(|&step| step >= least).unwrap_or(10.0 * decade)
}

fn costs(timeline: &Timeline) -> Vec<Option<Cost>> {
    (0..timeline.len() as u32).map(|frame| timeline.slot(frame)?.cost).collect()
}

fn line(
    name: &'static str,
    colour: Color32,
    quantity: Quantity,
    costs: &[Option<Cost>],
) -> Line<'static> {
    let mut sum = 0.0;
    let points: PlotPoints<'static> = costs
        .iter()
        .enumerate()
        .filter_map(|(frame, cost)| {
            let cost = (*cost)?;
            sum += cost.wall;
            let value = match quantity {
                Quantity::Faces => cost.faces as f64,
                Quantity::Seconds | Quantity::Stages => cost.wall,
                Quantity::Cumulative => sum,
            };
            Some([frame as f64, value])
        })
        .collect();
    Line::new(name, points).color(colour).width(1.6)
}

/// Seconds of each stage upon those before it.
fn stages(costs: &[Option<Cost>]) -> Vec<BarChart> {
    let names = StageSeconds::default().entries().map(|(name, _)| name);
    names
        .into_iter()
        .enumerate()
        .map(|(stage, name)| {
            let bars = costs.iter().enumerate().filter_map(|(frame, cost)| {
                let entries = cost.as_ref()?.stages.entries();
                let below: f64 = entries[..stage].iter().map(|(_, seconds)| seconds).sum();
                let bar = Bar::new(frame as f64, entries[stage].1).base_offset(below).width(0.9);
                Some(bar.fill(STAGE_COLOURS[stage]).stroke(egui::Stroke::NONE))
            });
            BarChart::new(name, bars.collect()).color(STAGE_COLOURS[stage])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_has_one_to_three_round_steps() {
        for (span, step) in [(3.0, 1.0), (3.1, 2.0), (4300.0, 2000.0), (0.07, 0.05), (29.0, 10.0)] {
            assert!((round_step(span) / step - 1.0).abs() < 1e-9, "{span}: {}", round_step(span));
        }
        for k in 1..2000 {
            let span = 1e-3 * 1.01f64.powi(k);
            let lines = span / round_step(span);
            assert!((1.2..=3.0 + 1e-9).contains(&lines), "{span}: {lines}");
        }
    }
}
