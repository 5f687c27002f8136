//! Contact: a penalty that holds cloth off a surface, and Coulomb friction along it.

use glam::{DMat3, DVec3};

use crate::math::outer;

/// The most nodes a contact acts on: a node and a face, or two edges.
pub const CONTACT_NODES: usize = 4;

/// How much stiffer than inertia a sticking contact is: it may creep at 1/100,000 of the speed that
/// its load would give a free node in a step. Stiff cloth loads light nodes with a thousand times
/// their weight; with 1000 a strip pressed on a plane creeps off at half of mu.
const STICKING_RATIO: f64 = 1e5;

/// The same of cloth on cloth: stiff contacts of many nodes each are what conjugate gradients are
/// worst at. Under its own weight cloth creeps off cloth by 50 micrometres a second.
const CLOTH_STICKING_RATIO: f64 = 1e3;

/// The same where the step is iterated, and slip found whatever the creep: light nodes under the load
/// of stiff cloth, a thousand times what inertia asks, may not creep visibly either.
const ITERATED_STICKING_RATIO: f64 = 1e6;

/// A point of the cloth near a surface, at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Global numbers, all different where the weight is not 0, and weights: the cloth's point is
    /// their weighted sum. Against an obstacle the weights add up to 1; of two points of cloth, the
    /// other has negative weights and all add up to 0.
    pub nodes: [(usize, f64); CONTACT_NODES],
    /// Unit, away from the surface.
    pub normal: DVec3,
    /// Signed distance minus thickness (m).
    pub gap: f64,
    /// (m/s).
    pub surface_velocity: DVec3,
    /// (N/m).
    pub stiffness: f64,
    /// Coulomb's mu.
    pub friction: f64,
}

/// Force of a contact over a step: f(v + dv) = `force` - `tangent` dv, of the contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactResponse {
    /// (N).
    pub force: DVec3,
    /// (N s/m); positive semi-definite.
    pub tangent: DMat3,
}

impl ContactPoint {
    /// A point of cloth with up to four nodes and weights.
    ///
    /// # Panics
    /// If there are more.
    pub fn weighted(nodes: &[(usize, f64)]) -> [(usize, f64); CONTACT_NODES] {
        let mut padded = [(0, 0.0); CONTACT_NODES];
        padded[..nodes.len()].copy_from_slice(nodes);
        padded
    }

    /// The nodes that take part.
    pub fn weights(&self) -> impl Iterator<Item = (usize, f64)> + Clone + use<> {
        self.nodes.into_iter().filter(|&(_, weight)| weight != 0.0)
    }

    /// The weighted sum of a quantity.
    pub fn weighted_sum(&self, values: &[DVec3]) -> DVec3 {
        self.weights().map(|(node, weight)| values[node] * weight).sum()
    }

    /// m = 1 / sum_i (w_i^2 / m_i) (kg): what an impulse at the contact point has to move.
    pub fn effective_mass(&self, masses: &[f64]) -> f64 {
        1.0 / self.weights().map(|(node, w)| w * w / masses[node]).sum::<f64>()
    }

    /// The sum of all weights: 1 against an obstacle, 0 between points of cloth.
    pub fn weight_sum(&self) -> f64 {
        self.weights().map(|(_, weight)| weight).sum()
    }

    fn sticking_ratio(&self) -> f64 {
        // Halfway between the two.
        if self.weight_sum() > 0.5 { STICKING_RATIO } else { CLOTH_STICKING_RATIO }
    }

    /// The response to the cloth's velocity at the contact point; `None` if the gap will be open at
    /// the end of the step under inertia and gravity, for a penalty must not pull.
    ///
    /// Friction counts on [`pressure_estimate`].
    pub fn response(
        &self,
        velocity: DVec3,
        gravity: DVec3,
        mass: f64,
        dt: f64,
    ) -> Option<ContactResponse> {
        let separation = (velocity - self.surface_velocity).dot(self.normal);
        let falling = self.gap + dt * separation + dt * dt * gravity.dot(self.normal);
        if falling > 0.0 {
            return None;
        }
        let pressure = pressure_estimate(self.gap, separation, self.stiffness, mass, dt);
        Some(self.closed_response(velocity, pressure, mass, dt))
    }

