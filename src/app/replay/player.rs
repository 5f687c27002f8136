//! Step by step through a script.

mod checks;
mod input;
mod report;

use std::collections::VecDeque;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use anyhow::{Result, ensure};
use egui::{Event, RawInput};

use crate::app::Desk;
use crate::app::desk::WorkDone;
use crate::app::script::{ScriptError, ScriptStep};
use crate::preview::FrameStatus;

pub use checks::check_ended;
use checks::{check_answered, check_going, check_written, may_leave_a_question_open};

/// A step that waits gives up when nothing has come of it for so long, and so does a script that has no
/// more steps but waits for what it opens or exports (s). A long film may take longer.
const PATIENCE: f64 = 600.0;
/// Passes with nothing to do before a picture is taken: what one pass asks for, the next one shows.
const SETTLING_PASSES: u32 = 3;

/// What a step asks of whoever draws.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    Nothing,
    /// The window as it is now, as PNG.
    Screenshot(PathBuf),
}

/// See the module.
pub struct Player {
    steps: VecDeque<ScriptStep>,
    /// Number of the step at hand, from 1.
    step: usize,
    /// When the step at hand began (s).
    since: Option<f64>,
    /// How far work was, and since when it has been (s).
    stood: Option<(WorkDone, f64)>,
    settled: u32,
    /// Inputs still to come, a pass at a time: a press and its release are two.
    inputs: VecDeque<Vec<Event>>,
}

impl Player {
    pub fn new(steps: Vec<ScriptStep>) -> Self {
        Self {
            steps: steps.into(),
            step: 1,
            since: None,
            stood: None,
            settled: 0,
            inputs: VecDeque::new(),
        }
    }

    /// Whether nothing is left to be done or to be waited for.
    pub fn is_done(&self, desk: &Desk) -> bool {
        let is_idle = !desk.has_actions() && !desk.previewer().is_opening() && !desk.is_exporting();
        self.steps.is_empty() && self.inputs.is_empty() && is_idle
    }

    /// How long it can be before the script looks again (s): what waits for the simulation must not take
    /// its time.
    pub fn patience(&self) -> f64 {
        match self.steps.front() {
            _ if !self.inputs.is_empty() => 0.0,
            Some(ScriptStep::WaitForFrames { .. } | ScriptStep::WaitUntilIdle) => 1.0,
            _ => 0.02,
        }
    }

    /// Goes on as far as it can in this pass of the panels: puts inputs among those of the pass, and
    /// asks for a picture.
    ///
    /// # Errors
    /// If a step cannot be done, or waits for too long.
    pub fn step(&mut self, desk: &mut Desk, input: &mut RawInput, now: f64) -> Result<Request> {
        if let Some(events) = self.inputs.pop_front() {
            desk.pace().note_input();
            input.events.extend(events);
            return Ok(Request::Nothing);
        }
        check_written(desk)?;
        let began = *self.since.get_or_insert(now);
        let waited = now - began;
        let idle = self.idle(desk.work_done(), now).min(waited);
        let Some(step) = self.steps.front().cloned() else {
            ensure!(
                idle <= PATIENCE,
                "after its last step the script has waited for {PATIENCE} s without a frame, and what \
                 it opens or exports is not done"
            );
            return Ok(Request::Nothing);
        };
        let outcome = self.carry_out(&step, desk, waited);
        let request = outcome.map_err(|why| match why.downcast::<ScriptError>() {
            Ok(error) => error.into(),
            Err(why) => self.failed(&step, format!("{why:#}")),
        })?;
        match request {
            Some(_) => {
                self.steps.pop_front();
                self.step += 1;
                self.since = None;
                self.settled = 0;
            }
            None if idle > PATIENCE && !matches!(step, ScriptStep::Wait { .. }) => {
                let why = format!("it has waited for {PATIENCE} s without a frame");
                return Err(self.failed(&step, why));
            }
            None => {}
        }
        Ok(request.unwrap_or(Request::Nothing))
    }

    /// For how long no frame has been made or exported (s).
    fn idle(&mut self, done: WorkDone, now: f64) -> f64 {
        let (_, since) =
            *self.stood.take_if(|(before, _)| *before == done).get_or_insert((done, now));
        self.stood = Some((done, since));
        now - since
    }

    fn failed(&self, step: &ScriptStep, why: String) -> anyhow::Error {
        ScriptError::Failed { step: self.step, what: format!("{step:?}"), why }.into()
    }

    /// What the step asks for when it is done; `None` while it waits.
    fn carry_out(
        &mut self,
        step: &ScriptStep,
        desk: &mut Desk,
        waited: f64,
    ) -> Result<Option<Request>> {
        if !may_leave_a_question_open(step) {
            check_answered(desk)?;
        }
        let is_done = match step {
            ScriptStep::Act(action) => {
                desk.pace().note_input();
                desk.act(action.clone());
                true
            }
            ScriptStep::WaitForFrames { first, last } => has_frames(desk, *first..=*last)?,
            ScriptStep::WaitUntilIdle => {
                check_going(desk)?;
                self.settled =
                    if desk.has_actions() || desk.is_busy() { 0 } else { self.settled + 1 };
                self.settled > SETTLING_PASSES
            }
            ScriptStep::WaitUntilShown { frame } => {
                desk.previewer().shown().is_some_and(|shown| shown.number >= *frame)
            }
            ScriptStep::Wait { seconds } => waited >= *seconds,
            ScriptStep::Click { at } => {
                self.inputs.extend(input::click(*at));
                true
            }
            ScriptStep::Drag { from, to, button } => {
                self.inputs.extend(input::drag(*from, *to, *button));
                true
            }
            ScriptStep::Press { key } => {
                self.inputs.extend(input::press(key)?);
                true
            }
            ScriptStep::Screenshot { to } => {
                self.settled = if desk.has_actions() { 0 } else { self.settled + 1 };
                let is_ready = self.settled > SETTLING_PASSES;
                return Ok(is_ready.then(|| Request::Screenshot(to.clone())));
            }
            ScriptStep::Report { to } => {
                report::write_report(desk, to)?;
                true
            }
            ScriptStep::ClearPace => {
                desk.pace().clear();
                true
            }
        };
        Ok(is_done.then_some(Request::Nothing))
    }
}

/// Whether these frames are there and as they should be.
///
/// # Errors
/// If they will not come.
fn has_frames(desk: &Desk, mut frames: RangeInclusive<u32>) -> Result<bool> {
    check_going(desk)?;
    let timeline = desk.previewer().timeline();
    let is_there =
        |frame| matches!(timeline.status(frame), FrameStatus::Ready | FrameStatus::Mixed);
    Ok(!desk.has_actions() && !desk.previewer().is_opening() && frames.all(is_there))
}

#[cfg(test)]
mod tests;
