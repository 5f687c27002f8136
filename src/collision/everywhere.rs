//! Stops cloth at cloth and at obstacles together: what one moves may run into the other.

use glam::DVec3;

use super::cloth::{ClothSearch, Zones, stop_cloth};
use super::resolve::MovedCloth;
use super::stop::{Stops, Surroundings, cut_faces, found_impacts, stop_at_obstacles};

/// Passes over cloth and obstacles in turn; what is left then moves as one with what it meets.
const PASSES: usize = 3;

/// Stops the cloth where it would pass through itself, and then wherever that leads. It has been
/// stopped at the obstacles before: `stops` is what that did, the result what both did.
pub(super) fn stop_everywhere(
    cloth: &mut MovedCloth<'_>,
    search: &mut ClothSearch<'_>,
    around: &Surroundings<'_>,
    mut stops: Stops,
) -> Stops {
    let mut among: Option<Vec<bool>> = None;
    for _ in 0..PASSES {
        let at_cloth = stop_cloth(cloth, search, among.as_deref());
        // Without impacts nothing is left either.
        if at_cloth.impacts == 0 {
            return stops;
        }
        let before: Vec<DVec3> = cloth.position.to_vec();
        let at_obstacles = stop_at_obstacles(cloth, around, Some(&at_cloth.moved));
        stops.impacts += at_cloth.impacts + at_obstacles.impacts;
        stops.unresolved = stops.unresolved.max(at_obstacles.unresolved);
        let moved: Vec<bool> = before.iter().zip(&*cloth.position).map(|(a, b)| a != b).collect();
        if !at_cloth.is_left && !moved.contains(&true) {
            return stops;
        }
        // What is left may not be among those that moved last.
        among = (!at_cloth.is_left).then_some(moved);
    }
    let of_obstacles =
        |cloth: &MovedCloth<'_>, among: Option<&[bool]>| found_impacts(cloth, around, among);
    let left = Zones::new(cloth).settle(cloth, search, around.obstacles, of_obstacles);
    stops.unresolved = left + cut_faces(cloth, around.obstacles);
    stops
}
