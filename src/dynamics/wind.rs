//! The drag of the air on a face.

use glam::{DMat3, DVec3};

use super::step::StepState;
use crate::math::outer;
use crate::scene::Air;

/// Force on a face, and how it yields to the face's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// (N).
    pub force: DVec3,
    /// Minus the derivative of the force by the velocity (N s/m); positive semi-definite.
    pub damping: DMat3,
}

/// True if the air acts on cloth at all.
pub fn is_felt(air: &Air) -> bool {
    air.density > 0.0 || air.tangential_drag > 0.0
}

/// f = -rho A |w_n| w_n n - c A (w - w_n n), with w the velocity relative to the air, w_n its
/// part along the unit normal n, A the area in the world, c the tangential drag.
///
/// The derivative takes n and A as constant. The sign of `area_vector` (twice the area along the
/// normal, m^2) is of no consequence; a face without area feels nothing.
pub fn drag(air: &Air, area_vector: DVec3, velocity: DVec3) -> Drag {
    let doubled_area = area_vector.length();
    let Some(normal) = area_vector.try_normalize() else {
        return Drag { force: DVec3::ZERO, damping: DMat3::ZERO };
    };
    let area = 0.5 * doubled_area;
    let relative = velocity - air.velocity;
    let along_normal = relative.dot(normal);
    let normal_drag = air.density * area * along_normal.abs();
    let tangential_drag = air.tangential_drag * area;
    let projector = outer(normal, normal);
    let force =
        -normal_drag * along_normal * normal - tangential_drag * (relative - along_normal * normal);
    let damping = projector * (2.0 * normal_drag) + (DMat3::IDENTITY - projector) * tangential_drag;
    Drag { force, damping }
}

/// The drag on a face at the mean velocity of its nodes.
pub(super) fn drag_on(nodes: [u32; 3], state: &StepState, air: &Air) -> Drag {
    let [a, b, c] = nodes.map(|n| state.position[n as usize]);
    drag(air, (b - a).cross(c - a), mean(nodes, &state.velocity))
}

pub(super) fn mean(nodes: [u32; 3], values: &[DVec3]) -> DVec3 {
    nodes.map(|n| values[n as usize]).iter().sum::<DVec3>() / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const AIR: Air =
        Air { density: 1.2, velocity: DVec3::new(3.0, -1.0, 0.5), tangential_drag: 0.7 };

    #[test]
    fn damping_is_the_derivative_of_the_drag() {
        let area_vector = DVec3::new(0.02, 0.05, -0.03);
        let velocity = DVec3::new(-2.0, 0.4, 1.0);
        let at = |v| drag(&AIR, area_vector, v);
        for axis in DVec3::AXES {
            let step = 1e-6;
            let difference = (at(velocity + axis * step).force - at(velocity - axis * step).force)
                / (2.0 * step);
            let error = difference + at(velocity).damping * axis;
            assert!(error.length() < 1e-8, "along {axis} the derivative is off by {error}");
        }
    }

    #[test]
    fn drag_takes_energy_from_what_moves_against_the_air_whichever_side_it_shows() {
        let area_vector = DVec3::new(0.02, 0.05, -0.03);
        let velocity = DVec3::new(-2.0, 0.4, 1.0);
        let felt = drag(&AIR, area_vector, velocity);
        assert!(felt.force.dot(velocity - AIR.velocity) < 0.0);
        assert_eq!(felt.force, drag(&AIR, -area_vector, velocity).force);
    }

    #[test]
    fn a_sheet_across_the_wind_feels_rho_a_v_squared() {
        let air = Air { density: 1.0, velocity: 2.0 * DVec3::X, tangential_drag: 0.0 };
        let force = drag(&air, 0.5 * 2.0 * DVec3::X, DVec3::ZERO).force;
        assert!((force - 2.0 * DVec3::X).length() < 1e-14);
    }

    #[test]
    fn a_vacuum_and_a_face_without_area_are_not_felt() {
        let vacuum = Air { density: 0.0, ..Air::default() };
        assert!(!is_felt(&vacuum) && is_felt(&AIR));
        assert_eq!(drag(&AIR, DVec3::ZERO, DVec3::X).force, DVec3::ZERO);
    }
}
