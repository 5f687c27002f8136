//! The settings that can be tuned, with unit, range, default, reset and the format's own sentence.

use std::sync::Arc;

use egui::{CollapsingHeader, DragValue, Id, Label, RichText, Slider, Ui};
use serde_json::{Value, json};

use super::Context;
use crate::app::theme;
use crate::preview::{
    Action, Off, Parameter, ParameterKind, Plan, Previewer, Scale, parameters, value,
};

/// Indentation, and a slider's number with its unit (points).
const BESIDE_SLIDERS: f32 = 125.0;
/// (points).
const RESET_WIDTH: f32 = 48.0;
/// (points).
const SLIDER_MIN: f32 = 40.0;

/// See the module.
#[derive(Default)]
pub struct ParametersPanel {
    /// Of the plan they were listed for.
    listed: Option<(Arc<Plan>, Vec<Parameter>)>,
    /// The value being dragged, which holds when it is let go.
    dragged: Option<(String, Value)>,
}

impl ParametersPanel {
    pub fn show(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let Some(plan) = context.previewer.plan() else {
            if context.previewer.scenery().is_some() {
                let words = "Settings of a finished run cannot be changed: open its shot.";
                ui.label(RichText::new(words).color(theme::FAINT));
            }
            return;
        };
        self.list(plan);
        let Some((_, listed)) = &self.listed else { return };
        let has_edits = context.previewer.has_unsaved_edits();
        ui.horizontal(|ui| {
            ui.strong("Settings");
            let reset = ui.add_enabled(has_edits, egui::Button::new("Reset all").small());
            if reset.on_hover_text("back to what the file says, camera and all").clicked() {
                actions.push(Action::ResetAll);
            }
        });
        let sliders = ui.available_width() - BESIDE_SLIDERS;
        ui.spacing_mut().slider_width = sliders.clamp(SLIDER_MIN, ui.spacing().slider_width);
        let mut rest = listed.as_slice();
        while let Some(first) = rest.first() {
            let count = rest.iter().take_while(|p| p.group == first.group).count();
            let (group, others) = rest.split_at(count);
            let is_edited = group.iter().any(|p| context.previewer.is_unsaved(&p.path));
            let mut title = RichText::new(&first.group);
            if is_edited {
                title = title.color(theme::ACCENT);
            }
            CollapsingHeader::new(title)
                .id_salt(&first.group)
                .default_open(first.group == "View")
                .show(ui, |ui| {
                    for parameter in group {
                        row(ui, parameter, context.previewer, plan, &mut self.dragged, actions);
                    }
                });
            rest = others;
        }
    }

    fn list(&mut self, plan: &Arc<Plan>) {
        if self.listed.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, plan)) {
            return;
        }
        let listed = parameters(&plan.requested.written, &plan.requested.scene);
        self.listed = Some((plan.clone(), listed));
    }
}

fn row(
    ui: &mut Ui,
    parameter: &Parameter,
    previewer: &Previewer,
    plan: &Plan,
    dragged: &mut Option<(String, Value)>,
    actions: &mut Vec<Action>,
) {
    let edits = &previewer.state().version.edits;
    let Some(in_force) = value(&plan.requested.written, edits, &parameter.path) else { return };
    let held = dragged.as_ref().filter(|(path, _)| *path == parameter.path);
    let mut now = held.map_or_else(|| in_force.clone(), |(_, value)| value.clone());
    let is_edited = previewer.is_unsaved(&parameter.path);
    let label = ui.horizontal(|ui| {
        let mut label = RichText::new(parameter.label);
        if is_edited {
            label = label.color(theme::ACCENT);
        }
        // On one line with its button, so that nothing below moves when there is one.
        let room = ui.available_width() - if is_edited { RESET_WIDTH } else { 0.0 };
        let label = ui
            .scope(|ui| {
                ui.set_max_width(room.max(SLIDER_MIN));
                ui.add(Label::new(label).truncate())
            })
            .inner
            .on_hover_text(hint(parameter));
        if is_edited
            && ui.small_button("reset").on_hover_text("back to what the file says").clicked()
        {
            actions.push(Action::Reset { path: parameter.path.clone() });
        }
        label.id
    });
    let change =
        ui.push_id(&parameter.path, |ui| control(ui, parameter, label.inner, &mut now)).inner;
    match change {
        Change::None => {}
        Change::Going => *dragged = Some((parameter.path.clone(), now)),
        Change::Done => {
            *dragged = None;
            if now != in_force {
                actions.push(Action::Set { path: parameter.path.clone(), value: now });
            }
        }
    }
}

