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
        let mut first_at: HashMap<[u64; 3], u32> = HashMap::new();
        let mut positions = Vec::new();
        let new_number: Vec<u32> = self
            .positions
            .iter()
            .map(|&p| {
                // Adding zero makes -0 the same as 0.
                let key = p.to_array().map(|x| (x + 0.0).to_bits());
                *first_at.entry(key).or_insert_with(|| {
                    positions.push(p);
                    positions.len() as u32 - 1
                })
            })
            .collect();
        let renumbered = |t: &[u32; 3]| t.map(|v| new_number[v as usize]);
        Self { positions, triangles: self.triangles.iter().map(renumbered).collect() }
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
}
