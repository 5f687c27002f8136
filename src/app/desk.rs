//! The program but for where it is shown.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::Ui;

use super::exports::Exports;
use super::panel;
use super::preferences::Preferences;
use super::presses::Typing;
use super::viewport::Viewports;
use super::{keys, pace::Pace};
use crate::preview::{Action, Effect, EyeAndTarget, Level, PanelName, Previewer, Source, Wake};
use crate::render::{AdapterChoice, Gpu, RenderError, Renderer, UiPainter};

/// Work done by other threads is shown this often while nothing else happens (s): more often would
/// take time from the simulation, which is what is waited for.
const SHOW_PROGRESS_EVERY: f64 = 1.0;

/// See the module.
pub struct Desk {
    previewer: Previewer,
    viewports: Viewports,
    panels: panel::Panels,
    exports: Exports,
    preferences: Preferences,
    pace: Pace,
    wishes: Vec<Wish>,
    /// Work since the last redraw that is not drawing.
    work: Duration,
    title: Option<String>,
    quits: bool,
    /// A size of text and controls that is to hold from the next frame on.
    scale: Option<f32>,
}

/// What is to be done with the next pass, in order.
enum Wish {
    Action(Action),
    Key(keys::Asked),
}

/// How far the work of threads is: frames simulated, of the adaptive run, and of the export going on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkDone {
    simulated: u64,
    compared: usize,
    exported: Option<u32>,
}

impl Desk {
    pub fn new(
        previewer: Previewer,
        preferences: Preferences,
        adapter: AdapterChoice,
        wake: Wake,
    ) -> Self {
        let scale = preferences.scale;
        Self {
            previewer,
            viewports: Viewports::new(wake.clone()),
            panels: panel::Panels::default(),
            exports: Exports::new(adapter, wake),
            preferences,
            pace: Pace::default(),
            wishes: Vec::new(),
            work: Duration::ZERO,
            title: None,
            quits: false,
            scale: Some(scale),
        }
    }

    /// Does what was asked for since the last call and takes in what threads have done. Returns when
    /// (s, same clock as `now`) there is something new to show even if nobody does anything.
    pub fn advance(&mut self, now: f64) -> Option<f64> {
        let began = Instant::now();
        self.previewer.receive();
        for wish in std::mem::take(&mut self.wishes) {
            match wish {
                Wish::Action(action) => self.previewer.act(action),
                Wish::Key(asked) if self.takes_keys() => self.previewer.act(asked(&self.previewer)),
                Wish::Key(_) => {}
            }
        }
        self.carry_out();
        self.exports.look_after(&mut self.previewer);
        let next = self.previewer.tick(now);
        self.work += began.elapsed();
        let progress = self.is_busy().then_some(now + SHOW_PROGRESS_EVERY);
        [next, progress].into_iter().flatten().reduce(f64::min)
    }

    /// Does as if a user had.
    pub fn act(&mut self, action: Action) {
        self.wishes.push(Wish::Action(action));
    }

    /// Lays out everything and collects what the user does with it.
    pub fn show(&mut self, ui: &mut Ui) {
        let began = Instant::now();
        if let Some(scale) = self.scale.take() {
            ui.ctx().set_zoom_factor(scale);
        }
        let mut actions = Vec::new();
        let flies = ui.ctx().input(|input| input.pointer.secondary_down());
        if !flies && self.takes_keys() && !ui.ctx().egui_wants_keyboard_input() {
            self.wishes.extend(ui.ctx().input_mut(keys::pressed).into_iter().map(Wish::Key));
        }
        self.open_dropped(ui, &mut actions);
        let context = panel::Context {
            previewer: &self.previewer,
            exports: &self.exports,
            preferences: &self.preferences,
            pace: &self.pace,
            room: panel::Room::of(ui),
            colour_by: self
                .previewer
                .scenery()
                .map(|s| self.viewports.colour_by(&self.previewer.state().look, s)),
        };
        self.panels.show(ui, &context, &mut actions);
        egui::CentralPanel::no_frame().show(ui, |ui| {
            self.viewports.show(ui, &self.previewer, &mut actions);
            self.panels.show_over_viewports(ui, &context, &mut actions);
        });
        self.wishes.extend(actions.into_iter().map(Wish::Action));
        self.work += began.elapsed();
    }

    /// Whether what is typed can be taken now.
    pub fn typing(&self) -> Typing {
        let state = self.previewer.state();
        match !state.has_question() && self.panels.awaits_focus(&state.look) {
            true => Typing::Waits,
            false => Typing::Goes,
        }
    }

    /// Not while a question is open, or a name is asked for.
    fn takes_keys(&self) -> bool {
        let state = self.previewer.state();
        !state.has_question() && !state.look.files_panel && !state.look.save_panel
    }

    /// Of several files the first is opened.
    fn open_dropped(&mut self, ui: &Ui, actions: &mut Vec<Action>) {
        let dropped = ui.ctx().input(|input| input.raw.dropped_files.clone());
        if dropped.len() > 1 {
            let words = format!("of the {} things dropped the first is opened", dropped.len());
            self.previewer.say(Level::Note, words);
        }
        let first = dropped.first().map(|file| Action::Open { path: file.path().to_owned() });
        actions.extend(first);
    }

