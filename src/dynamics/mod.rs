//! How cloth moves: energies, their derivatives, and one implicit step.
//!
//! A step is a backward Euler step: its end minimises an incremental potential. Linearised once it is
//! that of [`BW98`](crate::papers::BW98):
//! (M + h (h + beta) K_m + h^2 K_g + h D) dv = h (f - (h K + beta K_m) v), then v += dv, x += h v;
//! iterated ([`Dynamics::iterations`](crate::scene::Dynamics)) it is Newton's method with a line
//! search.
//! [`System`] holds what stays while the meshes stay; [`stretch`], [`bending`], [`wind`],
//! [`handles`] and [`contact`] each state a force and a positive semi-definite tangent, so that the
//! matrix is positive definite whatever the state; [`solve`] factorises it. Measured fabrics bend by
//! hinges of their own stiffness, elastic ones by all folds together (`folds`, `plate`).

mod assembly;
pub mod bending;
mod breakaway;
pub mod contact;
pub mod damping;
#[cfg(test)]
mod elastic_tests;
mod energy;
mod factor;
mod folds;
#[cfg(test)]
mod folds_tests;
pub mod handles;
mod iterate;
mod limit_projection;
#[cfg(test)]
mod limit_projection_tests;
pub mod matrix;
mod newton;
#[cfg(test)]
mod newton_tests;
mod plate;
pub mod principal;
pub mod solve;
mod step;
pub mod strain_limit;
pub mod stretch;
mod system;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
pub mod wind;

pub use contact::ContactPoint;
pub use handles::HandleSpring;
pub use limit_projection::TakenBack;
pub use solve::{Accuracy, LinearSolver, SolveError, SolverCounts};
pub use step::{Convergence, StepError, StepForces, StepOutcome, StepState};
pub use system::System;
