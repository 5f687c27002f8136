//! A sparse symmetric matrix of numbers, factorised once and solved with often. As in
//! [`solve`](super::solve), here is faer.

use std::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::reborrow::Reborrow;
use faer::sparse::linalg::cholesky::{
    LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

/// L of A = L L^T.
pub(super) struct Factor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    count: usize,
}

impl Factor {
    /// Of a matrix given as a sum of entries (row, column, value), of which those above the diagonal
    /// are not read. `None` if it is not positive definite, or too large for the memory.
    pub fn new(count: usize, mut entries: Vec<(u32, u32, f64)>) -> Option<Self> {
        entries.retain(|&(row, column, _)| row >= column);
        // Stable, so that equal entries are added in the order in which they were named.
        entries.sort_by_key(|&(row, column, _)| (column, row));
        let (mut starts, mut rows) = (vec![0u32; count + 1], Vec::new());
        let mut values: Vec<f64> = Vec::new();
        let mut last = None;
        for (row, column, value) in entries {
            if last == Some((row, column)) {
                *values.last_mut()? += value;
                continue;
            }
            last = Some((row, column));
            rows.push(row);
            values.push(value);
            starts[column as usize + 1] = rows.len() as u32;
        }
        for column in 0..count {
            starts[column + 1] = starts[column + 1].max(starts[column]);
        }
        Self::of_lower(
            &SymbolicSparseColMat::new_checked(count, count, starts, None, rows),
            &values,
        )
    }

    fn of_lower(lower: &SymbolicSparseColMat<u32>, entries: &[f64]) -> Option<Self> {
        let ordering = SymmetricOrdering::Amd;
        let symbolic =
            factorize_symbolic_cholesky(lower.rb(), Side::Lower, ordering, Default::default())
                .ok()?;
        let request = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut scratch = MemBuffer::try_new(request).ok()?;
        let mut values = vec![0.0; symbolic.len_val()];
        symbolic
            .factorize_numeric_llt(
                &mut values,
                SparseColMatRef::new(lower.rb(), entries),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut scratch),
                Default::default(),
            )
            .ok()?;
        Some(Self { symbolic, values, count: lower.nrows() })
    }

    /// Replaces b by A^-1 b.
    ///
    /// # Panics
    /// If b has another length than A.
    pub fn solve(&self, right_side: &mut [f64]) {
        assert_eq!(right_side.len(), self.count, "the right side is as long as the matrix");
        let request = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut scratch = MemBuffer::new(request);
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right_side, self.count, 1),
            Par::Seq,
            MemStack::new(&mut scratch),
        );
    }
}

impl fmt::Debug for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Factor").field("count", &self.count).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_entries_add_up_and_solutions_satisfy_the_equations() {
        // 4 on the diagonal, 1 beside it, each named in two parts; the last row stands alone.
        let mut entries = vec![(4, 4, 4.0)];
        for k in 0..4u32 {
            entries.extend([(k, k, 1.5), (k, k, 2.5)]);
            if k > 0 {
                entries.extend([(k, k - 1, 0.25), (k - 1, k, 7.0), (k, k - 1, 0.75)]);
            }
        }
        let factor = Factor::new(5, entries).unwrap();
        let mut x = [1.0, 2.0, 3.0, 4.0, 5.0];
        factor.solve(&mut x);
        for k in 0..4 {
            let before = if k > 0 { x[k - 1] } else { 0.0 };
            let after = if k < 3 { x[k + 1] } else { 0.0 };
            assert!((4.0 * x[k] + before + after - (k + 1) as f64).abs() < 1e-14);
        }
        assert_eq!(x[4], 1.25);
    }

    #[test]
    fn an_indefinite_matrix_has_no_factor() {
        assert!(Factor::new(2, vec![(0, 0, 1.0), (1, 1, 1.0), (1, 0, 2.0)]).is_none());
    }
}
