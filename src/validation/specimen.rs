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
/// Shorter ones move nothing (s).
const STEP_MIN: f64 = 1e-9;

/// A way is cut or lengthened to its minimum between these shares of it, unless that is all of it but
/// for little. Nearer minima are those of the membrane alone, which the next step relaxes anyway.
const SHARE_MIN: f64 = 0.3;
const SHARE_MAX: f64 = 10.0;
const SHARE_EXACT: f64 = 0.01;

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

    /// Puts the nodes of chosen material positions somewhere (m, world), and holds them there.
    pub fn clamp_at(&mut self, is_chosen: impl Fn(DVec2) -> bool, place: impl Fn(DVec2) -> DVec3) {
        for vertex in self.vertices(is_chosen) {
            let (node, target) = (self.node_of(vertex), place(self.mesh.material(vertex)));
            self.state.position[node] = target;
            self.clamps.push(HandleSpring { node, target, stiffness: CLAMP_STIFFNESS });
        }
    }

    /// The mesh where the specimen is now.
    pub fn into_mesh(self) -> Mesh {
        let Self { mut mesh, state, .. } = self;
        state.scatter(&mut [&mut mesh]);
        mesh
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

    /// Brings the forces on all nodes into balance: the least energy, by conjugate gradients after
    /// Polak and Ribiere, preconditioned by the simulator. A step that begins at rest goes
    /// (M / h^2 + K)^-1 f far: the longer the step, the more like Newton's. Returns how many it took.
    ///
    /// # Errors
    /// If it takes too many, or a step fails.
    pub fn settle(&mut self, rest: &Rest) -> Result<usize, ExperimentError> {
        let mut dt = rest.first_step;
        let mut energy = self.potential_energy();
        let mut force = self.forces();
        let mut residual = root_sum(&force) / rest.load;
        let mut last: Option<Search> = None;
        for steps in 0..rest.steps_max {
            if residual <= rest.residual {
                return Ok(steps);
            }
            let start = self.state.position.clone();
            let pull = self.way_of_a_step(dt)?;
            let way = last.as_ref().and_then(|l| l.conjugate(&pull, &force));
            let way = way.unwrap_or_else(|| pull.clone());
            let left = self.line_minimum(&start, &way, &force);
            let (after, size) = (self.potential_energy(), root_sum(&left) / rest.load);
            if after < energy - ENERGY_ROUNDING * energy.abs() || size < residual {
                last = Some(Search { pull, way, force });
                (energy, residual, force) = (after, size, left);
                dt = (dt * GROWTH).min(STEP_MAX);
                continue;
            }
            self.state.position = start;
            // Without a memory at first, then with a shorter step.
            if last.take().is_none() {
                dt = (dt * SHRINKAGE).max(STEP_MIN);
            }
        }
        Err(ExperimentError::NotAtRest { steps: rest.steps_max, residual, limit: rest.residual })
    }

    /// Where a step from rest takes the nodes (m); the state stays.
    fn way_of_a_step(&mut self, dt: f64) -> Result<Vec<DVec3>, StepError> {
        let start = self.state.position.clone();
        self.state.velocity.fill(DVec3::ZERO);
        self.step(dt)?;
        self.state.velocity.fill(DVec3::ZERO);
        let end = std::mem::replace(&mut self.state.position, start);
        Ok(end.iter().zip(&self.state.position).map(|(x, x0)| *x - *x0).collect())
    }

    /// Moves along a way to where its own component of the forces vanishes, as the forces at both
    /// ends of the way tell; returns the forces there (N).
    fn line_minimum(&mut self, start: &[DVec3], way: &[DVec3], force: &[DVec3]) -> Vec<DVec3> {
        self.place(start, way, 1.0);
        let end = self.forces();
        let (work, work_left) = (dot(force, way), dot(&end, way));
        let share = work / (work - work_left);
        if !(SHARE_MIN..=SHARE_MAX).contains(&share) || (share - 1.0).abs() < SHARE_EXACT {
            return end;
        }
        self.place(start, way, share);
        self.forces()
    }

    fn place(&mut self, start: &[DVec3], way: &[DVec3], share: f64) {
        let ends = start.iter().zip(way).map(|(x, d)| *x + *d * share);
        self.state.position.iter_mut().zip(ends).for_each(|(x, end)| *x = end);
    }

    pub fn node_of(&self, vertex: VertexId) -> usize {
        self.mesh.node_of(vertex).index()
    }
}

/// One step of the search for the least energy.
struct Search {
    /// As the preconditioner sees the forces (m).
    pull: Vec<DVec3>,
    /// As it was gone (m).
    way: Vec<DVec3>,
    /// At its start (N).
    force: Vec<DVec3>,
}

impl Search {
    /// The next way, conjugate to this one; `None` where the memory is of no use.
    fn conjugate(&self, pull: &[DVec3], force: &[DVec3]) -> Option<Vec<DVec3>> {
        let beta = (dot(pull, force) - dot(pull, &self.force)) / dot(&self.pull, &self.force);
        let way: Vec<DVec3> = pull.iter().zip(&self.way).map(|(z, d)| *z + *d * beta).collect();
        (beta > 0.0 && dot(&way, force) > 0.0).then_some(way)
    }
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn root_sum(forces: &[DVec3]) -> f64 {
    forces.iter().map(|f| f.length_squared()).sum::<f64>().sqrt()
}
