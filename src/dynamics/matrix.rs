//! The matrix of a step: symmetric, of one 3x3 block per pair of nodes that act on one another.
//!
//! Only the lower triangle is stored, by rows, under the global node numbering of all garments.
//! Elements know their blocks' places beforehand, so that assembly never searches.

use std::sync::Arc;

use glam::{DMat3, DVec3};

/// Which pairs of nodes have a block. Equal patterns share one symbolic factorisation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    row_start: Vec<u32>,
    /// Ascending in each row, the diagonal last.
    column: Vec<u32>,
}

impl Pattern {
    /// The pattern with a block for each node and each pair of nodes, named in either order and
    /// as often as they like.
    ///
    /// # Panics
    /// If a pair names a node that is not there.
    pub fn from_pairs(node_count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut fill = vec![0u32; node_count + 1];
        let entries = || {
            let below = pairs.clone().map(|[a, b]| [a.max(b), a.min(b)]).filter(|[r, c]| r != c);
            below.chain((0..node_count as u32).map(|node| [node, node]))
        };
        for [row, _] in entries() {
            fill[row as usize + 1] += 1;
        }
        for row in 0..node_count {
            fill[row + 1] += fill[row];
        }
        let row_start = fill.clone();
        let mut column = vec![0u32; row_start[node_count] as usize];
        for [row, col] in entries() {
            let place = &mut fill[row as usize];
            column[*place as usize] = col;
            *place += 1;
        }
        Self { row_start, column }.without_repeats()
    }

    fn without_repeats(mut self) -> Self {
        let mut kept = 0;
        for row in 0..self.node_count() {
            let range = self.row_range(row);
            self.row_start[row] = kept as u32;
            self.column[range.clone()].sort_unstable();
            for place in range {
                let first_of_row = kept == self.row_start[row] as usize;
                if first_of_row || self.column[kept - 1] != self.column[place] {
                    self.column[kept] = self.column[place];
                    kept += 1;
                }
            }
        }
        *self.row_start.last_mut().expect("there is one start more than rows") = kept as u32;
        self.column.truncate(kept);
        self
    }

    pub fn node_count(&self) -> usize {
        self.row_start.len() - 1
    }

    pub fn block_count(&self) -> usize {
        self.column.len()
    }

    /// The columns of a row's blocks, ascending; the last is the diagonal.
    pub fn row(&self, row: usize) -> &[u32] {
        &self.column[self.row_range(row)]
    }

    /// The slots of a row's blocks, in the order of [`Pattern::row`].
    pub fn row_range(&self, row: usize) -> std::ops::Range<usize> {
        self.row_start[row] as usize..self.row_start[row + 1] as usize
    }

    /// Where the block of two nodes is stored, as that of the larger (row) and the smaller.
    pub fn slot(&self, a: u32, b: u32) -> Option<u32> {
        let (row, col) = (a.max(b) as usize, a.min(b));
        let offset = self.row(row).iter().position(|&c| c == col)?;
        Some(self.row_start[row] + offset as u32)
    }

    pub fn diagonal_slot(&self, node: usize) -> u32 {
        self.row_start[node + 1] - 1
    }

    /// The slots of all M = N (N + 1) / 2 blocks among N nodes given in descending order: of nodes
    /// k and l for each k, for each l from k on, so that k is always the row.
    ///
    /// # Panics
    /// If the pattern lacks one of them.
    pub fn clique_slots<const N: usize, const M: usize>(&self, descending: [u32; N]) -> [u32; M] {
        let mut pairs = (0..N).flat_map(|k| (k..N).map(move |l| (k, l)));
        std::array::from_fn(|_| {
            let (k, l) = pairs.next().expect("M is the number of pairs");
            self.slot(descending[k], descending[l]).expect("the pattern holds every element")
        })
    }
}

/// A symmetric matrix with a pattern.
#[derive(Clone, Debug)]
pub struct BlockMatrix {
    pattern: Arc<Pattern>,
    blocks: Vec<DMat3>,
}

impl BlockMatrix {
    pub fn zero(pattern: Arc<Pattern>) -> Self {
        let blocks = vec![DMat3::ZERO; pattern.block_count()];
        Self { pattern, blocks }
    }

    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// One block per slot; in a row of node i the block at column j is that of (i, j).
    pub fn blocks(&self) -> &[DMat3] {
        &self.blocks
    }

    pub fn set_zero(&mut self) {
        self.blocks.fill(DMat3::ZERO);
    }

    /// Adds to the block at a slot; its row is the larger node.
    pub fn add(&mut self, slot: u32, block: DMat3) {
        self.blocks[slot as usize] += block;
    }

    /// Replaces the block at a slot.
    pub fn set(&mut self, slot: u32, block: DMat3) {
        self.blocks[slot as usize] = block;
    }

    /// A x.
    pub fn product(&self, x: &[DVec3]) -> Vec<DVec3> {
        let mut y = Vec::new();
        self.product_into(x, &mut y);
        y
    }

    /// y = A x, one pass over the lower triangle.
    pub fn product_into(&self, x: &[DVec3], y: &mut Vec<DVec3>) {
        y.clear();
        y.resize(x.len(), DVec3::ZERO);
        for row in 0..self.pattern.node_count() {
            let range = self.pattern.row_range(row);
            let (below, columns) = (range.start..range.end - 1, self.pattern.row(row));
            let mut sum = self.blocks[range.end - 1] * x[row];
            for (block, &col) in self.blocks[below].iter().zip(columns) {
                sum += *block * x[col as usize];
                y[col as usize] += transposed_product(block, x[row]);
            }
            y[row] += sum;
        }
    }
}

/// B^T x.
fn transposed_product(block: &DMat3, x: DVec3) -> DVec3 {
    DVec3::new(block.x_axis.dot(x), block.y_axis.dot(x), block.z_axis.dot(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_names_each_pair_once_and_every_diagonal() {
        let pairs = [[0, 2], [2, 0], [1, 2], [3, 3], [0, 2]];
        let pattern = Pattern::from_pairs(4, pairs.into_iter());
        assert_eq!(pattern.row(0), [0]);
        assert_eq!(pattern.row(2), [0, 1, 2]);
        assert_eq!(pattern.row(3), [3]);
        assert_eq!(pattern.block_count(), 6);
        assert_eq!(pattern.slot(0, 2), pattern.slot(2, 0));
        assert_eq!(pattern.slot(2, 2), Some(pattern.diagonal_slot(2)));
        assert_eq!(pattern.slot(3, 0), None);
    }

    #[test]
    fn the_order_of_pairs_does_not_change_the_pattern() {
        let forward = Pattern::from_pairs(4, [[0, 2], [1, 2], [3, 1]].into_iter());
        let backward = Pattern::from_pairs(4, [[1, 3], [2, 1], [0, 2], [2, 0]].into_iter());
        assert_eq!(forward, backward);
    }

    #[test]
    fn a_matrix_acts_by_its_lower_triangle_and_the_mirror_of_it() {
        let pattern = Arc::new(Pattern::from_pairs(2, [[0, 1]].into_iter()));
        let mut matrix = BlockMatrix::zero(pattern.clone());
        let block = DMat3::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        matrix.add(pattern.slot(0, 1).unwrap(), block);
        let y = matrix.product(&[DVec3::X, DVec3::Y]);
        assert_eq!(y, [block.transpose() * DVec3::Y, block * DVec3::X]);
    }
}
