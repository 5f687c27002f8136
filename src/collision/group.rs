//! Corners of a surface in groups that lie together, so that many are dismissed at once.

use glam::DVec3;

use super::nearest::bounds;

/// Corners in a ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    pub corners: Vec<usize>,
    /// Of a ball around them.
    pub centre: DVec3,
    /// (m).
    pub radius: f64,
}

/// At most so many corners in a group: about what it costs to ask for the group itself.
const CORNERS_MAX: usize = 32;

impl Group {
    /// The corners in groups, halved along the longest side of their box.
    pub fn divided(mut corners: Vec<usize>, positions: &[DVec3]) -> Vec<Self> {
        if corners.len() <= CORNERS_MAX {
            return vec![Self::around(corners, positions)];
        }
        let places: Vec<DVec3> = corners.iter().map(|&c| positions[c]).collect();
        let axis = bounds(&places).extents().max_position();
        // Corners at the same place keep their order.
        corners.sort_by(|&a, &b| positions[a][axis].total_cmp(&positions[b][axis]));
        let upper = corners.split_off(corners.len() / 2);
        let mut groups = Self::divided(corners, positions);
        groups.extend(Self::divided(upper, positions));
        groups
    }

    /// The same corners where they are now.
    pub fn around(corners: Vec<usize>, positions: &[DVec3]) -> Self {
        let places: Vec<DVec3> = corners.iter().map(|&c| positions[c]).collect();
        let centre = bounds(&places).center();
        let radius = places.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
        Self { corners, centre, radius }
    }
}
