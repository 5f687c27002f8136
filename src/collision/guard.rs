//! Keeps the remesher from putting faces through obstacles.

use glam::DVec3;

use super::obstacles::ObstacleMotion;
use crate::remesh::EditGuard;

/// Refuses faces that cross an obstacle where it is at the end of its step.
pub struct ObstacleGuard<'a> {
    pub obstacles: &'a [ObstacleMotion],
}

impl EditGuard for ObstacleGuard<'_> {
    fn allows(&self, new_faces: &[[DVec3; 3]]) -> bool {
        !new_faces.iter().any(|&face| self.obstacles.iter().any(|o| o.is_crossed_at_end(face)))
    }
}
