//! A desk in a real window. The only place that knows winit.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::presses::Presses;
use super::replay::{Player, Request, check_ended};
use super::{Desk, theme};
use crate::preview::{Action, Wake};
use crate::render::{
    AdapterChoice, Gpu, Presented, RenderError, Renderer, UiPainter, WindowSurface,
};

/// Size of the window at first (points).
const SIZE: [f64; 2] = [1280.0, 720.0];

/// Something happened on another thread.
#[derive(Debug)]
struct Woken;

/// Shows a desk in a window until it is closed. `make_desk` gets what wakes the window. A player
/// replays its script in the window, which it then closes.
///
/// # Errors
/// If there is no display, no adapter for it, or a script fails or its shot cannot be opened.
pub fn run(
    adapter: &AdapterChoice,
    make_desk: impl FnOnce(Wake) -> Desk,
    player: Option<Player>,
) -> Result<()> {
    let event_loop = EventLoop::<Woken>::with_user_event()
        .build()
        // Its own words name the place in its source.
        .map_err(|_| anyhow::anyhow!("there is no display that a window could be opened on"))?;
    let wake = wake(event_loop.create_proxy());
    let mut program = Program {
        desk: make_desk(wake),
        adapter: adapter.clone(),
        context: egui::Context::default(),
        shown: None,
        began: Instant::now(),
        next: None,
        presses: Presses::default(),
        player,
        failure: None,
        losses: 0,
    };
    theme::dress(&program.context);
    silence_expected_panics();
    event_loop.run_app(&mut program).context("the window failed")?;
    program.desk.close();
    match (program.failure, program.player) {
        (Some(failure), _) => Err(failure),
        (None, Some(_)) => check_ended(&program.desk),
        (None, None) => Ok(()),
    }
}

fn wake(proxy: EventLoopProxy<Woken>) -> Wake {
    Arc::new(move || {
        // A loop that has ended needs no waking.
        let _ = proxy.send_event(Woken);
    })
}

struct Program {
    desk: Desk,
    adapter: AdapterChoice,
    context: egui::Context,
    /// `None` before the window is there.
    shown: Option<Shown>,
    began: Instant,
    /// When to redraw even if nothing happens (s since the beginning).
    next: Option<f64>,
    presses: Presses,
    player: Option<Player>,
    failure: Option<anyhow::Error>,
    /// Times in a row that the device was lost.
    losses: u32,
}

/// A window and what is drawn to it with.
struct Shown {
    window: Arc<Window>,
    input: egui_winit::State,
    device: Device,
}

struct Device {
    gpu: Gpu,
    surface: WindowSurface,
    renderer: Renderer,
    painter: UiPainter,
}

impl Device {
    fn open(adapter: &AdapterChoice, window: &Arc<Window>) -> Result<Self, RenderError> {
        let size = window.inner_size();
        let (gpu, surface) =
            WindowSurface::open(adapter, window.clone(), [size.width, size.height])?;
        let (renderer, painter) = (Renderer::new(&gpu), surface.painter(&gpu));
        Ok(Self { gpu, surface, renderer, painter })
    }
}

/// Why nothing was shown.
enum ShowError {
    Device(RenderError),
    Other(anyhow::Error),
}

impl Device {
    /// Draws the viewports that have changed, and the window.
    fn show(
        &mut self,
        desk: &mut Desk,
        context: &egui::Context,
        mut output: egui::FullOutput,
        request: &Request,
    ) -> Result<Presented, ShowError> {
        let began = Instant::now();
        let scale = output.pixels_per_point;
        let primitives = context.tessellate(std::mem::take(&mut output.shapes), scale);
        desk.note_work(began.elapsed());
        let began = Instant::now();
        let Self { gpu, surface, renderer, painter } = self;
        painter.take(gpu, &mut output.textures_delta);
        desk.draw(gpu, renderer, painter).map_err(ShowError::Device)?;
        let presented = surface
            .present(gpu, scale, |sheet| painter.paint(gpu, &primitives, sheet))
            .map_err(ShowError::Device)?;
        desk.note_redraw(began.elapsed());
        if let Request::Screenshot(path) = request {
            let image = surface
                .capture(gpu, scale, |sheet| painter.paint(gpu, &primitives, sheet))
                .map_err(ShowError::Device)?;
            let saved = image.save(path);
            saved
                .with_context(|| format!("cannot write {:?}", path.display()))
                .map_err(ShowError::Other)?;
        }
        Ok(presented)
    }
}

