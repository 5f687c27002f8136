//! The solid a camera sees.

use glam::DVec3;

use super::View;

/// A half space: the points x with normal . x <= offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HalfSpace {
    /// Unit, outward.
    pub normal: DVec3,
    pub offset: f64,
}

impl HalfSpace {
    fn through(point: DVec3, outward: DVec3) -> Self {
        let normal = outward.normalize();
        Self { normal, offset: normal.dot(point) }
    }

    /// Signed distance (m), positive outside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// The convex solid between near and far plane and the four sides of the gate.
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum {
    view: View,
    /// Near, far, left, right, bottom, top.
    pub(super) sides: [HalfSpace; SIDE_COUNT],
    pub(super) corners: [DVec3; 8],
}

pub(super) const SIDE_COUNT: usize = 6;

/// An edge of the frustum: its two corners, and the two sides that meet in it.
pub(super) struct Edge {
    pub corners: [usize; 2],
    pub sides: [usize; 2],
}

const fn edge(corners: [usize; 2], sides: [usize; 2]) -> Edge {
    Edge { corners, sides }
}

pub(super) const EDGES: [Edge; 12] = [
    edge([0, 1], [0, 4]),
    edge([1, 2], [0, 3]),
    edge([2, 3], [0, 5]),
    edge([3, 0], [0, 2]),
    edge([4, 5], [1, 4]),
    edge([5, 6], [1, 3]),
    edge([6, 7], [1, 5]),
    edge([7, 4], [1, 2]),
    edge([0, 4], [2, 4]),
    edge([1, 5], [3, 4]),
    edge([2, 6], [3, 5]),
    edge([3, 7], [2, 5]),
];

impl Frustum {
    pub fn of(view: &View) -> Self {
        let View { eye, right, up, back, gate_min, gate_max, .. } = *view;
        let sides = [
            HalfSpace::through(eye - back * view.near, back),
            HalfSpace::through(eye - back * view.far, -back),
            HalfSpace::through(eye, -(right + back * gate_min.x)),
            HalfSpace::through(eye, right + back * gate_max.x),
            HalfSpace::through(eye, -(up + back * gate_min.y)),
            HalfSpace::through(eye, up + back * gate_max.y),
        ];
        let corners = corners_between(view, view.near, view.far);
        Self { view: *view, sides, corners }
    }

    /// World positions (m): left bottom, right bottom, right top, left top of the near plane, then
    /// of the far plane.
    pub fn corners(&self) -> [DVec3; 8] {
        self.corners
    }

    /// As [`Frustum::corners`], with the far plane moved to `depth` (m): a far plane at the horizon
    /// makes a poor drawing.
    pub fn corners_to_depth(&self, depth: f64) -> [DVec3; 8] {
        corners_between(&self.view, self.view.near, depth)
    }

    /// Pairs of indices into the corners, one for each edge of the solid.
    pub fn edges() -> [[usize; 2]; 12] {
        EDGES.map(|e| e.corners)
    }
}

fn corners_between(view: &View, near: f64, far: f64) -> [DVec3; 8] {
    let (low, high) = (view.gate_min, view.gate_max);
    let at =
        |x: f64, y: f64, depth: f64| view.eye + (view.right * x + view.up * y - view.back) * depth;
    std::array::from_fn(|i| {
        let depth = if i < 4 { near } else { far };
        let x = if matches!(i % 4, 1 | 2) { high.x } else { low.x };
        let y = if i % 4 >= 2 { high.y } else { low.y };
        at(x, y, depth)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::tests::sample_view;

    #[test]
    fn each_edge_lies_in_the_two_sides_it_names() {
        let frustum = Frustum::of(&sample_view());
        for edge in &EDGES {
            for corner in edge.corners {
                for (index, side) in frustum.sides.iter().enumerate() {
                    let d = side.distance(frustum.corners[corner]);
                    assert!(d < 1e-9, "corner {corner} is outside of side {index}");
                    assert!(!edge.sides.contains(&index) || d.abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn the_corners_are_the_corners_of_the_image() {
        let view = sample_view();
        let corners = Frustum::of(&view).corners_to_depth(3.0);
        let [width, height] = view.resolution.map(f64::from);
        for (corner, pixel) in [(4, [0.0, height]), (5, [width, height]), (6, [width, 0.0])] {
            let projected = view.point_in_image(corners[corner]).unwrap();
            assert!((projected - glam::DVec2::from_array(pixel)).length() < 1e-9);
        }
    }
}
