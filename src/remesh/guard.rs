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

/// Whether the new faces' principal stretches are within what is always allowed, or hardly beyond
/// the old ones'. Where cloth is folded, an edit that is harmless in the flat cloth can span a fold
/// askew in the world; the next step would answer with a kick.
pub(super) fn keeps_stretch(
    mesh: &Mesh,
    new_faces: &[[VertexId; 3]],
    old_faces: &[[VertexId; 3]],
    [least_allowed, most_allowed]: [f64; 2],
) -> bool {
    let extremes = |faces: &[[VertexId; 3]]| {
        let stretches = faces.iter().map(|f| mesh.deformation_of(*f).singular_values());
        stretches.fold([f64::INFINITY, 0.0_f64], |[least, most], [major, minor]| {
            [least.min(minor), most.max(major)]
        })
    };
    let [new_least, new_most] = extremes(new_faces);
    if new_least >= least_allowed && new_most <= most_allowed {
        return true;
    }
    let [old_least, old_most] = extremes(old_faces);
    (new_least >= least_allowed || new_least >= old_least)
        && (new_most <= most_allowed || new_most <= old_most)
}

/// The faces in the world.
pub(super) fn in_world(mesh: &Mesh, faces: &[[VertexId; 3]]) -> Vec<[DVec3; 3]> {
    faces.iter().map(|f| f.map(|v| mesh.vertex_position(v))).collect()
}
