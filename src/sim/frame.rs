//! One finished frame: what the simulation publishes and everything downstream reads.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use super::SimError;
use crate::collision::Resolution;
use crate::mesh::Mesh;
use crate::scene::{Pose, Scene, Surface};

/// The state at the end of a frame: all that the next one depends on besides shot and settings.
/// Never changes once published.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Frames since the start; 0 is the start itself.
    pub number: u32,
    /// (s).
    pub time: f64,
    /// In the order of the scene's garments.
    pub garments: Vec<Arc<Mesh>>,
    /// World from obstacle space, in the order of the scene's obstacles.
    pub obstacle_poses: Vec<Pose>,
    /// By the obstacle's number, the points in its own space (m) where they move by themselves.
    pub obstacle_points: BTreeMap<u32, Arc<Vec<DVec3>>>,
    /// Per handle of the scene and node of it, where the node was when the handle took hold
    /// (m, world); `None` while it has not.
    pub handle_anchors: Vec<Vec<Option<DVec3>>>,
    pub report: FrameReport,
}

impl Frame {
    /// The points of an obstacle in its own space (m); `at_rest` is its surface at first.
    pub fn points_of_obstacle<'a>(&'a self, number: usize, at_rest: &'a Surface) -> &'a [DVec3] {
        let moved = u32::try_from(number).ok().and_then(|n| self.obstacle_points.get(&n));
        moved.map_or(at_rest.positions.as_slice(), |points| points.as_slice())
    }

    pub fn face_count(&self) -> usize {
        self.garments.iter().map(|g| g.face_count()).sum()
    }

    pub fn vertex_count(&self) -> usize {
        self.garments.iter().map(|g| g.vertex_count()).sum()
    }

    pub fn node_count(&self) -> usize {
        self.garments.iter().map(|g| g.node_count()).sum()
    }

    /// The principal stretch minus 1 that no more than such a share of the material area exceeds: with
    /// share 0 the largest of all faces. 0 without cloth.
    pub fn stretch_of_all_but(&self, share: f64) -> f64 {
        let faces = self.garments.iter().flat_map(|mesh| mesh.face_ids().map(move |f| (mesh, f)));
        let mut stretches: Vec<(f64, f64)> = faces
            .map(|(mesh, f)| {
                let [major, _] = mesh.deformation_gradient(f).singular_values();
                (major - 1.0, mesh.material_area(f))
            })
            .collect();
        stretches.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        let allowed = share * stretches.iter().map(|(_, area)| area).sum::<f64>();
        let mut beyond = 0.0;
        let mut most_stretched_first = stretches.iter();
        let reached = most_stretched_first.find(|(_, area)| {
            beyond += area;
            beyond > allowed
        });
        reached.or(stretches.last()).map_or(0.0, |(stretch, _)| *stretch)
    }

    /// # Errors
    /// If there are more or fewer of anything than in the scene.
    pub(super) fn check_belongs_to(&self, scene: &Scene) -> Result<(), SimError> {
        let anchors = self.handle_anchors.iter().map(Vec::len);
        let held = scene.handles.iter().map(|h| h.nodes.len());
        for (what, found, expected) in [
            ("garments", self.garments.len(), scene.garments.len()),
            ("obstacles", self.obstacle_poses.len(), scene.obstacles.len()),
            ("handles", self.handle_anchors.len(), scene.handles.len()),
            ("nodes in handles", anchors.sum(), held.sum()),
        ] {
            if found != expected {
                return Err(SimError::OtherScene { frame: self.number, what, found, expected });
            }
        }
        Ok(())
    }
}

/// What a frame cost and how it went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameReport {
    pub stages: StageSeconds,
    pub counts: StageCounts,
    /// Process CPU time over the frame (s).
    pub cpu_seconds: f64,
    pub view_factor_min: f64,
    /// Weighted by material area.
    pub view_factor_mean: f64,
    /// Pairs of triangles that intersect at the end of the frame: of cloth with cloth, and of cloth with
    /// obstacles. `None` where cloth may pass through cloth.
    pub intersections: Option<usize>,
    /// Steps taken; more than asked for where steps were halved.
    pub steps_taken: u32,
    /// Largest principal stretch of a face minus 1.
    pub largest_stretch: f64,
    /// Stretch and bending energy of all cloth at the end of the frame (J).
    pub elastic_energy: f64,
    /// Kinetic energy of all cloth at the end of the frame (J).
    pub kinetic_energy: f64,
    /// Nodes inside an obstacle at the end of the frame, as between two parts that overlap.
    pub trapped_nodes: usize,
    /// What went wrong and was mended, in words.
    pub warnings: Vec<String>,
}

