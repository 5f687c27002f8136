//! The adaptive run: for its costs alone, beside the simulation.

use super::Previewer;
use crate::preview::engine::Job;
use crate::preview::key::{FrameKey, step_keys};
use crate::preview::message::Event;
use crate::preview::state::Level;
use crate::preview::timeline::Cost;
use crate::sim::SizingMode;

impl Previewer {
    /// Begins or ends the simulation for its costs.
    pub(super) fn measure_adaptive(&mut self, on: bool) {
        self.rival.on = on;
        self.follow_rival();
    }

    /// Costs of other settings are forgotten; those that are asked for are measured. Of a finished run
    /// there is nothing to measure.
    pub(super) fn follow_rival(&mut self) {
        let Some(plan) = self.open.plan.clone() else {
            self.forget_rival();
            return;
        };
        let mut requested = plan.requested.clone();
        requested.settings.sizing = SizingMode::Adaptive;
        let after = |parent: &mut Option<FrameKey>, step| {
            *parent = Some(FrameKey::after(*parent, step));
            *parent
        };
        let keys: Vec<FrameKey> =
            step_keys(&requested, plan.last()).into_iter().scan(None, after).collect();
        if self.rival.keys != keys {
            self.rival.costs = vec![None; keys.len()];
            self.rival.keys = keys.clone();
            self.end_rival();
        }
        if !self.rival.on {
            self.end_rival();
        } else if self.rival.job.is_none() && self.rival.costs.contains(&None) {
            let (scene, settings) = (requested.scene.clone(), requested.settings);
            let job = Job { scene, settings, start: None, frames: keys };
            self.rival.job = Some(self.rival.engine.begin(job));
        }
    }

    fn forget_rival(&mut self) {
        self.end_rival();
        self.rival.on = false;
        self.rival.costs.clear();
        self.rival.keys.clear();
    }

    fn end_rival(&mut self) {
        self.rival.engine.stop();
        self.rival.job = None;
    }

    pub(super) fn take_rival(&mut self, event: Event) {
        match event {
            Event::Simulated { job, frame, .. } if self.rival.job == Some(job) => {
                if let Some(cost) = self.rival.costs.get_mut(frame.number as usize) {
                    *cost = Some(Cost::of(&frame));
                }
            }
            Event::Finished { job } if self.rival.job == Some(job) => self.rival.job = None,
            Event::Failed { job, why, .. } if self.rival.job == Some(job) => {
                self.rival.job = None;
                self.state.say(Level::Warning, format!("the adaptive run stopped: {why}"));
            }
            _ => {}
        }
    }
}
