//! What a command may fail with, and the exit code that says so.

use std::process::ExitCode;

use super::interrupt::Signal;
use crate::compare::RunsError;
use crate::render::RenderError;
use crate::run::RunError;
use crate::scene::LoadError;
use crate::sim::SimError;

/// An error that is known to the exit code; everything else is 1.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    #[error("{0}")]
    Usage(String),
    #[error("{0}")]
    BadInput(String),
    #[error(transparent)]
    Input(#[from] LoadError),
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Runs(#[from] RunsError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Simulation(#[from] SimError),
    /// What was compared is not as it should be.
    #[error("{0}")]
    Check(String),
    #[error("interrupted; what is written so far is whole")]
    Interrupted(Signal),
    #[error(
        "interrupted; what is written so far is whole: the same command with --resume goes on from there"
    )]
    Paused(Signal),
}

impl Failure {
    /// As CONTRACT says: 2 usage, 3 bad input, 4 no graphics adapter, 5 the simulation failed,
    /// 6 a check failed, 130 and 143 interrupted.
    fn exit_code(&self) -> u8 {
        match self {
            Failure::Usage(_) => 2,
            Failure::BadInput(_) | Failure::Input(_) => 3,
            Failure::Run(error) if error.is_bad_input() => 3,
            Failure::Run(_) => 1,
            Failure::Runs(RunsError::Run(error)) if !error.is_bad_input() => 1,
            Failure::Runs(_) => 3,
            Failure::Render(RenderError::NoAdapter { .. }) => 4,
            Failure::Render(_) => 1,
            Failure::Simulation(_) => 5,
            Failure::Check(_) => 6,
            Failure::Interrupted(signal) | Failure::Paused(signal) => signal.exit_code(),
        }
    }
}

/// The exit code of an error: that of the failure in its chain.
pub fn exit_code(error: &anyhow::Error) -> ExitCode {
    let known = error.chain().find_map(|cause| cause.downcast_ref::<Failure>());
    ExitCode::from(known.map_or(1, Failure::exit_code))
}
