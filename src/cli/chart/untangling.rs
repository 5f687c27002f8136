//! `shotsilk chart --suite untangling`: how methods of untangling take the same tangles apart.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use rayon::prelude::*;

use super::super::failure::Failure;
use super::super::interrupt::Interrupt;
use super::super::output::{self, PendingFolder};
use crate::chart::UntanglingCurve;
use crate::collision::Method;
use crate::validation::tangle::{LIMITS, Outcome, Tangle, tangles};

const METHODS: [(Method, &str); 3] = [
    (Method::Contours, "contours"),
    (Method::Crossings, "crossings one by one"),
    (Method::PushApart, "push apart"),
];

struct Row {
    tangle: &'static str,
    method: &'static str,
    outcome: Outcome,
}

/// # Errors
/// If the output cannot be written, or the user asks to stop.
pub fn run(out: &Path) -> Result<()> {
    let folder = PendingFolder::create(out)?;
    let csv = folder.file("untangling.csv")?;
    let svg = folder.file("untangling.svg")?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let rows = rows(&tangles(), &interrupt)?;
    csv.write(table_of_rounds(&rows).as_bytes())?;
    let curves: Vec<UntanglingCurve> = rows.iter().map(Row::curve).collect();
    let drawing = crate::chart::untangling_svg(&curves).map_err(|e| anyhow!(e.to_string()))?;
    svg.write(drawing.as_bytes())?;
    output::print(table(&rows))
}

fn rows(tangles: &[Tangle], interrupt: &Interrupt) -> Result<Vec<Row>> {
    let trials: Vec<(&Tangle, (Method, &'static str))> =
        tangles.iter().flat_map(|t| METHODS.map(|method| (t, method))).collect();
    trials
        .par_iter()
        .map(|&(tangle, (method, name))| {
            if let Some(signal) = interrupt.requested() {
                return Err(Failure::Interrupted(signal).into());
            }
            let outcome = tangle.taken_apart(method, LIMITS);
            Ok(Row { tangle: tangle.name, method: name, outcome })
        })
        .collect()
}

impl Row {
    fn curve(&self) -> UntanglingCurve {
        UntanglingCurve {
            tangle: self.tangle.into(),
            method: self.method.into(),
            crossings: self.outcome.rounds().iter().map(|r| r.crossings).collect(),
        }
    }

    /// Rounds after which the state that is kept was there.
    fn rounds_to_best(&self) -> usize {
        let left = self.outcome.untangling.left.len();
        self.outcome.rounds().iter().position(|r| r.crossings == left).unwrap_or(0)
    }
}

/// A line per round.
fn table_of_rounds(rows: &[Row]) -> String {
    let mut lines = vec!["tangle,method,round,crossings,contours,length_m".to_owned()];
    for row in rows {
        let of = |(number, round): (usize, &crate::collision::Round)| {
            let (crossings, contours, length) = (round.crossings, round.contours, round.length);
            format!("{},{},{number},{crossings},{contours},{length}", row.tangle, row.method)
        };
        lines.extend(row.outcome.rounds().iter().enumerate().map(of));
    }
    lines.join("\n") + "\n"
}

/// A line per tangle and method.
fn table(rows: &[Row]) -> String {
    let head = format!(
        "{:22} {:22} {:>8} {:>8} {:>8} {:>10}",
        "tangle", "method", "crossing", "left", "rounds", "way (mm)"
    );
    let line = |row: &Row| {
        let first = row.outcome.rounds().first().map_or(0, |r| r.crossings);
        format!(
            "{:22} {:22} {first:8} {:8} {:8} {:10.1}",
            row.tangle,
            row.method,
            row.outcome.untangling.left.len(),
            row.rounds_to_best(),
            1e3 * row.outcome.longest_way(),
        )
    };
    std::iter::once(head).chain(rows.iter().map(line)).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_takes_its_turn_at_every_tangle_and_every_round_is_written() {
        let tangles: Vec<Tangle> = tangles().into_iter().take(1).collect();
        let tangle = &tangles[0];
        let limits = crate::collision::Limits { rounds: 2, ..LIMITS };
        let row = |&(method, name): &(Method, &'static str)| Row {
            tangle: tangle.name,
            method: name,
            outcome: tangle.taken_apart(method, limits),
        };
        let rows: Vec<Row> = METHODS.iter().map(row).collect();
        assert_eq!(table(&rows).lines().count(), 1 + METHODS.len());
        let rounds: usize = rows.iter().map(|r| r.outcome.rounds().len()).sum();
        assert_eq!(table_of_rounds(&rows).lines().count(), 1 + rounds);
        assert_eq!(rounds, 3 * METHODS.len());
    }
}
