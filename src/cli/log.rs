//! Logs go to stderr; stdout is for results.

use std::io::{self, IsTerminal, Write};
use std::sync::LazyLock;

use clap::{ArgAction, Args, ValueEnum};
use indicatif::MultiProgress;
use tracing_subscriber::EnvFilter;
use tracing_subscriber::fmt::MakeWriter;

/// What stands at the bottom of the terminal; log lines are printed above it.
pub(super) static TERMINAL: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Overrides the level flags, in the syntax of `tracing_subscriber::EnvFilter`.
const FILTER_VARIABLE: &str = "SHOTSILK_LOG";

/// Arguments of every command.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct LogArgs {
    /// How log lines are written to stderr
    #[arg(long = "log", value_name = "FORMAT", default_value = "text", global = true)]
    pub format: LogFormat,
    /// Says more; twice: everything
    #[arg(short, long, action = ArgAction::Count, global = true)]
    pub verbose: u8,
    /// Says nothing but errors
    #[arg(short, long, conflicts_with = "verbose", global = true)]
    pub quiet: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    #[default]
    Text,
    /// A JSON object a line, progress included
    Json,
}

impl LogArgs {
    /// Sends the program's log to stderr. Call once, before anything is logged; a second call has
    /// no effect.
    pub fn install(self) {
        let filter = EnvFilter::try_from_env(FILTER_VARIABLE)
            .unwrap_or_else(|_| EnvFilter::new(self.directives()));
        let log = tracing_subscriber::fmt().with_env_filter(filter).with_writer(AboveTheBar);
        // Fails only if a subscriber is already there.
        let _ = match self.format {
            LogFormat::Text => log
                .without_time()
                .with_target(false)
                .with_ansi(io::stderr().is_terminal())
                .try_init(),
            LogFormat::Json => log.json().flatten_event(true).try_init(),
        };
    }

    /// Other crates speak up only when something is wrong.
    fn directives(self) -> &'static str {
        match (self.quiet, self.verbose) {
            (true, _) => "error",
            (false, 0) => "warn,shotsilk=info",
            (false, 1) => "warn,shotsilk=debug",
            (false, _) => "info,shotsilk=trace",
        }
    }
}

/// Writes to stderr without tearing the progress bar.
struct AboveTheBar;

impl Write for AboveTheBar {
    fn write(&mut self, line: &[u8]) -> io::Result<usize> {
        TERMINAL.suspend(|| io::stderr().write(line))
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().flush()
    }
}

impl MakeWriter<'_> for AboveTheBar {
    type Writer = AboveTheBar;

    fn make_writer(&self) -> AboveTheBar {
        AboveTheBar
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        log: LogArgs,
    }

    fn args(line: &str) -> Result<LogArgs, clap::Error> {
        Line::try_parse_from(line.split(' ')).map(|line| line.log)
    }

    #[test]
    fn flags_choose_format_and_level() {
        assert_eq!(args("x").unwrap().directives(), "warn,shotsilk=info");
        assert_eq!(args("x").unwrap().format, LogFormat::Text);
        assert_eq!(args("x -v --log json").unwrap().directives(), "warn,shotsilk=debug");
        assert_eq!(args("x -v --log json").unwrap().format, LogFormat::Json);
        assert_eq!(args("x -vv").unwrap().directives(), "info,shotsilk=trace");
        assert_eq!(args("x --quiet").unwrap().directives(), "error");
        assert!(args("x -q -v").is_err());
        assert!(args("x --log xml").is_err());
    }

    #[test]
    fn every_level_is_a_filter_the_library_knows() {
        for line in ["x", "x -v", "x -vv", "x -q"] {
            EnvFilter::try_new(args(line).unwrap().directives()).unwrap();
        }
    }
}
