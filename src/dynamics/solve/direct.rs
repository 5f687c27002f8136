//! A sparse Cholesky factorisation. Only here: faer.
//!
//! Nodes, not scalars, are ordered (approximate minimum degree on the graph of blocks): half the time
//! for the same fill. The blocks are scattered into the permuted scalar matrix through a
//! map made once per pattern, so that a refactorisation neither orders nor allocates.

use std::fmt;
use std::sync::Arc;

use super::SolveError;
use super::permuted::{PermutedBlocks, Place, ScalarPattern};
use crate::dynamics::matrix::{BlockMatrix, Pattern};
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::reborrow::Reborrow;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use glam::{DMat3, DVec3};

/// Factorises block matrices and solves with the last factor; keeps all buffers while the pattern
/// stands.
#[derive(Default)]
pub struct DirectSolver {
    analysis: Option<Analysis>,
    analysis_count: usize,
}

/// What depends on the pattern only, and buffers of the right size.
struct Analysis {
    pattern: Arc<Pattern>,
    order: NodeOrder,
    /// Lower triangle of the permuted scalar matrix, by columns.
    lower: SymbolicSparseColMat<u32>,
    places: Vec<Place>,
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    factor: Vec<f64>,
    factorized: bool,
    right_side: Vec<f64>,
    scratch: MemBuffer,
}

/// The order in which nodes are eliminated.
#[derive(Debug)]
struct NodeOrder {
    node_of_rank: Vec<u32>,
    rank_of_node: Vec<u32>,
}

impl DirectSolver {
    /// How often a new pattern had to be analysed.
    pub fn analysis_count(&self) -> usize {
        self.analysis_count
    }

    /// Whether the last pattern analysed is this matrix's.
    pub fn has_pattern_of(&self, matrix: &BlockMatrix) -> bool {
        self.analysis.as_ref().is_some_and(|analysis| {
            Arc::ptr_eq(&analysis.pattern, matrix.pattern())
                || analysis.pattern == *matrix.pattern()
        })
    }

    /// Prepares [`solve`](Self::solve). Analyses the pattern only if it is not the last one's.
    ///
    /// # Errors
    /// If a pivot is not positive; nothing can then be solved.
    pub fn factorize(&mut self, matrix: &BlockMatrix) -> Result<(), SolveError> {
        if !self.has_pattern_of(matrix) {
            self.analysis = None;
            self.analysis = Some(Analysis::new(matrix.pattern().clone())?);
            self.analysis_count += 1;
        }
        let analysis = self.analysis.as_mut().expect("the pattern was just analysed");
        analysis.factorize(matrix.blocks())
    }

    /// Replaces b by A^-1 b.
    ///
    /// # Panics
    /// Unless the last call of [`factorize`](Self::factorize) succeeded, with a matrix as large.
    pub fn solve(&mut self, right_side: &mut [DVec3]) {
        let analysis = self.analysis.as_mut().expect("a matrix was factorised");
        analysis.solve(right_side);
    }
}

impl fmt::Debug for DirectSolver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DirectSolver").field("analysis_count", &self.analysis_count).finish()
    }
}

impl Analysis {
    fn new(pattern: Arc<Pattern>) -> Result<Self, SolveError> {
        let nodes = pattern.node_count();
        let too_large = |_| SolveError::TooLarge { nodes };
        let order = NodeOrder::minimum_degree(&pattern).map_err(too_large)?;
        let blocks = PermutedBlocks::new(&pattern, &order.rank_of_node);
        let (lower, places) = blocks.lower_scalars();
        let (lower, upper) = (sparse(lower), sparse(blocks.upper_scalars()));
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        // The values are permuted on their way in, so faer has nothing left to order.
        let symbolic = factorize_symbolic_cholesky(
            upper.rb(),
            Side::Upper,
            SymmetricOrdering::Identity,
            params,
        )
        .map_err(too_large)?;
        let scratch = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        Ok(Self {
            values: vec![0.0; lower.row_idx().len()],
            factor: vec![0.0; symbolic.len_val()],
            factorized: false,
            right_side: vec![0.0; 3 * nodes],
            scratch: MemBuffer::try_new(scratch).map_err(|_| SolveError::TooLarge { nodes })?,
            pattern,
            order,
            lower,
            places,
            symbolic,
        })
    }

    fn factorize(&mut self, blocks: &[DMat3]) -> Result<(), SolveError> {
        for (place, block) in self.places.iter().zip(blocks) {
            place.scatter(block, &mut self.values);
        }
        self.factorized = false;
        let matrix = SparseColMatRef::new(self.lower.rb(), &self.values);
        let outcome = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            matrix,
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.scratch),
            Default::default(),
        );
        match outcome {
            Ok(_) => {
                self.factorized = true;
                Ok(())
            }
            Err(LltError::NonPositivePivot { index }) => {
                let rank = (index / 3).min(self.order.node_of_rank.len() - 1);
                let node = self.order.node_of_rank[rank] as usize;
                Err(SolveError::NotPositiveDefinite { node })
            }
        }
    }

    fn solve(&mut self, right_side: &mut [DVec3]) {
        assert!(self.factorized, "the last factorisation failed");
        assert_eq!(right_side.len(), self.order.rank_of_node.len());
        for (b, &rank) in right_side.iter().zip(&self.order.rank_of_node) {
            let start = 3 * rank as usize;
            self.right_side[start..start + 3].copy_from_slice(&b.to_array());
        }
        let count = self.right_side.len();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut self.right_side, count, 1),
            Par::Seq,
            MemStack::new(&mut self.scratch),
        );
        for (b, &rank) in right_side.iter_mut().zip(&self.order.rank_of_node) {
            *b = DVec3::from_slice(&self.right_side[3 * rank as usize..]);
        }
    }
}

