//! Judges of frames: energy, crossings, cuts. They look at meshes and obstacles alone, pair by pair,
//! and share with the simulator no more than the test of two triangles.

mod crossings;
mod ledger;

pub use crossings::{crossing_pairs, cut_faces};
pub use ledger::{Balance, Ledger};

use std::sync::Arc;

use super::record::Record;
use super::stress::Trial;
use crate::collision::Shape;
use crate::scene::Scene;
use crate::sim::Frame;

/// Looks at one frame after the other and keeps the worst.
pub struct Watch {
    scene: Arc<Scene>,
    shapes: Vec<Shape>,
    ledger: Ledger,
}

impl Watch {
    pub fn new(trial: &Trial, scene: Arc<Scene>) -> Self {
        let shapes = scene.obstacles.iter().map(|o| Shape::new(&o.surface)).collect();
        let ledger = Ledger::new(trial.passive_from, trial.drive_speed);
        Self { scene, shapes, ledger }
    }

    /// Adds a frame to the record; one that is not finite breaks it.
    pub fn see(&mut self, frame: &Frame, record: &mut Record) {
        let report = &frame.report;
        record.frames_done = frame.number;
        record.cpu_seconds += report.cpu_seconds;
        record.faces = record.faces.max(frame.face_count());
        record.trapped = record.trapped.max(report.trapped_nodes);
        record.unconverged_steps += report.counts.unconverged_steps;
        if frame.number > 0 {
            record.extra_steps += report.steps_taken.saturating_sub(self.scene.steps_per_frame);
        }
        // Halved steps are counted already.
        record.warnings += report.warnings.iter().filter(|w| !w.contains("halved")).count();
        let mut points =
            frame.garments.iter().flat_map(|g| g.position.iter().chain(g.velocity.iter()));
        if !points.all(|p| p.is_finite()) {
            record.broken = Some(format!("not finite at frame {}", frame.number));
            return;
        }
        record.largest_stretch = worse(record.largest_stretch, report.largest_stretch);
        record.crossings_at_end = crossing_pairs(&frame.garments);
        record.crossings = record.crossings.max(record.crossings_at_end);
        record.cuts_at_end = cut_faces(frame, &self.shapes);
        record.cuts = record.cuts.max(record.cuts_at_end);
        self.ledger.enter(frame.number, Balance::of(frame, &self.scene));
        record.energy_gain = self.ledger.gain();
        record.kick = self.scene.stages.remeshing.then(|| self.ledger.kick());
        record.speed_share = self.ledger.speed_share();
        record.fall = self.ledger.fall();
    }
}

/// The larger of two; a NaN is worse than anything.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
