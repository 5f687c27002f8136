//! The whole program without a window: a script instead of a user, a picture in memory instead of a
//! screen. The same desk, drawn by the same renderer.

mod player;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};

use super::{Desk, theme};
use crate::preview::Wake;
use crate::render::{AdapterChoice, Canvas, Gpu, Renderer, Sheet, UiPainter, WINDOW_FORMAT};

pub use player::{Player, Request, check_ended};

/// Between two redraws nothing may happen for so long, unless a thread has something to say.
const PASS_EVERY: Duration = Duration::from_millis(15);

/// A screen that nobody sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Width and height (px).
    pub size: [u32; 2],
    /// Pixels to a point.
    pub scale: f32,
}

/// Replays a script. `make_desk` gets what wakes the replay.
///
/// # Errors
/// If there is no adapter, a step of the script fails, or the shot cannot be opened.
pub fn run(
    adapter: &AdapterChoice,
    screen: Screen,
    make_desk: impl FnOnce(Wake) -> Desk,
    mut player: Player,
) -> Result<()> {
    let (wake, woken) = wake();
    let mut desk = make_desk(wake);
    let mut stage = Stage::new(adapter, screen)?;
    let began = Instant::now();
    while !player.is_done(&desk) && !desk.quits() {
        stage.pass(&mut desk, &mut player, began.elapsed().as_secs_f64())?;
        let _ = woken.recv_timeout(PASS_EVERY);
        while woken.try_recv().is_ok() {}
    }
    desk.close();
    check_ended(&desk)
}

fn wake() -> (Wake, Receiver<()>) {
    let (sender, woken): (Sender<()>, _) = channel();
    let wake: Wake = Arc::new(move || {
        // A replay that has ended needs no waking.
        let _ = sender.send(());
    });
    (wake, woken)
}

/// What is drawn with, and to.
struct Stage {
    context: egui::Context,
    gpu: Gpu,
    renderer: Renderer,
    painter: UiPainter,
    canvas: Canvas,
    screen: Screen,
}

impl Stage {
    fn new(adapter: &AdapterChoice, screen: Screen) -> Result<Self> {
        let gpu = Gpu::new(adapter)?;
        let context = egui::Context::default();
        theme::dress(&context);
        let renderer = Renderer::new(&gpu);
        let painter = UiPainter::new(&gpu, WINDOW_FORMAT);
        let canvas = Canvas::new(&gpu, screen.size);
        Ok(Self { context, gpu, renderer, painter, canvas, screen })
    }

    fn pass(&mut self, desk: &mut Desk, player: &mut Player, now: f64) -> Result<()> {
        let Screen { size, scale } = self.screen;
        desk.advance(now);
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(
                egui::Pos2::ZERO,
                egui::vec2(size[0] as f32, size[1] as f32) / (scale * self.context.zoom_factor()),
            )),
            time: Some(now),
            focused: true,
            ..Default::default()
        };
        let root = input.viewports.entry(egui::ViewportId::ROOT).or_default();
        root.native_pixels_per_point = Some(scale);
        let request = player.step(desk, &mut input, now)?;
        let mut output = self.context.run_ui(input, |ui| desk.show(ui));
        let began = Instant::now();
        let primitives = self.context.tessellate(output.shapes, output.pixels_per_point);
        desk.note_work(began.elapsed());
        let began = Instant::now();
        desk.draw(&self.gpu, &mut self.renderer, &mut self.painter)?;
        let view = self.canvas.sheet_view();
        let sheet = Sheet { view: &view, size, scale: output.pixels_per_point };
        self.painter.take(&self.gpu, &mut output.textures_delta);
        self.painter.paint(&self.gpu, &primitives, sheet)?;
        if let Request::Screenshot(path) = request {
            let image = self.canvas.read(&self.gpu)?;
            image.save(&path).with_context(|| format!("cannot write {:?}", path.display()))?;
        }
        self.gpu.wait()?;
        desk.note_redraw(began.elapsed());
        Ok(())
    }
}
