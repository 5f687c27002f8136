//! The export that is going on, if any: begun from what the user sees, looked after until it is done.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use super::export::{
    BurnIn, ExportJob, ExportKind as Kind, ExportProgress, ExportRequest, ExportState, ExportView,
    FFMPEG, FrameSupply, in_the_way, start,
};
use crate::preview::{
    Action, Export, ExportKind, FrameKey, FrameReader, Level, Playback, Previewer, Scenery,
    Viewport, Wake,
};
use crate::render::{AdapterChoice, PictureOptions};
use crate::run::RunInfo;
use crate::scene::Surface;
use crate::shot::{CameraPath, View};
use crate::sim::Frame;

/// See the module.
pub struct Exports {
    adapter: AdapterChoice,
    wake: Wake,
    job: Option<ExportJob>,
    /// What the user is being asked about.
    asked: Option<Asked>,
    /// Why the export that was asked for last was not made.
    unwritten: Option<String>,
}

/// An export as it was when it was asked for: while the question stands, time and settings may go on.
struct Asked {
    /// What the answer asks for.
    export: Export,
    request: ExportRequest,
    supply: Supply,
}

impl Exports {
    pub fn new(adapter: AdapterChoice, wake: Wake) -> Self {
        Self { adapter, wake, job: None, asked: None, unwritten: None }
    }

    pub fn is_running(&self) -> bool {
        self.job.is_some()
    }

    pub fn progress(&self) -> Option<ExportProgress> {
        self.job.as_ref().map(ExportJob::progress)
    }

    /// Why there is nothing of the export that was asked for last.
    pub fn unwritten(&self) -> Option<&str> {
        self.unwritten.as_deref()
    }

    /// Has what is going on cancelled and its unfinished files taken away, as far as a moment is enough.
    pub fn end(&self) {
        const PATIENCE: Duration = Duration::from_secs(2);
        const POLL: Duration = Duration::from_millis(5);
        self.cancel();
        let began = Instant::now();
        let is_running = || self.progress().is_some_and(|p| p.state == ExportState::Running);
        while is_running() && began.elapsed() < PATIENCE {
            thread::sleep(POLL);
        }
    }

    pub fn cancel(&self) {
        if let Some(job) = &self.job {
            job.cancel();
        }
    }

    /// Begins an export, or says why not, or has the user asked whether it may write over files.
    pub fn start(
        &mut self,
        export: Export,
        options: Option<PictureOptions>,
        witness: Option<View>,
        previewer: &mut Previewer,
    ) {
        self.unwritten = None;
        if self.job.is_some() {
            let why = "an export is going on: wait for it or cancel it";
            previewer.say(Level::Note, why);
            self.unwritten = Some(why.to_owned());
            return;
        }
        if let Some(asked) = self.asked.take_if(|asked| asked.export == export) {
            self.begin(asked.request, asked.supply);
            return;
        }
        match self.request(&export, options, witness, previewer) {
            Ok((request, supply)) => {
                if export.kind == ExportKind::Sheet && export.viewport != Viewport::Both {
                    previewer.say(Level::Note, "a contact sheet shows both views");
                }
                let existing = in_the_way(&request, supply.info.first_frame);
                if let Some(what) = existing.filter(|_| !export.overwrite) {
                    let export = Export { overwrite: true, ..export };
                    let action = Action::Export { export: export.clone() };
                    previewer.ask_before_overwriting(what, action);
                    self.asked = Some(Asked { export, request, supply });
                    return;
                }
                self.begin(request, supply);
            }
            Err(why) => {
                previewer.say(Level::Warning, why.clone());
                self.unwritten = Some(why);
            }
        }
    }

    fn begin(&mut self, request: ExportRequest, supply: Supply) {
        let wake = self.wake.clone();
        self.job = Some(start(request, Box::new(supply), self.adapter.clone(), wake));
    }

    /// Says how an export has ended, and forgets what nobody is asked about any more.
    pub fn look_after(&mut self, previewer: &mut Previewer) {
        let question = previewer.state().overwriting.as_ref().map(|asked| &asked.action);
        self.asked.take_if(
            |asked| !matches!(question, Some(Action::Export { export }) if *export == asked.export),
        );
        let Some(progress) = self.progress() else { return };
        match progress.state {
            ExportState::Running => return,
            ExportState::Done(path) => {
                let path = std::path::absolute(&path).unwrap_or(path);
                previewer.say(Level::Note, format!("exported {:?}", path.display()));
            }
            ExportState::Failed(why) => {
                previewer.say(Level::Error, format!("not exported: {why}"));
                self.unwritten = Some(why);
            }
            ExportState::Cancelled(left) => previewer.say(Level::Note, left),
        }
        self.job = None;
    }

