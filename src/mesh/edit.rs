//! Local edits: split, collapse, flip.

use super::Mesh;

/// Edits a mesh.
pub struct MeshEditor<'a> {
    mesh: &'a mut Mesh,
}

impl<'a> MeshEditor<'a> {
    pub fn new(mesh: &'a mut Mesh) -> Self {
        Self { mesh }
    }

    pub fn mesh(&self) -> &Mesh {
        self.mesh
    }
}
