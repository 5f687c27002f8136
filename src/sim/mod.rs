//! The main loop.
//!
//! ```text
//! start:    take apart, refine and relax what was given -> frame 0
//! advance:  buckling of what nobody sees
//!           for each step    obstacles and handles move -> contacts -> implicit step -> resolve
//!           once             base metric -> view factor -> vertex metric -> remesh -> strain limits
//!                            -> untangle
//!           publish          a frame that never changes again
//! ```
//!
//! # From frame to frame
//! The bits of a frame depend on the scene, the settings and the published frame before it, on
//! nothing else: not on the frames before that one, nor on the number of threads. What a simulation
//! keeps from frame to frame beyond that (what the solver knows of the matrix, the tree of faces)
//! is a function of them or forgotten when a frame begins. So a simulation that is taken up from any
//! of its frames goes on with the bits of one that never stopped.

mod clock;
mod frame;
mod handles;
mod limits;
mod perturb;
mod refine;
mod settings;
mod start;
mod step;
mod trial;
mod untangle;

pub use frame::{Frame, FrameReport, StageCounts, StageSeconds};
pub use settings::{SimSettings, SizingMode};
pub use step::SimError;
pub use trial::TrialStep;

use std::sync::Arc;

use crate::collision::{
    ClothContact, Depth, FaceTree, NearMemory, ObstacleMotion, Obstacles, Resolution,
};
use crate::dynamics::{StepState, System};
use crate::mesh::{FaceId, IdVec, Mesh};
use crate::scene::{Fabric, Garment, Pose, Scene};
use clock::{Stage, StageClock};
use handles::{Anchors, HeldNodes};
use step::Regime;
use untangle::Moment;

/// A shot being simulated: the state after the last published frame.
pub struct Simulation {
    scene: Arc<Scene>,
    settings: SimSettings,
    obstacles: Obstacles,
    garments: Vec<Mesh>,
    cloth: MovingCloth,
    anchors: Anchors,
    frame: u32,
    /// Of the last published frame, see [`FrameReport`]; 0 where they are not counted.
    intersections: usize,
}

/// The garments as the step sees them: one numbering of nodes over all, and what hangs on the
/// topology. Made anew whenever a garment is remeshed.
struct MovingCloth {
    system: System,
    state: StepState,
    /// Material area of each node (m^2).
    area: Vec<f64>,
    /// How far each node is held off (m).
    thickness: Vec<f64>,
    faces: Vec<[u32; 3]>,
    tree: FaceTree,
    near: NearMemory,
    /// `None` where cloth passes through cloth.
    own: Option<ClothContact>,
    held: HeldNodes,
}

impl Simulation {
    /// Prepares frame 0: garments are refined to the sizing and relaxed, then everything is at the
    /// velocities of the scene.
    ///
    /// # Errors
    /// If relaxation turns out not finite even in the smallest steps.
    pub fn start(scene: Arc<Scene>, settings: SimSettings) -> Result<(Self, Frame), SimError> {
        let started = Self::start_while(scene, settings, &|| true)?;
        Ok(started.expect("nobody has put an end to it"))
    }

