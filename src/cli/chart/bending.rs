//! `shotsilk chart --suite bending`: what models of bending cost, and how far off they are.

mod onset;

use std::hint::black_box;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use cpu_time::ThreadTime;
use rayon::prelude::*;
use serde_json::json;

use self::onset::OnsetRow;
use super::super::failure::Failure;
use super::super::interrupt::Interrupt;
use super::super::output::{self, PendingFolder};
use crate::chart::BendingCandidate;
use crate::dynamics::{Accuracy, LinearSolver, StepForces};
use crate::scene::{BendingModel, PRESETS, Preset, SolverChoice};
use crate::validation::bending::{Droop, MODELS, Trial, curled, droop, droop_of};
use crate::validation::sheet::Layout;

/// Along the strip.
const CELLS: [u32; 2] = [15, 30];

/// L/h: such a membrane hardly resists what a mesh makes of bending.
const THICK: f64 = 100.0;

/// L/h: as taut as cotton's.
const THIN: f64 = 1000.0;

/// Matrices assembled and factorised to time one: the least time is that of nobody interfering.
const REPEATS: u32 = 20;

const STEP: f64 = 5e-3;

/// # Errors
/// If the output cannot be written, or the user asks to stop.
pub fn run(out: &Path) -> Result<()> {
    let folder = PendingFolder::create(out)?;
    let json = folder.file("bending.json")?;
    let svg = folder.file("bending.svg")?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    let rows = rows(&interrupt)?;
    let onsets = onset::rows(&interrupt)?;
    let presets = presets();
    let costs = MODELS.iter().map(|&model| cost(model)).collect::<Result<Vec<_>>>()?;
    let written = rows.iter().map(|(trial, droop)| {
        json!({
            "model": trial.model, "layout": trial.layout.name(), "cells": trial.cells,
            "slenderness": trial.slenderness,
            "errors": droop.map(|d| d.errors), "steps": droop.map(|d| d.steps),
        })
    });
    let costs_written = costs.iter().map(|cost| {
        json!({
            "model": cost.model, "assembly_us_per_node": cost.assembly_us,
            "solution_us_per_node": cost.solution_us,
            "blocks_per_row": cost.blocks_per_row,
        })
    });
    let presets_written =
        presets.iter().map(|(preset, droop)| json!({"preset": preset.name, "h_over_w": droop}));
    let all = json!({
        "rows": written.collect::<Vec<_>>(),
        "onsets": onsets.iter().map(OnsetRow::json).collect::<Vec<_>>(),
        "costs": costs_written.collect::<Vec<_>>(),
        "presets": presets_written.collect::<Vec<_>>(),
    });
    json.write(&serde_json::to_vec_pretty(&all)?)?;
    let candidates: Vec<BendingCandidate> =
        costs.iter().map(|cost| candidate(cost, &rows, &onsets)).collect();
    let drawing = crate::chart::bending_svg(&candidates).map_err(|e| anyhow!(e.to_string()))?;
    svg.write(drawing.as_bytes())?;
    output::print(
        [table(&rows, &costs), onset::table(&onsets), preset_table(&presets)].join("\n\n"),
    )
}

/// Every preset with the droop of a strip along warp and weft.
fn presets() -> Vec<(Preset, Option<[f64; 2]>)> {
    PRESETS
        .into_par_iter()
        .map(|preset| {
            let droop = droop_of(&preset.fabric());
            if let Err(error) = &droop {
                tracing::warn!("{}: {error}", preset.name);
            }
            (preset, droop.ok())
        })
        .collect()
}

fn preset_table(presets: &[(Preset, Option<[f64; 2]>)]) -> String {
    let head = "H/W of a strip of 20 cm, along warp and weft".to_owned();
    let line = |(preset, droop): &(Preset, Option<[f64; 2]>)| match droop {
        Some([warp, weft]) => format!("{:8} {warp:8.3} {weft:8.3}", preset.name),
        None => format!("{:8} not at rest", preset.name),
    };
    std::iter::once(head).chain(presets.iter().map(line)).collect::<Vec<_>>().join("\n")
}

type Row = (Trial, Option<Droop>);

