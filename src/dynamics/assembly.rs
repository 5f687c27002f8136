//! Matrix and right side of a step, one pass over each kind of element.

use glam::{DMat3, DVec3};

use super::bending::{Hinge, dihedral};
use super::contact::{ContactPoint, ContactResponse};
use super::damping::Lead;
use super::handles::HandleSpring;
use super::matrix::BlockMatrix;
use super::step::{StepForces, StepOutcome, StepState};
use super::stretch::MembraneTangent;
use super::system::{HingeSlots, System};
use super::{outer, wind};
use crate::scene::Air;

impl System {
    /// Fills matrix and right side: (M + h^2 K + h beta K_m + h D) dv = h (f - (h K + beta K_m) v),
    /// at the stiffness last frozen. The outcome counts what took no part.
    pub fn assemble(&mut self, state: &StepState, forces: &StepForces<'_>, dt: f64) -> StepOutcome {
        self.make_room_for(forces.contacts);
        self.matrix.set_zero();
        self.add_inertia(forces.gravity, dt);
        self.add_stretch(state, dt);
        let degenerate_hinges = self.add_bending(state, dt);
        if wind::is_felt(&forces.air) {
            self.add_wind(state, &forces.air, dt);
        }
        self.add_handles(state, forces.handles, dt);
        let active_contacts = self.add_contacts(state, forces, dt);
        StepOutcome { degenerate_hinges, active_contacts }
    }

    /// The matrix and right side last assembled.
    pub fn linear_system(&self) -> (&BlockMatrix, &[DVec3]) {
        (&self.matrix, &self.right_side)
    }

    /// Lets the pattern stand if it has a block for every pair of nodes in contact.
    fn make_room_for(&mut self, contacts: &[ContactPoint]) {
        let pattern = self.matrix.pattern();
        if !contacts.iter().flat_map(node_pairs).all(|[a, b]| pattern.slot(a, b).is_some()) {
            let pairs: Vec<_> = contacts.iter().flat_map(node_pairs).collect();
            self.set_pattern(&pairs);
        }
    }

    fn add_inertia(&mut self, gravity: DVec3, dt: f64) {
        for (node, &mass) in self.masses.iter().enumerate() {
            let slot = self.matrix.pattern().diagonal_slot(node);
            self.matrix.add(slot, DMat3::from_diagonal(DVec3::splat(mass)));
            self.right_side[node] = gravity * (mass * dt);
        }
    }

    fn add_stretch(&mut self, state: &StepState, dt: f64) {
        for garment in &self.garments {
            let lead = Lead::new(dt, garment.fabric.damping());
            let (material, geometric) = (dt * lead.material, dt * lead.geometric);
            for index in garment.membranes.clone() {
                let face = &self.membranes[index];
                let deformation = face.gradient_of(&state.position);
                let tangent =
                    MembraneTangent::new(face.area, self.frozen.stretch[index], deformation);
                let now = tangent.force_density();
                let ahead = tangent.led_force_density(face.gradient_of(&state.velocity), lead);
                for (node, &g) in face.nodes.iter().zip(&face.gradients) {
                    let force = now.mul_vec2(g) + ahead.mul_vec2(g);
                    self.right_side[*node as usize] += force * dt;
                }
                let mut slots = self.membrane_slots[index].into_iter();
                for (k, &gk) in face.gradients.iter().enumerate() {
                    for (&gl, slot) in face.gradients[k..].iter().zip(&mut slots) {
                        self.matrix.add(slot, tangent.block(gk, gl, material, geometric));
                    }
                }
            }
        }
    }

    /// Returns how many hinges have no angle.
    fn add_bending(&mut self, state: &StepState, dt: f64) -> usize {
        let mut degenerate = 0;
        for garment in &self.garments {
            let lead = Lead::new(dt, garment.fabric.damping());
            for index in garment.hinges.clone() {
                let hinge = &self.hinges[index];
                let Some(push) = HingePush::new(hinge, self.frozen.bending[index], state, lead)
                else {
                    degenerate += 1;
                    continue;
                };
                for (node, &gradient) in hinge.nodes.iter().zip(&push.gradients) {
                    self.right_side[*node as usize] += gradient * (push.moment * dt);
                }
                let scale = push.stiffness * dt * lead.material;
                push.scatter(scale, self.hinge_slots[index], &mut self.matrix);
            }
        }
        degenerate
    }

