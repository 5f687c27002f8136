//! Keeps the remesher from putting faces through obstacles.

use glam::DVec3;

use super::motion::ObstacleMotion;
use crate::remesh::{Change, EditGuard};

/// Refuses edits after which more faces cross an obstacle, where it is at the end of its step, than
/// before.
pub struct ObstacleGuard<'a> {
    pub obstacles: &'a [ObstacleMotion],
}

impl ObstacleGuard<'_> {
    fn crossings(&self, faces: &[[DVec3; 3]]) -> usize {
        let crossed = |face: &[DVec3; 3]| {
            self.obstacles.iter().filter(|o| o.is_crossed_at_end(*face)).count()
        };
        faces.iter().map(crossed).sum()
    }
}

impl EditGuard for ObstacleGuard<'_> {
    fn allows(&self, change: &Change) -> bool {
        let new = self.crossings(&change.new_faces);
        new == 0 || new <= self.crossings(&change.old_faces)
    }
}
