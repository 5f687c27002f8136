//! Where a frame's time goes.

use std::time::Instant;

use cpu_time::ProcessTime;

use super::StageSeconds;

/// The stages of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Obstacles,
    Proximity,
    Dynamics,
    Collision,
    Sizing,
    View,
    Remesh,
    Untangle,
}

/// Adds up wall seconds by stage; what no stage claims is `other`.
pub struct StageClock {
    started: Instant,
    cpu_started: ProcessTime,
    seconds: StageSeconds,
}

impl StageClock {
    pub fn start() -> Self {
        Self {
            started: Instant::now(),
            cpu_started: ProcessTime::now(),
            seconds: StageSeconds::default(),
        }
    }

    /// Runs one stage.
    pub fn time<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        let started = Instant::now();
        let result = work();
        *self.slot(stage) += started.elapsed().as_secs_f64();
        result
    }

    /// The stages, which add up to the time since the start.
    pub fn finish(&mut self) -> StageSeconds {
        self.seconds.other = 0.0;
        let total = self.started.elapsed().as_secs_f64();
        self.seconds.other = (total - self.seconds.total()).max(0.0);
        self.seconds
    }

    /// Of the process, since the start.
    pub fn cpu_seconds(&self) -> f64 {
        self.cpu_started.elapsed().as_secs_f64()
    }

    fn slot(&mut self, stage: Stage) -> &mut f64 {
        let s = &mut self.seconds;
        match stage {
            Stage::Obstacles => &mut s.obstacles,
            Stage::Proximity => &mut s.proximity,
            Stage::Dynamics => &mut s.dynamics,
            Stage::Collision => &mut s.collision,
            Stage::Sizing => &mut s.sizing,
            Stage::View => &mut s.view,
            Stage::Remesh => &mut s.remesh,
            Stage::Untangle => &mut s.untangle,
        }
    }
}
