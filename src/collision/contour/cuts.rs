//! Faces of cloth that cut an obstacle, or are cut by one, though all their nodes are outside: what
//! leading nodes out leaves, as where a coarse face lies across a limb.
//!
//! An obstacle knows its inside, so that there is no need of contours: the middle of the cut is inside,
//! and leaves by the nearest way.

use glam::DVec3;
use rayon::prelude::*;

use crate::collision::face_tree::Touch;
use crate::collision::motion::ObstacleMotion;
use crate::collision::resolve::{FLOOR_IN_THICKNESSES, MovedCloth, lift_face};
use crate::math::closest_point_on_triangle;
use crate::scene::Contact;

/// A face of the cloth and an obstacle that cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// Number of the obstacle.
    pub obstacle: usize,
    pub face: u32,
    /// Triangles of the obstacle that the face crosses, at least 1.
    pub triangle_count: usize,
    pub nodes: CutNodes,
}

/// Where the nodes of a cut face are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutNodes {
    /// All outside of every obstacle.
    Free,
    /// One or more inside an obstacle: while the node is trapped, the face is.
    Trapped,
}

/// All faces that cross an obstacle at the end of its step, in the order of obstacles and faces.
pub fn cuts(positions: &[DVec3], faces: &[[u32; 3]], obstacles: &[ObstacleMotion]) -> Vec<Cut> {
    let is_inside = |n: &u32| obstacles.iter().any(|o| o.contains_at_end(positions[*n as usize]));
    let of = |(number, obstacle): (usize, &ObstacleMotion)| {
        let cut = |(index, face): (usize, &[u32; 3])| {
            let triangle_count =
                obstacle.crossing_count_at_end(face.map(|n| positions[n as usize]));
            (triangle_count > 0).then(|| {
                let nodes = match face.iter().any(is_inside) {
                    true => CutNodes::Trapped,
                    false => CutNodes::Free,
                };
                Cut { obstacle: number, face: index as u32, triangle_count, nodes }
            })
        };
        let numbered = faces.par_iter().enumerate().with_min_len(64);
        numbered.filter_map(cut).collect::<Vec<_>>()
    };
    obstacles.iter().enumerate().flat_map(of).collect()
}

/// Lifts each cut face whose nodes are free out by the nearest way, by `step` (m) at most; the cloth's approach ends there.
/// One after the other: what an earlier one did for a later one counts.
pub fn lift_cuts(
    cloth: &mut MovedCloth<'_>,
    found: &[Cut],
    obstacles: &[ObstacleMotion],
    settings: &Contact,
    step: f64,
) {
    let floor = FLOOR_IN_THICKNESSES * settings.thickness;
    for cut in found.iter().filter(|cut| cut.nodes == CutNodes::Free) {
        let obstacle = &obstacles[cut.obstacle];
        let nodes = cloth.faces[cut.face as usize].map(|n| n as usize);
        let corners = nodes.map(|n| cloth.position[n]);
        let Some(middle) = obstacle.middle_of_cut_at_end(corners) else { continue };
        let Some(exit) = obstacle.nearest_at_end(middle, f64::INFINITY) else { continue };
        let lift = (floor - exit.signed_distance).clamp(0.0, step);
        let touch = Touch {
            nodes,
            weights: closest_point_on_triangle(middle, corners).barycentric,
            normal: exit.normal,
            signed_distance: exit.signed_distance,
        };
        let surface_velocity = obstacle.surface_velocity(exit.triangle, exit.barycentric);
        lift_face(cloth, &touch, lift, surface_velocity);
    }
}
