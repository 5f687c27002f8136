//! The command line, one subcommand a file.

mod args;
mod chart;
mod compare;
mod failure;
mod figure;
mod footage;
mod interrupt;
mod log;
mod output;
mod pictures;
mod preview;
mod progress;
mod render;
mod schema;
mod sheet;
mod shot;
mod simulate;
mod summary;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

/// Cloth simulated only as finely as the shot's camera can see it.
#[derive(Parser, Debug)]
#[command(name = "shotsilk", version, about, long_about = None)]
struct Cli {
    /// Without one, where there is a display: the previewer
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    log: log::LogArgs,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Scrub a shot, tune how its camera coarsens the cloth, move the camera: in a window
    Preview(preview::PreviewArgs),
    /// Simulate a shot into a run folder
    Simulate(simulate::SimulateArgs),
    /// Draw the frames of a shot or a run as PNG pictures
    Render(render::RenderArgs),
    /// Draw a contact sheet of a shot or a run
    Sheet(sheet::SheetArgs),
    /// Put pictures side by side, with text under them
    Figure(figure::FigureArgs),
    /// Compare two runs as the shot camera sees them, or two pictures
    Compare(compare::CompareArgs),
    /// Measure a suite of figures and hold them against what is known
    Chart(chart::ChartArgs),
    /// Print the JSON Schema of the shot file
    Schema,
}

/// Parses the arguments, runs the command, prints its error once.
pub fn main() -> ExitCode {
    // clap prints usage errors itself and ends with its exit code 2.
    let cli = Cli::parse();
    cli.log.install();
    let Some(command) = cli.command.or_else(usual_command) else {
        // As clap does without a subcommand.
        eprint!("{}", Cli::command().render_help().ansi());
        return ExitCode::from(2);
    };
    let result = match command {
        Command::Preview(args) => preview::run(&args),
        Command::Simulate(args) => simulate::run(&args, cli.log),
        Command::Render(args) => render::run(&args, cli.log),
        Command::Sheet(args) => sheet::run(&args, cli.log),
        Command::Figure(args) => figure::run(&args),
        Command::Compare(args) => compare::run(&args, cli.log),
        Command::Chart(args) => chart::run(&args, cli.log),
        Command::Schema => output::print(schema::run()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tracing::error!("{error:#}");
            failure::exit_code(&error)
        }
    }
}

/// What the program does when it is not told: it shows its window, if there is anywhere to show it.
fn usual_command() -> Option<Command> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let has_display = cfg!(not(all(unix, not(target_os = "macos"))))
        || is_set("DISPLAY")
        || is_set("WAYLAND_DISPLAY");
    has_display.then(|| Cli::parse_from(["shotsilk", "preview"]).command).flatten()
}
