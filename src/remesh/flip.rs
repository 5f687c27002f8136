//! Flipping edges until the mesh is Delaunay in its metric.

use super::guard::{Change, in_world, keeps_stretch};
use super::{Remesher, VALID_LENGTH_SQUARED};
use crate::mesh::{CornerId, Mesh, aspect_ratio};

/// An edge is flipped if the sine of the sum of its opposite angles is below this: a little below
/// zero, or cocircular corners would flip for ever and a slowly changing metric would flicker.
const FLIP_SINE: f64 = -0.02;

/// Flips per edge visited: more can only be a cycle, as each edge sees a metric of its own.
const FLIPS_PER_SEED_MAX: usize = 16;

impl Remesher<'_> {
    pub(super) fn flip_all(&mut self) {
        let seeds = self.editor.edges().collect();
        self.flip_from(seeds);
    }

    /// Flips the seeds and what their flips disturb. Returns every edge looked at, as it is now.
    pub(super) fn flip_from(&mut self, seeds: Vec<CornerId>) -> Vec<CornerId> {
        let flips_max = seeds.len() * FLIPS_PER_SEED_MAX;
        let mut flips = 0;
        let mut seen = seeds.clone();
        let mut stack = seeds;
        while let Some(corner) = stack.pop() {
            if flips == flips_max {
                continue;
            }
            let Some(change) = self.wanted_flip(corner) else { continue };
            let other = self.editor.mesh().opposite(corner);
            if self.editor.flip(corner).is_err() {
                continue;
            }
            self.guard.note(&change);
            flips += 1;
            let faces = [Some(corner), other].into_iter().flatten().map(CornerId::face);
            for changed in faces.flat_map(|f| f.corners()) {
                stack.push(changed);
                seen.push(changed);
            }
        }
        self.report.flips += flips;
        seen
    }

    /// What flipping changes, if it is allowed, makes the mesh more Delaunay, and does no harm: no
    /// invalid edge, no triangle slimmer than allowed, no intersection.
    fn wanted_flip(&mut self, corner: CornerId) -> Option<Change> {
        let mesh = self.editor.mesh();
        if !self.editor.is_alive(corner.face()) {
            return None;
        }
        let other = mesh.opposite(corner)?;
        if mesh.is_seam(corner)
            || opposite_angle_sine(mesh, corner, other) >= FLIP_SINE
            || self.editor.check_flip(corner).is_err()
        {
            return None;
        }
        let [a, b, p, q] = mesh.diamond(corner, other);
        let new_length = ((mesh.metric[p] + mesh.metric[q]) * 0.5)
            .quadratic_form(mesh.material(q) - mesh.material(p));
        if new_length > VALID_LENGTH_SQUARED && new_length > mesh.metric_length_squared(corner) {
            return None;
        }
        let least_aspect = |faces: [[_; 3]; 2]| {
            let aspect = |f: [_; 3]| aspect_ratio(f.map(|v| mesh.material(v)));
            faces.map(aspect).into_iter().fold(f64::INFINITY, f64::min)
        };
        let new_faces = [[p, a, q], [q, b, p]];
        let new_aspect = least_aspect(new_faces);
        let old_faces = [[p, a, b], [q, b, a]];
        if new_aspect < self.settings.aspect_min && new_aspect < least_aspect(old_faces) {
            return None;
        }
        let change =
            Change { new_faces: in_world(mesh, &new_faces), old_faces: in_world(mesh, &old_faces) };
        let allowed = keeps_stretch(mesh, &new_faces, &old_faces, self.settings.stretch_allowed)
            && self.guard.allows(&change);
        self.report.vetoes += usize::from(!allowed);
        allowed.then_some(change)
    }
}

/// The sine of the sum of the two angles opposite to an edge, measured in the mean metric M of the
/// four vertices; negative where the other diagonal is the better one:
/// sin(a + b) = (|x, y| z^T M w + x^T M y |z, w|) sqrt(det M) / (|x| |y| |z| |w|)_M,
/// with x, y the sides at one tip and z, w those at the other
/// ([`NSO12`](crate::papers::NSO12), anisotropic Delaunay criterion).
fn opposite_angle_sine(mesh: &Mesh, corner: CornerId, other: CornerId) -> f64 {
    let vertices = mesh.diamond(corner, other);
    let metric = vertices.iter().fold(Default::default(), |sum, &v| mesh.metric[v] + sum) * 0.25;
    let [a, b, p, q] = vertices.map(|v| mesh.material(v));
    let (x, y, z, w) = (a - p, b - p, b - q, a - q);
    let lengths = [x, y, z, w].map(|side| metric.quadratic_form(side)).iter().product::<f64>();
    if !(lengths > 0.0) {
        return 0.0;
    }
    let turn =
        x.perp_dot(y) * metric.bilinear_form(z, w) + metric.bilinear_form(x, y) * z.perp_dot(w);
    turn * metric.determinant().max(0.0).sqrt() / lengths.sqrt()
}
