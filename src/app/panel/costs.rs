//! What frames cost, live: faces and seconds over the timeline, as in the papers' figures of speed, with
//! the stages stacked and, when asked for, what the same shot costs whoever looks.

mod curves;

use egui::{Color32, Grid, Label, RichText, ScrollArea, Sense, Ui, Vec2, vec2};
use egui_plot::{Plot, PlotUi, VLine};

use super::Context;
use crate::app::theme;
use crate::preview::{Action, Cost, FrameStatus, Previewer, Scenery, Timeline};
use curves::{Quantity, lines, round_step, stage_names, stages};

/// See the module.
#[derive(Default)]
pub struct CostsPanel {
    shows: Quantity,
}

const QUANTITIES: [(Quantity, &str); 4] = [
    (Quantity::Faces, "faces"),
    (Quantity::Seconds, "seconds a frame"),
    (Quantity::Cumulative, "seconds in all"),
    (Quantity::Stages, "stages"),
];

/// (points).
const PLOT_MIN: Vec2 = vec2(64.0, 24.0);
/// Of the names beside the plot, for stages in two columns (points).
const LEGEND_WIDTH: f32 = 190.0;

/// A line of the scale with its number takes so much (points), and there are no more than so many.
const LINE_HEIGHT: f32 = 32.0;
const LINES_MAX: f32 = 3.0;

/// Of a colour in the legend (points).
const SWATCH: Vec2 = vec2(9.0, 9.0);

const OURS: Color32 = Color32::from_rgb(96, 186, 150);
const ADAPTIVE: Color32 = Color32::from_rgb(236, 130, 96);

/// What frames cost, by number, apart by the settings that made them.
struct Costs {
    /// Those in force.
    ours: Vec<Option<Cost>>,
    /// Others, which no speed-up counts.
    stale: Vec<Option<Cost>>,
}

impl Costs {
    fn of(timeline: &Timeline) -> Self {
        let all = 0..timeline.len() as u32;
        let is_stale = |frame| timeline.status(frame) == FrameStatus::Stale;
        let cost = |frame| timeline.slot(frame).and_then(|slot| slot.cost);
        Self {
            ours: all.clone().map(|f| cost(f).filter(|_| !is_stale(f))).collect(),
            stale: all.map(|f| cost(f).filter(|_| is_stale(f))).collect(),
        }
    }
}

impl CostsPanel {
    pub fn show(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let previewer = context.previewer;
        let Some(scenery) = previewer.scenery() else { return };
        let costs = Costs::of(previewer.timeline());
        ui.horizontal(|ui| {
            for (quantity, name) in QUANTITIES {
                ui.selectable_value(&mut self.shows, quantity, name);
            }
            ui.separator();
            if previewer.plan().is_some() {
                adaptive(ui, context, actions);
            }
            summary(ui, context, &costs);
        });
        let room = ui.available_size();
        let legend = LEGEND_WIDTH.min(0.4 * room.x);
        ui.horizontal_top(|ui| {
            let size = vec2(room.x - legend - ui.spacing().item_spacing.x, room.y);
            if let Some(frame) = self.plot(ui, size, previewer, scenery, &costs) {
                actions.push(Action::GoTo { frame });
            }
            ScrollArea::vertical().show(ui, |ui| self.legend(ui, previewer, &costs));
        });
    }

    /// Returns the frame that was clicked.
    fn plot(
        &self,
        ui: &mut Ui,
        size: Vec2,
        previewer: &Previewer,
        scenery: &Scenery,
        costs: &Costs,
    ) -> Option<u32> {
        let last = f64::from(previewer.timeline().last());
        let current = f64::from(previewer.state().playback.current);
        let lines = (size.y / LINE_HEIGHT).clamp(1.0, LINES_MAX);
        let is_empty = costs.ours.iter().chain(&costs.stale).all(Option::is_none);
        let unit = if self.shows == Quantity::Faces { "" } else { " s" };
        let first_frame = scenery.shown(0) as f64;
        let plot = Plot::new("costs")
            .allow_drag(false)
            .allow_zoom(false)
            .allow_scroll(false)
            .allow_boxed_zoom(false)
            .include_y(0.0)
            .include_y(if is_empty { 1.0 } else { 0.0 })
            .include_x(0.0)
            .include_x(last)
            .width(size.x)
            .height(size.y)
            .min_size(PLOT_MIN)
            .show_x(false)
            .y_axis_min_width(44.0)
            .x_axis_formatter(move |mark, _| format!("{}", mark.value + first_frame))
            .y_axis_formatter(move |mark, _| {
                format!("{:.*}{unit}", curves::decimals(mark.step_size), mark.value)
            })
            .y_grid_spacer(egui_plot::uniform_grid_spacer(|input| {
                let step =
                    round_step((input.bounds.1 - input.bounds.0).abs().max(1e-9), lines.into());
                [step, step, step]
            }));
        let response = plot.show(ui, |plot| {
            plot.vline(VLine::new("", current).color(theme::ACCENT));
            self.curves(plot, previewer, costs);
            let clicked = plot.response().clicked() || plot.response().dragged();
            plot.pointer_coordinate().filter(|_| clicked)
        });
        response.inner.map(|at| at.x.round().clamp(0.0, last) as u32)
    }

