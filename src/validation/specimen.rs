//! A piece of cloth in the laboratory: clamped, loaded, brought to rest or left to move.

use glam::{DVec2, DVec3};

use super::experiment::ExperimentError;
use crate::dynamics::{HandleSpring, StepError, StepForces, StepState, System};
use crate::mesh::{Id, Mesh, VertexId};
use crate::scene::{Dynamics, Fabric, SolverChoice};

/// (N/m): yields to no load of these experiments by more than rounding.
const CLAMP_STIFFNESS: f64 = 1e7;

/// One mesh of one fabric, in a vacuum, without contact.
pub struct Specimen {
    pub mesh: Mesh,
    pub system: System,
    pub state: StepState,
    /// Acceleration (m/s^2).
    pub gravity: DVec3,
    pub clamps: Vec<HandleSpring>,
}

/// When a specimen counts as at rest, and how it gets there.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    /// Largest sum of squares of the forces on nodes, as a root, in units of `load`.
    pub residual: f64,
    /// What residuals are compared with (N): the weight, or the pull of the clamps.
    pub load: f64,
    /// The first step (s); it grows while energy falls. A step bounds how far inertia lets a node go.
    pub first_step: f64,
    pub steps_max: usize,
}

/// How a step that ends at rest grows when it has lowered the energy, and shrinks when not.
const GROWTH: f64 = 1.5;
const SHRINKAGE: f64 = 0.25;

/// Longer steps are no longer Newton steps but the same (s).
const STEP_MAX: f64 = 1e3;

/// Energies closer than this, relative, are the same.
const ENERGY_ROUNDING: f64 = 1e-12;

impl Specimen {
    pub fn new(mesh: Mesh, fabric: &Fabric) -> Self {
        let mut system = System::new(&[&mesh], &[fabric]);
        // To rounding: what is validated is the physics.
        system.set_dynamics(Dynamics { solver: SolverChoice::Direct, ..Dynamics::default() });
        let state = StepState::gathered(&[&mesh]);
        Self { mesh, system, state, gravity: DVec3::ZERO, clamps: Vec::new() }
    }

    /// Holds the nodes of chosen material positions where they are now.
    pub fn clamp(&mut self, is_chosen: impl Fn(DVec2) -> bool) {
        for vertex in self.vertices(is_chosen) {
            let node = self.node_of(vertex);
            let target = self.state.position[node];
            self.clamps.push(HandleSpring { node, target, stiffness: CLAMP_STIFFNESS });
        }
    }

    pub fn vertices(&self, is_chosen: impl Fn(DVec2) -> bool) -> Vec<VertexId> {
        self.mesh.vertex_ids().filter(|&v| is_chosen(self.mesh.material(v))).collect()
    }

    /// The mean place in the world of nodes of chosen material positions (m).
    pub fn mean_position(&self, is_chosen: impl Fn(DVec2) -> bool) -> DVec3 {
        let chosen = self.vertices(is_chosen);
        let sum: DVec3 = chosen.iter().map(|&v| self.state.position[self.node_of(v)]).sum();
        sum / chosen.len() as f64
    }

    /// (kg).
    pub fn mass(&self) -> f64 {
        self.system.masses().iter().sum()
    }

    /// (kg m/s).
    pub fn momentum(&self) -> DVec3 {
        self.system.masses().iter().zip(&self.state.velocity).map(|(m, v)| *v * *m).sum()
    }

    /// Of stretch, bending, clamps and gravity (J).
    pub fn potential_energy(&self) -> f64 {
        let x = &self.state.position;
        let clamps: f64 = self.clamps.iter().map(|c| c.energy(x[c.node])).sum();
        let weights = self.system.masses().iter().zip(x);
        let falling: f64 = weights.map(|(m, x)| m * self.gravity.dot(*x)).sum();
        self.system.potential_energy(&self.state) + clamps - falling
    }

    /// Of motion and of [`potential_energy`](Self::potential_energy) (J).
    pub fn energy(&self) -> f64 {
        self.system.kinetic_energy(&self.state) + self.potential_energy()
    }

    /// One step of the simulator (s).
    ///
    /// # Errors
    /// As [`System::step`].
    pub fn step(&mut self, dt: f64) -> Result<(), StepError> {
        let forces =
            StepForces { gravity: self.gravity, handles: &self.clamps, ..StepForces::NONE };
        self.system.step(&mut self.state, &forces, dt)?;
        Ok(())
    }

    /// The forces on the nodes, as if all were at rest (N).
    pub fn forces(&mut self) -> Vec<DVec3> {
        let still = StepState {
            position: self.state.position.clone(),
            velocity: vec![DVec3::ZERO; self.state.velocity.len()],
        };
        let forces =
            StepForces { gravity: self.gravity, handles: &self.clamps, ..StepForces::NONE };
        self.system.freeze_stiffness(&still.position);
        self.system.assemble(&still, &forces, 1.0);
        self.system.linear_system().1.to_vec()
    }

    /// Steps that each begin and end without velocity, until the forces on all nodes are balanced:
    /// with growing steps Newton's method for the least energy. Returns how many it took.
    ///
    /// # Errors
    /// If it takes too many, or a step fails.
    pub fn settle(&mut self, rest: &Rest) -> Result<usize, ExperimentError> {
        let mut dt = rest.first_step;
        let mut energy = self.potential_energy();
        let mut residual = f64::INFINITY;
        for steps in 0..rest.steps_max {
            residual = root_sum(&self.forces()) / rest.load;
            if residual <= rest.residual {
                return Ok(steps);
            }
            let before = self.state.position.clone();
            self.state.velocity.fill(DVec3::ZERO);
            self.step(dt)?;
            self.state.velocity.fill(DVec3::ZERO);
            let after = self.potential_energy();
            if after <= energy + ENERGY_ROUNDING * energy.abs() {
                energy = after;
                dt = (dt * GROWTH).min(STEP_MAX);
            } else {
                self.state.position = before;
                dt *= SHRINKAGE;
            }
        }
        Err(ExperimentError::NotAtRest { steps: rest.steps_max, residual, limit: rest.residual })
    }

    pub fn node_of(&self, vertex: VertexId) -> usize {
        self.mesh.node_of(vertex).index()
    }
}

fn root_sum(forces: &[DVec3]) -> f64 {
    forces.iter().map(|f| f.length_squared()).sum::<f64>().sqrt()
}