fn sparse(pattern: ScalarPattern) -> SymbolicSparseColMat<u32> {
    let count = pattern.starts.len() - 1;
    SymbolicSparseColMat::new_checked(count, count, pattern.starts, None, pattern.rows)
}

impl NodeOrder {
    fn minimum_degree(pattern: &Pattern) -> Result<Self, faer::sparse::FaerError> {
        let nodes = pattern.node_count();
        // The rows of the lower triangle are the columns of the upper one.
        let (mut starts, mut rows) = (vec![0], Vec::with_capacity(pattern.block_count()));
        for row in 0..nodes {
            rows.extend_from_slice(pattern.row(row));
            starts.push(rows.len() as u32);
        }
        let upper = SymbolicSparseColMatRef::new_checked(nodes, nodes, &starts, None, &rows);
        let mut order = Self { node_of_rank: vec![0; nodes], rank_of_node: vec![0; nodes] };
        let mut scratch = MemBuffer::try_new(amd::order_scratch::<u32>(nodes, rows.len()))?;
        amd::order(
            &mut order.node_of_rank,
            &mut order.rank_of_node,
            upper,
            amd::Control::default(),
            MemStack::new(&mut scratch),
        )?;
        Ok(order)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::dynamics::testing::Random;

    /// A positive definite matrix on a ring with a few chords.
    fn sample(nodes: u32, random: &mut Random) -> BlockMatrix {
        let ring = (0..nodes).map(|n| [n, (n + 1) % nodes]);
        let chords = (0..nodes / 3).map(|n| [n, (n * 7 + 3) % nodes]);
        let pattern = Arc::new(Pattern::from_pairs(nodes as usize, ring.chain(chords)));
        let mut matrix = BlockMatrix::zero(pattern.clone());
        fill(&mut matrix, random);
        matrix
    }

    fn fill(matrix: &mut BlockMatrix, random: &mut Random) {
        let pattern = matrix.pattern().clone();
        matrix.set_zero();
        for row in 0..pattern.node_count() {
            for &col in pattern.row(row) {
                let slot = pattern.slot(row as u32, col).unwrap();
                if col as usize == row {
                    matrix.add(slot, DMat3::IDENTITY * 30.0);
                } else {
                    let columns = [(); 3].map(|()| random.vector());
                    matrix.add(slot, DMat3::from_cols(columns[0], columns[1], columns[2]));
                }
            }
        }
    }

    fn dense(matrix: &BlockMatrix) -> DMatrix<f64> {
        let nodes = matrix.pattern().node_count();
        let mut dense = DMatrix::zeros(3 * nodes, 3 * nodes);
        for column in 0..3 * nodes {
            let mut unit = vec![DVec3::ZERO; nodes];
            unit[column / 3][column % 3] = 1.0;
            for (row, value) in matrix.product(&unit).into_iter().enumerate() {
                for axis in 0..3 {
                    dense[(3 * row + axis, column)] = value[axis];
                }
            }
        }
        dense
    }

    fn assert_solves_like_dense(solver: &mut DirectSolver, matrix: &BlockMatrix) {
        let mut random = Random::new(8);
        let mut x: Vec<DVec3> =
            (0..matrix.pattern().node_count()).map(|_| random.vector()).collect();
        let b = DVector::from_iterator(3 * x.len(), x.iter().flat_map(|v| v.to_array()));
        solver.factorize(matrix).unwrap();
        solver.solve(&mut x);
        let expected = dense(matrix).cholesky().expect("positive definite").solve(&b);
        let found = DVector::from_iterator(3 * x.len(), x.iter().flat_map(|v| v.to_array()));
        assert!((found - &expected).norm() < 1e-12 * expected.norm());
    }

    #[test]
    fn solutions_agree_with_a_dense_solve() {
        let mut random = Random::new(6);
        for nodes in [1, 2, 5, 40] {
            let matrix = sample(nodes, &mut random);
            assert_solves_like_dense(&mut DirectSolver::default(), &matrix);
        }
    }

    #[test]
    fn a_pattern_is_analysed_once_while_it_stands_and_again_when_it_changes() {
        let mut random = Random::new(7);
        let mut solver = DirectSolver::default();
        let mut matrix = sample(30, &mut random);
        assert_solves_like_dense(&mut solver, &matrix);
        fill(&mut matrix, &mut random);
        assert_solves_like_dense(&mut solver, &matrix);
        let equal = sample(30, &mut random);
        assert!(!Arc::ptr_eq(equal.pattern(), matrix.pattern()));
        assert_solves_like_dense(&mut solver, &equal);
        assert_eq!(solver.analysis_count(), 1);
        assert_solves_like_dense(&mut solver, &sample(31, &mut random));
        assert_eq!(solver.analysis_count(), 2);
    }

    #[test]
    fn an_indefinite_matrix_is_an_error_that_names_a_node() {
        let mut random = Random::new(9);
        let mut matrix = sample(12, &mut random);
        let slot = matrix.pattern().diagonal_slot(5);
        matrix.add(slot, DMat3::IDENTITY * -100.0);
        let mut solver = DirectSolver::default();
        let error = solver.factorize(&matrix).unwrap_err();
        assert!(matches!(error, SolveError::NotPositiveDefinite { .. }), "{error}");
        matrix.add(slot, DMat3::IDENTITY * 100.0);
        assert_solves_like_dense(&mut solver, &matrix);
    }
}
