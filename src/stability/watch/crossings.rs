//! Faces that cross, each pair tried.

use std::sync::Arc;

use glam::DVec3;

use crate::collision::Shape;
use crate::math::triangles_cross;
use crate::mesh::{Id, Mesh};
use crate::sim::Frame;

/// A face of the cloth: nodes numbered over all garments, corners (m), and the box around them.
struct Face {
    nodes: [usize; 3],
    corners: [DVec3; 3],
    low: DVec3,
    high: DVec3,
}

/// Pairs of faces without a common node that cross.
pub fn crossing_pairs(garments: &[Arc<Mesh>]) -> usize {
    let mut faces = faces(garments);
    faces.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
    let mut count = 0;
    for (index, first) in faces.iter().enumerate() {
        // Those behind it begin farther along x than all before them.
        let near = faces[index + 1..].iter().take_while(|second| second.low.x <= first.high.x);
        count += near.filter(|second| first.crosses(second)).count();
    }
    count
}

/// Faces of the cloth that an obstacle's surface cuts, counted for each obstacle by itself.
pub fn cut_faces(frame: &Frame, shapes: &[Shape]) -> usize {
    let mut count = 0;
    for (shape, pose) in shapes.iter().zip(&frame.obstacle_poses) {
        let own = pose.inverse();
        let is_cut =
            |face: &Face| shape.is_crossed_by(face.corners.map(|p| own.transform_point(p)));
        count += faces(&frame.garments).iter().filter(|face| is_cut(face)).count();
    }
    count
}

fn faces(garments: &[Arc<Mesh>]) -> Vec<Face> {
    let mut all = Vec::new();
    let mut first = 0;
    for mesh in garments {
        for face in mesh.face_ids() {
            let corners = mesh.face_positions(face);
            all.push(Face {
                nodes: mesh.face_nodes(face).map(|n| first + n.index()),
                corners,
                low: corners[0].min(corners[1]).min(corners[2]),
                high: corners[0].max(corners[1]).max(corners[2]),
            });
        }
        first += mesh.node_count();
    }
    all
}

impl Face {
    fn crosses(&self, other: &Face) -> bool {
        self.low.cmple(other.high).all()
            && other.low.cmple(self.high).all()
            && !self.nodes.iter().any(|n| other.nodes.contains(n))
            && triangles_cross(self.corners, other.corners)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Pose;
    use crate::stability::stage::{ball, square};

    fn flat(height: f64) -> Arc<Mesh> {
        Arc::new(square(0.1, |u| u.extend(height)))
    }

    #[test]
    fn sheets_that_cross_are_found_and_those_apart_are_not() {
        let upright = Arc::new(square(0.1, |u| DVec3::new(u.x, 0.013, u.y)));
        assert_eq!(crossing_pairs(&[flat(0.0), flat(0.01)]), 0);
        // The line in which they cross runs through every column of either: 6 squares, 11 or more
        // triangles of each.
        assert!(crossing_pairs(&[flat(0.003), upright]) >= 11);
    }

    #[test]
    fn faces_with_a_common_node_do_not_cross_whatever_they_look_like() {
        assert_eq!(crossing_pairs(&[flat(0.0)]), 0);
    }

    #[test]
    fn faces_that_a_ball_cuts_are_counted_for_each_ball() {
        let frame = |height: f64| Frame {
            garments: vec![flat(height)],
            obstacle_poses: vec![Pose::IDENTITY; 2],
            ..Frame::default()
        };
        let shapes = [Shape::new(&ball(0.2)), Shape::new(&ball(0.1))];
        assert_eq!(cut_faces(&frame(0.201), &shapes), 0);
        let [both, one] = [&shapes[..], &shapes[..1]].map(|s| cut_faces(&frame(0.03), s));
        assert!(one >= 12 && both > one, "{one} {both}");
    }
}