impl ApplicationHandler<Woken> for Program {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.shown.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(shown) => {
                shown.window.request_redraw();
                self.shown = Some(shown);
            }
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            // The redraw says when the next one is due.
            self.next = None;
            self.request_redraw();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, _: Woken) {
        // What threads have done is taken in at once, which is cheap; it is shown when it concerns
        // what is seen, or with the next redraw.
        let now = self.now();
        let before = self.desk.seen();
        let next = self.desk.advance(now);
        self.next = [self.next, next].into_iter().flatten().reduce(f64::min);
        if self.desk.seen() != before {
            self.request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else { return };
        match event {
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.redraw(event_loop) {
                    self.fail(event_loop, error);
                }
                return;
            }
            WindowEvent::CloseRequested => {
                self.desk.act(Action::Quit);
                let now = self.now();
                self.desk.advance(now);
                if self.desk.quits() {
                    event_loop.exit();
                }
                self.request_redraw();
                return;
            }
            WindowEvent::Destroyed => {
                if let Err(error) = self.end_with_the_window() {
                    self.fail(event_loop, error);
                }
                return;
            }
            WindowEvent::Resized(size) => {
                let device = &mut shown.device;
                device.surface.resize(&device.gpu, [size.width, size.height]);
            }
            _ => {}
        }
        let response = shown.input.on_window_event(&shown.window, &event);
        if response.repaint {
            self.desk.pace().note_input();
            shown.window.request_redraw();
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let wait = self.next.map(|next| self.began + Duration::from_secs_f64(next.max(0.0)));
        event_loop.set_control_flow(match wait {
            Some(until) => ControlFlow::WaitUntil(until),
            None => ControlFlow::Wait,
        });
    }
}

impl Program {
    fn open(&self, event_loop: &ActiveEventLoop) -> Result<Shown> {
        let size = winit::dpi::LogicalSize::new(SIZE[0], SIZE[1]);
        let attributes = Window::default_attributes().with_title("Shotsilk").with_inner_size(size);
        let window =
            Arc::new(event_loop.create_window(attributes).context("cannot open a window")?);
        let device = Device::open(&self.adapter, &window)?;
        let input = input_of(&self.context, &window);
        Ok(Shown { window, input, device })
    }