    fn add_wind(&mut self, state: &StepState, air: &Air, dt: f64) {
        for (face, slots) in self.membranes.iter().zip(&self.membrane_slots) {
            let [a, b, c] = face.nodes.map(|n| state.position[n as usize]);
            let velocity =
                face.nodes.map(|n| state.velocity[n as usize]).iter().sum::<DVec3>() / 3.0;
            let drag = wind::drag(air, (b - a).cross(c - a), velocity);
            for node in face.nodes {
                self.right_side[node as usize] += drag.force * (dt / 3.0);
            }
            // A third of the force on each corner, by the mean of three velocities.
            let block = drag.damping * (dt / 9.0);
            for &slot in slots {
                self.matrix.add(slot, block);
            }
        }
    }

    fn add_handles(&mut self, state: &StepState, handles: &[HandleSpring], dt: f64) {
        for spring in handles {
            let ahead = state.velocity[spring.node] * (dt * spring.stiffness);
            let force = spring.force(state.position[spring.node]) - ahead;
            self.right_side[spring.node] += force * dt;
            let slot = self.matrix.pattern().diagonal_slot(spring.node);
            self.matrix.add(slot, DMat3::IDENTITY * (dt * dt * spring.stiffness));
        }
    }

    /// Returns how many contacts act.
    fn add_contacts(&mut self, state: &StepState, forces: &StepForces<'_>, dt: f64) -> usize {
        let mut active = 0;
        for (index, contact) in forces.contacts.iter().enumerate() {
            let Some(mut response) = self.response(contact, state, forces, dt) else { continue };
            if let Some(Some(friction)) = self.breakaway.get(index) {
                response = response.with_friction(contact.normal, *friction);
            }
            active += 1;
            for (k, (node, weight)) in contact.weights().enumerate() {
                self.right_side[node] += response.force * (weight * dt);
                for (other, factor) in contact.weights().skip(k) {
                    let pattern = self.matrix.pattern();
                    let slot = pattern.slot(node as u32, other as u32);
                    let slot = slot.expect("the pattern has room for every contact");
                    self.matrix.add(slot, response.tangent * (weight * factor * dt));
                }
            }
        }
        active
    }

    /// A contact's response at the start of a step; `None` if it will be open.
    pub(super) fn response(
        &self,
        contact: &ContactPoint,
        state: &StepState,
        forces: &StepForces<'_>,
        dt: f64,
    ) -> Option<ContactResponse> {
        let velocity = contact.weighted_sum(&state.velocity);
        let mass = contact.effective_mass(&self.masses);
        // A contact between points of cloth falls as a whole.
        let weight_sum: f64 = contact.weights().map(|(_, weight)| weight).sum();
        contact.response(velocity, forces.gravity * weight_sum, mass, dt)
    }
}

/// What a hinge adds to a step.
struct HingePush {
    gradients: [DVec3; 4],
    /// -dW/dtheta at the lead (N m).
    moment: f64,
    /// d2W/dtheta2 (N m).
    stiffness: f64,
}

impl HingePush {
    /// W = k shape (theta - theta_0)^2; its tangent keeps dtheta dtheta^T and drops the second
    /// derivative of theta (Gauss-Newton), which is exact at rest and never indefinite.
    fn new(hinge: &Hinge, k: f64, state: &StepState, lead: Lead) -> Option<Self> {
        let now = dihedral(hinge.corners(&state.position))?;
        let velocities = hinge.corners(&state.velocity);
        let rate: f64 = now.gradients.iter().zip(velocities).map(|(g, v)| g.dot(v)).sum();
        let stiffness = 2.0 * k * hinge.shape;
        let moment = -stiffness * (hinge.fold(now.angle) + lead.material * rate);
        Some(Self { gradients: now.gradients, moment, stiffness })
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
