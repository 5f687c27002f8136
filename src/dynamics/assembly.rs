//! Matrix and right side of a step, one pass over each kind of element.

use glam::{DMat3, DVec3};

use super::bending::{Dihedral, Hinge, dihedral, dihedral_angle, turn};
use super::contact::{ContactPoint, ContactResponse};
use super::damping::Viscosity;
use super::handles::HandleSpring;
use super::iterate::Iterate;
use super::matrix::BlockMatrix;
use super::step::{StepForces, StepState};
use super::stretch::{MembraneTangent, green_strain, strain_rate};
use super::system::{GarmentRanges, HingeSlots, System};
use super::wind;
use crate::math::outer;
use crate::scene::Air;

impl System {
    /// Fills matrix A and right side b for the velocity change of a step, A dv = b, linearised
    /// where the step starts, at the stiffness last frozen and without contacts:
    /// (M + h (h + beta) K_m + h^2 K_g + h D) dv = h (f - (h K + beta K_m) v).
    ///
    /// Returns the number of hinges that have no angle and took no part.
    pub fn assemble(&mut self, state: &StepState, forces: &StepForces<'_>, dt: f64) -> usize {
        self.make_room_for(forces.contacts);
        let degenerate_hinges =
            self.assemble_at(&Iterate::at_start(state), state, Some(&state.velocity), forces, dt);
        self.refer_to(&state.velocity);
        // The solution where nothing but gravity acts.
        self.change.fill(forces.gravity * dt);
        degenerate_hinges
    }

