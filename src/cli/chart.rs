//! `shotsilk chart`: suites of measurements, as tables and files.

mod bending;
mod contact;
mod stability;
mod untangling;
mod visible_error;

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use cpu_time::ThreadTime;
use rayon::prelude::*;

use super::args::ShotArgs;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::log::LogArgs;
use super::output::{self, PendingFolder};
use crate::render::{AdapterChoice, Headless};
use crate::validation::{Experiment, Row, experiments};

#[derive(Args, Debug)]
pub struct ChartArgs {
    /// The shot of a suite that measures one
    #[command(flatten)]
    shot: ShotArgs,
    /// What is measured
    #[arg(long, value_enum)]
    suite: Suite,
    /// The folder to write into
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Only rows or stresses whose name contains this
    #[arg(long, value_name = "PATTERN")]
    only: Option<String>,
    /// Compare shaded pictures of the runs as well
    #[arg(long)]
    shaded: bool,
    /// The graphics adapter for shaded pictures: software, hardware, or part of a name
    #[arg(long, default_value = "software")]
    adapter: AdapterChoice,
}

/// `--suite`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Suite {
    /// Experiments whose outcome is known exactly: validation.json
    Validation,
    /// What models of bending cost, and how far off they are: bending.json, bending.svg
    Bending,
    /// How methods take the same tangles of sheets apart: untangling.csv, untangling.svg
    Untangling,
    /// How ways of keeping cloth out of cloth do on the same steps, of scenes of its own and of the shot
    /// if one is given: contact.csv, contact.md, contact.svg
    Contact,
    /// Growing stress until the simulator fails: stability.csv, stability.md, stability.svg
    Stability,
    /// What coarsening costs a shot on screen, against a fine reference run of it: charts, tables,
    /// and the runs
    VisibleError,
}

impl ChartArgs {
    /// An argument that was given but means nothing to the suite.
    fn meaningless(&self) -> Option<&'static str> {
        let Self { shot, suite, out: _, only, shaded, adapter: _ } = self;
        let ShotArgs { shot, camera, sets, fps, frames, sizing, edge_length, threads: _ } = shot;
        let of_shots = [
            (shot.is_some(), "a shot"),
            (camera.is_some(), "--camera"),
            (!sets.is_empty(), "--set"),
            (fps.is_some(), "--fps"),
            (frames.is_some(), "--frames"),
            (sizing.is_some(), "--sizing"),
            (edge_length.is_some(), "--edge-length"),
            (*shaded, "--shaded"),
        ];
        // It chooses these itself.
        let of_visible_error =
            [(sizing.is_some(), "--sizing"), (edge_length.is_some(), "--edge-length")];
        let only = (only.is_some(), "--only");
        let given: Vec<(bool, &'static str)> = match suite {
            Suite::Validation | Suite::Stability => of_shots.to_vec(),
            Suite::Bending | Suite::Untangling => of_shots.into_iter().chain([only]).collect(),
            Suite::Contact if shot.is_some() => vec![(*shaded, "--shaded")],
            Suite::Contact => of_shots.to_vec(),
            Suite::VisibleError => of_visible_error.into_iter().chain([only]).collect(),
        };
        given.into_iter().find_map(|(is_given, name)| is_given.then_some(name))
    }
}

/// # Errors
/// If an argument has no meaning, the output cannot be written, a row is off, or the user asks to stop.
pub fn run(args: &ChartArgs, log: LogArgs) -> Result<()> {
    if let Some(name) = args.meaningless() {
        let suite = args.suite.to_possible_value();
        let suite = suite.as_ref().map_or("", |value| value.get_name());
        return Err(Failure::Usage(format!("the suite {suite} has no use for {name}")).into());
    }
    super::shot::set_threads(args.shot.threads)?;
    match args.suite {
        Suite::Validation => validation(args),
        Suite::Bending => bending::run(&args.out),
        Suite::Untangling => untangling::run(&args.out),
        Suite::Contact => contact::run(&args.shot, &args.out, args.only.as_deref()),
        Suite::Stability => stability::run(&args.out, args.only.as_deref()),
        Suite::VisibleError => visible_error(args, log),
    }
}

fn visible_error(args: &ChartArgs, log: LogArgs) -> Result<()> {
    let gpu = args.shaded.then(|| Headless::new(&args.adapter)).transpose();
    let gpu = gpu.map_err(Failure::from)?;
    visible_error::run(visible_error::Suite { shot: &args.shot, out: &args.out, gpu }, log)
}