    /// As [`Simulation::start`], but asks before each step of relaxation whether to go on. `None` where
    /// not.
    ///
    /// # Errors
    /// As [`Simulation::start`].
    pub fn start_while(
        scene: Arc<Scene>,
        settings: SimSettings,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<(Self, Frame)>, SimError> {
        let mut clock = StageClock::start();
        let obstacles = Obstacles::new(&scene);
        let garments: Vec<Mesh> =
            scene.garments.iter().map(|g| g.mesh.clone().in_local_order()).collect();
        let mut simulation = Self {
            cloth: MovingCloth::new(&scene, &garments),
            anchors: Anchors::new(&scene),
            scene,
            settings,
            obstacles,
            garments,
            frame: 0,
            intersections: 0,
        };
        let mut report = FrameReport::default();
        simulation.take_apart_at_start(&mut clock, &mut report);
        simulation.warn_of_bending(&mut report);
        if simulation.settle(goes_on, &mut clock, &mut report)?.is_break() {
            return Ok(None);
        }
        simulation.perturb();
        simulation.cloth.refit();
        clock.time(Stage::Collision, || simulation.clear_obstacles(&mut report));
        simulation.take_back_within_limits(&mut clock, &mut report);
        simulation.untangle(Moment::Start, &mut clock, &mut report);
        let frame = simulation.publish(clock, report);
        Ok(Some((simulation, frame)))
    }

    /// Goes on from a published frame of the same scene and settings.
    ///
    /// # Errors
    /// If the frame is that of another scene.
    pub fn from_frame(
        scene: Arc<Scene>,
        settings: SimSettings,
        frame: &Frame,
    ) -> Result<Self, SimError> {
        frame.check_belongs_to(&scene)?;
        let garments: Vec<Mesh> = frame.garments.iter().map(|g| (**g).clone()).collect();
        Ok(Self {
            cloth: MovingCloth::new(&scene, &garments),
            obstacles: Obstacles::new(&scene),
            anchors: Anchors::published(&frame.handle_anchors),
            scene,
            settings,
            garments,
            frame: frame.number,
            intersections: frame.report.intersections.unwrap_or(0),
        })
    }

    /// Computes the next frame. On error the simulation stays where it was in the failed step and
    /// must not be advanced further.
    ///
    /// # Errors
    /// If a step fails even when halved as often as allowed.
    pub fn advance(&mut self) -> Result<Frame, SimError> {
        let frame = self.advance_while(&|| true)?;
        Ok(frame.expect("nobody has put an end to it"))
    }

    /// As [`Simulation::advance`], but asks before each step whether to go on. `None` where not: the
    /// simulation stays between two frames and must not be advanced further.
    ///
    /// # Errors
    /// As [`Simulation::advance`].
    pub fn advance_while(&mut self, goes_on: &dyn Fn() -> bool) -> Result<Option<Frame>, SimError> {
        let mut clock = StageClock::start();
        let mut report = FrameReport::default();
        self.begin_frame(&mut clock);
        let (start, step_time) = (self.time(), self.scene.step_time());
        for step in 0..self.scene.steps_per_frame {
            if !goes_on() {
                return Ok(None);
            }
            let time = start + f64::from(step) * step_time;
            self.step(time, step_time, Regime::Motion, &mut clock, &mut report)?;
        }
        // What is measured and compared is the cloth's own energy.
        self.cloth.system.lift_compensation();
        self.frame += 1;
        self.cloth.write_back(&mut self.garments);
        if self.is_remeshing() {
            self.refine(&mut clock, &mut report);
        }
        clock.time(Stage::Collision, || self.clear_obstacles(&mut report));
        self.take_back_within_limits(&mut clock, &mut report);
        self.untangle(Moment::Frame, &mut clock, &mut report);
        Ok(Some(self.publish(clock, report)))
    }

    /// From what is published to what the steps need.
    fn begin_frame(&mut self, clock: &mut StageClock) {
        self.cloth.forget_the_past(&self.garments, clock);
        clock.time(Stage::View, || self.compensate_buckling());
        clock.time(Stage::Untangle, || self.let_go_of_tangles());
    }

    /// Cloth that is inside an obstacle, however deep, is led out once a frame: where a coarse face
    /// had sagged into one, a split makes nodes there.
    fn clear_obstacles(&mut self, report: &mut FrameReport) {
        report.note(self.led_out_of_obstacles());
    }

    fn led_out_of_obstacles(&mut self) -> Resolution {
        if self.obstacles.is_empty() || !self.scene.stages.collision {
            return Resolution::default();
        }
        let obstacles = self.obstacles_at_rest();
        let start = self.cloth.state.position.clone();
        let done = self.cloth.lead_out(&start, &obstacles, &self.scene.contact, Depth::Any);
        if done.impacts > 0 {
            self.cloth.write_back(&mut self.garments);
        }
        done
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

    /// The obstacles where they are at the current frame.
    fn obstacles_at_rest(&mut self) -> Vec<ObstacleMotion> {
        let now = self.time();
        self.obstacles.moving(&self.scene, [now, now], self.scene.step_time())
    }

    fn obstacle_poses(&self) -> Vec<Pose> {
        Obstacles::poses(&self.scene, self.time())
    }

    fn publish(&self, mut clock: StageClock, mut report: FrameReport) -> Frame {
        frame::measure(&self.garments, &mut report);
        self.warn_of_limits(&mut report);
        report.elastic_energy = self.cloth.system.potential_energy(&self.cloth.state);
        report.kinetic_energy = self.cloth.system.kinetic_energy(&self.cloth.state);
        report.stages = clock.finish();
        report.cpu_seconds = clock.cpu_seconds();
        Frame {
            number: self.frame,
            time: self.time(),
            garments: self.garments.iter().cloned().map(Arc::new).collect(),
            obstacle_poses: self.obstacle_poses(),
            obstacle_points: self.scene.moved_points(self.time()),
            handle_anchors: self.anchors.points().to_vec(),
            report,
        }
    }
}

impl MovingCloth {
    fn new(scene: &Scene, garments: &[Mesh]) -> Self {
        let meshes: Vec<&Mesh> = garments.iter().collect();
        let fabrics: Vec<&Fabric> = scene.garments.iter().map(|g| &g.fabric).collect();
        let state = StepState::gathered(&meshes);
        let faces = global_faces(garments);
        // Only obstacles and other cloth ask for faces.
        let is_asked = !scene.obstacles.is_empty() || scene.stages.self_contact;
        let tree = FaceTree::new(&state.position, if is_asked { &faces } else { &[] });
        let own =
            scene.stages.self_contact.then(|| ClothContact::new(garments, &tree, &state.position));
        let mut system = System::new(&meshes, &fabrics);
        if !scene.stages.strain_limiting {
            system.lift_strain_limits();
        }
        system.set_dynamics(scene.dynamics);
        Self {
            system,
            tree,
            own,
            thickness: thickness_of_nodes(scene, garments),
            area: meshes.iter().flat_map(|m| m.node_areas().into_vec()).collect(),
            near: NearMemory::new(state.position.len(), scene.obstacles.len()),
            held: HeldNodes::new(scene, garments),
            state,
            faces,
        }
    }

    /// Takes in that garments have been remeshed. What the solver knows about the pattern of the
    /// matrix is kept where the pattern is the same.
    fn renew(&mut self, scene: &Scene, garments: &[Mesh]) {
        let old = std::mem::replace(self, Self::new(scene, garments));
        self.system.set_solver(old.system.into_solver());
    }

    /// Becomes what a new one of the published garments would be. Which of several nearest faces
    /// is found depends on the tree's shape, and how a solution is rounded on the matrix's pattern.
    fn forget_the_past(&mut self, garments: &[Mesh], clock: &mut StageClock) {
        self.state = StepState::gathered(&garments.iter().collect::<Vec<_>>());
        clock.time(Stage::Proximity, || {
            self.tree.rebuild(&self.state.position);
            if let Some(own) = &mut self.own {
                own.forget(&self.tree, &self.state.position);
            }
        });
        self.near.forget();
        clock.time(Stage::Dynamics, || self.system.forget_the_past());
    }

    fn refit(&mut self) {
        self.tree.refit(&self.state.position);
    }

    fn write_back(&self, garments: &mut [Mesh]) {
        self.state.scatter(&mut garments.iter_mut().collect::<Vec<_>>());
    }
}

/// Each node's contact thickness (m).
fn thickness_of_nodes(scene: &Scene, garments: &[Mesh]) -> Vec<f64> {
    let of = |(garment, mesh): (&Garment, &Mesh)| {
        let own = garment.contact_thickness.unwrap_or(scene.contact.thickness);
        std::iter::repeat_n(own, mesh.node_count())
    };
    scene.garments.iter().zip(garments).flat_map(of).collect()
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
mod passing_tests;
#[cfg(test)]
mod tests;
