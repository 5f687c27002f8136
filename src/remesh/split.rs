//! Splitting edges that are too long.

use glam::DVec3;

use super::guard::Change;
use super::queue::EdgeQueue;
use super::{Remesher, VALID_LENGTH_SQUARED};
use crate::mesh::CornerId;

impl Remesher<'_> {
    /// Splits the longest edge in the metric until none is longer than 1, and keeps the mesh
    /// Delaunay meanwhile. Each split halves an edge, so the loop ends; the limit of faces bounds
    /// it against metrics that ask for too much.
    pub(super) fn split_invalid_edges(&mut self) {
        let mut queue = EdgeQueue::default();
        let edges: Vec<CornerId> = self.editor.edges().collect();
        edges.into_iter().for_each(|c| self.queue_if_invalid(&mut queue, c));
        while let Some((corner, priority)) = queue.pop() {
            let length = self.editor.mesh().metric_length_squared(corner);
            if length <= VALID_LENGTH_SQUARED {
                continue;
            }
            if length < priority {
                queue.push(corner, length);
                continue;
            }
            if self.editor.face_count() >= self.settings.face_count_max {
                break;
            }
            let mesh = self.editor.mesh();
            let sides = [Some(corner), mesh.opposite(corner)];
            let old_faces: Vec<[DVec3; 3]> =
                sides.into_iter().flatten().map(|c| mesh.face_positions(c.face())).collect();
            let node = self.editor.split(corner);
            self.report.splits += 1;
            let around: Vec<CornerId> = self.editor.mesh().corners_around(node).collect();
            let mesh = self.editor.mesh();
            let new_faces = around.iter().map(|c| mesh.face_positions(c.face())).collect();
            self.guard.note(&Change { old_faces, new_faces });
            let seeds = around.iter().flat_map(|c| c.face().corners()).collect();
            for changed in self.flip_from(seeds) {
                self.queue_if_invalid(&mut queue, changed);
            }
        }
    }

    fn queue_if_invalid(&self, queue: &mut EdgeQueue, corner: CornerId) {
        let length = self.editor.mesh().metric_length_squared(corner);
        if length > VALID_LENGTH_SQUARED {
            queue.push(corner, length);
        }
    }
}
