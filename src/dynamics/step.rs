//! One implicit step: all of it happens, or nothing.
//!
//! The velocity v at the end of the step minimises the incremental potential
//! ([`incremental_energy`](super::energy)); its linearisation at rest, where the step starts, is the
//! step of [`BW98`](crate::papers::BW98).

use glam::DVec3;
use thiserror::Error;

use super::breakaway::CORRECTIONS_MAX;
use super::contact::ContactPoint;
use super::handles::HandleSpring;
use super::iterate::Iterate;
use super::solve::{Accuracy, SolveError};
use super::system::System;
use crate::mesh::Mesh;
use crate::scene::Air;

/// What a step changes, by global node number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepState {
    /// (m, world).
    pub position: Vec<DVec3>,
    /// (m/s, world).
    pub velocity: Vec<DVec3>,
}

/// What acts on the cloth from outside during a step.
#[derive(Clone, Copy, Debug)]
pub struct StepForces<'a> {
    /// Acceleration (m/s^2).
    pub gravity: DVec3,
    pub air: Air,
    /// Their targets are those of the end of the step.
    pub handles: &'a [HandleSpring],
    /// Those that may close during the step.
    pub contacts: &'a [ContactPoint],
}

/// How a step went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepOutcome {
    /// Hinges without an angle, which contributed nothing: one of their faces has collapsed.
    pub degenerate_hinges: usize,
    /// Contacts that pushed.
    pub active_contacts: usize,
    /// Linear systems solved.
    pub solutions: usize,
    /// Iterations of conjugate gradients.
    pub solver_iterations: usize,
    /// Complete factorisations.
    pub factorisations: usize,
    pub convergence: Convergence,
}

/// How the iterations of a step ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Convergence {
    /// One linearised step was asked for, and taken.
    #[default]
    NotAsked,
    /// The last iteration changed no velocity by more than the tolerance.
    Reached,
    /// The iterations were used up.
    IterationsUsedUp,
    /// No share of the last direction lowered the energy any more.
    Stalled,
}

impl Convergence {
    /// Whether the step is what it was asked to be.
    pub fn is_satisfied(self) -> bool {
        matches!(self, Convergence::NotAsked | Convergence::Reached)
    }
}

/// Why a step was not taken. A shorter step may be.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum StepError {
    #[error("the {what} of node {node} is not finite, or too large to be squared")]
    NonFinite { what: &'static str, node: usize },
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl StepForces<'_> {
    /// In a vacuum, without gravity, handles and contacts.
    pub const NONE: Self = Self {
        gravity: DVec3::ZERO,
        air: Air { density: 0.0, velocity: DVec3::ZERO, tangential_drag: 0.0 },
        handles: &[],
        contacts: &[],
    };
}

impl StepState {
    /// Positions and velocities of all garments.
    pub fn gathered(meshes: &[&Mesh]) -> Self {
        let mut state = Self::default();
        for mesh in meshes {
            state.position.extend(mesh.position.iter());
            state.velocity.extend(mesh.velocity.iter());
        }
        state
    }

    /// Writes positions and velocities back to the meshes it was gathered from.
    ///
    /// # Panics
    /// If the meshes have other node counts by now.
    pub fn scatter(&self, meshes: &mut [&mut Mesh]) {
        let mut start = 0;
        for mesh in meshes {
            let end = start + mesh.node_count();
            mesh.position.as_mut_slice().copy_from_slice(&self.position[start..end]);
            mesh.velocity.as_mut_slice().copy_from_slice(&self.velocity[start..end]);
            start = end;
        }
        assert_eq!(start, self.position.len(), "the state has as many nodes as the meshes");
    }

    /// # Errors
    /// The first position or velocity that is not finite, or whose square is not.
    pub fn check_finite(&self) -> Result<(), StepError> {
        finite("position", &self.position)?;
        finite("velocity", &self.velocity)
    }
}

