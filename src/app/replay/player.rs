//! Step by step through a script.

use std::collections::VecDeque;
use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use egui::{Event, Key, Modifiers, PointerButton, RawInput, pos2};
use serde_json::json;

use crate::app::Desk;
use crate::app::script::{Button, ScriptError, ScriptStep};
use crate::preview::{Action, FrameStatus, Level};

/// A step that waits gives up after so long (s).
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
    settled: u32,
    /// Inputs still to come, a pass at a time: a press and its release are two.
    inputs: VecDeque<Vec<Event>>,
}

impl Player {
    pub fn new(steps: Vec<ScriptStep>) -> Self {
        Self { steps: steps.into(), step: 1, since: None, settled: 0, inputs: VecDeque::new() }
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
        let Some(step) = self.steps.front().cloned() else { return Ok(Request::Nothing) };
        let outcome = self.carry_out(&step, desk, now - began);
        let (is_done, request) = outcome.map_err(|why| match why.downcast::<ScriptError>() {
            Ok(error) => error.into(),
            Err(why) => self.failed(&step, format!("{why:#}")),
        })?;
        if is_done {
            self.steps.pop_front();
            self.step += 1;
            self.since = None;
            self.settled = 0;
        } else if now - began > PATIENCE {
            return Err(self.failed(&step, format!("it has waited for {PATIENCE} s")));
        }
        Ok(request)
    }

    fn failed(&self, step: &ScriptStep, why: String) -> anyhow::Error {
        ScriptError::Failed { step: self.step, what: format!("{step:?}"), why }.into()
    }

    /// Whether the step is done, and what it asks for.
    fn carry_out(
        &mut self,
        step: &ScriptStep,
        desk: &mut Desk,
        waited: f64,
    ) -> Result<(bool, Request)> {
        if !may_leave_a_question_open(step) {
            check_answered(desk)?;
        }
        let mut request = Request::Nothing;
        let done = match step {
            ScriptStep::Act(action) => {
                desk.pace().note_input();
                desk.act(action.clone());
                true
            }
            ScriptStep::WaitForFrames { first, last } => {
                check_going(desk)?;
                let timeline = desk.previewer().timeline();
                let is_there = |frame| {
                    let status = timeline.status(frame);
                    matches!(status, FrameStatus::Ready | FrameStatus::Mixed)
                };
                !desk.has_actions()
                    && !desk.previewer().is_opening()
                    && (*first..=*last).all(is_there)
            }
            ScriptStep::WaitUntilIdle => {
                check_going(desk)?;
                let previewer = desk.previewer();
                let is_busy = desk.has_actions()
                    || previewer.is_opening()
                    || previewer.is_working()
                    || previewer.is_loading()
                    || previewer.rival().1
                    || desk.is_exporting();
                self.settled = if is_busy { 0 } else { self.settled + 1 };
                self.settled > SETTLING_PASSES
            }
            ScriptStep::WaitUntilShown { frame } => {
                desk.previewer().shown().is_some_and(|shown| shown.number >= *frame)
            }
            ScriptStep::Wait { seconds } => waited >= *seconds,
            ScriptStep::Click { at } => {
                self.click(*at);
                true
            }
            ScriptStep::Drag { from, to, button } => {
                self.drag(*from, *to, *button);
                true
            }
            ScriptStep::Press { key } => {
                self.press(key)?;
                true
            }
            ScriptStep::Screenshot { to } => {
                self.settled = if desk.has_actions() { 0 } else { self.settled + 1 };
                let is_ready = self.settled > SETTLING_PASSES;
                if is_ready {
                    request = Request::Screenshot(to.clone());
                }
                is_ready
            }
            ScriptStep::Report { to } => {
                let text = serde_json::to_string_pretty(&report(desk)).expect("numbers and words");
                std::fs::write(to, text + "\n")
                    .with_context(|| format!("cannot write {:?}", to.display()))?;
                true
            }
            ScriptStep::ClearPace => {
                desk.pace().clear();
                true
            }
        };
        Ok((done, request))
    }

    fn click(&mut self, [x, y]: [f32; 2]) {
        let at = pos2(x, y);
        self.inputs.extend([
            vec![Event::PointerMoved(at)],
            vec![button(at, PointerButton::Primary, true)],
            vec![button(at, PointerButton::Primary, false)],
        ]);
    }

