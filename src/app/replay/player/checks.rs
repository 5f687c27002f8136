//! What ends a script before its time, and how it has ended.

use anyhow::{Result, bail};

use crate::app::Desk;
use crate::app::script::{ScriptError, ScriptStep};
use crate::preview::{Action, Level};

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
pub(super) fn check_written(desk: &Desk) -> Result<()> {
    match desk.unwritten_export() {
        Some(why) => bail!("not exported: {why}"),
        None => Ok(()),
    }
}

/// A script that looks at the question, or clicks on its answer.
pub(super) fn may_leave_a_question_open(step: &ScriptStep) -> bool {
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
pub(super) fn check_answered(desk: &Desk) -> Result<()> {
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
pub(super) fn check_going(desk: &Desk) -> Result<()> {
    check_opened(desk)?;
    if desk.has_actions() || desk.previewer().is_opening() {
        // What was said may be about what is to be otherwise.
        return Ok(());
    }
    let failure = desk.previewer().state().messages.iter().find(|m| m.level == Level::Error);
    match failure {
        Some(message) => bail!("{}", message.text),
        None => Ok(()),
    }
}