impl System {
    /// Advances by `dt` (s): one backward Euler step at the stiffness of its start, linearised or
    /// iterated as [`Dynamics`](crate::scene::Dynamics) asks.
    ///
    /// # Errors
    /// If something is not finite, or the matrix not positive definite. The state is then as it was.
    ///
    /// # Panics
    /// If `dt` is not positive, or the state has another node count than the system.
    pub fn step(
        &mut self,
        state: &mut StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Result<StepOutcome, StepError> {
        state.check_finite()?;
        self.freeze_stiffness(&state.position);
        self.step_frozen(state, forces, dt)
    }

    /// [`step`](Self::step) at the stiffness last frozen.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    ///
    /// # Panics
    /// As [`step`](Self::step).
    pub fn step_frozen(
        &mut self,
        state: &mut StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Result<StepOutcome, StepError> {
        assert!(dt > 0.0, "a step takes time, not {dt} s");
        assert_eq!(state.position.len(), self.node_count(), "positions are those of the system");
        assert_eq!(state.velocity.len(), self.node_count(), "velocities are those of the system");
        state.check_finite()?;
        let before = self.solver.counts();
        let (Iterate { position, velocity }, mut outcome) = match self.iterations_max() {
            0 | 1 => self.linearised_step(state, forces, dt)?,
            _ => self.iterated_step(state, forces, dt)?,
        };
        let mut end = StepState { position, velocity };
        if self.is_limited() {
            self.take_back(&mut end, forces.handles, dt);
        }
        let after = self.solver.counts();
        outcome.solver_iterations = after.iterations - before.iterations;
        outcome.factorisations = after.factorisations - before.factorisations;
        // Checked before anything is written.
        finite("velocity after the step", &end.velocity)?;
        finite("position after the step", &end.position)?;
        *state = end;
        Ok(outcome)
    }

    /// Takes faces back within strain limits, and gives nodes the velocity of what that moves them by.
    fn take_back(&self, end: &mut StepState, handles: &[HandleSpring], dt: f64) {
        let before = end.position.clone();
        if self.take_back_within_limits(&mut end.position, handles, dt).found > 0 {
            let ways = end.position.iter().zip(&before).map(|(now, before)| *now - *before);
            end.velocity.iter_mut().zip(ways).for_each(|(v, way)| *v += way / dt);
        }
    }

    /// Roughly solved until the contacts are what they were taken for, then finely.
    fn linearised_step(
        &mut self,
        start: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Result<(Iterate, StepOutcome), StepError> {
        self.findings.clear();
        let degenerate_hinges = self.assemble(start, forces, dt);
        let free_side = self.right_side.clone();
        let mut active_contacts = self.add_found_contacts(start, forces, dt);
        let mut solutions = 1;
        if !forces.contacts.is_empty() {
            self.solve_change(Accuracy::ROUGH)?;
            while solutions <= CORRECTIONS_MAX && self.examine_contacts(start, forces, dt) {
                self.remove_contacts();
                self.right_side.copy_from_slice(&free_side);
                active_contacts = self.add_found_contacts(start, forces, dt);
                self.solve_change(Accuracy::ROUGH)?;
                solutions += 1;
            }
        }
        // Cloth that hangs or lies still need not be known better than cloth that falls. What holds
        // it there must: the rough solutions look at forces.
        let falling = self.energy_of_falling(forces.gravity * dt);
        self.solve_change(Accuracy::FINE.of_at_least(falling))?;
        let outcome =
            StepOutcome { degenerate_hinges, active_contacts, solutions, ..StepOutcome::default() };
        let begun = Iterate { position: Vec::new(), velocity: start.velocity.clone() };
        Ok((begun.moved(&self.change, 1.0, start, dt), outcome))
    }

    /// dv . M dv of a change of velocity that all nodes share (J).
    fn energy_of_falling(&self, change: DVec3) -> f64 {
        self.masses.iter().sum::<f64>() * change.length_squared()
    }

    /// Adds the contacts as they have been found so far; returns how many push.
    pub(super) fn add_found_contacts(
        &mut self,
        start: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> usize {
        let responses = self.found_responses(start, forces, dt);
        let active = responses.len();
        self.add_contacts(responses.into_iter(), dt);
        active
    }

    /// Solves the system last assembled for `change`, from what that holds on.
    pub(super) fn solve_change(&mut self, accuracy: Accuracy) -> Result<(), StepError> {
        finite("force", &self.right_side)?;
        self.solver.solve(&self.matrix, &self.right_side, &mut self.change, accuracy)?;
        Ok(())
    }
}

/// Of what cannot be squared no length and no energy is known either.
fn finite(what: &'static str, values: &[DVec3]) -> Result<(), StepError> {
    match values.iter().position(|value| !value.length_squared().is_finite()) {
        Some(node) => Err(StepError::NonFinite { what, node }),
        None => Ok(()),
    }
}
