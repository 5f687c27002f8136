//! A say in what remeshing does to the surface in the world.

use glam::DVec3;

use crate::mesh::{Mesh, VertexId};

/// Watches over the surface while it is remeshed.
pub trait EditGuard {
    /// Whether a collapse or a flip may put new faces in the place of old ones (m, world).
    fn allows(&self, change: &Change) -> bool;

    /// Takes note of what an edit has done; of splits as well, which nobody asks about.
    fn note(&self, _change: &Change) {}
}

/// What an edit does to the faces in the world (m).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    pub old_faces: Vec<[DVec3; 3]>,
    pub new_faces: Vec<[DVec3; 3]>,
}

/// Allows everything.
pub struct NoGuard;

impl EditGuard for NoGuard {
    fn allows(&self, _change: &Change) -> bool {
        true
    }
}

/// A face that an edit makes may be stretched by this much, whatever stood there before: what
/// cloth shows anyway.
const STRETCH_ALWAYS_ALLOWED: f64 = 1.05;

/// Whether the new faces are stretched hardly more than the old ones. Where cloth is folded, an edit
/// that is harmless in the flat cloth can span a fold askew in the world; the next step would
/// answer with a kick.
pub(super) fn keeps_stretch(
    mesh: &Mesh,
    new_faces: &[[VertexId; 3]],
    old_faces: &[[VertexId; 3]],
) -> bool {
    let largest = |faces: &[[VertexId; 3]]| {
        let stretch = |f: &[VertexId; 3]| mesh.deformation_of(*f).singular_values()[0];
        faces.iter().map(stretch).fold(0.0, f64::max)
    };
    let new = largest(new_faces);
    new <= STRETCH_ALWAYS_ALLOWED || new <= largest(old_faces)
}

/// The faces in the world.
pub(super) fn in_world(mesh: &Mesh, faces: &[[VertexId; 3]]) -> Vec<[DVec3; 3]> {
    faces.iter().map(|f| f.map(|v| mesh.vertex_position(v))).collect()
}
