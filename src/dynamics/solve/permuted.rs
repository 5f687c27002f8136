//! A block matrix as scalars in another order of its nodes, for a solver that wants columns.

use glam::DMat3;

use crate::dynamics::matrix::Pattern;

/// The lower triangle's blocks after nodes were given ranks: by column, ascending in each.
#[derive(Debug)]
pub struct PermutedBlocks {
    columns: Vec<Vec<PermutedBlock>>,
    block_count: usize,
}

/// Where the entries of a sparse scalar matrix are, by columns, ascending in each.
#[derive(Debug)]
pub struct ScalarPattern {
    /// Per column its first entry; one more at the end.
    pub starts: Vec<u32>,
    pub rows: Vec<u32>,
}

/// A block of the permuted lower triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PermutedBlock {
    row_rank: u32,
    slot: u32,
    transposed: bool,
}

/// Where a block's three columns start among the scalar values, and whether it is stored as its
/// transpose.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    columns: [u32; 3],
    kind: PlaceKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PlaceKind {
    /// Of a diagonal block only the lower triangle is stored.
    Diagonal,
    AsItIs,
    Transposed,
}

impl PermutedBlocks {
    pub fn new(pattern: &Pattern, rank_of_node: &[u32]) -> Self {
        let mut columns = vec![Vec::new(); pattern.node_count()];
        for row in 0..pattern.node_count() {
            for (slot, &col) in pattern.row_range(row).zip(pattern.row(row)) {
                let (a, b) = (rank_of_node[row], rank_of_node[col as usize]);
                columns[a.min(b) as usize].push(PermutedBlock {
                    row_rank: a.max(b),
                    slot: slot as u32,
                    transposed: a < b,
                });
            }
        }
        for column in &mut columns {
            column.sort_unstable();
        }
        Self { columns, block_count: pattern.block_count() }
    }

    /// The lower scalar triangle, and where each slot's block goes in it.
    pub fn lower_scalars(&self) -> (ScalarPattern, Vec<Place>) {
        let nothing = Place { columns: [0; 3], kind: PlaceKind::AsItIs };
        let mut places = vec![nothing; self.block_count];
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (rank, column) in self.columns.iter().enumerate() {
            for axis in 0..3 {
                for block in column {
                    let place = &mut places[block.slot as usize];
                    place.columns[axis] = rows.len() as u32;
                    place.kind = block.kind(rank);
                    let first = 3 * block.row_rank;
                    let above = if place.kind == PlaceKind::Diagonal { axis as u32 } else { 0 };
                    rows.extend(first + above..first + 3);
                }
                starts.push(rows.len() as u32);
            }
        }
        (ScalarPattern { starts, rows }, places)
    }

    /// The same triangle by rows, which is the upper one by columns.
    pub fn upper_scalars(&self) -> ScalarPattern {
        let mut columns_of_row = vec![Vec::new(); self.columns.len()];
        for (rank, column) in self.columns.iter().enumerate() {
            for block in column {
                columns_of_row[block.row_rank as usize].push(rank as u32);
            }
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (rank, columns) in columns_of_row.iter().enumerate() {
            for axis in 0..3u32 {
                for &column in columns {
                    let length = if column as usize == rank { axis + 1 } else { 3 };
                    rows.extend(3 * column..3 * column + length);
                }
                starts.push(rows.len() as u32);
            }
        }
        ScalarPattern { starts, rows }
    }
}

impl PermutedBlock {
    fn kind(self, column_rank: usize) -> PlaceKind {
        match self.transposed {
            _ if self.row_rank as usize == column_rank => PlaceKind::Diagonal,
            true => PlaceKind::Transposed,
            false => PlaceKind::AsItIs,
        }
    }
}

impl Place {
    /// Writes the block among the values of the lower scalar triangle.
    pub fn scatter(&self, block: &DMat3, values: &mut [f64]) {
        let transpose = block.transpose();
        let stored = if self.kind == PlaceKind::Transposed { &transpose } else { block };
        for (axis, &start) in self.columns.iter().enumerate() {
            let column = stored.col(axis).to_array();
            let kept = if self.kind == PlaceKind::Diagonal { &column[axis..] } else { &column };
            values[start as usize..start as usize + kept.len()].copy_from_slice(kept);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scalars_stand_where_the_ranks_put_them() {
        let pattern = Pattern::from_pairs(2, [[0, 1]].into_iter());
        let diagonal = DMat3::from_diagonal(glam::DVec3::new(1.0, 2.0, 3.0));
        let mixed = DMat3::from_cols_array(&[11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 19.0]);
        for (ranks, first_column) in [([0, 1], [11.0, 12.0, 13.0]), ([1, 0], [11.0, 14.0, 17.0])] {
            let (lower, places) = PermutedBlocks::new(&pattern, &ranks).lower_scalars();
            let mut values = vec![0.0; lower.rows.len()];
            for (place, block) in places.iter().zip([diagonal, mixed, diagonal]) {
                place.scatter(&block, &mut values);
            }
            assert_eq!(lower.rows[..6], [0, 1, 2, 3, 4, 5]);
            assert_eq!(values[..3], [1.0, 0.0, 0.0]);
            assert_eq!(values[3..6], first_column);
            assert_eq!(lower.starts, [0, 6, 11, 15, 18, 20, 21]);
        }
    }

    #[test]
    fn the_upper_triangle_is_the_lower_one_by_rows() {
        let pattern = Pattern::from_pairs(4, [[0, 1], [1, 3], [0, 2]].into_iter());
        let blocks = PermutedBlocks::new(&pattern, &[2, 0, 3, 1]);
        let entries = |p: &ScalarPattern| -> Vec<(u32, u32)> {
            let column = |c: usize| p.starts[c] as usize..p.starts[c + 1] as usize;
            (0..12)
                .flat_map(|c| column(c).map(move |k| (c as u32, k)))
                .map(|(c, k)| (p.rows[k], c))
                .collect()
        };
        let mut mirrored: Vec<_> =
            entries(&blocks.lower_scalars().0).into_iter().map(|(r, c)| (c, r)).collect();
        mirrored.sort_unstable_by_key(|&(r, c)| (c, r));
        assert_eq!(entries(&blocks.upper_scalars()), mirrored);
    }
}
