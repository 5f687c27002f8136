//! A say in what remeshing does to the surface in the world.

use glam::DVec3;

/// Watches over the surface while it is remeshed.
pub trait EditGuard {
    /// Whether a collapse or a flip may put these faces (m, world) in the place of others.
    fn allows(&self, new_faces: &[[DVec3; 3]]) -> bool;
}

/// Allows everything.
pub struct NoGuard;

impl EditGuard for NoGuard {
    fn allows(&self, _new_faces: &[[DVec3; 3]]) -> bool {
        true
    }
}
