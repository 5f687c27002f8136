//! `shotsilk chart --suite contact`: looking for impacts on the whole way against bounds on the ways
//! of nodes, on the same steps of the same shots.

mod scenes;
mod tables;

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result, anyhow};

use self::scenes::Subject;
use self::tables::Measured;
use super::super::args::ShotArgs;
use super::super::failure::Failure;
use super::super::interrupt::Interrupt;
use super::super::output::{self, PendingFolder};
use crate::chart::ContactPoint;
use crate::mesh::Mesh;
use crate::sim::{Frame, Simulation};
use crate::validation::way_bounds::{BoundRound, Bounded, Comparison};

/// How far bounds look, in contact thicknesses: less is cheaper, and lets less motion through.
const RADII: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

/// Which of them is drawn.
const RADIUS_DRAWN: f64 = 1.0;

/// `only` chooses the scenes whose name contains it.
///
/// # Errors
/// If there is no such scene, the shot is bad, a simulation fails, the output cannot be written, or the
/// user asks to stop.
pub fn run(shot: &ShotArgs, out: &Path, only: Option<&str>) -> Result<()> {
    let subjects = scenes::chosen(shot, only)?;
    let folder = PendingFolder::create(out)?;
    let csv = folder.file("contact.csv")?;
    let table = folder.file("contact.md")?;
    let svg = folder.file("contact.svg")?;
    let interrupt = Interrupt::install().context("cannot listen for signals")?;
    // Time is that of one thread.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let alone = alone.context("cannot start a thread")?;
    let mut measured = Vec::new();
    for subject in &subjects {
        tracing::info!("simulating {:?}", subject.name);
        measured.push(alone.install(|| measure(subject, &interrupt))?);
    }
    csv.write(tables::csv(&measured).as_bytes())?;
    let markdown = tables::markdown(&measured);
    table.write(markdown.as_bytes())?;
    let points: Vec<ContactPoint> = measured.iter().flat_map(points).collect();
    let drawing = crate::chart::contact_svg(&points);
    svg.write(drawing.map_err(|e| anyhow!("cannot draw the chart: {e}"))?.as_bytes())?;
    output::print(markdown.trim_end())
}

/// Both ways on the first step after every so many frames.
fn measure(subject: &Subject, interrupt: &Interrupt) -> Result<Measured> {
    let Subject { name, scene, settings, frames, every } = subject;
    let started = Simulation::start(Arc::new(scene.clone()), *settings).map_err(Failure::from)?;
    let (mut simulation, mut frame) = started;
    let mut measured = Measured { scene: name.clone(), ..Measured::default() };
    for number in 0..*frames {
        if let Some(signal) = interrupt.requested() {
            return Err(Failure::Interrupted(signal).into());
        }
        if number % every == 0 {
            measured.push(compared(&mut simulation, &frame)?);
        }
        frame = simulation.advance().map_err(Failure::from)?;
        let steps = f64::from(frames * scene.steps_per_frame);
        measured.step_seconds += frame.report.cpu_seconds / steps;
    }
    Ok(measured)
}

/// `None` if the frame has crossings.
fn compared(simulation: &mut Simulation, frame: &Frame) -> Result<Option<(u32, Comparison)>> {
    let trial = simulation.trial_step().map_err(Failure::from)?;
    let garments: Vec<Mesh> = frame.garments.iter().map(|mesh| (**mesh).clone()).collect();
    let contact = simulation.scene().contact;
    let compared = Comparison::of(&trial, &garments, &contact, &RADII);
    Ok(compared.map(|compared| (frame.number, compared)))
}

/// Four dots a step.
fn points(measured: &Measured) -> Vec<ContactPoint> {
    let of = |(_, step): &(u32, Comparison)| {
        let point = |method: &str, seconds: f64, motion_kept: f64| ContactPoint {
            scene: measured.scene.clone(),
            method: method.to_owned(),
            speed: step.speed,
            us_per_node: 1e6 * seconds / step.node_count.max(1) as f64,
            motion_kept,
        };
        let search = &step.searched;
        let mut all = vec![point("search", search.seconds.iter().sum(), search.motion_kept)];
        let drawn = step.bounded.iter().find(|b| b.radius == RADIUS_DRAWN);
        if let Some(bounded) = drawn {
            let after = |rounds: usize| {
                let seconds = bounded.rounds[..rounds].iter().map(|r| r.seconds).sum();
                (seconds, bounded.rounds[rounds - 1].motion_kept)
            };
            let settled = tables::rounds_to_settle(bounded).unwrap_or(bounded.rounds.len());
            for (method, rounds) in [
                ("bounds, one round", 1),
                ("bounds, until 1 % are held", settled),
                ("bounds, 16 rounds or all arrived", bounded.rounds.len()),
            ] {
                let (seconds, kept) = after(rounds);
                all.push(point(method, seconds, kept));
            }
        }
        all
    };
    measured.steps.iter().flat_map(of).collect()
}

/// The rounds that a way of bounds has made; at least one.
fn last(bounded: &Bounded) -> &BoundRound {
    bounded.rounds.last().expect("there is a first round")
}