    /// The response of a contact that is closed, with the pressure (N) that friction counts on.
    ///
    /// Normal: f_n = -k (gap + h n.(v + dv - v_s)). Friction: f_t = -c (I - n n^T)(v + dv - v_s)
    /// with c = min( mu N / |v_t|, r m / h ), r m / h being what holds a point that sticks.
    pub fn closed_response(
        &self,
        velocity: DVec3,
        pressure: f64,
        mass: f64,
        dt: f64,
    ) -> ContactResponse {
        let relative = velocity - self.surface_velocity;
        let separation = relative.dot(self.normal);
        let slip = relative - separation * self.normal;
        let sticking = self.sticking_ratio() * mass / dt;
        let c = coefficient(self.friction * pressure, sticking, slip.length());
        let projector = outer(self.normal, self.normal);
        let push = -self.stiffness * (self.gap + dt * separation);
        ContactResponse {
            force: push * self.normal - c * slip,
            tangent: projector * (dt * self.stiffness) + (DMat3::IDENTITY - projector) * c,
        }
    }

    /// How deep the contact point is at the end of a step that ends with a velocity (m); 0 where
    /// the gap is open.
    pub fn depth_after(&self, velocity: DVec3, dt: f64) -> f64 {
        (-(self.gap + dt * (velocity - self.surface_velocity).dot(self.normal))).max(0.0)
    }
}

/// A contact at an iterate of a step's end. The pressure that friction counts on is held while the
/// energy is searched along a direction, and set anew for the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IteratedContact {
    /// The normal force that friction counts on (N).
    pub pressure: f64,
    /// What the contact has to move (kg).
    pub mass: f64,
}

impl IteratedContact {
    /// The gap at the end of the step (m): gap + h n.(v - v_s).
    fn gap(contact: &ContactPoint, velocity: DVec3, dt: f64) -> f64 {
        contact.gap + dt * (velocity - contact.surface_velocity).dot(contact.normal)
    }

    fn slip(contact: &ContactPoint, velocity: DVec3) -> DVec3 {
        let relative = velocity - contact.surface_velocity;
        relative - contact.normal * relative.dot(contact.normal)
    }

    /// The contact at an iterate whose contact point has a velocity, its pressure that of the
    /// penalty there.
    pub fn at(contact: &ContactPoint, velocity: DVec3, mass: f64, dt: f64) -> Self {
        let pressure = contact.stiffness * (-Self::gap(contact, velocity, dt)).max(0.0);
        Self { pressure, mass }
    }

    /// Force and tangent at the same velocity; `None` where the gap is open: there is no pressure
    /// to rub either.
    pub fn response(
        &self,
        contact: &ContactPoint,
        velocity: DVec3,
        dt: f64,
    ) -> Option<ContactResponse> {
        let gap = Self::gap(contact, velocity, dt);
        if gap >= 0.0 {
            return None;
        }
        let slip = Self::slip(contact, velocity);
        let limit = contact.friction * self.pressure;
        let c = coefficient(limit, ITERATED_STICKING_RATIO * self.mass / dt, slip.length());
        let projector = outer(contact.normal, contact.normal);
        Some(ContactResponse {
            force: contact.normal * (-contact.stiffness * gap) - c * slip,
            tangent: projector * (dt * contact.stiffness) + (DMat3::IDENTITY - projector) * c,
        })
    }