/// The format's sentence, the range, the default and the path.
fn hint(parameter: &Parameter) -> String {
    let range = match parameter.kind {
        ParameterKind::Number { min, max, .. } | ParameterKind::Vector3 { min, max, .. } => {
            format!("{min} to {max}")
        }
        ParameterKind::Integer { min, max } => format!("{min} to {max}"),
    };
    let unit =
        if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
    let default = parameter.default.as_ref().map_or(String::new(), |value| {
        format!(
            "\ndefault {}{unit}",
            if value.is_null() { "off".to_owned() } else { value.to_string() }
        )
    });
    let is_of_garment =
        parameter.path.starts_with("garments.") && parameter.path.contains(".view.");
    let default = if is_of_garment { "\ndefault: as under View".to_owned() } else { default };
    format!("{}\n\nusual range {range}{unit}{default}\n{}", parameter.help, parameter.path)
}

/// How far a control is in being changed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Change {
    None,
    /// The pointer still holds it.
    Going,
    Done,
}

/// `label` is what names it.
fn control(ui: &mut Ui, parameter: &Parameter, label: Id, now: &mut Value) -> Change {
    match parameter.kind {
        ParameterKind::Number { min, max, scale, decimals, off } => {
            let mut change = Change::None;
            ui.horizontal(|ui| {
                if off == Off::Null {
                    let mut on = !now.is_null();
                    if ui
                        .checkbox(&mut on, "")
                        .on_hover_text("off: the criterion asks for nothing")
                        .labelled_by(label)
                        .changed()
                    {
                        let usual = parameter.default.clone().filter(|d| !d.is_null());
                        *now = if on { usual.unwrap_or(json!(max)) } else { Value::Null };
                        change = Change::Done;
                    }
                    if now.is_null() {
                        ui.label(RichText::new("off").color(theme::FAINT));
                        return;
                    }
                }
                let Some(mut number) = now.as_f64() else { return };
                let slider = Slider::new(&mut number, min..=max)
                    .logarithmic(scale == Scale::Logarithmic)
                    .clamping(egui::SliderClamping::Never)
                    .max_decimals(decimals)
                    .update_while_editing(false)
                    .suffix(suffix(parameter.unit));
                let response = ui.add(slider).labelled_by(label);
                if response.changed() {
                    *now = json!(rounded(number, decimals));
                }
                // The criterion may just have been switched on.
                if change == Change::None {
                    change = change_of(&response);
                }
            });
            change
        }
        ParameterKind::Integer { min, max } => {
            let Some(mut number) = now.as_i64() else { return Change::None };
            let slider = Slider::new(&mut number, min..=max)
                .update_while_editing(false)
                .suffix(suffix(parameter.unit));
            let response = ui.add(slider).labelled_by(label);
            if response.changed() {
                *now = json!(number);
            }
            change_of(&response)
        }
        ParameterKind::Vector3 { min, max, decimals } => {
            vector(ui, parameter, label, now, [min, max], decimals)
        }
    }
}

fn vector(
    ui: &mut Ui,
    parameter: &Parameter,
    label: Id,
    now: &mut Value,
    [min, max]: [f64; 2],
    decimals: usize,
) -> Change {
    let numbers = now.as_array().map(|n| n.iter().filter_map(Value::as_f64).collect::<Vec<_>>());
    let Some(mut numbers) = numbers.filter(|n| n.len() == 3) else { return Change::None };
    let mut change = Change::None;
    ui.horizontal_wrapped(|ui| {
        for (axis, number) in ["x ", "y ", "z "].into_iter().zip(&mut numbers) {
            let field = DragValue::new(number)
                .speed((max - min) * 0.005)
                .prefix(axis)
                .update_while_editing(false)
                .suffix(suffix(parameter.unit))
                .max_decimals(decimals);
            let response = ui.add(field).labelled_by(label);
            let this = change_of(&response);
            if this != Change::None {
                change = this;
            }
        }
    });
    if change != Change::None {
        *now = json!(numbers.iter().map(|&n| rounded(n, decimals)).collect::<Vec<_>>());
    }
    change
}

fn suffix(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// A change that is typed, or stepped by a key, is done at once.
fn change_of(response: &egui::Response) -> Change {
    if response.drag_stopped() {
        Change::Done
    } else if response.changed() {
        if response.dragged() { Change::Going } else { Change::Done }
    } else {
        Change::None
    }
}

/// What the control shows is what is set: no digits that nobody sees.
fn rounded(number: f64, decimals: usize) -> f64 {
    format!("{number:.decimals$}").parse().unwrap_or(number)
}