    fn curves(&self, plot: &mut PlotUi<'_>, previewer: &Previewer, costs: &Costs) {
        if self.shows == Quantity::Stages {
            for (costs, strength) in [(&costs.ours, 1.0), (&costs.stale, 0.4)] {
                stages(costs, strength).into_iter().for_each(|bars| plot.bar_chart(bars));
            }
            return;
        }
        let stale = (theme::status_colour(FrameStatus::Stale), costs.stale.as_slice());
        // A sum of what is out of date is that of nothing.
        let stale = (self.shows != Quantity::Cumulative).then_some(stale);
        let others = [(ADAPTIVE, previewer.rival_costs()), (OURS, costs.ours.as_slice())];
        for (colour, costs) in stale.into_iter().chain(others) {
            lines(costs, self.shows, colour).into_iter().for_each(|line| plot.line(line));
        }
    }

    /// Beside the plot, where it covers nothing.
    fn legend(&self, ui: &mut Ui, previewer: &Previewer, costs: &Costs) {
        let has = |costs: &[Option<Cost>]| costs.iter().any(Option::is_some);
        let names: Vec<(Color32, &str)> = match self.shows {
            Quantity::Stages => stage_names(),
            shows => {
                let stale = has(&costs.stale) && shows != Quantity::Cumulative;
                [
                    (true, OURS, "these settings"),
                    (has(previewer.rival_costs()), ADAPTIVE, "adaptive, whoever looks"),
                    (stale, theme::status_colour(FrameStatus::Stale), "other settings (stale)"),
                ]
                .into_iter()
                .filter_map(|(is_there, colour, name)| is_there.then_some((colour, name)))
                .collect()
            }
        };
        let columns = if names.len() > 4 { 2 } else { 1 };
        Grid::new("cost colours").num_columns(columns).spacing([8.0, 1.0]).show(ui, |ui| {
            for row in names.chunks(columns) {
                for &(colour, name) in row {
                    ui.horizontal(|ui| {
                        ui.spacing_mut().item_spacing.x = 4.0;
                        let (swatch, _) = ui.allocate_exact_size(SWATCH, Sense::hover());
                        ui.painter().rect_filled(swatch, 1.0, colour);
                        ui.label(RichText::new(name).small().color(theme::FAINT));
                    });
                }
                ui.end_row();
            }
        });
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
fn summary(ui: &mut Ui, context: &Context<'_>, costs: &Costs) {
    let known: Vec<Cost> = costs.ours.iter().flatten().copied().collect();
    let stale = costs.stale.iter().flatten().count();
    if known.is_empty() && stale == 0 {
        return;
    }
    let mut words = match known.len() {
        0 => "no frame of these settings yet".to_owned(),
        count => {
            let seconds: f64 = known.iter().map(|cost| cost.wall).sum();
            let faces = known.iter().map(|cost| cost.faces as f64).sum::<f64>();
            let [faces, seconds] = [faces, seconds].map(|sum| sum / count as f64);
            format!("{count} frames, {faces:.0} faces, {seconds:.3} s a frame")
        }
    };
    if stale > 0 {
        words += &format!(" ({stale} stale left out)");
    }
    words += &against_adaptive(&costs.ours, context.previewer.rival_costs()).unwrap_or_default();
    ui.add(Label::new(words).truncate()).on_hover_ui(|ui| {
        let pace = context.pace.report();
        ui.label(format!(
            "wall seconds. Interface: {:.1} ms of its own a redraw, {:.0} ms from input to picture \
             (medians of {} redraws)",
            pace.work_ms_median, pace.input_to_redraw_ms_median, pace.redraws
        ));
    });
}

fn against_adaptive(ours: &[Option<Cost>], theirs: &[Option<Cost>]) -> Option<String> {
    let both: Vec<(Cost, Cost)> =
        ours.iter().zip(theirs).filter_map(|(a, b)| (*a).zip(*b)).collect();
    let seconds: f64 = both.iter().map(|(a, _)| a.wall).sum();
    let faces: f64 = both.iter().map(|(a, _)| a.faces as f64).sum();
    let their_seconds: f64 = both.iter().map(|(_, b)| b.wall).sum();
    let their_faces: f64 = both.iter().map(|(_, b)| b.faces as f64).sum();
    (seconds > 0.0).then(|| {
        format!(
            "   {:.1} x the speed of adaptive, {:.0} % of its faces over {} frames",
            their_seconds / seconds,
            100.0 * faces / their_faces.max(1.0),
            both.len()
        )
    })
}
