//! Collapsing edges that are shorter than they need be.

use super::Remesher;
use super::guard::{Change, in_world, keeps_stretch};
use super::queue::EdgeQueue;
use crate::mesh::{Collapse, CornerId, Mesh, VertexId, aspect_ratio};

impl Remesher<'_> {
    /// Collapses the shortest edge in the metric until no collapse is allowed. Each takes a node
    /// away, so the loop ends.
    pub(super) fn collapse_short_edges(&mut self) {
        let mut queue = EdgeQueue::default();
        let edges: Vec<CornerId> = self.editor.edges().collect();
        edges.into_iter().for_each(|c| self.queue_if_short(&mut queue, c));
        while let Some((corner, priority)) = queue.pop() {
            if !self.editor.is_alive(corner.face()) {
                continue;
            }
            let length = -self.editor.mesh().metric_length_squared(corner);
            if length < priority {
                // Longer than it was when it was queued.
                self.queue_if_short(&mut queue, corner);
                continue;
            }
            let ways = self.editor.collapses(corner);
            let wanted = ways.into_iter().find_map(|c| Some((c, self.wanted(c)?)));
            let Some((collapse, change)) = wanted else { continue };
            if self.editor.collapse(collapse).is_err() {
                continue;
            }
            self.guard.note(&change);
            self.report.collapses += 1;
            let around = self.editor.mesh().corners_around(collapse.kept);
            let seeds = around.flat_map(|c| c.face().corners()).collect();
            for changed in self.flip_from(seeds) {
                self.queue_if_short(&mut queue, changed);
            }
        }
    }

    /// In a metric that does not vary, an edge longer than the longest a collapse may make cannot
    /// be collapsed: some new edge would be at least as long.
    fn queue_if_short(&self, queue: &mut EdgeQueue, corner: CornerId) {
        let mesh = self.editor.mesh();
        if [mesh.edge_nodes(corner)].iter().flatten().all(|&n| mesh.node_origin(n).is_kept()) {
            return;
        }
        let length = mesh.metric_length_squared(corner);
        if length <= self.settings.collapsed_edge_max * self.settings.collapsed_edge_max {
            queue.push(corner, -length);
        }
    }

    /// What a collapse changes, if it is allowed and does no harm.
    fn wanted(&mut self, collapse: Collapse) -> Option<Change> {
        self.editor.check_collapse(collapse).ok()?;
        let faces: Vec<[VertexId; 3]> = self.moved_faces(collapse);
        let mesh = self.editor.mesh();
        let shapes_kept = self
            .editor
            .moved_corners(collapse)
            .zip(&faces)
            .all(|(corner, &face)| self.is_shape_allowed(mesh, corner, face));
        if !shapes_kept || !self.are_edges_allowed(collapse, &faces) {
            return None;
        }
        let corners = self.editor.moved_corners(collapse);
        let mut old: Vec<_> = corners.map(|c| mesh.face_vertices(c.face())).collect();
        let sides = [Some(collapse.corner), mesh.opposite(collapse.corner)];
        old.extend(sides.into_iter().flatten().map(|c| mesh.face_vertices(c.face())));
        let change = Change { new_faces: in_world(mesh, &faces), old_faces: in_world(mesh, &old) };
        let allowed = keeps_stretch(mesh, &faces, &old, self.settings.stretch_allowed)
            && self.guard.allows(&change);
        self.report.vetoes += usize::from(!allowed);
        allowed.then_some(change)
    }

    /// The faces that change, as they would be, each beginning with the kept node's vertex.
    fn moved_faces(&self, collapse: Collapse) -> Vec<[VertexId; 3]> {
        let mesh = self.editor.mesh();
        let replacements = self.editor.replacements(collapse);
        let replaced = |old: VertexId| {
            replacements.iter().flatten().find(|(from, _)| *from == old).map_or(old, |(_, to)| *to)
        };
        self.editor
            .moved_corners(collapse)
            .map(|c| {
                [
                    replaced(mesh.vertex_at(c)),
                    mesh.vertex_at(c.next()),
                    mesh.vertex_at(c.previous()),
                ]
            })
            .collect()
    }

    /// A face may be slim only if it was already slimmer.
    fn is_shape_allowed(&self, mesh: &Mesh, corner: CornerId, face: [VertexId; 3]) -> bool {
        let aspect = aspect_ratio(face.map(|v| mesh.material(v)));
        aspect >= self.settings.aspect_min
            || (aspect > ASPECT_FLOOR && aspect >= aspect_ratio(mesh.face_material(corner.face())))
    }

    /// Every edge that the collapse makes must be short enough; the two edges onto which others
    /// fall exist already.
    fn are_edges_allowed(&self, collapse: Collapse, faces: &[[VertexId; 3]]) -> bool {
        let mesh = self.editor.mesh();
        let length_max = self.settings.collapsed_edge_max * self.settings.collapsed_edge_max;
        let tips = [Some(collapse.corner), mesh.opposite(collapse.corner)]
            .map(|side| side.map(|c| mesh.node_at(c)));
        faces.iter().all(|&[kept, next, previous]| {
            [next, previous].into_iter().all(|end| {
                let mean = (mesh.metric[kept] + mesh.metric[end]) * 0.5;
                tips.contains(&Some(mesh.node_of(end)))
                    || mean.quadratic_form(mesh.material(end) - mesh.material(kept)) <= length_max
            })
        })
    }
}

/// Below this aspect a face is numerically flat, whatever it was before.
const ASPECT_FLOOR: f64 = 1e-3;
