//! Preconditioned conjugate gradients.

use glam::DVec3;

use super::Accuracy;
use crate::dynamics::matrix::BlockMatrix;

/// Vectors that are kept between solutions.
#[derive(Debug, Default)]
pub struct ConjugateGradients {
    residual: Vec<DVec3>,
    preconditioned: Vec<DVec3>,
    direction: Vec<DVec3>,
    product: Vec<DVec3>,
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    pub accuracy: Accuracy,
    pub iterations: usize,
}

/// How the iterations ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    Converged {
        iterations: usize,
    },
    UsedUp {
        iterations: usize,
    },
    /// The matrix is not positive definite along a direction, or something is not finite.
    Indefinite {
        iterations: usize,
    },
}

impl Outcome {
    pub fn iterations(self) -> usize {
        match self {
            Outcome::Converged { iterations }
            | Outcome::UsedUp { iterations }
            | Outcome::Indefinite { iterations } => iterations,
        }
    }
}

impl ConjugateGradients {
    /// Improves the guess `x` of A x = b; `precondition` writes its inverse times the first into
    /// the second.
    ///
    /// The norm of a residual r is sqrt(r.z) with z the preconditioned r: close to the energy norm
    /// of the error, which weighs what the forces would notice.
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
        mut precondition: impl FnMut(&[DVec3], &mut [DVec3]),
        budget: Budget,
    ) -> Outcome {
        let count = b.len();
        for buffer in [&mut self.preconditioned, &mut self.direction] {
            buffer.clear();
            buffer.resize(count, DVec3::ZERO);
        }
        precondition(b, &mut self.preconditioned);
        let Accuracy { tolerance, least } = budget.accuracy;
        let goal = tolerance * tolerance * dot(b, &self.preconditioned).max(least);
        let mut squared = self.start(matrix, b, x, &mut precondition);
        for iterations in 0..=budget.iterations {
            if squared <= goal {
                return Outcome::Converged { iterations };
            }
            if iterations == budget.iterations {
                break;
            }
            matrix.product_into(&self.direction, &mut self.product);
            let curvature = dot(&self.direction, &self.product);
            // Written so that a NaN is refused with the rest.
            if !(curvature > 0.0 && curvature.is_finite()) {
                return Outcome::Indefinite { iterations };
            }
            let length = squared / curvature;
            add(x, &self.direction, length);
            add(&mut self.residual, &self.product, -length);
            precondition(&self.residual, &mut self.preconditioned);
            let next = dot(&self.residual, &self.preconditioned);
            let turn = next / squared;
            squared = next;
            for (d, z) in self.direction.iter_mut().zip(&self.preconditioned) {
                *d = *z + *d * turn;
            }
        }
        Outcome::UsedUp { iterations: budget.iterations }
    }

    /// Residual and first direction at the guess, or at 0 where that is the better guess: cloth at
    /// rest does not fall. Returns the residual's squared norm.
    fn start(
        &mut self,
        matrix: &BlockMatrix,
        b: &[DVec3],
        x: &mut [DVec3],
        precondition: &mut impl FnMut(&[DVec3], &mut [DVec3]),
    ) -> f64 {
        self.residual.clear();
        self.residual.extend_from_slice(b);
        self.direction.copy_from_slice(&self.preconditioned);
        let at_zero = dot(b, &self.preconditioned);
        if x.iter().all(|x| *x == DVec3::ZERO) {
            return at_zero;
        }
        matrix.product_into(x, &mut self.product);
        add(&mut self.residual, &self.product, -1.0);
        precondition(&self.residual, &mut self.preconditioned);
        let at_guess = dot(&self.residual, &self.preconditioned);
        if at_guess <= at_zero {
            self.direction.copy_from_slice(&self.preconditioned);
            return at_guess;
        }
        x.fill(DVec3::ZERO);
        self.residual.copy_from_slice(b);
        at_zero
    }
}

/// a += b s.
fn add(a: &mut [DVec3], b: &[DVec3], s: f64) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += *b * s);
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}
