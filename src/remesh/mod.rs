//! Split, collapse and flip until every edge is valid and the mesh is coarse
//! ([`NSO12`](crate::papers::NSO12) section 4).
//!
//! The metric at the vertices says how long an edge may be. Longest edges are split first, shortest
//! collapsed first, ties go to the smaller id: the result depends on nothing but the mesh.

mod collapse;
mod flip;
mod guard;
mod queue;
mod split;

pub use guard::{Change, EditGuard, NoGuard};

use crate::mesh::{Mesh, MeshEditor};

/// What the remesher keeps to besides the metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemeshSettings {
    /// No collapse makes a triangle with a smaller aspect 12 sqrt(3) A / P^2, in material space.
    pub aspect_min: f64,
    /// No collapse makes an edge longer than this in the metric, where 1 is the longest allowed:
    /// the slack keeps the mesh from flickering between split and collapse.
    pub collapsed_edge_max: f64,
    /// Principal stretches, least and largest, that a collapse or flip may give a face whatever was
    /// there before.
    pub stretch_allowed: [f64; 2],
    /// Splitting ends, and is reported, when the mesh has this many faces.
    pub face_count_max: usize,
}

/// A stretch that cloth shows anyway. Compression is more often a fold than strain.
const STRETCH_SHOWN: f64 = 1.05;

impl RemeshSettings {
    /// The same for a fabric whose principal stretches are to stay within ratios: no edit makes
    /// faces beyond them.
    pub fn within(self, [least, largest]: [f64; 2]) -> Self {
        let [_, allowed] = self.stretch_allowed;
        Self { stretch_allowed: [least, largest.min(allowed)], ..self }
    }
}

impl Default for RemeshSettings {
    fn default() -> Self {
        Self {
            aspect_min: 0.2,
            collapsed_edge_max: 0.9,
            stretch_allowed: [0.0, STRETCH_SHOWN],
            face_count_max: 2_000_000,
        }
    }
}

/// What remeshing did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RemeshReport {
    pub splits: usize,
    pub collapses: usize,
    pub flips: usize,
    /// Edits given up for what they would do in the world: stretch, or an intersection that the
    /// guard saw.
    pub vetoes: usize,
    /// Edges longer than 1 in the metric that remain: only at the limit of faces.
    pub invalid_edges: usize,
}

impl RemeshReport {
    pub fn edit_count(&self) -> usize {
        self.splits + self.collapses + self.flips
    }
}

/// Remeshes to the vertex metrics. An edit that the guard refuses is left out; splits leave the
/// surface as it is and are never refused. If there was any, nodes, vertices and faces are numbered
/// anew ([`Mesh::in_local_order`]).
pub fn remesh(
    mesh: Mesh,
    settings: &RemeshSettings,
    guard: &dyn EditGuard,
) -> (Mesh, RemeshReport) {
    let mut remesher = Remesher {
        editor: MeshEditor::new(mesh),
        settings,
        guard,
        report: RemeshReport::default(),
    };
    remesher.flip_all();
    remesher.split_invalid_edges();
    remesher.collapse_short_edges();
    // A collapse, and the flips after it, make only valid edges; what the limit of faces left is
    // all that can remain.
    remesher.report.invalid_edges = remesher.invalid_edge_count();
    let Remesher { editor, report, .. } = remesher;
    let mesh = editor.finish();
    (if report.edit_count() > 0 { mesh.in_local_order() } else { mesh }, report)
}

struct Remesher<'a> {
    editor: MeshEditor,
    settings: &'a RemeshSettings,
    guard: &'a dyn EditGuard,
    report: RemeshReport,
}

impl Remesher<'_> {
    fn invalid_edge_count(&self) -> usize {
        let mesh = self.editor.mesh();
        self.editor
            .edges()
            .filter(|&c| mesh.metric_length_squared(c) > VALID_LENGTH_SQUARED)
            .count()
    }
}

/// An edge is valid up to this squared length in its metric: 1, and what rounding adds to it.
pub const VALID_LENGTH_SQUARED: f64 = 1.0 + 1e-9;

#[cfg(test)]
mod tests;