    /// (s).
    fn now(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    fn request_redraw(&self) {
        if let Some(shown) = &self.shown {
            shown.window.request_redraw();
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let now = self.now();
        let next = self.desk.advance(now);
        let Some(shown) = &mut self.shown else { return Ok(()) };
        let Some(mut input) = shown.input_while_it_lives() else {
            return self.end_with_the_window();
        };
        let request = match &mut self.player {
            Some(player) => player.step(&mut self.desk, &mut input, now)?,
            None => Request::Nothing,
        };
        input.events = self.presses.take(input.events, self.desk.typing());
        let desk = &mut self.desk;
        let mut output = self.context.run_ui(input, |ui| desk.show(ui));
        let platform = std::mem::take(&mut output.platform_output);
        shown.input.handle_platform_output(&shown.window, platform);
        let delay = output.viewport_output.values().map(|v| v.repaint_delay).min();
        let presented = match shown.device.show(&mut self.desk, &self.context, output, &request) {
            Ok(presented) => presented,
            Err(ShowError::Device(error)) => return self.reopen(&error),
            Err(ShowError::Other(error)) => return Err(error),
        };
        self.losses = 0;
        if let Some(title) = self.desk.take_title() {
            shown.window.set_title(&title);
        }
        self.plan_redraw(now, next, delay, presented);
        let is_played = self.player.as_ref().is_some_and(|player| player.is_done(&self.desk));
        if self.desk.quits() || is_played {
            event_loop.exit();
        }
        Ok(())
    }

    /// When to redraw next: for what threads do, for what egui animates, for a script.
    fn plan_redraw(
        &mut self,
        now: f64,
        next: Option<f64>,
        delay: Option<Duration>,
        presented: Presented,
    ) {
        /// egui says "never" by a delay beyond any patience.
        const NEVER: Duration = Duration::from_secs(3600);
        let at_once =
            self.desk.has_actions() || self.presses.has_more() || delay == Some(Duration::ZERO);
        let animation = delay.filter(|&delay| delay < NEVER).map(|delay| now + delay.as_secs_f64());
        let script = self.player.as_ref().map(|player| now + player.patience());
        let again = (presented == Presented::NotNow).then_some(now + 0.1);
        self.next = [next, animation, script, again].into_iter().flatten().reduce(f64::min);
        if at_once {
            self.request_redraw();
        }
    }

    /// The device is lost: everything that lived on it is made anew; window, shot and frames stay.
    fn reopen(&mut self, error: &RenderError) -> Result<()> {
        /// So often in a row without a picture in between.
        const LOSSES_MAX: u32 = 3;
        self.losses += 1;
        if self.losses > LOSSES_MAX {
            anyhow::bail!("the graphics device is lost again and again: {error}");
        }
        if self.shown.as_ref().is_some_and(|shown| !shown.is_alive()) {
            return self.end_with_the_window();
        }
        self.desk.note_lost_device(error);
        let Some(shown) = &mut self.shown else { return Ok(()) };
        // A new context sends its letters again.
        self.context = egui::Context::default();
        theme::dress(&self.context);
        shown.device =
            Device::open(&self.adapter, &shown.window).context("the graphics device is lost")?;
        shown.input = input_of(&self.context, &shown.window);
        shown.window.request_redraw();
        Ok(())
    }

    /// Nobody asks the window about itself from now on.
    fn end_with_the_window(&mut self) -> Result<()> {
        self.shown = None;
        anyhow::bail!(self.words_at_the_windows_end())
    }

    /// For a window that was not closed but destroyed, so that nobody could be asked.
    fn words_at_the_windows_end(&self) -> &'static str {
        match self.desk.previewer().has_unsaved_edits() {
            false => "the window was destroyed from outside",
            true => {
                "the window was destroyed from outside: changed settings that were not saved are lost"
            }
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: anyhow::Error) {
        self.failure.get_or_insert(error);
        event_loop.exit();
    }
}

thread_local! {
    /// Whether a panic on this thread is expected, and taken for an answer.
    static IS_PANIC_AN_ANSWER: Cell<bool> = const { Cell::new(false) };
}

/// What a window is asked for; `None` if it has been destroyed: winit then panics when asked for its
/// size.
fn answer_of_a_window<T>(ask: impl FnOnce() -> T) -> Option<T> {
    IS_PANIC_AN_ANSWER.set(true);
    let answer = panic::catch_unwind(AssertUnwindSafe(ask)).ok();
    IS_PANIC_AN_ANSWER.set(false);
    answer
}

/// Has expected panics say nothing.
fn silence_expected_panics() {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !IS_PANIC_AN_ANSWER.get() {
            usual(info);
        }
    }));
}

impl Shown {
    /// What has come in since the last redraw; `None` if the window has been destroyed, though its event
    /// has not come yet.
    fn input_while_it_lives(&mut self) -> Option<egui::RawInput> {
        answer_of_a_window(|| self.input.take_egui_input(&self.window))
    }

    fn is_alive(&self) -> bool {
        answer_of_a_window(|| self.window.inner_size()).is_some()
    }
}

/// Turns events of a window into those of a context.
fn input_of(context: &egui::Context, window: &Window) -> egui_winit::State {
    egui_winit::State::new(
        context.clone(),
        egui::ViewportId::ROOT,
        window,
        Some(window.scale_factor() as f32),
        window.theme(),
        None,
    )
}