    fn request(
        &self,
        export: &Export,
        options: Option<PictureOptions>,
        witness: Option<View>,
        previewer: &Previewer,
    ) -> Result<(ExportRequest, Supply), String> {
        let (Some(scenery), Some(options)) = (previewer.scenery(), options) else {
            return Err("nothing is open".to_owned());
        };
        let Playback { current, first, last, .. } = previewer.state().playback;
        let what = match export.kind {
            ExportKind::Still => Kind::Still { frame: current },
            ExportKind::Sheet => Kind::Sheet { frames: sheet_frames(first, last) },
            ExportKind::Sequence => Kind::Sequence { first, last, stride: 1 },
            ExportKind::Video => Kind::Video { first, last },
            ExportKind::Run => Kind::Run { first: 0, last },
        };
        let range = match export.kind {
            ExportKind::Still => (current, current),
            ExportKind::Run => (0, last),
            _ => (first, last),
        };
        check_clean(previewer, scenery, export.kind, range)?;
        let witness = || witness.ok_or_else(|| "the witness has nothing to look at".to_owned());
        let viewport = match export.kind {
            // A page shows both.
            ExportKind::Sheet => Viewport::Both,
            _ => export.viewport,
        };
        let view = match viewport {
            Viewport::Shot => ExportView::Shot,
            Viewport::Witness => ExportView::Witness(witness()?),
            Viewport::Both => ExportView::Both(witness()?),
        };
        let supply = Supply {
            reader: previewer.frame_reader(),
            keys: previewer.timeline().keys(),
            hashes: hashes(previewer),
            scenery: scenery.clone(),
            camera: scenery.camera.as_deref().cloned(),
            info: previewer.run_info().ok_or("nothing is open")?,
        };
        let request = ExportRequest {
            what,
            view,
            width: export.width,
            options,
            ghost_frames: previewer.state().look.ghost.then(|| scenery.anticipation()),
            burn_in: if export.burn_in { BurnIn::Strip } else { BurnIn::None },
            ffmpeg: PathBuf::from(FFMPEG),
            to: export.to.clone(),
        };
        Ok((request, supply))
    }
}

/// Frames of a contact sheet: at most as many as fit a page at a glance.
fn sheet_frames(first: u32, last: u32) -> Vec<u32> {
    const FRAMES_MAX: u32 = 12;
    let stride = (last - first + 1).div_ceil(FRAMES_MAX).max(1);
    (first..=last).step_by(stride as usize).collect()
}

/// All but a still must be what a run from the start gives.
fn check_clean(
    previewer: &Previewer,
    scenery: &Scenery,
    kind: ExportKind,
    (first, last): (u32, u32),
) -> Result<(), String> {
    let timeline = previewer.timeline();
    let missing = (first..=last).find(|&frame| timeline.slot(frame).is_none());
    if let Some(frame) = missing {
        let why = match previewer.plan() {
            Some(_) => "is not simulated yet",
            None => "is missing in the run",
        };
        return Err(format!("frame {} {why}", scenery.shown(frame)));
    }
    if kind == ExportKind::Still || timeline.is_clean(first, last) {
        return Ok(());
    }
    let [first, last] = [first, last].map(|frame| scenery.shown(frame));
    Err(format!(
        "frames {first} to {last} were made with different settings: re-run from the start (R) first"
    ))
}

fn hashes(previewer: &Previewer) -> Vec<String> {
    let timeline = previewer.timeline();
    let hash = |frame| timeline.slot(frame).map(|slot| slot.settings_hash.clone());
    let clean = previewer.scenery().map_or_else(String::new, |s| s.settings_hash.clone());
    let is_ready = |frame| timeline.is_clean(frame, frame);
    (0..timeline.len() as u32)
        // What a clean run gives carries the hash of that run, whichever made it.
        .map(|frame| if is_ready(frame) { clean.clone() } else { hash(frame).unwrap_or_default() })
        .collect()
}

/// The frames there were when the export began.
struct Supply {
    reader: FrameReader,
    keys: Vec<Option<FrameKey>>,
    hashes: Vec<String>,
    scenery: Arc<Scenery>,
    camera: Option<CameraPath>,
    info: RunInfo,
}

impl FrameSupply for Supply {
    fn frame(&self, number: u32) -> Result<Arc<Frame>, String> {
        let key = self.keys.get(number as usize).copied().flatten();
        self.reader.frame(key.ok_or("it is not simulated yet")?, number)
    }

    fn settings_hash(&self, number: u32) -> Result<String, String> {
        let hash = self.hashes.get(number as usize).cloned();
        hash.ok_or_else(|| "it is not simulated yet".to_owned())
    }

    fn surfaces(&self) -> Vec<Arc<Surface>> {
        self.scenery.surfaces.clone()
    }

    fn camera(&self) -> Option<CameraPath> {
        self.camera.clone()
    }

    fn info(&self) -> RunInfo {
        self.info.clone()
    }
}