impl FrameReport {
    /// Takes in what leading cloth out of obstacles did, and says in how many places it could not be
    /// stopped.
    pub(super) fn note(&mut self, done: Resolution) {
        self.counts.impacts += done.impacts as u64;
        if done.unresolved > 0 {
            self.warnings.push(format!(
                "cloth passes through obstacles or cloth in {} places that leave it no way out",
                done.unresolved
            ));
        }
    }
}

/// What the stages did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageCounts {
    /// Contacts that pushed in the last step.
    pub contacts: u64,
    /// Features that had to be led out of obstacles, or stopped at obstacles or other cloth.
    pub impacts: u64,
    /// Most hinges in a step that had lost their angle and resisted nothing.
    pub degenerate_hinges: u64,
    pub splits: u64,
    pub collapses: u64,
    pub flips: u64,
    /// Collapses and flips left out for what they would do in the world.
    pub vetoes: u64,
    /// Linear systems solved: one a step, and more where contacts or iterations ask for them.
    pub solutions: u64,
    /// Iterations of conjugate gradients.
    pub solver_iterations: u64,
    /// Complete factorisations.
    pub factorisations: u64,
    /// Steps that did not converge in the iterations allowed; linearised steps do not try to.
    pub unconverged_steps: u64,
}

impl StageCounts {
    /// Changes of the mesh.
    pub fn edits(&self) -> u64 {
        self.splits + self.collapses + self.flips
    }

    /// Names as in `stats.csv`, and values in that order.
    pub fn entries(&self) -> [(&'static str, u64); 11] {
        // Exhaustive, so that a new count cannot be forgotten here.
        let Self {
            contacts,
            impacts,
            degenerate_hinges,
            splits,
            collapses,
            flips,
            vetoes,
            solutions,
            solver_iterations,
            factorisations,
            unconverged_steps,
        } = *self;
        [
            ("contacts", contacts),
            ("impacts", impacts),
            ("degenerate_hinges", degenerate_hinges),
            ("splits", splits),
            ("collapses", collapses),
            ("flips", flips),
            ("vetoes", vetoes),
            ("solutions", solutions),
            ("solver_iterations", solver_iterations),
            ("factorisations", factorisations),
            ("unconverged_steps", unconverged_steps),
        ]
    }
}

/// Wall seconds by stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageSeconds {
    pub obstacles: f64,
    pub proximity: f64,
    pub dynamics: f64,
    pub collision: f64,
    pub sizing: f64,
    pub view: f64,
    pub remesh: f64,
    pub untangle: f64,
    pub other: f64,
}

impl StageSeconds {
    /// Names as in `stats.csv` without `_s`, and values in that order.
    pub fn entries(&self) -> [(&'static str, f64); 9] {
        // Exhaustive, so that a new stage cannot be forgotten here.
        let Self {
            obstacles,
            proximity,
            dynamics,
            collision,
            sizing,
            view,
            remesh,
            untangle,
            other,
        } = *self;
        [
            ("obstacles", obstacles),
            ("proximity", proximity),
            ("dynamics", dynamics),
            ("collision", collision),
            ("sizing", sizing),
            ("view", view),
            ("remesh", remesh),
            ("untangle", untangle),
            ("other", other),
        ]
    }

    pub fn total(&self) -> f64 {
        self.entries().iter().map(|(_, seconds)| seconds).sum()
    }
}

/// Fills in what can be read off the finished garments.
pub(super) fn measure(garments: &[Mesh], report: &mut FrameReport) {
    let (mut area, mut weighted, mut least) = (0.0, 0.0, f64::INFINITY);
    let mut largest_stretch: f64 = 0.0;
    for mesh in garments {
        for face in mesh.face_ids() {
            let face_area = mesh.material_area(face);
            area += face_area;
            weighted += face_area * mesh.view_factor[face];
            least = least.min(mesh.view_factor[face]);
            largest_stretch =
                largest_stretch.max(mesh.deformation_gradient(face).singular_values()[0]);
        }
    }
    report.view_factor_min = if least.is_finite() { least } else { 1.0 };
    report.view_factor_mean = if area > 0.0 { weighted / area } else { 1.0 };
    report.largest_stretch = largest_stretch - 1.0;
}
