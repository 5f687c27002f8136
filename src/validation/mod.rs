//! Experiments whose outcome is known exactly, done with the simulator and held against it.
//!
//! An [`Experiment`] makes one or more [`Claim`]s and measures what becomes of them. Each lives in a
//! file of its own, with the formula it is held against. What they are made of: [`sheet`]s of known
//! layout and [`specimen`]s that are clamped, loaded and brought to rest.

pub mod bending;
pub mod buckling;
mod cantilever;
mod cantilever_remeshed;
mod capstan;
mod drape;
mod energy;
mod experiment;
mod fabric;
mod first_mode;
mod free_fall;
mod hanging;
mod incline;
mod momentum;
mod order;
mod patch;
mod popping;
mod remesh_only;
mod roll_up;
pub mod sheet;
pub mod specimen;
pub(crate) mod stage;
mod stick_slip;
pub mod tangle;
mod triangulate;
pub mod way_bounds;
mod wrinkles;

pub use experiment::{Claim, Experiment, ExperimentError, Outcome, Row, Tolerance};

/// All experiments, in the order in which they are listed.
pub fn experiments() -> Vec<Experiment> {
    [
        patch::experiments(),
        hanging::experiments(),
        cantilever::experiments(),
        cantilever_remeshed::experiments(),
        roll_up::experiments(),
        buckling::experiments(),
        wrinkles::experiments(),
        drape::experiments(),
        incline::experiments(),
        stick_slip::experiments(),
        capstan::experiments(),
        free_fall::experiments(),
        momentum::experiments(),
        energy::experiments(),
        first_mode::experiments(),
        order::experiments(),
        remesh_only::experiments(),
        popping::experiments(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Acceleration of free fall (m/s^2).
const GRAVITY: f64 = 9.81;

#[cfg(test)]
mod tests;
