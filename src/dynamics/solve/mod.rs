//! Solving a step's matrix.
//!
//! Cloth in short steps gives matrices that conjugate gradients solve in a few dozen iterations,
//! behind an incomplete factorisation that costs next to nothing. Stiff cloth in long steps does
//! not: then the matrix is factorised, once a frame if that lasts, for a factor of an earlier step
//! is the best preconditioner there is. Which way is taken depends on counts of iterations alone,
//! never on clocks.

mod conjugate;
mod direct;
mod incomplete;
mod permuted;
#[cfg(test)]
mod tests;

use glam::DVec3;
use thiserror::Error;

use super::matrix::BlockMatrix;
use crate::scene::SolverChoice;
use conjugate::{Budget, ConjugateGradients, Outcome};
use direct::DirectSolver;
use incomplete::IncompleteFactor;

/// Why a matrix has no solution.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum SolveError {
    #[error("the matrix is not positive definite at node {node}")]
    NotPositiveDefinite { node: usize },
    #[error("the factor of {nodes} nodes does not fit in memory")]
    TooLarge { nodes: usize },
}

/// Solves block matrices; keeps all buffers, and what is known of the matrix, between solutions.
#[derive(Debug, Default)]
pub struct LinearSolver {
    choice: SolverChoice,
    patience: Patience,
    direct: DirectSolver,
    incomplete: IncompleteFactor,
    conjugate: ConjugateGradients,
    preconditioner: Preconditioner,
    /// The complete factor is that of the matrix last solved, and no other has been announced.
    is_factor_current: bool,
    failures: Failures,
    counts: SolverCounts,
}

/// What did not converge since the solver last forgot.
#[derive(Clone, Copy, Debug, Default)]
struct Failures {
    incomplete: u32,
    outdated_factor: u32,
}

/// A preconditioner that has failed so often is not tried again: one bad matrix says nothing of the
/// next, two say it is the cloth.
const FAILURES_MAX: u32 = 2;

/// How long iterations are given a chance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Patience {
    /// As long as a factorisation would take.
    #[default]
    Long,
    /// A third of that and only once, and no factor of an earlier matrix is tried. For cloth of
    /// which some faces are far stiffer than the rest, others in every matrix: it takes hundreds of
    /// iterations or few.
    Short,
}

/// What stands ready to precondition with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Preconditioner {
    /// Nothing, and not enough is known against iterating.
    #[default]
    None,
    /// An incomplete factor of the matrix.
    Incomplete,
    /// Iterations were too many; no factor yet.
    Needed,
    /// A factor of this or an earlier matrix.
    Factor,
}

/// What solving took, since the solver was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SolverCounts {
    /// Patterns analysed.
    pub analyses: usize,
    /// Complete factorisations.
    pub factorisations: usize,
    /// Iterations of conjugate gradients.
    pub iterations: usize,
}

/// How good a solution must be: iterations end when the residual is `tolerance` of the right side,
/// both in the norm of the preconditioner, which is about that of the energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    pub tolerance: f64,
    /// What the right side counts as at least, its norm squared (J): where it all but vanishes, a
    /// share of it would be next to nothing.
    pub least: f64,
}

impl Accuracy {
    /// To see which contacts hold.
    pub const ROUGH: Self = Self { tolerance: 1e-3, least: 0.0 };
    /// To move the cloth. On a garment in motion velocities are then off by about 0.1 mm/s.
    pub const FINE: Self = Self { tolerance: 1e-5, least: 0.0 };

    /// The same, with a right side of `energy` (J) at least.
    pub fn of_at_least(self, energy: f64) -> Self {
        Self { least: energy, ..self }
    }
}

/// Iterations with an incomplete factor which cost as much as a complete factorisation, for
/// 5,000 nodes; the price of a factorisation over that of an iteration grows by the root.
const ITERATIONS_AT_5000: f64 = 100.0;

/// Iterations with an outdated complete factor before a new one is cheaper: each is a solution, of
/// which a factorisation costs eight.
const ITERATIONS_WITH_FACTOR: usize = 8;

impl Patience {
    fn iterations_at_5000(self) -> f64 {
        match self {
            Patience::Long => ITERATIONS_AT_5000,
            Patience::Short => 0.3 * ITERATIONS_AT_5000,
        }
    }

    fn incomplete_failures_max(self) -> u32 {
        match self {
            Patience::Long => FAILURES_MAX,
            Patience::Short => 1,
        }
    }

    fn outdated_failures_max(self) -> u32 {
        match self {
            Patience::Long => FAILURES_MAX,
            Patience::Short => 0,
        }
    }
}

