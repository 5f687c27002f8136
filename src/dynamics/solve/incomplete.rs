//! An incomplete factorisation: Cholesky's, kept to the blocks that the matrix has.

use glam::{DMat3, DVec3, Mat3, Vec3};

use crate::dynamics::matrix::{BlockMatrix, Pattern};

/// A ~ (D + L) D^-1 (D + L)^T with L below the diagonal and D block diagonal
/// ([`MV77`](crate::papers::MV77)), kept in single precision: it only has to be near.
///
/// Positive definite whatever the matrix: a diagonal block that the omitted blocks would make
/// indefinite is taken as the matrix has it.
#[derive(Debug, Default)]
pub struct IncompleteFactor {
    /// Per row its first block below the diagonal; one more at the end.
    row_start: Vec<u32>,
    column: Vec<u32>,
    below: Vec<Mat3>,
    inverse_diagonal: Vec<Mat3>,
    work: Work,
}

/// Scratch of a factorisation and of an application.
#[derive(Debug, Default)]
struct Work {
    below: Vec<DMat3>,
    inverse_diagonal: Vec<DMat3>,
    /// L_ij D_j^-1 of the row in work.
    scaled: Vec<DMat3>,
    solution: Vec<Vec3>,
    carried: Vec<Vec3>,
}

/// Share of what elimination subtracts from diagonal blocks that is subtracted. Blocks without a
/// place are dropped, and some of them would have added: 0.93 halves the iterations that 1 takes on
/// garments, and 0.97 loses a pivot now and then.
const SUBTRACTED_SHARE: f64 = 0.93;

/// A pivot below this share of the matrix's own is noise.
const PIVOT_SHARE_MIN: f64 = 1e-2;

impl IncompleteFactor {
    /// L_ij = A_ij - sum_k L_ik D_k^-1 L_jk^T, D_i = A_ii - 0.93 sum_k L_ik D_k^-1 L_ik^T, over the
    /// columns k that both rows have.
    pub fn factorize(&mut self, matrix: &BlockMatrix) {
        self.set_pattern(matrix.pattern());
        let work = &mut self.work;
        work.below.clear();
        work.inverse_diagonal.clear();
        for row in 0..matrix.pattern().node_count() {
            let blocks = &matrix.blocks()[matrix.pattern().row_range(row)];
            let start = self.row_start[row] as usize;
            let columns = &self.column[start..self.row_start[row + 1] as usize];
            let (own, below) = blocks.split_last().expect("every row has its diagonal");
            let mut diagonal = *own;
            work.scaled.clear();
            for (place, (&col, block)) in columns.iter().zip(below).enumerate() {
                let col = col as usize;
                let other = self.row_start[col] as usize..self.row_start[col + 1] as usize;
                let eliminated = shared_product(
                    (&columns[..place], &work.scaled),
                    (&self.column[other.clone()], &work.below[other]),
                );
                let entry = *block - eliminated;
                let scaled = entry * work.inverse_diagonal[col];
                diagonal -= times_transposed(&scaled, &entry) * SUBTRACTED_SHARE;
                work.below.push(entry);
                work.scaled.push(scaled);
            }
            work.inverse_diagonal.push(inverse(&diagonal, own));
        }
        self.below.clear();
        self.below.extend(work.below.iter().map(DMat3::as_mat3));
        self.inverse_diagonal.clear();
        self.inverse_diagonal.extend(work.inverse_diagonal.iter().map(DMat3::as_mat3));
    }

    /// z = (D + L)^-T D (D + L)^-1 r.
    pub fn apply(&mut self, r: &[DVec3], z: &mut [DVec3]) {
        let Work { solution, carried, .. } = &mut self.work;
        solution.clear();
        for (row, r) in r.iter().enumerate() {
            let range = self.row_start[row] as usize..self.row_start[row + 1] as usize;
            let mut left = r.as_vec3();
            for (block, &col) in self.below[range.clone()].iter().zip(&self.column[range]) {
                left -= *block * solution[col as usize];
            }
            solution.push(self.inverse_diagonal[row] * left);
        }
        carried.clear();
        carried.resize(r.len(), Vec3::ZERO);
        for row in (0..r.len()).rev() {
            let range = self.row_start[row] as usize..self.row_start[row + 1] as usize;
            let done = solution[row] - self.inverse_diagonal[row] * carried[row];
            for (block, &col) in self.below[range.clone()].iter().zip(&self.column[range]) {
                carried[col as usize] += block.mul_transpose_vec3(done);
            }
            z[row] = done.as_dvec3();
        }
    }

    fn set_pattern(&mut self, pattern: &Pattern) {
        self.row_start.clear();
        self.column.clear();
        self.row_start.push(0);
        for row in 0..pattern.node_count() {
            let columns = pattern.row(row);
            self.column.extend_from_slice(&columns[..columns.len() - 1]);
            self.row_start.push(self.column.len() as u32);
        }
    }
}

/// The sum of a_k b_k^T over the columns k that two rows share, both ascending.
fn shared_product(a: (&[u32], &[DMat3]), b: (&[u32], &[DMat3])) -> DMat3 {
    let mut sum = DMat3::ZERO;
    let mut place = 0;
    for (col, block) in a.0.iter().zip(a.1) {
        while place < b.0.len() && b.0[place] < *col {
            place += 1;
        }
        if place < b.0.len() && b.0[place] == *col {
            sum += times_transposed(block, &b.1[place]);
        }
    }
    sum
}

/// A B^T.
fn times_transposed(a: &DMat3, b: &DMat3) -> DMat3 {
    let column = |x: f64, y: f64, z: f64| a.x_axis * x + a.y_axis * y + a.z_axis * z;
    DMat3::from_cols(
        column(b.x_axis.x, b.y_axis.x, b.z_axis.x),
        column(b.x_axis.y, b.y_axis.y, b.z_axis.y),
        column(b.x_axis.z, b.y_axis.z, b.z_axis.z),
    )
}

/// The inverse of a diagonal block, or of the matrix's own where elimination has left too little of
/// it; a block that is not positive definite itself counts as its diagonal, or 1.
fn inverse(block: &DMat3, own: &DMat3) -> DMat3 {
    let (Some(pivots), Some(own_pivots)) = (pivots(block), pivots(own)) else {
        return if pivots(own).is_some() { own.inverse() } else { DMat3::IDENTITY };
    };
    if pivots.cmpgt(own_pivots * PIVOT_SHARE_MIN).all() { block.inverse() } else { own.inverse() }
}

/// The pivots of a symmetric block; `None` unless all are positive.
fn pivots(block: &DMat3) -> Option<DVec3> {
    let first = block.x_axis.x;
    let (l1, l2) = (block.x_axis.y / first, block.x_axis.z / first);
    let second = block.y_axis.y - l1 * block.x_axis.y;
    let below = block.y_axis.z - l2 * block.x_axis.y;
    let third = block.z_axis.z - l2 * block.x_axis.z - below * below / second;
    let pivots = DVec3::new(first, second, third);
    // Written so that a NaN is refused with the rest.
    (pivots.cmpgt(DVec3::ZERO).all()).then_some(pivots)
}