    /// Draws the viewports that have changed.
    ///
    /// # Errors
    /// If the device reports one.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut Renderer,
        painter: &mut UiPainter,
    ) -> Result<(), RenderError> {
        let began = Instant::now();
        let wanted = self.viewports.prepare(&self.previewer);
        self.work += began.elapsed();
        self.viewports.draw(wanted, gpu, renderer, painter)
    }

    /// Adds work that was done on the desk's behalf, such as turning shapes into triangles.
    pub fn note_work(&mut self, work: Duration) {
        self.work += work;
    }

    /// A redraw is finished, in which drawing took so long.
    pub fn note_redraw(&mut self, drawing: Duration) {
        self.pace.note_redraw(std::mem::take(&mut self.work), drawing);
    }

    pub fn pace(&mut self) -> &mut Pace {
        &mut self.pace
    }

    pub fn previewer(&self) -> &Previewer {
        &self.previewer
    }

    /// Where the views were laid out last (points).
    #[cfg(test)]
    pub fn views(&self) -> egui::Rect {
        self.viewports.space
    }

    /// What of the threads' doings is seen at once: while this stays the same, a redraw can wait.
    pub fn seen(&self) -> impl PartialEq + use<> {
        let previewer = &self.previewer;
        let state = previewer.state();
        (
            previewer.shown().map(|shown| (shown.number, Arc::as_ptr(&shown.frame) as usize)),
            previewer.scenery().map(|scenery| Arc::as_ptr(scenery) as usize),
            previewer.shown_of_a().map(|frame| Arc::as_ptr(frame) as usize),
            state.messages.len(),
            previewer.changed_files().len(),
            previewer.is_opening(),
            previewer.is_working(),
            self.exports.progress(),
        )
    }

    /// What has been done since the program began.
    pub fn work_done(&self) -> WorkDone {
        WorkDone {
            simulated: self.previewer.simulated(),
            compared: self.previewer.rival_costs().iter().flatten().count(),
            exported: self.exports.progress().map(|progress| progress.done),
        }
    }

    /// Whether actions wait to be done: then another pass is due at once.
    pub fn has_actions(&self) -> bool {
        !self.wishes.is_empty()
    }

    /// Whether anything is being simulated, read, opened or exported.
    pub fn is_busy(&self) -> bool {
        self.previewer.is_working()
            || self.previewer.is_opening()
            || self.previewer.is_loading()
            || self.previewer.rival().1
            || self.exports.is_running()
    }

    pub fn is_exporting(&self) -> bool {
        self.exports.is_running()
    }

    /// Why there is nothing of the export that was asked for last; `None` if there is, if it is going on
    /// or was cancelled, and while a question about it is open.
    pub fn unwritten_export(&self) -> Option<&str> {
        self.exports.unwritten()
    }

    /// A new title for the window, once.
    pub fn take_title(&mut self) -> Option<String> {
        self.title.take()
    }

    /// Whether the program is to end.
    pub fn quits(&self) -> bool {
        self.quits
    }

    /// Something went wrong with drawing: pictures are made anew.
    pub fn note_lost_device(&mut self, error: &RenderError) {
        self.viewports.forget_pictures();
        self.scale = Some(self.preferences.scale);
        self.previewer.say(Level::Error, format!("drawing failed and begins anew: {error}"));
    }

    fn carry_out(&mut self) {
        for effect in self.previewer.take_effects() {
            match effect {
                Effect::Export(export) => {
                    let options = self.viewports.picture_options(&self.previewer);
                    let view = self.viewports.witness_view(&self.previewer, [1280, 720]);
                    self.exports.start(export, options, view, &mut self.previewer);
                }
                Effect::CancelExport => self.exports.cancel(),
                Effect::Scale(scale) => {
                    let scale = scale.clamp(0.5, 3.0);
                    self.preferences.scale = scale;
                    self.scale = Some(scale);
                    self.keep_preferences();
                }
                Effect::FrameCloth => {
                    if let Some(EyeAndTarget { eye, target }) =
                        self.viewports.framed(&self.previewer)
                    {
                        self.previewer.act(Action::SetWitness { eye, target });
                    }
                }
                Effect::Opened(source) => {
                    self.viewports.forget_place();
                    self.note_name(&source);
                }
                Effect::Renamed(source) => self.note_name(&source),
                Effect::Quit => {
                    self.keep_preferences();
                    self.quits = true;
                }
            }
        }
    }

    /// What was chosen in the files' panel is open: nothing is left to be done there.
    fn note_name(&mut self, source: &Source) {
        for panel in [PanelName::Files, PanelName::SaveAs] {
            self.previewer.act(Action::SetPanel { panel, open: false });
        }
        let name = self.previewer.scenery().map_or_else(String::new, |s| s.name.clone());
        self.title = Some(format!("{name} - Shotsilk"));
        let path: Option<PathBuf> = match source {
            Source::Shot(request) => request.shot.clone(),
            Source::Run(folder) => Some(folder.clone()),
        };
        if let Some(path) = path {
            self.preferences.note_recent(&path);
            self.keep_preferences();
        }
    }

    /// The window is about to go: what is to be remembered is written.
    pub fn close(&mut self) {
        self.exports.end();
        self.keep_preferences();
    }

    fn keep_preferences(&mut self) {
        self.preferences.look = self.previewer.state().look;
        self.preferences.memory_mb = self.previewer.store().budget() >> 20;
        if let Err(why) = self.preferences.save() {
            self.previewer.say(Level::Warning, why);
        }
    }
}