    /// 1/2 k min(0, gap)^2 + h P(slip) (J), with P(s) the potential of friction: 1/2 c s^2 while the
    /// point sticks with c = r m / h, and mu N (s - s_0 / 2) beyond s_0 = mu N / c.
    pub fn energy(&self, contact: &ContactPoint, velocity: DVec3, dt: f64) -> f64 {
        let depth = (-Self::gap(contact, velocity, dt)).max(0.0);
        let slip = Self::slip(contact, velocity).length();
        let limit = contact.friction * self.pressure;
        let sticking = ITERATED_STICKING_RATIO * self.mass / dt;
        let first_slip = limit / sticking;
        let friction = if slip <= first_slip {
            0.5 * sticking * slip * slip
        } else {
            limit * (slip - 0.5 * first_slip)
        };
        0.5 * contact.stiffness * depth * depth + dt * friction
    }
}

impl ContactResponse {
    /// The same normal response with a friction that is known (N), across the normal.
    pub fn with_friction(self, normal: DVec3, friction: DVec3) -> Self {
        let projector = outer(normal, normal);
        Self {
            force: normal * self.force.dot(normal) + friction,
            tangent: projector * (normal.dot(self.tangent * normal)),
        }
    }
}

/// The normal force that friction may count on (N):
/// min( k max(0, -(gap + h s)), k max(0, -gap) + m max(0, -s) / h ), with s the separation speed.
///
/// The first is the penalty where inertia takes the point by the end of the step. For a contact
/// that is just predicted it can exceed any force that will act (k h s grows with k), so the
/// second bounds it by the penalty already there plus what stops the approach within the step.
/// At rest both are the penalty, which is the true normal force.
pub fn pressure_estimate(gap: f64, separation: f64, stiffness: f64, mass: f64, dt: f64) -> f64 {
    let predicted = stiffness * (-(gap + dt * separation)).max(0.0);
    let stopping = stiffness * (-gap).max(0.0) + mass * (-separation).max(0.0) / dt;
    predicted.min(stopping)
}