fn validation(args: &ChartArgs) -> Result<()> {
    let chosen = chosen(experiments(), args.only.as_deref())?;
    let folder = PendingFolder::create(&args.out)?;
    let file = folder.file("validation.json")?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let rows = measured(&chosen, &interrupt)?;
    let rows: Vec<Row> = rows.into_iter().filter(|r| is_wanted(&r.name, args)).collect();
    file.write(&serde_json::to_vec_pretty(&rows)?)?;
    output::print(table(&rows))?;
    let off: Vec<&str> = rows.iter().filter(|r| !r.holds()).map(|r| r.name.as_str()).collect();
    if off.is_empty() {
        return Ok(());
    }
    let why = format!("{} of {} rows are off: {}", off.len(), rows.len(), off.join(", "));
    Err(Failure::Check(why).into())
}

fn is_wanted(name: &str, args: &ChartArgs) -> bool {
    args.only.as_ref().is_none_or(|pattern| name.contains(pattern))
}

fn chosen(all: Vec<Experiment>, only: Option<&str>) -> Result<Vec<Experiment>> {
    let Some(pattern) = only else { return Ok(all) };
    let is_chosen = |e: &Experiment| e.claims().iter().any(|c| c.name.contains(pattern));
    let chosen: Vec<Experiment> = all.into_iter().filter(is_chosen).collect();
    if chosen.is_empty() {
        let why = format!("no row of the suite has {pattern:?} in its name");
        return Err(Failure::Usage(why).into());
    }
    Ok(chosen)
}

/// The rows of all experiments, in their order, whoever runs them first.
fn measured(experiments: &[Experiment], interrupt: &Interrupt) -> Result<Vec<Row>> {
    let done = AtomicUsize::new(0);
    let rows: Result<Vec<Vec<Row>>> = experiments
        .par_iter()
        .map(|experiment| {
            if let Some(signal) = interrupt.requested() {
                return Err(Failure::Interrupted(signal).into());
            }
            let start = ThreadTime::now();
            let outcome = experiment.run();
            let name = &experiment.claims()[0].name;
            if let Some(error) = &outcome.error {
                tracing::warn!("{name}: {error}");
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            let seconds = start.elapsed().as_secs_f64();
            tracing::info!("{done} of {}: {name}: {seconds:.1} CPU s", experiments.len());
            Ok(outcome.rows)
        })
        .collect();
    Ok(rows?.concat())
}

/// One line per row, in columns.
fn table(rows: &[Row]) -> String {
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or(0).max(4);
    let head = format!(
        "{:width$}  {:>12} {:>12} {:>9} {:>9}",
        "name", "expected", "measured", "error", "limit"
    );
    let line = |row: &Row| {
        let verdict = if row.holds() { "" } else { "  OFF" };
        format!(
            "{:width$}  {:>12} {:>12} {:>9} {:>9}{verdict}",
            row.name,
            figure(row.expected),
            figure(row.measured),
            figure_in(row.error, 2),
            figure_in(row.tolerance, 2),
        )
    };
    std::iter::once(head).chain(rows.iter().map(line)).collect::<Vec<_>>().join("\n")
}

fn figure(value: f64) -> String {
    figure_in(value, 6)
}

/// So many significant digits, in the shorter of the two notations.
fn figure_in(value: f64, digits: usize) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        format!("{value}")
    } else if (1e-3..1e6).contains(&magnitude) {
        let whole = magnitude.log10().floor() as i32 + 1;
        format!("{value:.*}", (digits as i32 - whole).max(0) as usize)
    } else {
        format!("{value:.*e}", digits - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validation::Claim;

    #[test]
    fn figures_have_the_digits_asked_for() {
        let shown = [0.0, 1.0, 18.178, 1234567.0, 2.5e-13, f64::NAN].map(figure);
        assert_eq!(shown, ["0", "1.00000", "18.1780", "1.23457e6", "2.50000e-13", "NaN"]);
        assert_eq!(figure_in(0.0213, 2), "0.021");
    }

    #[test]
    fn rows_that_are_off_are_marked_in_the_table() {
        let claim = Claim::relative("a/b", 2.0, 0.1);
        let table = table(&[claim.row(2.1), claim.row(3.0), claim.row(f64::NAN)]);
        let off: Vec<bool> = table.lines().map(|line| line.ends_with("OFF")).collect();
        assert_eq!(off, [false, false, true, true]);
    }

    #[test]
    fn a_pattern_chooses_rows_and_one_that_chooses_none_is_refused() {
        let all = || vec![Experiment::new(vec![Claim::none("a/b", 1.0)], || Ok(vec![0.0]))];
        assert_eq!(chosen(all(), Some("a/")).unwrap().len(), 1);
        assert_eq!(chosen(all(), None).unwrap().len(), 1);
        assert!(chosen(all(), Some("c")).is_err());
    }
}