    fn drag(&mut self, from: [f32; 2], to: [f32; 2], with: Button) {
        /// Moves of the pointer that make up a drag.
        const MOVES: u32 = 8;
        let which = match with {
            Button::Primary => PointerButton::Primary,
            Button::Secondary => PointerButton::Secondary,
            Button::Middle => PointerButton::Middle,
        };
        let (from, to) = (pos2(from[0], from[1]), pos2(to[0], to[1]));
        self.inputs.extend([vec![Event::PointerMoved(from)], vec![button(from, which, true)]]);
        for k in 1..=MOVES {
            let at = from.lerp(to, k as f32 / MOVES as f32);
            self.inputs.push_back(vec![Event::PointerMoved(at)]);
        }
        self.inputs.push_back(vec![button(to, which, false)]);
    }

    fn press(&mut self, name: &str) -> Result<()> {
        let Some(key) = Key::from_name(name) else { bail!("{name:?} is no key") };
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        self.inputs.extend([vec![event(true)], vec![event(false)]]);
        Ok(())
    }
}

fn button(pos: egui::Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}

/// How a script has ended.
///
/// # Errors
/// If its shot could not be opened, it has left a question open, or what it would export is not there.
pub fn check_ended(desk: &Desk) -> Result<()> {
    check_opened(desk)?;
    check_answered(desk)?;
    check_written(desk)?;
    if desk.is_exporting() {
        bail!("the script quits before its export is done: let it wait until idle");
    }
    Ok(())
}

/// What a script exports is there, or it has failed.
fn check_written(desk: &Desk) -> Result<()> {
    match desk.unwritten_export() {
        Some(why) => bail!("not exported: {why}"),
        None => Ok(()),
    }
}

/// A script that looks at the question, or clicks on its answer.
fn may_leave_a_question_open(step: &ScriptStep) -> bool {
    match step {
        ScriptStep::Act(action) => matches!(action, Action::WriteOver { .. }),
        ScriptStep::WaitForFrames { .. }
        | ScriptStep::WaitUntilIdle
        | ScriptStep::WaitUntilShown { .. } => false,
        ScriptStep::Wait { .. }
        | ScriptStep::Click { .. }
        | ScriptStep::Drag { .. }
        | ScriptStep::Press { .. }
        | ScriptStep::Screenshot { .. }
        | ScriptStep::Report { .. }
        | ScriptStep::ClearPace => true,
    }
}

/// Nobody is there to be asked.
fn check_answered(desk: &Desk) -> Result<()> {
    match &desk.previewer().state().overwriting {
        Some(asked) => bail!("{}: to write over it say \"overwrite\": true", asked.what),
        None => Ok(()),
    }
}

/// A script is for a shot: one that cannot be read, and none opened after it, is bad input.
///
/// # Errors
/// In the words of whoever read it.
fn check_opened(desk: &Desk) -> Result<()> {
    match desk.previewer().opening_failure() {
        Some(why) => Err(ScriptError::NotOpened(why.to_owned()).into()),
        None => Ok(()),
    }
}

/// What has gone wrong will not get better by waiting.
fn check_going(desk: &Desk) -> Result<()> {
    check_opened(desk)?;
    let failure = desk.previewer().state().messages.iter().find(|m| m.level == Level::Error);
    match failure {
        Some(message) => bail!("{}", message.text),
        None => Ok(()),
    }
}

/// Where the program stands.
fn report(desk: &mut Desk) -> serde_json::Value {
    let pace = desk.pace().report();
    let previewer = desk.previewer();
    let (state, timeline) = (previewer.state(), previewer.timeline());
    let letter = |frame| match timeline.status(frame) {
        FrameStatus::Ready => 'r',
        FrameStatus::Mixed => 'm',
        FrameStatus::Stale => 's',
        FrameStatus::Missing => '.',
    };
    let keys: Vec<Option<String>> =
        timeline.keys().into_iter().map(|key| key.map(|key| key.to_string())).collect();
    let messages: Vec<&str> = state.messages.iter().map(|m| m.text.as_str()).collect();
    json!({
        "current": state.playback.current,
        "playing": state.playback.playing,
        "statuses": (0..timeline.len() as u32).map(letter).collect::<String>(),
        "keys": keys,
        "simulated": previewer.simulated(),
        "seconds": (0..timeline.len() as u32)
            .filter_map(|frame| Some(timeline.slot(frame)?.cost?.wall))
            .sum::<f64>(),
        "edits": state.version.edits,
        "settings_hash": previewer.scenery().map(|s| s.settings_hash.clone()),
        "messages": messages,
        "memory_bytes": previewer.store().used(),
        "pace": pace,
    })
}
