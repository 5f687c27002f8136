//! Scenes under growing stress, to find where the simulator begins to fail.
//!
//! A [`Stress`] is a small scene with one quantity that grows. At every value the scene is simulated
//! ([`Stress::run`]), each frame is judged from its meshes and obstacles ([`watch`]), and a
//! [`Record`] says what came of it and how that is to be called ([`Verdict`]). Each stress lives in a
//! file of its own.

mod blind;
mod cuts;
mod drape;
mod folds;
mod grading;
mod obstacle_speed;
mod pinch;
mod record;
mod ring;
mod run;
mod slivers;
pub(crate) mod stage;
mod step;
mod stiffness;
mod stress;
pub mod watch;
mod weight;
mod whip;
mod wind;

pub use record::{Flaw, Record, Severity, Verdict};
pub use run::CPU_BUDGET;
pub use stress::{Stress, Trial};

/// All stresses, in the order in which they are listed.
pub fn stresses() -> Vec<Stress> {
    vec![
        step::linearised(),
        step::iterated(),
        stiffness::stress(),
        weight::lighter(),
        weight::heavier(),
        wind::stress(),
        obstacle_speed::stress(),
        pinch::stress(),
        ring::stress(),
        folds::stress(),
        grading::stress(),
        slivers::kept(),
        slivers::remeshed(),
        whip::stress(),
        cuts::stress(),
        blind::stress(),
    ]
}

#[cfg(test)]
mod tests;
