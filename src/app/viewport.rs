//! The two views: laid out and navigated while panels are, drawn between that and the paint.

mod crossings;
mod draw;
mod navigate;
mod ranges;
mod wipe;

use std::sync::Arc;

use egui::{Color32, Rect, Sense, Stroke, StrokeKind, TextureId, Ui, pos2, vec2};

use super::theme;
use crate::preview::{Action, EyeAndTarget, Layout, Look, Previewer, Scenery, Wake};
use crate::render::{
    CameraTrail, ColourBy, DrawList, GateRect, SafeArea, TargetTexture, gate_aspect, gate_rect,
};
use crate::shot::{CameraPath, View};
use crate::sim::Frame;
use crossings::FoundCrossings;
use ranges::Ranges;

/// Who looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Eye {
    Shot,
    Witness,
}

/// Whose frames are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    /// What is in force.
    B,
    /// What it is compared with.
    A,
}

/// A picture in the window.
#[derive(Default)]
struct Pane {
    texture: Option<(TargetTexture, TextureId)>,
    /// Size that the layout gives it (px); `None` while it is not shown.
    wanted: Option<[u32; 2]>,
    drawn: Option<Drawn>,
}

/// Something that never changes, compared by which it is. Held, so that no other takes its place.
#[derive(Clone, Debug)]
struct Same<T>(Arc<T>);

impl<T> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// What a pane shows: while this stays the same, so does the picture.
#[derive(Clone, Debug, PartialEq)]
struct Drawn {
    frame: Same<Frame>,
    scenery: Same<Scenery>,
    view: View,
    shot: Option<View>,
    ghost: Option<View>,
    look: Look,
    colour: ColourBy,
    size: [u32; 2],
    /// Whether crossings that are to be shown have been found.
    marked: bool,
}

/// Where a view is shown, and of what.
#[derive(Clone, Copy)]
struct Picture<'a> {
    eye: Eye,
    rect: Rect,
    previewer: &'a Previewer,
    scenery: &'a Scenery,
}

/// See the module.
pub struct Viewports {
    /// Where they were laid out last (points).
    pub space: Rect,
    /// Shot and witness of B, then of A.
    panes: [Pane; 4],
    /// Of B's camera and of A's.
    trails: Vec<(Arc<CameraPath>, CameraTrail)>,
    /// Where the witness stands unless it is moved, found once for what is open.
    found_witness: Option<FoundWitness>,
    ranges: Ranges,
    lists: Vec<CachedList>,
    crossings: FoundCrossings,
    /// What is drawn where there is no frame: always the same, so that it is drawn once.
    no_frame: Arc<Frame>,
    /// A drag began on a camera that may be moved.
    grabbed: bool,
    /// The shot camera is being moved in its own view.
    moves_shot: bool,
}

/// What is found once for a shot, from the first of its cloth.
struct FoundWitness {
    place: EyeAndTarget,
    /// Height of the ground (m).
    ground: f64,
}

/// What a frame has to be drawn, built once for all panes that show it.
struct CachedList {
    frame: Same<Frame>,
    scenery: Same<Scenery>,
    look: Look,
    colour: ColourBy,
    list: DrawList,
}

const SAFE_LINE: Color32 = Color32::from_rgba_premultiplied(40, 42, 48, 170);

impl Viewports {
    /// `wake` is called when something was found that takes its time.
    pub fn new(wake: Wake) -> Self {
        Self {
            space: Rect::ZERO,
            panes: Default::default(),
            trails: Vec::new(),
            found_witness: None,
            ranges: Ranges::default(),
            lists: Vec::new(),
            crossings: FoundCrossings::new(wake),
            no_frame: Arc::default(),
            grabbed: false,
            moves_shot: false,
        }
    }

    /// What is drawn is drawn anew, as after a lost device.
    pub fn forget_pictures(&mut self) {
        self.panes = Default::default();
    }

    /// Something else was opened.
    pub fn forget_place(&mut self) {
        self.found_witness = None;
        self.ranges = Ranges::default();
    }

    /// Lays the panes out over the rest of the space.
    pub fn show(&mut self, ui: &mut Ui, previewer: &Previewer, actions: &mut Vec<Action>) {
        let space = ui.available_rect_before_wrap();
        self.space = space;
        ui.painter().rect_filled(space, 0.0, theme::WELL);
        self.panes.iter_mut().for_each(|pane| pane.wanted = None);
        let Some(scenery) = previewer.scenery().cloned() else {
            let words = if previewer.is_opening() { "opening ..." } else { "nothing is open" };
            ui.painter().text(
                space.center(),
                egui::Align2::CENTER_CENTER,
                words,
                egui::FontId::proportional(16.0),
                theme::FAINT,
            );
            return;
        };
        match previewer.state().look.layout {
            Layout::Shot => self.show_eye(ui, Eye::Shot, space, previewer, &scenery, actions),
            Layout::Witness => {
                self.show_eye(ui, Eye::Witness, space, previewer, &scenery, actions);
            }
            Layout::Both => {
                let gap = 2.0;
                let left =
                    Rect::from_min_max(space.min, pos2(space.center().x - 0.5 * gap, space.max.y));
                let right =
                    Rect::from_min_max(pos2(space.center().x + 0.5 * gap, space.min.y), space.max);
                self.show_eye(ui, Eye::Shot, left, previewer, &scenery, actions);
                self.show_eye(ui, Eye::Witness, right, previewer, &scenery, actions);
            }
        }
    }

