//! The shot camera's keys and lens.

use std::sync::Arc;

use egui::{CollapsingHeader, DragValue, RichText, Ui};

use super::Context;
use crate::app::theme;
use crate::preview::{Action, CameraEdit, CameraEditError, LensValue, Plan};

/// A baked camera that is made one with keys gets one every so many frames.
const KEYS_EVERY: u32 = 10;

/// See the module.
#[derive(Default)]
pub struct CameraPanel {
    /// The lens being dragged, and the frame it was taken at; it holds when it is let go.
    dragged_lens: Option<(f64, f64)>,
    /// As chosen last; until then it follows the path.
    lens_for: Option<LensFor>,
    /// The camera of the plan that it was read from.
    read: Option<(Arc<Plan>, Result<CameraEdit, CameraEditError>)>,
}

/// What a changed lens holds for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LensFor {
    ThisFrame,
    WholePath,
}

impl CameraPanel {
    pub fn show(&mut self, ui: &mut Ui, context: &Context<'_>, actions: &mut Vec<Action>) {
        let Some(plan) = context.previewer.plan() else { return };
        CollapsingHeader::new("Camera").default_open(true).show(ui, |ui| match self.camera(plan) {
            Ok(camera) => self.keyed(ui, context, plan, &camera, actions),
            Err(CameraEditError::Baked) => {
                ui.label("The camera has a matrix a frame and no keys.");
                let hint = format!("a key every {KEYS_EVERY} frames, and at cuts");
                if ui.button("Turn it into keys").on_hover_text(hint).clicked() {
                    actions.push(Action::MakeKeys { every: KEYS_EVERY });
                }
            }
            Err(error) => {
                ui.label(RichText::new(error.to_string()).color(theme::FAINT));
            }
        });
    }

    fn camera(&mut self, plan: &Arc<Plan>) -> Result<CameraEdit, CameraEditError> {
        if let Some((_, camera)) = self.read.as_ref().filter(|(of, _)| Arc::ptr_eq(of, plan)) {
            return camera.clone();
        }
        let camera = CameraEdit::of_shot(plan.resolved(), &plan.requested.scene);
        self.read = Some((plan.clone(), camera.clone()));
        camera
    }

    fn keyed(
        &mut self,
        ui: &mut Ui,
        context: &Context<'_>,
        plan: &Plan,
        camera: &CameraEdit,
        actions: &mut Vec<Action>,
    ) {
        let state = context.previewer.state();
        let current = f64::from(state.playback.current);
        let key = camera.keys().iter().find(|key| key.frame == current);
        let mut unlocked = state.camera_unlocked;
        let hint = "drags in the shot's view, or of the camera's eye in the witness's, move the shot \
                    camera and set a key (C)";
        if ui.checkbox(&mut unlocked, "unlocked").on_hover_text(hint).changed() {
            actions.push(Action::UnlockCamera { on: unlocked });
        }
        ui.horizontal_wrapped(|ui| {
            let hint = "a key where the camera is now (K)";
            let name = if key.is_some() { "Set key" } else { "Add key" };
            if ui.button(name).on_hover_text(hint).clicked() {
                actions.push(Action::SetKey);
            }
            let delete = ui.add_enabled(key.is_some(), egui::Button::new("Delete key"));
            if delete.on_hover_text("the key at this frame (Delete)").clicked() {
                actions.push(Action::DeleteKey { frame: current });
            }
            if let Some(key) = key {
                let mut cut = key.cut;
                let hint = "the camera jumps to this key instead of moving there";
                if ui.checkbox(&mut cut, "cut").on_hover_text(hint).changed() {
                    actions.push(Action::SetCut { frame: current, cut });
                }
            }
        });
        self.lens(ui, plan, camera, current, actions);
        let shown = |frame: f64| frame + plan.requested.scene.first_frame as f64;
        let keys: Vec<String> = camera
            .keys()
            .iter()
            .map(|key| format!("{}{}", shown(key.frame), if key.cut { " cut" } else { "" }))
            .collect();
        ui.label(RichText::new(format!("keys: {}", keys.join(", "))).small().color(theme::FAINT));
    }

    /// The lens at the current frame, and what it is to change for.
    fn lens(
        &mut self,
        ui: &mut Ui,
        plan: &Plan,
        camera: &CameraEdit,
        current: f64,
        actions: &mut Vec<Action>,
    ) {
        let between_keys = || plan.camera().map(|path| LensValue::of(path.lens(current)));
        let Some(lens) = camera.lens(current).ok().or_else(between_keys) else { return };
        let (name, value, range, suffix) = match lens {
            LensValue::FovYDeg(degrees) => ("field of view", degrees, 1.0..=150.0, " deg"),
            LensValue::FocalMm(focal) => ("focal length", focal, 4.0..=400.0, " mm"),
        };
        let mut lens_for = self.lens_for.unwrap_or(match camera.zooms() {
            true => LensFor::ThisFrame,
            false => LensFor::WholePath,
        });
        let mut now = self.dragged_lens.map_or(value, |(_, lens)| lens);
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(name);
            let field = DragValue::new(&mut now)
                .range(range)
                // One that is beyond it stays until somebody changes it.
                .clamp_existing_to_range(false)
                .speed(0.1)
                .suffix(suffix)
                .max_decimals(1)
                .update_while_editing(false);
            let response = ui.add(field).labelled_by(label.id);
            if response.dragged() && !response.drag_stopped() {
                let since = self.dragged_lens.map_or(current, |(frame, _)| frame);
                self.dragged_lens = Some((since, now));
            } else if response.drag_stopped() || response.changed() {
                // Playing may have gone on since.
                let since = self.dragged_lens.take().map_or(current, |(frame, _)| frame);
                let frame = (lens_for == LensFor::ThisFrame).then_some(since);
                actions.push(match lens {
                    LensValue::FovYDeg(_) => Action::SetFieldOfView { frame, degrees: now },
                    LensValue::FocalMm(_) => Action::SetFocalLength { frame, focal_mm: now },
                });
            }
        });
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("changed").color(theme::FAINT));
            for (choice, name, hint) in [
                (LensFor::ThisFrame, "at this frame", "a changed lens sets a key here"),
                (
                    LensFor::WholePath,
                    "whole path",
                    "a changed lens is that of all keys, also of those with one of their own",
                ),
            ] {
                let chosen = ui.selectable_value(&mut lens_for, choice, name).on_hover_text(hint);
                if chosen.clicked() {
                    self.lens_for = Some(choice);
                }
            }
        });
    }
}
