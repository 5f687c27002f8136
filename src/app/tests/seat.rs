//! A user at a desk, who sees what it says and clicks what it offers.

use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Rect, Vec2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};

use crate::app::{Desk, Preferences, theme};
use crate::preview::stage::{LAST, PATIENCE, SHOT, Stage};
use crate::preview::{Action, FrameStatus, Level, Look, Previewer, Source, Start, Wake};
use crate::render::AdapterChoice;

/// Passes after an input in which nothing new may be asked for at the latest.
const PASSES_MAX: u64 = 20;

/// What the harness leaves free around the window (points).
const MARGIN: f32 = 8.0;

/// See the module.
pub struct Seat {
    desk: Harness<'static, Desk>,
    began: Instant,
    /// More than has really passed (s).
    passed: f64,
    /// What is open lies in it.
    pub stage: Stage,
}

/// What a seat begins with.
pub struct Setting {
    /// Of the shot's file.
    pub shot: String,
    pub simulating: bool,
    /// Of the window (points).
    pub size: [f32; 2],
}

impl Default for Setting {
    fn default() -> Self {
        Self { shot: SHOT.to_owned(), simulating: false, size: [1280.0, 720.0] }
    }
}

/// With a stage's shot being opened, and nothing kept beyond it.
pub fn desk_at(stage: &Stage, setting: &Setting) -> Desk {
    let wake: Wake = Arc::new(|| {});
    let previewer = Previewer::start(Start {
        source: Source::Shot(stage.request()),
        look: Look::default(),
        cache: None,
        memory: 64 << 20,
        simulating: setting.simulating,
        wake: wake.clone(),
    });
    Desk::new(previewer, Preferences::default(), AdapterChoice::Software, wake)
}

impl Seat {
    /// With the small shot open and nothing simulated.
    pub fn take() -> Self {
        Self::take_with(Setting::default())
    }

    /// With all frames of the small shot.
    pub fn take_simulated() -> Self {
        let mut seat = Self::take_with(Setting { simulating: true, ..Setting::default() });
        seat.until("all frames", |p| {
            (0..=LAST).all(|frame| p.timeline().status(frame) == FrameStatus::Ready)
        });
        seat
    }

    pub fn take_with(setting: Setting) -> Self {
        let stage = Stage::set();
        std::fs::write(stage.shot(), &setting.shot).unwrap();
        let desk = desk_at(&stage, &setting);
        let desk = Harness::builder()
            .with_size(vec2(setting.size[0], setting.size[1]) + Vec2::splat(2.0 * MARGIN))
            .with_max_steps(PASSES_MAX)
            .with_context_setup(theme::dress)
            .build_ui_state(|ui, desk: &mut Desk| desk.show(ui), desk);
        let mut seat = Self { desk, began: Instant::now(), passed: 0.0, stage };
        seat.until("the shot", |p| p.scenery().is_some() && !p.is_opening());
        seat
    }

    pub fn previewer(&self) -> &Previewer {
        self.desk.state().previewer()
    }

    /// What is left for the views (points).
    pub fn views(&self) -> Rect {
        self.desk.state().views()
    }

    pub fn is_exporting(&self) -> bool {
        self.desk.state().is_exporting()
    }

    pub fn current(&self) -> u32 {
        self.previewer().state().playback.current
    }

    /// Lets time go by (s).
    pub fn pass(&mut self, seconds: f64) {
        self.passed += seconds;
        self.settle();
        self.settle();
    }

    fn now(&self) -> f64 {
        self.began.elapsed().as_secs_f64() + self.passed
    }

    /// Does what was asked for, and shows it.
    pub fn settle(&mut self) {
        let now = self.now();
        loop {
            self.desk.run();
            let had_actions = self.desk.state().has_actions();
            self.desk.state_mut().advance(now);
            if !had_actions {
                break;
            }
        }
        self.desk.run();
    }

