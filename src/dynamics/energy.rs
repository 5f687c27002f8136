//! The incremental potential: what the end of a step minimises.
//!
//! Phi(v) = sum 1/2 m |v - v_0 - h g|^2 + W(x_0 + h v) + dissipation + drag + handles + contacts (J),
//! with the stiffness frozen, drag linearised at the start, and friction at the pressure last seen.
//! Its gradient by v is minus the right side that [`assemble_at`](System::assemble_at) and the
//! contacts leave.

use glam::DVec3;

use super::bending::{Hinge, dihedral_angle, turn};
use super::contact::IteratedContact;
use super::damping::Viscosity;
use super::iterate::Iterate;
use super::step::{StepForces, StepState};
use super::stretch::energy_density;
use super::system::{GarmentRanges, System};
use super::wind;
use crate::scene::Air;

impl System {
    /// Phi at an iterate (J); `contacts` are those of `forces`, with the pressures held.
    pub(super) fn incremental_energy(
        &self,
        iterate: &Iterate,
        start: &StepState,
        forces: &StepForces<'_>,
        contacts: &[IteratedContact],
        dt: f64,
    ) -> f64 {
        let handles = forces.handles.iter().map(|h| h.energy(iterate.position[h.node]));
        let touching = forces.contacts.iter().zip(contacts);
        self.inertia_energy(iterate, start, forces.gravity * dt)
            + self.stretch_energy(iterate, start, dt)
            + self.bending_energy(iterate, start, dt)
            + self.drag_energy(iterate, start, &forces.air, dt)
            + handles.sum::<f64>()
            + touching
                .map(|(c, at)| at.energy(c, c.weighted_sum(&iterate.velocity), dt))
                .sum::<f64>()
    }

    fn inertia_energy(&self, iterate: &Iterate, start: &StepState, gained: DVec3) -> f64 {
        let change = iterate.velocity.iter().zip(&start.velocity).map(|(v, v0)| *v - *v0 - gained);
        self.masses.iter().zip(change).map(|(m, dv)| 0.5 * m * dv.length_squared()).sum()
    }

    /// A [psi(E) + beta / h psi(E - E_0)].
    fn stretch_energy(&self, iterate: &Iterate, start: &StepState, dt: f64) -> f64 {
        let mut sum = 0.0;
        for garment in &self.garments {
            let viscosity = Viscosity::new(garment.fabric.damping(), dt);
            for index in garment.membranes.clone() {
                let (face, k) = (&self.membranes[index], self.frozen.stretch[index]);
                let strain = face.strain(&iterate.position);
                let mut density = self.elastic_density(garment, index, strain);
                if viscosity.is_felt() {
                    let increment = strain - face.strain(&start.position);
                    density += viscosity.ratio * energy_density(k, increment);
                }
                sum += face.area * density;
            }
        }
        sum
    }

    /// W(theta - theta_rest) + beta / h W(theta - theta_0); of a hinge, W(fold) = k shape fold^2.
    fn bending_energy(&self, iterate: &Iterate, start: &StepState, dt: f64) -> f64 {
        let mut sum = 0.0;
        for garment in &self.garments {
            let viscosity = Viscosity::new(garment.fabric.damping(), dt);
            if let Some(law) = &garment.fold_law {
                sum += law.energy(&self.folds(garment, &iterate.position));
                if viscosity.is_felt() {
                    sum += viscosity.ratio * law.energy(&self.folds_since(garment, iterate, start));
                }
                continue;
            }
            for index in garment.hinges.clone() {
                let hinge = &self.hinges[index];
                let Some(angle) = dihedral_angle(hinge.corners(&iterate.position)) else {
                    continue;
                };
                let mut folds = hinge.fold(angle).powi(2);
                if viscosity.is_felt()
                    && let Some(first) = dihedral_angle(hinge.corners(&start.position))
                {
                    folds += viscosity.ratio * turn(first, angle).powi(2);
                }
                sum += 0.5 * self.frozen.bending[index] * folds;
            }
        }
        sum
    }

    /// How far a garment's hinges have turned since a step's start (rad).
    pub(super) fn folds_since(
        &self,
        garment: &GarmentRanges,
        iterate: &Iterate,
        start: &StepState,
    ) -> Vec<f64> {
        let since = |hinge: &Hinge| {
            let first = dihedral_angle(hinge.corners(&start.position))?;
            let now = dihedral_angle(hinge.corners(&iterate.position))?;
            Some(turn(first, now))
        };
        let hinges = self.hinges[garment.hinges.clone()].iter();
        hinges.map(|hinge| since(hinge).unwrap_or(0.0)).collect()
    }

    /// -h (f_0.dv - 1/2 dv.D dv) with dv the change of a face's mean velocity.
    fn drag_energy(&self, iterate: &Iterate, start: &StepState, air: &Air, dt: f64) -> f64 {
        if !wind::is_felt(air) {
            return 0.0;
        }
        let on_face = |nodes: [u32; 3]| {
            let drag = wind::drag_on(nodes, start, air);
            let change = wind::mean(nodes, &iterate.velocity) - wind::mean(nodes, &start.velocity);
            0.5 * change.dot(drag.damping * change) - drag.force.dot(change)
        };
        dt * self.membranes.iter().map(|face| on_face(face.nodes)).sum::<f64>()
    }
}
