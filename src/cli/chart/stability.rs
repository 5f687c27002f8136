//! `shotsilk chart --suite stability`: growing stress until the simulator fails.

use std::path::Path;

use anyhow::{Context, Result, anyhow};

use super::super::failure::Failure;
use super::super::interrupt::Interrupt;
use super::super::output::{self, PendingFolder};
use crate::chart::{StabilityMap, StressRow};
use crate::stability::{Record, Stress, stresses};

/// `only` chooses the stresses whose name contains it.
///
/// # Errors
/// If there is no such stress, the output cannot be written, or the user asks to stop. That a scene
/// fails is what the suite looks for, and no error.
pub fn run(out: &Path, only: Option<&str>) -> Result<()> {
    let chosen = chosen(only)?;
    let folder = PendingFolder::create(out)?;
    let csv = folder.file("stability.csv")?;
    let table = folder.file("stability.md")?;
    let svg = folder.file("stability.svg")?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let map = map(&chosen, &interrupt)?;
    csv.write(map.csv().as_bytes())?;
    table.write(map.markdown().as_bytes())?;
    let drawing = map.svg().map_err(|e| anyhow!("cannot draw the chart: {e}"))?;
    svg.write(drawing.as_bytes())?;
    output::print(map.markdown().trim_end())
}

fn chosen(only: Option<&str>) -> Result<Vec<Stress>> {
    let is_chosen = |stress: &Stress| only.is_none_or(|pattern| stress.name.contains(pattern));
    let chosen: Vec<Stress> = stresses().into_iter().filter(is_chosen).collect();
    if chosen.is_empty() {
        let why = format!("no stress has {:?} in its name", only.unwrap_or_default());
        return Err(Failure::Usage(why).into());
    }
    Ok(chosen)
}

/// One scene after the other: the CPU time of each is its own.
fn map(stresses: &[Stress], interrupt: &Interrupt) -> Result<StabilityMap> {
    let count: usize = stresses.iter().map(|stress| stress.values.len()).sum();
    let mut done = 0;
    let mut map = StabilityMap::default();
    for stress in stresses {
        let mut records = Vec::new();
        for &value in stress.values {
            let record = stress.run(value, &mut || interrupt.requested().is_none());
            let Some(record) = record else { return Err(interrupted(interrupt)) };
            done += 1;
            tracing::info!("{done} of {count}: {}", line(&record));
            records.push(record);
        }
        map.rows.push(StressRow { name: stress.name.into(), about: stress.about.into(), records });
    }
    Ok(map)
}

fn interrupted(interrupt: &Interrupt) -> anyhow::Error {
    match interrupt.requested() {
        Some(signal) => Failure::Interrupted(signal).into(),
        None => anyhow!("stopped, though nobody asked for it"),
    }
}

fn line(record: &Record) -> String {
    let flaws: Vec<String> = record.flaws().into_iter().map(|flaw| flaw.text).collect();
    let found = if flaws.is_empty() { "holds".to_owned() } else { flaws.join(", ") };
    let Record { stress, label, cpu_seconds, .. } = record;
    format!("{stress} {label}: {found}; {cpu_seconds:.1} CPU s")
}