impl LinearSolver {
    /// Solves as chosen from now on.
    pub fn set_choice(&mut self, choice: SolverChoice) {
        self.choice = choice;
    }

    /// Is so patient from now on.
    pub fn set_patience(&mut self, patience: Patience) {
        self.patience = patience;
    }

    pub fn counts(&self) -> SolverCounts {
        SolverCounts { analyses: self.direct.analysis_count(), ..self.counts }
    }

    /// Forgets everything that earlier matrices have taught, but keeps buffers and the analysis of
    /// the pattern, which depends on the pattern alone.
    pub fn forget(&mut self) {
        self.preconditioner = Preconditioner::None;
        self.is_factor_current = false;
        self.failures = Failures::default();
    }

    /// Says that the next matrix is another one. Contacts alone make it so: they are far stiffer than
    /// cloth, and an incomplete factor with the wrong ones is worse than none.
    pub fn expect_new_matrix(&mut self) {
        self.is_factor_current = false;
        if self.failures.incomplete < self.patience.incomplete_failures_max() {
            self.preconditioner = Preconditioner::None;
        }
    }

    /// Improves the guess `x` of A x = b until it is the solution.
    ///
    /// # Errors
    /// If the matrix turns out not to be positive definite, or its factor does not fit in memory.
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
        accuracy: Accuracy,
    ) -> Result<(), SolveError> {
        if self.choice == SolverChoice::Direct {
            if !(self.is_factor_current && self.direct.has_pattern_of(matrix)) {
                self.factorize(matrix)?;
            }
            self.solve_with_current_factor(b, x);
            return Ok(());
        }
        match self.preconditioner {
            Preconditioner::None => {
                self.incomplete.factorize(matrix);
                self.preconditioner = Preconditioner::Incomplete;
                self.solve_with_incomplete_factor(matrix, b, x, accuracy)
            }
            Preconditioner::Incomplete => self.solve_with_incomplete_factor(matrix, b, x, accuracy),
            Preconditioner::Needed => self.solve_directly(matrix, b, x),
            Preconditioner::Factor => self.solve_with_factor(matrix, b, x, accuracy),
        }
    }

    /// With the factor of an earlier matrix, if it lasts.
    fn solve_with_factor(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
        accuracy: Accuracy,
    ) -> Result<(), SolveError> {
        let is_given_up = self.failures.outdated_factor >= self.patience.outdated_failures_max();
        if is_given_up || !self.direct.has_pattern_of(matrix) {
            return self.solve_directly(matrix, b, x);
        }
        let budget = Budget { accuracy, iterations: ITERATIONS_WITH_FACTOR };
        let direct = &mut self.direct;
        let apply = |r: &[DVec3], z: &mut [DVec3]| {
            z.copy_from_slice(r);
            direct.solve(z);
        };
        let outcome = self.conjugate.solve(matrix, b, x, apply, budget);
        if self.has_converged(outcome) {
            return Ok(());
        }
        self.failures.outdated_factor += 1;
        self.solve_directly(matrix, b, x)
    }

    fn solve_with_incomplete_factor(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
        accuracy: Accuracy,
    ) -> Result<(), SolveError> {
        let growth = (b.len() as f64 / 5e3).sqrt().max(0.5);
        let iterations = (self.patience.iterations_at_5000() * growth) as usize;
        let budget = Budget { accuracy, iterations };
        let incomplete = &mut self.incomplete;
        let apply = |r: &[DVec3], z: &mut [DVec3]| incomplete.apply(r, z);
        let outcome = self.conjugate.solve(matrix, b, x, apply, budget);
        if self.has_converged(outcome) {
            return Ok(());
        }
        self.failures.incomplete += 1;
        self.solve_directly(matrix, b, x)
    }

    /// Counts the iterations of an outcome; true if it is a solution.
    fn has_converged(&mut self, outcome: Outcome) -> bool {
        self.counts.iterations += outcome.iterations();
        matches!(outcome, Outcome::Converged { .. })
    }

    fn solve_directly(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
    ) -> Result<(), SolveError> {
        self.factorize(matrix)?;
        self.solve_with_current_factor(b, x);
        Ok(())
    }

    fn factorize(&mut self, matrix: &BlockMatrix) -> Result<(), SolveError> {
        self.preconditioner = Preconditioner::Needed;
        self.is_factor_current = false;
        self.counts.factorisations += 1;
        self.direct.factorize(matrix)?;
        self.preconditioner = Preconditioner::Factor;
        self.is_factor_current = true;
        Ok(())
    }

    fn solve_with_current_factor(&mut self, b: &[DVec3], x: &mut [DVec3]) {
        x.copy_from_slice(b);
        self.direct.solve(x);
    }
}
