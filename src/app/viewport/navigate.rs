//! Moving cameras with the pointer.

use egui::{Key, PointerButton, Response, Ui};
use glam::{DVec2, DVec3};

use super::{Eye, Picture, Viewports, draw, shot_view};
use crate::preview::{Action, EyeAndTarget};
use crate::shot::View;

/// A drag over the whole height of a view turns by this much (rad).
const TURN: f64 = 3.0;
/// Zoom per point of scrolling.
const ZOOM: f64 = 0.004;
/// How near to its eye the camera is grabbed in the witness's view (points).
const GRAB_RADIUS: f32 = 22.0;

impl Viewports {
    /// Moves the camera that a picture shows, by what the pointer does in it.
    pub(super) fn navigate(
        &mut self,
        ui: &Ui,
        response: &Response,
        picture: Picture<'_>,
        actions: &mut Vec<Action>,
    ) {
        match picture.eye {
            Eye::Witness => self.navigate_witness(ui, response, picture, actions),
            Eye::Shot => self.navigate_shot(ui, response, picture, actions),
        }
    }

    fn navigate_witness(
        &mut self,
        ui: &Ui,
        response: &Response,
        picture: Picture<'_>,
        actions: &mut Vec<Action>,
    ) {
        let scale = ui.pixels_per_point();
        let Some(place) = self.witness_place(picture.previewer) else { return };
        let view = draw::witness(place, super::pixels(picture.rect, scale));
        if self.grab_camera(ui, response, picture, &view, actions) {
            return;
        }
        if let Some(EyeAndTarget { eye, target }) = moved(ui, response, place, &view, scale) {
            actions.push(Action::SetWitness { eye, target });
        }
    }

    /// The shot camera moves only if it is unlocked; where it is let go it gets a key.
    fn navigate_shot(
        &mut self,
        ui: &Ui,
        response: &Response,
        picture: Picture<'_>,
        actions: &mut Vec<Action>,
    ) {
        let Picture { rect, previewer, scenery, .. } = picture;
        let Some(view) = shot_view(previewer, scenery) else { return };
        if !previewer.state().camera_unlocked {
            self.moves_shot = false;
            return;
        }
        let scale = ui.pixels_per_point();
        let view = View { resolution: super::pixels(rect, scale), ..view };
        let place = draw::place_of(&view, previewer);
        if let Some(EyeAndTarget { eye, target }) = moved(ui, response, place, &view, scale) {
            self.moves_shot = true;
            actions.push(Action::MoveCamera { eye, target });
        } else if self.moves_shot && !response.is_pointer_button_down_on() && !is_scrolling(ui) {
            self.moves_shot = false;
            actions.push(Action::SetKey);
        }
    }

    /// The shot camera's eye can be dragged in the witness's view, in the plane that faces the
    /// witness; true while it is.
    fn grab_camera(
        &mut self,
        ui: &Ui,
        response: &Response,
        picture: Picture<'_>,
        witness: &View,
        actions: &mut Vec<Action>,
    ) -> bool {
        let Picture { rect, previewer, scenery, .. } = picture;
        if !previewer.state().camera_unlocked {
            self.grabbed = false;
            return false;
        }
        let Some(shot) = shot_view(previewer, scenery) else { return false };
        let place = draw::place_of(&shot, previewer);
        let [width, _] = witness.resolution;
        let points = f64::from(rect.width()) / f64::from(width.max(1));
        let on_screen = witness
            .point_in_image(place.eye)
            .map(|p| rect.min + egui::vec2((p.x * points) as f32, (p.y * points) as f32));
        if response.drag_started_by(PointerButton::Primary) {
            // Where it was pressed: a quick drag has left that place when it is known to be one.
            let pressed = ui.input(|input| input.pointer.press_origin());
            let near = pressed.zip(on_screen);
            self.grabbed = near.is_some_and(|(at, eye)| at.distance(eye) < GRAB_RADIUS);
        }
        if !self.grabbed {
            return false;
        }
        if response.dragged() {
            let drag = response.drag_delta();
            let drag = DVec2::new(f64::from(drag.x), f64::from(drag.y)) / points;
            // The eye follows the pointer at its own depth; what it looks at stays.
            let at_eye = EyeAndTarget { eye: witness.eye, target: place.eye };
            let shift = at_eye.panned(witness, -drag);
            let eye = place.eye + (shift.target - at_eye.target);
            actions.push(Action::MoveCamera { eye, target: place.target });
        }
        if response.drag_stopped() {
            self.grabbed = false;
            actions.push(Action::SetKey);
        }
        true
    }
}

fn is_scrolling(ui: &Ui) -> bool {
    ui.input(|input| input.smooth_scroll_delta().y != 0.0)
}

/// Where a drag or the wheel takes a camera; `None` if neither is moved.
fn moved(
    ui: &Ui,
    response: &Response,
    place: EyeAndTarget,
    view: &View,
    scale: f32,
) -> Option<EyeAndTarget> {
    let drag = response.drag_delta();
    let drag = DVec2::new(f64::from(drag.x), f64::from(drag.y));
    let height = f64::from(view.resolution[1].max(1)) / f64::from(scale);
    let turn = drag * (TURN / height);
    let modifiers = ui.input(|input| input.modifiers);
    let mut now = place;
    if drag != DVec2::ZERO {
        if response.dragged_by(PointerButton::Secondary) {
            now = now.looked(-turn.x, -turn.y);
        } else if response.dragged_by(PointerButton::Primary) && !modifiers.shift {
            now = now.orbited(-turn.x, turn.y);
        } else if response.dragged() {
            now = now.panned(view, drag * f64::from(scale));
        }
    }
    if response.is_pointer_button_down_on() && ui.input(|input| input.pointer.secondary_down()) {
        now = flown(ui, now);
    }
    if response.hovered() {
        let scroll = ui.input(|input| f64::from(input.smooth_scroll_delta().y));
        // A way of nothing would not be nothing by rounding.
        if scroll != 0.0 {
            now = now.dollied(scroll * ZOOM);
        }
    }
    (now != place).then_some(now)
}

/// Through the scene with the keys W, A, S, D, Q and E, four times as fast with Shift.
fn flown(ui: &Ui, place: EyeAndTarget) -> EyeAndTarget {
    /// (m/s).
    const SPEED: f64 = 1.0;
    let (along, seconds, fast) = ui.input(|input| {
        let axis = |plus, minus| {
            f64::from(u8::from(input.key_down(plus))) - f64::from(u8::from(input.key_down(minus)))
        };
        let along = DVec3::new(axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S));
        (along, f64::from(input.stable_dt), input.modifiers.shift)
    });
    if along == DVec3::ZERO {
        return place;
    }
    // As long as a key is down there is no other event to redraw for.
    ui.ctx().request_repaint();
    // A redraw that was late must not make a leap.
    let step = SPEED * seconds.min(0.1) * if fast { 4.0 } else { 1.0 };
    place.flown(along * step)
}
