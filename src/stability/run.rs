//! A scene under stress, simulated as far as it goes.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use super::record::Record;
use super::stress::{Stress, Trial};
use super::watch::Watch;
use crate::sim::Simulation;

/// CPU time that a scene may take (s); looked at after every frame. A scene that needs more is
/// recorded as too slow, with the frames it has done.
pub const CPU_BUDGET: f64 = 30.0;

impl Stress {
    /// What comes of the scene at a value; `None` if `is_wanted` says between two frames that nobody
    /// wants to know any more.
    ///
    /// Nothing that the simulator does ends it: errors and panics are what it looks for.
    pub fn run(&self, value: f64, is_wanted: &mut dyn FnMut() -> bool) -> Option<Record> {
        let mut record = Record {
            stress: self.name.to_owned(),
            value,
            label: (self.label)(value),
            ..Record::default()
        };
        let all = AssertUnwindSafe(|| {
            let trial = (self.trial)(value);
            record.frames_asked = trial.frames;
            record.fall_min = trial.fall_min;
            simulate(&trial, &mut record, is_wanted)
        });
        match catch_unwind(all) {
            Ok(is_done) => is_done.then_some(record),
            Err(panic) => {
                record.broken = Some(format!("crash: {}", message(&*panic)));
                Some(record)
            }
        }
    }
}

/// False if it was not wanted any more.
pub(super) fn simulate(
    trial: &Trial,
    record: &mut Record,
    is_wanted: &mut dyn FnMut() -> bool,
) -> bool {
    let scene = Arc::new(trial.scene.clone());
    let mut watch = Watch::new(trial, scene.clone());
    let started = Simulation::start(scene, trial.settings);
    let (mut simulation, first) = match started {
        Ok(started) => started,
        Err(error) => {
            record.broken = Some(error.to_string());
            return true;
        }
    };
    watch.see(&first, record);
    for _ in 0..trial.frames {
        if record.broken.is_some() {
            break;
        }
        if record.cpu_seconds > CPU_BUDGET {
            record.is_too_slow = true;
            break;
        }
        if !is_wanted() {
            return false;
        }
        match simulation.advance() {
            Ok(frame) => watch.see(&frame, record),
            Err(error) => record.broken = Some(error.to_string()),
        }
    }
    true
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("without a word").to_owned()
}