fn rows(interrupt: &Interrupt) -> Result<Vec<Row>> {
    let thick = MODELS.map(|model| (model, THICK));
    let all = thick.into_iter().chain([(BendingModel::Moments, THIN)]);
    let trials: Vec<Trial> = all
        .flat_map(|(model, slenderness)| {
            let of =
                move |cells| Layout::ALL.map(|layout| Trial { model, layout, cells, slenderness });
            CELLS.into_iter().flat_map(of)
        })
        .collect();
    trials
        .par_iter()
        .map(|&trial| {
            if let Some(signal) = interrupt.requested() {
                return Err(Failure::Interrupted(signal).into());
            }
            let outcome = droop(trial);
            if let Err(error) = &outcome {
                let (model, layout) = (name(trial.model), trial.layout.name());
                let strip = format!("{layout} mesh of {} cells", trial.cells);
                tracing::warn!("{model}, {strip}, L/h {}: {error}", trial.slenderness);
            }
            Ok((trial, outcome.ok()))
        })
        .collect()
}

/// CPU time per node, the least of [`REPEATS`].
struct Cost {
    model: BendingModel,
    assembly_us: f64,
    /// Of the matrix, factorised anew.
    solution_us: f64,
    /// Of the whole matrix, diagonal included.
    blocks_per_row: f64,
}

fn cost(model: BendingModel) -> Result<Cost> {
    let (mut system, state) = curled(model);
    let nodes = system.node_count() as f64;
    let assembly_us = least_us(|| {
        system.freeze_stiffness(&state.position);
        black_box(system.assemble(&state, &StepForces::NONE, STEP));
        Ok(())
    })?;
    let (matrix, right_side) = system.linear_system();
    let mut solver = LinearSolver::default();
    solver.set_choice(SolverChoice::Direct);
    let mut change = right_side.to_vec();
    let solution_us = least_us(|| {
        solver.expect_new_matrix();
        solver.solve(matrix, right_side, &mut change, Accuracy::FINE)?;
        Ok(())
    })?;
    let blocks_per_row = 2.0 * matrix.pattern().block_count() as f64 / nodes - 1.0;
    let [assembly_us, solution_us] = [assembly_us, solution_us].map(|us| us / nodes);
    Ok(Cost { model, assembly_us, solution_us, blocks_per_row })
}

/// The least CPU time that something takes (microseconds).
fn least_us(mut work: impl FnMut() -> Result<()>) -> Result<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let start = ThreadTime::now();
        work()?;
        least = least.min(start.elapsed().as_secs_f64() * 1e6);
    }
    Ok(least)
}

/// Of the cantilevers those of the finer mesh, and of the membrane that hardly matters.
fn candidate(cost: &Cost, rows: &[Row], onsets: &[OnsetRow]) -> BendingCandidate {
    let of_model = rows.iter().filter(|(trial, _)| {
        trial.model == cost.model && trial.cells == CELLS[1] && trial.slenderness == THICK
    });
    let buckled = onsets.iter().filter(|row| row.model == cost.model);
    BendingCandidate {
        name: name(cost.model),
        assembly_us: cost.assembly_us,
        droop_errors: of_model.filter_map(|(_, droop)| droop.map(|d| d.worst())).collect(),
        onset_errors: buckled.filter_map(OnsetRow::worst).collect(),
    }
}

fn table(rows: &[Row], costs: &[Cost]) -> String {
    let mut lines = vec![format!(
        "{:10} {:12} {:>5} {:>5} {:>9} {:>9} {:>9} {:>6}",
        "model", "layout", "cells", "L/h", "Gamma 5", "Gamma 20", "Gamma 100", "steps"
    )];
    lines.extend(rows.iter().map(|(trial, droop)| {
        let head = format!(
            "{:10} {:12} {:5} {:5.0}",
            name(trial.model),
            trial.layout.name(),
            trial.cells,
            trial.slenderness
        );
        match droop {
            Some(Droop { errors, steps }) => {
                let [a, b, c] = errors.map(|e| format!("{:+.2} %", 100.0 * e));
                format!("{head} {a:>9} {b:>9} {c:>9} {steps:6}")
            }
            None => format!("{head}  not at rest"),
        }
    }));
    lines.push(String::new());
    lines.extend(costs.iter().map(|cost| {
        format!(
            "{:10} assembly {:.2} us, direct solution {:.2} us a node; {:.1} blocks a row",
            name(cost.model),
            cost.assembly_us,
            cost.solution_us,
            cost.blocks_per_row
        )
    }));
    lines.join("\n")
}

fn name(model: BendingModel) -> String {
    let text = serde_json::to_value(model).expect("a model has a name");
    text.as_str().unwrap_or_default().to_owned()
}