    fn show_eye(
        &mut self,
        ui: &mut Ui,
        eye: Eye,
        space: Rect,
        previewer: &Previewer,
        scenery: &Scenery,
        actions: &mut Vec<Action>,
    ) {
        let Some(rect) = picture_rect(ui, eye, space, previewer, scenery) else {
            let words = "the shot has no camera: open one with --camera, or name it in the shot";
            let font = egui::FontId::proportional(13.0);
            let at = space.center();
            ui.painter().text(at, egui::Align2::CENTER_CENTER, words, font, theme::FAINT);
            return;
        };
        let response = ui.interact(space, ui.scope_id().with(eye as u8), Sense::click_and_drag());
        let size = pixels(rect, ui.pixels_per_point());
        let wipe = previewer.state().wipe.filter(|_| previewer.state().a.is_some());
        self.image(ui, eye, Side::B, rect, size, 0.0);
        if let Some(share) = wipe {
            self.image(ui, eye, Side::A, rect, size, share as f32);
            wipe::show(ui, eye, rect, share, previewer, actions);
        }
        if eye == Eye::Shot {
            self.gate(ui, rect, &previewer.state().look);
        }
        caption(ui, eye, space, previewer, scenery);
        let picture = Picture { eye, rect, previewer, scenery };
        self.navigate(ui, &response, picture, actions);
    }

    /// Paints a pane's picture; of A only the part to the left of the wipe.
    fn image(&mut self, ui: &Ui, eye: Eye, side: Side, rect: Rect, size: [u32; 2], share: f32) {
        let pane = &mut self.panes[index(eye, side)];
        pane.wanted = Some(size);
        let (part, uv) = match side {
            Side::B => (rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0))),
            Side::A => (
                Rect::from_min_size(rect.min, vec2(rect.width() * share, rect.height())),
                Rect::from_min_max(pos2(0.0, 0.0), pos2(share, 1.0)),
            ),
        };
        match &pane.texture {
            // One that holds what was drawn last is not shown when there is nothing to be drawn.
            Some((_, id)) if pane.drawn.is_some() => {
                ui.painter().image(*id, part, uv, Color32::WHITE);
            }
            _ => drop(ui.painter().rect_filled(part, 0.0, theme::WELL)),
        }
    }

    /// The edge of the film gate, and what of it is safe.
    fn gate(&self, ui: &Ui, rect: Rect, look: &Look) {
        let painter = ui.painter();
        painter.rect_stroke(rect, 0.0, Stroke::new(1.0, theme::FAINT), StrokeKind::Outside);
        if look.safe_areas {
            let whole = GateRect {
                left: rect.left(),
                top: rect.top(),
                width: rect.width(),
                height: rect.height(),
            };
            for area in [SafeArea::Action, SafeArea::Title] {
                let safe = egui_rect(whole.safe_area(area));
                painter.rect_stroke(safe, 0.0, Stroke::new(1.0, SAFE_LINE), StrokeKind::Middle);
            }
        }
    }
}

fn index(eye: Eye, side: Side) -> usize {
    eye as usize + 2 * side as usize
}

fn egui_rect(rect: GateRect) -> Rect {
    Rect::from_min_size(pos2(rect.left, rect.top), vec2(rect.width, rect.height))
}

/// Where in its space a view's picture stands: the shot's in its own shape; `None` without a camera.
fn picture_rect(
    ui: &Ui,
    eye: Eye,
    space: Rect,
    previewer: &Previewer,
    scenery: &Scenery,
) -> Option<Rect> {
    match eye {
        Eye::Witness => Some(space),
        Eye::Shot => {
            let view = shot_view(previewer, scenery)?;
            let scale = ui.pixels_per_point();
            let room = space.shrink(6.0).size() * scale;
            let gate = egui_rect(gate_rect(gate_aspect(&view), [room.x, room.y]));
            let min = space.min + vec2(6.0, 6.0) + gate.min.to_vec2() / scale;
            Some(Rect::from_min_size(min, gate.size() / scale))
        }
    }
}

/// The shot camera at the current frame, as it is dragged if it is.
fn shot_view(previewer: &Previewer, scenery: &Scenery) -> Option<View> {
    let path = scenery.camera.as_ref()?;
    let view = path.view(f64::from(previewer.state().playback.current));
    Some(match previewer.state().dragged_camera {
        Some(place) => draw::placed(&view, place),
        None => view,
    })
}

fn pixels(rect: Rect, scale: f32) -> [u32; 2] {
    [rect.width(), rect.height()].map(|points| (points * scale).round().max(1.0) as u32)
}

/// The digits of a hash that tell settings apart.
pub fn short(hash: &str) -> &str {
    hash.get(..8).unwrap_or(hash)
}

/// Which view it is, and, in the shot's, which frame and how it stands.
fn caption(ui: &Ui, eye: Eye, space: Rect, previewer: &Previewer, scenery: &Scenery) {
    let state = previewer.state();
    let words = match eye {
        Eye::Witness => "witness".to_owned(),
        Eye::Shot => {
            let current = state.playback.current;
            let mut words = format!("{}   {}", scenery.name, scenery.shown(current));
            match previewer.shown() {
                Some(shown) if shown.number != current => {
                    words += &format!("   cloth of {}", scenery.shown(shown.number));
                }
                None => words += "   not simulated yet",
                Some(_) => {}
            }
            if state.camera_unlocked {
                words += "   camera unlocked";
            }
            words
        }
    };
    let font = egui::FontId::proportional(12.0);
    let at = space.left_bottom() + vec2(10.0, -8.0);
    let shadow = at + vec2(1.0, 1.0);
    ui.painter().text(shadow, egui::Align2::LEFT_BOTTOM, &words, font.clone(), theme::WELL);
    let colour =
        if state.camera_unlocked && eye == Eye::Shot { theme::ACCENT } else { theme::TEXT };
    ui.painter().text(at, egui::Align2::LEFT_BOTTOM, words, font, colour);
}