    pub fn until(&mut self, what: &str, is_so: impl Fn(&Previewer) -> bool) {
        let began = Instant::now();
        loop {
            self.settle();
            let messages = &self.previewer().state().messages;
            let error = messages.iter().find(|message| message.level == Level::Error);
            assert!(error.is_none(), "{}", error.unwrap().text);
            if is_so(self.previewer()) {
                return;
            }
            assert!(began.elapsed() < PATIENCE, "{what} has not come about");
            sleep(Duration::from_millis(1));
        }
    }

    /// Until what was to be opened has turned out not to be a shot.
    pub fn until_refused(&mut self) {
        let began = Instant::now();
        while self.previewer().opening_failure().is_none() {
            self.settle();
            assert!(began.elapsed() < PATIENCE, "there is no answer");
        }
        self.settle();
    }

    /// Until no plan is awaited, whatever is said meanwhile.
    pub fn until_answered(&mut self) {
        let began = Instant::now();
        self.settle();
        while self.previewer().is_opening() {
            self.settle();
            assert!(began.elapsed() < PATIENCE, "there is no answer");
        }
        self.settle();
    }

    /// Until no plan is awaited.
    pub fn until_planned(&mut self) {
        self.settle();
        self.until("the plan", |p| !p.is_opening());
    }

    pub fn act(&mut self, action: Action) {
        self.desk.state_mut().act(action);
        let now = self.now();
        self.desk.state_mut().advance(now);
        self.settle();
    }

    pub fn press(&mut self, key: egui::Key) {
        self.desk.key_press(key);
        self.settle();
    }

    /// Keys that come within one pass.
    pub fn press_all(&mut self, keys: &[egui::Key]) {
        keys.iter().for_each(|&key| self.desk.key_press(key));
        self.settle();
    }

    /// The button, or what can be selected, of a name.
    pub fn click(&mut self, name: &str) {
        self.desk.get_by_role_and_label(Role::Button, name).click();
        self.settle();
    }

    /// Presses and lets go there, without a way in between.
    pub fn click_at(&mut self, pos: egui::Pos2) {
        let button = |pressed| egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: egui::Modifiers::NONE,
        };
        for event in [egui::Event::PointerMoved(pos), button(true), button(false)] {
            self.desk.event(event);
            self.settle();
        }
    }

    /// Opens or closes the heading of a name, be it scrolled out of sight.
    pub fn unfold(&mut self, name: &str) {
        self.desk.get_by_role_and_label(Role::DisclosureTriangle, name).click_accesskit();
        self.settle();
    }

    pub fn tick(&mut self, name: &str) {
        self.desk.get_by_role_and_label(Role::CheckBox, name).click_accesskit();
        self.settle();
    }

    pub fn is_offered(&self, button: &str) -> bool {
        let found = self.desk.query_by_role_and_label(Role::Button, button);
        found.is_some_and(|node| !node.accesskit_node().is_disabled())
    }

    /// Whether something says just this.
    pub fn says(&self, words: &str) -> bool {
        self.desk.query_all_by_label(words).next().is_some()
    }

    /// How many things say just this.
    pub fn count_of(&self, words: &str) -> usize {
        self.desk.query_all_by_label(words).count()
    }

    /// Whether something says this among other things.
    pub fn mentions(&self, words: &str) -> bool {
        self.desk.query_all_by_label_contains(words).next().is_some()
    }

    /// The only text that can be typed.
    pub fn text(&self) -> Node<'_> {
        self.desk.get_by_role(Role::TextInput)
    }

    /// Types it in place of what the only text has.
    pub fn type_over(&mut self, words: &str) {
        self.text().focus();
        self.settle();
        self.desk.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
        self.settle();
        self.text().type_text(words);
        self.settle();
    }

    pub fn node<'n>(&'n self, role: Role, name: &'n str) -> Node<'n> {
        self.desk.get_by_role_and_label(role, name)
    }

    /// Rests the pointer on what says this, until its hint is there.
    pub fn point_at(&mut self, words: &str) {
        /// More than hints wait for, at the time that a pass takes here.
        const PASSES: usize = 6;
        self.desk.get_by_role_and_label(Role::Label, words).hover();
        self.desk.run_steps(PASSES);
    }
}