    /// Fills the matrix with the tangent at an iterate of a step's end, and the right side with
    /// what is out of balance there (N s): h f + m (v_0 + h g - v), contacts left out. Which strain
    /// limits are felt is judged where `expected` velocities (m/s) lead, or at the iterate.
    ///
    /// Returns the number of hinges that have no angle and took no part.
    pub(super) fn assemble_at(
        &mut self,
        iterate: &Iterate,
        start: &StepState,
        expected: Option<&[DVec3]>,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> usize {
        self.matrix.set_zero();
        self.touched.clear();
        self.solver.expect_new_matrix();
        self.add_inertia(iterate, start, forces.gravity, dt);
        self.add_stretch(iterate, start, expected, dt);
        let degenerate_hinges = self.add_bending(iterate, start, dt);
        if wind::is_felt(&forces.air) {
            self.add_wind(iterate, start, &forces.air, dt);
        }
        self.add_handles(iterate, forces.handles, dt);
        degenerate_hinges
    }

    /// Makes the right side that of the change from `velocities`, when it was linearised at rest:
    /// b - A v.
    fn refer_to(&mut self, velocities: &[DVec3]) {
        self.matrix.product_into(velocities, &mut self.product);
        for (b, product) in self.right_side.iter_mut().zip(&self.product) {
            *b -= *product;
        }
    }

    /// The matrix and right side last assembled.
    pub fn linear_system(&self) -> (&BlockMatrix, &[DVec3]) {
        (&self.matrix, &self.right_side)
    }

    /// Lets the pattern stand if it has a block for every pair of nodes in contact.
    pub(super) fn make_room_for(&mut self, contacts: &[ContactPoint]) {
        let pattern = self.matrix.pattern();
        if !contacts.iter().flat_map(node_pairs).all(|[a, b]| pattern.slot(a, b).is_some()) {
            let pairs: Vec<_> = contacts.iter().flat_map(node_pairs).collect();
            self.set_pattern(&pairs);
        }
    }

    fn add_inertia(&mut self, iterate: &Iterate, start: &StepState, gravity: DVec3, dt: f64) {
        for (node, &mass) in self.masses.iter().enumerate() {
            let slot = self.matrix.pattern().diagonal_slot(node);
            self.matrix.add(slot, DMat3::from_diagonal(DVec3::splat(mass)));
            let change = iterate.velocity[node] - start.velocity[node];
            self.right_side[node] = (gravity * dt - change) * mass;
        }
    }

    fn add_stretch(
        &mut self,
        iterate: &Iterate,
        start: &StepState,
        expected: Option<&[DVec3]>,
        dt: f64,
    ) {
        for garment in &self.garments {
            let viscosity = Viscosity::new(garment.fabric.damping(), dt);
            for index in garment.membranes.clone() {
                let face = &self.membranes[index];
                let mut tangent = self.elastic_tangent(garment, index, iterate, expected, dt);
                if viscosity.is_felt() {
                    tangent = tangent.damped(viscosity, face.strain(&start.position));
                }
                let density = tangent.force_density();
                for (node, &g) in face.nodes.iter().zip(&face.gradients) {
                    self.right_side[*node as usize] += density.mul_vec2(g) * dt;
                }
                let mut slots = self.membrane_slots[index].into_iter();
                for (k, &gk) in face.gradients.iter().enumerate() {
                    for (&gl, slot) in face.gradients[k..].iter().zip(&mut slots) {
                        self.matrix.add(slot, tangent.block(gk, gl) * (dt * dt));
                    }
                }
            }
        }
    }

    /// The tangent of a face's elastic energy at an iterate, with compensation and limits: the
    /// derivatives of [`elastic_density`](System::elastic_density).
    fn elastic_tangent(
        &self,
        garment: &GarmentRanges,
        membrane: usize,
        iterate: &Iterate,
        expected: Option<&[DVec3]>,
        dt: f64,
    ) -> MembraneTangent {
        let (face, k) = (&self.membranes[membrane], self.frozen.stretch[membrane]);
        let deformation = face.gradient_of(&iterate.position);
        let tangent = match self.root_alpha(membrane) {
            Some(root) => MembraneTangent::compensated(face.area, k, deformation, root),
            None => MembraneTangent::new(face.area, k, deformation),
        };
        let Some(limit) = &garment.strain_limit else { return tangent };
        let strain = green_strain(deformation);
        let gain = expected.map(|v| strain_rate(deformation, face.gradient_of(v)) * dt);
        let ahead = gain.map_or(strain, |gain| strain + gain);
        match limit.derivatives(strain, ahead) {
            Some(derivatives) => tangent.and(&derivatives),
            None => tangent,
        }
    }

    /// Returns how many hinges have no angle.
    fn add_bending(&mut self, iterate: &Iterate, start: &StepState, dt: f64) -> usize {
        let mut degenerate = 0;
        for garment in &self.garments {
            let viscosity = Viscosity::new(garment.fabric.damping(), dt);
            let moments = self.law_moments(garment, iterate, start, viscosity);
            for index in garment.hinges.clone() {
                let hinge = &self.hinges[index];
                let Some(now) = dihedral(hinge.corners(&iterate.position)) else {
                    degenerate += 1;
                    continue;
                };
                let stiffness = self.frozen.bending[index];
                let mut push = HingePush::new(hinge, now, stiffness, viscosity, start);
                if let Some(moments) = &moments {
                    push.moment = -moments[index - garment.hinges.start];
                }
                for (node, &gradient) in hinge.nodes.iter().zip(&push.gradients) {
                    self.right_side[*node as usize] += gradient * (push.moment * dt);
                }
                let scale = push.stiffness * dt * dt;
                push.scatter(scale, self.hinge_slots[index], &mut self.matrix);
            }
        }
        degenerate
    }

    /// The moments of a garment's fold law at an iterate (N m), damping included.
    fn law_moments(
        &self,
        garment: &GarmentRanges,
        iterate: &Iterate,
        start: &StepState,
        viscosity: Viscosity,
    ) -> Option<Vec<f64>> {
        let law = garment.fold_law.as_ref()?;
        let mut moments = self.folds(garment, &iterate.position);
        if viscosity.is_felt() {
            let since = self.folds_since(garment, iterate, start);
            moments.iter_mut().zip(since).for_each(|(fold, s)| *fold += viscosity.ratio * s);
        }
        law.moments(&mut moments);
        Some(moments)
    }

    /// The drag is linearised where the step starts, at every iterate.
    fn add_wind(&mut self, iterate: &Iterate, start: &StepState, air: &Air, dt: f64) {
        for (face, slots) in self.membranes.iter().zip(&self.membrane_slots) {
            let drag = wind::drag_on(face.nodes, start, air);
            let change =
                wind::mean(face.nodes, &iterate.velocity) - wind::mean(face.nodes, &start.velocity);
            let force = drag.force - drag.damping * change;
            for node in face.nodes {
                self.right_side[node as usize] += force * (dt / 3.0);
            }
            // A third of the force on each corner, by the mean of three velocities.
            let block = drag.damping * (dt / 9.0);
            for &slot in slots {
                self.matrix.add(slot, block);
            }
        }
    }

    fn add_handles(&mut self, iterate: &Iterate, handles: &[HandleSpring], dt: f64) {
        for spring in handles {
            self.right_side[spring.node] += spring.force(iterate.position[spring.node]) * dt;
            let slot = self.matrix.pattern().diagonal_slot(spring.node);
            self.matrix.add(slot, DMat3::IDENTITY * (dt * dt * spring.stiffness));
        }
    }

    /// Adds what contacts do, given at the velocities that the right side refers to.
    pub(super) fn add_contacts<'a>(
        &mut self,
        responses: impl Iterator<Item = (&'a ContactPoint, ContactResponse)>,
        dt: f64,
    ) {
        for (contact, response) in responses {
            for (k, (node, weight)) in contact.weights().enumerate() {
                self.right_side[node] += response.force * (weight * dt);
                for (other, factor) in contact.weights().skip(k) {
                    let pattern = self.matrix.pattern();
                    let slot = pattern.slot(node as u32, other as u32);
                    let slot = slot.expect("the pattern has room for every contact");
                    self.touched.push((slot, self.matrix.blocks()[slot as usize]));
                    self.matrix.add(slot, response.tangent * (weight * factor * dt));
                }
            }
        }
    }

    /// Takes all contacts out of the matrix again, to the bit.
    pub(super) fn remove_contacts(&mut self) {
        while let Some((slot, block)) = self.touched.pop() {
            self.matrix.set(slot, block);
        }
        self.solver.expect_new_matrix();
    }
}

/// What a hinge adds to a step.
struct HingePush {
    gradients: [DVec3; 4],
    /// -dW/dtheta (N m).
    moment: f64,
    /// d2W/dtheta2 (N m).
    stiffness: f64,
}

impl HingePush {
    /// W = 1/2 stiffness ((theta - theta_rest)^2 + ratio (theta - theta_start)^2), `stiffness` in N m;
    /// its tangent keeps dtheta dtheta^T and drops the second derivative of theta (Gauss-Newton),
    /// which is exact at rest and never indefinite.
    fn new(
        hinge: &Hinge,
        now: Dihedral,
        stiffness: f64,
        viscosity: Viscosity,
        start: &StepState,
    ) -> Self {
        let at_start = match viscosity.is_felt() {
            true => dihedral_angle(hinge.corners(&start.position)),
            false => None,
        };
        let since = at_start.map_or(0.0, |angle| turn(angle, now.angle));
        Self {
            gradients: now.gradients,
            moment: -stiffness * (hinge.fold(now.angle) + viscosity.ratio * since),
            stiffness: stiffness * (1.0 + viscosity.ratio),
        }
    }

    fn scatter(&self, scale: f64, slots: HingeSlots, matrix: &mut BlockMatrix) {
        let gradients = slots.descending.map(|k| self.gradients[k as usize]);
        let mut slots = slots.slots.into_iter();
        for (k, &gk) in gradients.iter().enumerate() {
            for (&gl, slot) in gradients[k..].iter().zip(&mut slots) {
                matrix.add(slot, outer(gk * scale, gl));
            }
        }
    }
}

/// All pairs of different nodes that a contact acts on.
fn node_pairs(contact: &ContactPoint) -> impl Iterator<Item = [u32; 2]> + use<> {
    let nodes = contact.weights().map(|(node, _)| node as u32);
    let rest = nodes.clone();
    nodes.enumerate().flat_map(move |(k, a)| rest.clone().skip(k + 1).map(move |b| [a, b]))
}
