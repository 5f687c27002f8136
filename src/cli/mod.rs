//! The command line, one subcommand a file.

mod args;
mod chart;
mod compare;
mod failure;
mod figure;
mod footage;
mod interrupt;
mod leftovers;
mod log;
mod output;
mod pictures;
mod progress;
mod render;
mod schema;
mod sheet;
mod shot;
mod simulate;
mod summary;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Cloth simulated only as finely as the shot's camera can see it.
#[derive(Parser, Debug)]
#[command(name = "shotsilk", version, about, long_about = None)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    log: log::LogArgs,
}

#[derive(Subcommand, Debug)]
enum Command {
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
    let result = match cli.command {
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
