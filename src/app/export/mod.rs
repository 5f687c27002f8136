//! Frames as files: stills, contact sheets, sequences, video and run folders.
//!
//! An export runs on a thread of its own with a renderer of its own ([`start`]); whoever started it
//! looks at its progress and may cancel it, and never waits for it. A file appears under its name only
//! when it is whole. Of a cancelled sequence or run the whole frames that are written stay.

mod burn_in;
mod check;
mod job;
mod pictures;
mod place;
mod run_folder;
mod stills;
mod supply;
mod video;

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;

use crate::render::{AdapterChoice, PictureOptions};
use crate::shot::View;

pub use check::{SHEET_PIXELS_MAX, WIDTH_MAX, WIDTH_MIN, in_the_way};
pub use job::{ExportJob, ExportProgress, ExportState};
pub(in crate::app) use pictures::seen_in_shape;
pub use supply::FrameSupply;

use job::{Outcome, Ticket};

/// What to export, as whom it is seen, and where to.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportRequest {
    pub what: ExportKind,
    /// A run folder has all views.
    pub view: ExportView,
    /// Width of one view's picture (px), [`WIDTH_MIN`] to [`WIDTH_MAX`]; its height follows from the
    /// view's shape. Video rounds both to even numbers.
    pub width: u32,
    /// How frames are drawn; its `size` is not used, and its ground only where the witness looks.
    pub options: PictureOptions,
    /// The shot camera's frustum that many frames later, as a ghost in the witness's view.
    pub ghost_frames: Option<f64>,
    pub burn_in: BurnIn,
    /// The program that encodes video; a bare name is looked for on the `PATH`.
    pub ffmpeg: PathBuf,
    /// The file, or the folder of a sequence or a run.
    pub to: PathBuf,
}

/// The name under which ffmpeg is usually installed.
pub const FFMPEG: &str = "ffmpeg";

/// What is made of which frames; they count from the start of the simulation, ends included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportKind {
    /// A PNG picture.
    Still { frame: u32 },
    /// A PNG page with both views of each frame.
    Sheet { frames: Vec<u32> },
    /// A folder of PNG pictures, `FFFF.shot.png`, `FFFF.witness.png` or `FFFF.both.png`.
    Sequence { first: u32, last: u32, stride: u32 },
    /// A film at the shot's rate: `.mp4`, `.mov` or `.mkv`.
    Video { first: u32, last: u32 },
    /// A folder as `simulate` writes it, of frames that the same settings have made.
    Run { first: u32, last: u32 },
}

/// Who looks.
#[derive(Clone, Debug, PartialEq)]
pub enum ExportView {
    Shot,
    Witness(View),
    /// The shot camera's picture on the left, this witness's in the same shape on the right.
    Both(View),
}

/// A strip under the picture, never over it: shot, view, frame, lens, and the first digits of the hash
/// of the settings that made the frame. Contact sheets have captions instead.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BurnIn {
    #[default]
    None,
    Strip,
}

/// Begins an export and returns at once. `wake` is called from its thread after every change of its
/// progress. What is wrong with the request is said by the job's state, in words.
pub fn start(
    request: ExportRequest,
    supply: Box<dyn FrameSupply>,
    adapter: AdapterChoice,
    wake: Arc<dyn Fn() + Send + Sync>,
) -> ExportJob {
    let to = request.to.clone();
    job::start(to, wake, move |ticket| {
        Task { request: &request, supply: supply.as_ref(), adapter: &adapter, ticket }.carry_out()
    })
}

/// What all exports need.
#[derive(Clone, Copy)]
struct Task<'a> {
    request: &'a ExportRequest,
    supply: &'a dyn FrameSupply,
    adapter: &'a AdapterChoice,
    ticket: &'a Ticket,
}

impl Task<'_> {
    fn carry_out(self) -> Result<Outcome> {
        let frames = check::checked_frames(self.request)?;
        self.ticket.expect(frames.len() as u32);
        match &self.request.what {
            ExportKind::Still { frame } => stills::still(self, *frame),
            ExportKind::Sheet { .. } => stills::sheet(self, &frames),
            ExportKind::Sequence { .. } => stills::sequence(self, &frames),
            ExportKind::Video { .. } => video::film(self, &frames),
            ExportKind::Run { .. } => run_folder::run(self, &frames),
        }
    }
}

#[cfg(test)]
mod tests;
