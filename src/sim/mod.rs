//! The main loop.
//!
//! ```text
//! start:    refine and relax what was given -> frame 0
//! advance:  for each step    obstacles and handles move -> contacts -> implicit step -> resolve
//!           once             base metric -> view factor -> vertex metric -> remesh
//!           publish          a frame that never changes again
//! ```

mod clock;
mod frame;
mod handles;
mod refine;
mod settings;
mod start;
mod step;

pub use frame::{Frame, FrameReport, StageSeconds};
pub use settings::{SimSettings, SizingMode};
pub use step::SimError;

use std::sync::Arc;

use crate::collision::{FaceTree, Obstacles};
use crate::dynamics::{StepState, System};
use crate::mesh::{FaceId, IdVec, Mesh};
use crate::scene::{Fabric, Pose, Scene};
use clock::StageClock;
use handles::Anchors;
use step::Regime;

/// A shot being simulated: the state after the last published frame.
pub struct Simulation {
    scene: Arc<Scene>,
    settings: SimSettings,
    obstacles: Obstacles,
    garments: Vec<Mesh>,
    cloth: MovingCloth,
    anchors: Anchors,
    frame: u32,
}

/// The garments as the step sees them: one numbering of nodes over all, and what hangs on the
/// topology. Made anew whenever a garment is remeshed.
struct MovingCloth {
    system: System,
    state: StepState,
    /// Material area of each node (m^2).
    area: Vec<f64>,
    faces: Vec<[u32; 3]>,
    tree: FaceTree,
}

impl Simulation {
    /// Prepares frame 0: garments are refined to the sizing and relaxed, then everything is at the
    /// velocities of the scene.
    ///
    /// # Errors
    /// If relaxation turns out not finite even in the smallest steps.
    pub fn start(scene: Arc<Scene>, settings: SimSettings) -> Result<(Self, Frame), SimError> {
        let mut clock = StageClock::start();
        let obstacles = Obstacles::new(&scene);
        let garments: Vec<Mesh> = scene.garments.iter().map(|g| g.mesh.clone()).collect();
        let mut simulation = Self {
            cloth: MovingCloth::new(&scene, &garments),
            anchors: Anchors::new(&scene),
            scene,
            settings,
            obstacles,
            garments,
            frame: 0,
        };
        let mut report = FrameReport::default();
        simulation.settle(&mut clock, &mut report)?;
        let frame = simulation.publish(clock, report);
        Ok((simulation, frame))
    }

    /// Computes the next frame. On error the simulation stays where it was in the failed step and
    /// must not be advanced further.
    ///
    /// # Errors
    /// If a step fails even when halved as often as allowed.
    pub fn advance(&mut self) -> Result<Frame, SimError> {
        let mut clock = StageClock::start();
        let mut report = FrameReport::default();
        let (start, step_time) = (self.time(), self.scene.step_time());
        for step in 0..self.scene.steps_per_frame {
            let time = start + f64::from(step) * step_time;
            self.step(time, step_time, Regime::Motion, &mut clock, &mut report)?;
        }
        self.frame += 1;
        self.cloth.write_back(&mut self.garments);
        if self.is_remeshing() {
            self.refine(&mut clock, &mut report);
        }
        Ok(self.publish(clock, report))
    }

    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Of the last published frame (s).
    pub fn time(&self) -> f64 {
        f64::from(self.frame) * self.scene.frame_time()
    }

    fn is_remeshing(&self) -> bool {
        self.scene.stages.remeshing && !matches!(self.settings.sizing, SizingMode::Uniform { .. })
    }

    fn obstacle_poses(&self) -> Vec<Pose> {
        Obstacles::poses(&self.scene, self.time())
    }

    fn publish(&self, mut clock: StageClock, mut report: FrameReport) -> Frame {
        frame::measure(&self.garments, &mut report);
        report.stages = clock.finish();
        report.cpu_seconds = clock.cpu_seconds();
        Frame {
            number: self.frame,
            time: self.time(),
            garments: self.garments.iter().cloned().map(Arc::new).collect(),
            obstacle_poses: self.obstacle_poses(),
            report,
        }
    }
}

impl MovingCloth {
    fn new(scene: &Scene, garments: &[Mesh]) -> Self {
        let meshes: Vec<&Mesh> = garments.iter().collect();
        let fabrics: Vec<&Fabric> = scene.garments.iter().map(|g| &g.fabric).collect();
        let position = meshes.iter().flat_map(|m| m.position.iter().copied()).collect();
        let velocity = meshes.iter().flat_map(|m| m.velocity.iter().copied()).collect();
        let area = meshes.iter().flat_map(|m| m.node_areas().into_vec()).collect();
        let faces = global_faces(garments);
        let state = StepState { position, velocity };
        Self {
            system: System::new(&meshes, &fabrics),
            tree: FaceTree::new(&state.position, &faces),
            state,
            area,
            faces,
        }
    }

    fn write_back(&self, garments: &mut [Mesh]) {
        let mut first = 0;
        for mesh in garments {
            let nodes = first..first + mesh.node_count();
            mesh.position.as_mut_slice().copy_from_slice(&self.state.position[nodes.clone()]);
            mesh.velocity.as_mut_slice().copy_from_slice(&self.state.velocity[nodes]);
            first += mesh.node_count();
        }
    }
}

/// Nodes of every face in the numbering over all garments.
fn global_faces(garments: &[Mesh]) -> Vec<[u32; 3]> {
    use crate::mesh::Id;
    let mut faces = Vec::new();
    let mut first = 0;
    for mesh in garments {
        let global = |f: FaceId| mesh.face_nodes(f).map(|n| (first + n.index()) as u32);
        faces.extend(mesh.face_ids().map(global));
        first += mesh.node_count();
    }
    faces
}

/// One value per face, for all faces of a mesh.
type PerFace<T> = IdVec<FaceId, T>;

#[cfg(test)]
mod tests;
