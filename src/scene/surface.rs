//! The surface of a solid, as files give it.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

/// Triangles without connectivity; counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// (m), in the solid's own space.
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The same surface with points at the same place made one, as where patches meet.
    #[must_use]
    pub fn welded(&self) -> Self {
        let welding = Welding::new([self.positions.as_slice()]);
        Self {
            positions: welding.welded(&self.positions),
            triangles: self.triangles.iter().map(|t| welding.renumbered(*t)).collect(),
        }
    }

    /// Edges with a triangle on one side only, or two that run the same way: 0 for a closed
    /// surface. Inside and outside mean nothing beside such an edge.
    pub fn open_edge_count(&self) -> usize {
        let welded = self.welded();
        let directed: HashSet<(u32, u32)> = welded
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
            .filter(|(a, b)| a != b)
            .collect();
        directed.iter().filter(|&&(a, b)| !directed.contains(&(b, a))).count()
    }
}

/// Which points are one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Welding {
    new_number: Vec<u32>,
    /// The first of the points that became one.
    first: Vec<u32>,
}

impl Welding {
    /// Points are one that are at the same place in each of the arrays, which are equally long;
    /// nothing without arrays.
    pub fn new<'a>(arrays: impl IntoIterator<Item = &'a [DVec3]>) -> Self {
        let mut welding: Option<Self> = None;
        for positions in arrays {
            let before = welding.map(|w| w.new_number).unwrap_or(vec![0; positions.len()]);
            welding = Some(Self::finer(&before, positions));
        }
        welding.unwrap_or(Self { new_number: Vec::new(), first: Vec::new() })
    }

    fn finer(before: &[u32], positions: &[DVec3]) -> Self {
        let mut known: HashMap<(u32, [u64; 3]), u32> = HashMap::new();
        let mut first = Vec::new();
        let number = |(point, (&p, &group)): (usize, (&DVec3, &u32))| {
            // Adding zero makes -0 the same as 0.
            let key = (group, p.to_array().map(|x| (x + 0.0).to_bits()));
            *known.entry(key).or_insert_with(|| {
                first.push(point as u32);
                first.len() as u32 - 1
            })
        };
        let new_number = positions.iter().zip(before).enumerate().map(number).collect();
        Self { new_number, first }
    }

    /// One of each group of points that are one.
    pub fn welded(&self, positions: &[DVec3]) -> Vec<DVec3> {
        self.first.iter().map(|&point| positions[point as usize]).collect()
    }

    pub fn renumbered(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|v| self.new_number[v as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Surface {
        Surface {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        }
    }

    #[test]
    fn a_closed_surface_has_no_open_edge_even_if_its_points_are_not_shared() {
        let closed = tetrahedron();
        assert_eq!(closed.open_edge_count(), 0);
        let corners = closed.triangles.iter().flatten();
        let apart = Surface {
            positions: corners.map(|&v| closed.positions[v as usize]).collect(),
            triangles: (0..4).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        };
        assert_eq!(apart.open_edge_count(), 0);
        assert_eq!(apart.welded().positions.len(), 4);
    }

    #[test]
    fn a_missing_or_inverted_triangle_leaves_three_open_edges() {
        let mut holed = tetrahedron();
        holed.triangles.pop();
        assert_eq!(holed.open_edge_count(), 3);
        let mut inverted = tetrahedron();
        inverted.triangles[0].swap(0, 1);
        assert_eq!(inverted.open_edge_count(), 3);
    }
    #[test]
    fn points_that_part_later_are_not_welded() {
        let together = [DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::ZERO];
        let apart = [DVec3::Y, DVec3::Y, DVec3::X, DVec3::ZERO];
        let welding = Welding::new([together.as_slice(), apart.as_slice()]);
        assert_eq!(welding.renumbered([0, 1, 3]), [0, 0, 2]);
        assert_eq!(welding.welded(&apart), [DVec3::Y, DVec3::X, DVec3::ZERO]);
    }
}
