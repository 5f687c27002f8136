//! Scenes for experiments that need the whole simulator.

use std::sync::Arc;

use glam::DVec3;

use super::GRAVITY;
use crate::mesh::Mesh;
use crate::scene::{
    Air, Contact, Dynamics, Fabric, Garment, Obstacle, Pose, Scene, SizingSettings, StageSwitches,
    Surface, ViewSettings,
};

/// How an experiment solves its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Once, as by default.
    Linearised,
    /// Until nothing changes any more.
    Iterated,
}

impl Step {
    pub const ALL: [Step; 2] = [Step::Iterated, Step::Linearised];

    /// For the names of claims.
    pub fn prefix(self) -> &'static str {
        match self {
            Step::Linearised => "linearised/",
            Step::Iterated => "",
        }
    }

    /// The settings of the experiment where it iterates.
    pub fn dynamics(self, iterated: Dynamics) -> Dynamics {
        match self {
            Step::Linearised => Dynamics::default(),
            Step::Iterated => iterated,
        }
    }
}

/// In a vacuum, without obstacles and contact of cloth with cloth: 5 ms a step.
pub fn scene(garments: Vec<Garment>) -> Scene {
    Scene {
        name: "experiment".into(),
        fps: 25.0,
        steps_per_frame: 8,
        last_frame: None,
        first_frame: 0,
        gravity: DVec3::NEG_Z * GRAVITY,
        air: Air { density: 0.0, ..Air::default() },
        contact: Contact { thickness: 1e-3, ..Contact::default() },
        dynamics: Dynamics::default(),
        handle_stiffness: 1e6,
        start_perturbation: 0.0,
        stages: StageSwitches { remeshing: false, self_contact: false, ..StageSwitches::default() },
        garments,
        obstacles: Vec::new(),
        motions: Vec::new(),
        handles: Vec::new(),
        viewers: Vec::new(),
    }
}

pub fn garment(mesh: Mesh, fabric: Fabric) -> Garment {
    Garment {
        name: "specimen".into(),
        mesh,
        fabric,
        sizing: SizingSettings::default(),
        view: ViewSettings::default(),
        two_sided: true,
        contact_thickness: None,
    }
}

pub fn obstacle(surface: Surface, placement: Pose) -> Obstacle {
    Obstacle {
        name: "obstacle".into(),
        surface: Arc::new(surface),
        deformation: None,
        placement,
        motion: None,
    }
}

/// A box of half extents around the origin (m).
pub fn block(half: DVec3) -> Surface {
    let corner = |k: u32| {
        let side = |bit: u32| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        DVec3::new(side(0), side(1), side(2)) * half
    };
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    Surface {
        positions: (0..8).map(corner).collect(),
        triangles: quads.into_iter().flat_map(halves).collect(),
    }
}

/// A cube of finer and finer triangles, blown up to a radius (m).
pub fn ball(radius: f64) -> Surface {
    let mut surface = block(DVec3::ONE);
    for _ in 0..3 {
        let mut finer = Surface::default();
        for [a, b, c] in surface.triangles.iter().map(|t| t.map(|v| surface.positions[v as usize]))
        {
            let first = finer.positions.len() as u32;
            finer.positions.extend([a, b, c, a.midpoint(b), b.midpoint(c), c.midpoint(a)]);
            let parts = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];
            finer.triangles.extend(parts.map(|t: [u32; 3]| t.map(|v| first + v)));
        }
        surface = finer.welded();
    }
    surface.positions.iter_mut().for_each(|p| *p = p.normalize() * radius);
    surface
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_closed_and_faces_outward() {
        let block = block(DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(block.open_edge_count(), 0);
        for t in &block.triangles {
            let [a, b, c] = t.map(|k| block.positions[k as usize]);
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "{t:?}");
        }
    }
}