/// c = min( mu N / |v_t|, r m / h ) (N s/m), with mu N the limit, v_t the slip velocity at the start
/// of the step and r the sticking ratio.
///
/// A point that slips feels mu N against its motion; at the end of the step the force is c times the
/// slip left, hence less while it brakes, never reversed. Below the slip at which both terms are
/// equal the point sticks: it creeps at 1/r of the speed that the unbalanced force would give it in
/// one step. A force beyond mu N lets the creep grow by the ratio of the two each step until it
/// slips.
fn coefficient(limit: f64, sticking: f64, slip: f64) -> f64 {
    // Compared as forces: no division by a slip of zero.
    if limit >= sticking * slip {
        // Without pressure nothing sticks, not even at rest.
        if limit > 0.0 { sticking } else { 0.0 }
    } else {
        limit / slip
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 5e-3;
    const MASS: f64 = 1e-4;

    fn contact(normal: DVec3, friction: f64) -> ContactPoint {
        ContactPoint {
            nodes: ContactPoint::weighted(&[(0, 1.0)]),
            normal,
            gap: 0.0,
            surface_velocity: DVec3::ZERO,
            stiffness: 500.0,
            friction,
        }
    }

    /// A particle on a plane through the origin under gravity: way and velocity after `steps` steps
    /// from rest, pressed in as far as its weight asks.
    fn on_an_incline(angle: f64, friction: f64, steps: usize) -> (DVec3, DVec3) {
        let normal = DVec3::new(angle.sin(), 0.0, angle.cos());
        let gravity = -9.81 * DVec3::Z;
        let start = normal * (MASS * gravity.dot(normal) / 500.0);
        let (mut x, mut v) = (start, DVec3::ZERO);
        for _ in 0..steps {
            let point = ContactPoint { gap: x.dot(normal), ..contact(normal, friction) };
            let (mut matrix, mut force) = (DMat3::IDENTITY * MASS, MASS * gravity);
            if let Some(response) = point.response(v, gravity, MASS, DT) {
                matrix += response.tangent * DT;
                force += response.force;
            }
            v += matrix.inverse() * (force * DT);
            x += v * DT;
        }
        (x - start, v)
    }

    #[test]
    fn a_block_sticks_on_an_incline_below_the_friction_angle() {
        for mu in [0.1, 0.3, 0.6, 1.0] {
            let (x, v) = on_an_incline((0.97f64 * mu).atan(), mu, 2000);
            assert!(v.length() < 1e-4 && x.length() < 1e-3, "mu {mu}: {v} m/s, {x} m");
        }
    }

    #[test]
    fn a_block_slides_on_an_incline_above_the_friction_angle() {
        for mu in [0.1f64, 0.3, 0.6, 1.0] {
            let angle = (1.05 * mu).atan();
            let (before, after) =
                (on_an_incline(angle, mu, 1600).1, on_an_incline(angle, mu, 2000).1);
            let acceleration = (after.length() - before.length()) / (400.0 * DT);
            let expected = 9.81 * (angle.sin() - mu * angle.cos());
            assert!((acceleration / expected - 1.0).abs() < 0.02, "mu {mu}: {acceleration} m/s^2");
        }
    }

    #[test]
    fn without_friction_a_block_slides_freely() {
        let (_, v) = on_an_incline(0.3, 0.0, 400);
        assert!((v.length() - 9.81 * 0.3f64.sin() * 400.0 * DT).abs() < 1e-3 * v.length());
    }

    #[test]
    fn a_block_that_slides_on_the_flat_stops_after_v_squared_over_two_mu_g() {
        let (mu, start) = (0.4, 2.0);
        let (mut x, mut v) = (DVec3::new(0.0, 0.0, -MASS * 9.81 / 500.0), start * DVec3::X);
        for _ in 0..400 {
            let point = ContactPoint { gap: x.z, ..contact(DVec3::Z, mu) };
            let response = point.response(v, -9.81 * DVec3::Z, MASS, DT).expect("it rests");
            let matrix = DMat3::IDENTITY * MASS + response.tangent * DT;
            v += matrix.inverse() * ((response.force - MASS * 9.81 * DVec3::Z) * DT);
            x += v * DT;
        }
        let expected = start * start / (2.0 * mu * 9.81);
        assert!((x.x / expected - 1.0).abs() < 0.03, "{} m, not {expected} m", x.x);
        assert!(v.length() < 1e-6);
    }

    #[test]
    fn a_contact_about_to_open_does_not_pull() {
        let point = ContactPoint { gap: -1e-4, ..contact(DVec3::Z, 0.3) };
        assert!(point.response(DVec3::Z, DVec3::ZERO, MASS, DT).is_none());
        let far = ContactPoint { gap: 1e-2, ..point };
        assert!(far.response(DVec3::ZERO, DVec3::ZERO, MASS, DT).is_none());
    }

    #[test]
    fn a_new_contact_counts_on_no_more_than_stops_the_approach() {
        let stiff = 1e8;
        assert_eq!(pressure_estimate(1e-4, -1.0, stiff, MASS, DT), MASS / DT);
        assert_eq!(pressure_estimate(1e-4, 1.0, stiff, MASS, DT), 0.0);
        assert_eq!(pressure_estimate(-1e-4, 0.0, 500.0, MASS, DT), 0.05);
    }

    #[test]
    fn response_carries_the_surface_along() {
        let still = ContactPoint { gap: -1e-4, ..contact(DVec3::Z, 0.3) };
        let moving = ContactPoint { surface_velocity: DVec3::new(0.5, 0.0, 0.2), ..still };
        let at_rest = still.response(DVec3::ZERO, DVec3::ZERO, MASS, DT).unwrap();
        let along = moving.response(moving.surface_velocity, DVec3::ZERO, MASS, DT).unwrap();
        assert_eq!(at_rest, along);
        let dragged = moving.response(DVec3::ZERO, DVec3::ZERO, MASS, DT).unwrap();
        assert!(dragged.force.x > 0.0);
    }
}
