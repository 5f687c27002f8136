//! Stretch: the membrane energy of a face, orthotropic and as stiff as was measured.

use glam::{DMat3, DVec2, DVec3};

use super::damping::Viscosity;
use super::principal::{StrainDerivatives, compensated_derivatives};
use crate::math::{Mat3x2, SymTensor2, outer};
use crate::scene::StretchStiffness;

/// What a face's membrane depends on besides positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membrane {
    /// Global numbers, descending, so that the block of corners k <= l lies in the lower triangle.
    pub nodes: [u32; 3],
    /// Material gradients of the corners' shape functions (1/m).
    pub gradients: [DVec2; 3],
    /// In material space (m^2).
    pub area: f64,
}

impl Membrane {
    /// The sum over i of value_i g_i^T: dx/du of positions, dv/du of velocities.
    pub fn gradient_of(&self, values: &[DVec3]) -> Mat3x2 {
        Mat3x2::from_gradients(self.nodes.map(|n| values[n as usize]), self.gradients)
    }

    /// E at positions.
    pub fn strain(&self, positions: &[DVec3]) -> SymTensor2 {
        green_strain(self.gradient_of(positions))
    }
}

/// E = 1/2 (F^T F - I).
pub fn green_strain(deformation: Mat3x2) -> SymTensor2 {
    (deformation.gram() - SymTensor2::IDENTITY) * 0.5
}

/// dE/dt = 1/2 (F^T dF/dt + dF/dt^T F) (1/s).
pub fn strain_rate(deformation: Mat3x2, rate: Mat3x2) -> SymTensor2 {
    let (f, r) = (deformation, rate);
    let xy = 0.5 * (f.x_axis.dot(r.y_axis) + f.y_axis.dot(r.x_axis));
    SymTensor2 { xx: f.x_axis.dot(r.x_axis), xy, yy: f.y_axis.dot(r.y_axis) }
}

/// psi = 1/2 (k_uu E_uu^2 + k_vv E_vv^2) + k_uv E_uu E_vv + k_shear E_uv^2 (J/m^2), the stiffness
/// frozen ([`WOR11`](crate::papers::WOR11)).
pub fn energy_density(k: StretchStiffness, e: SymTensor2) -> f64 {
    0.5 * (k.uu * e.xx * e.xx + k.vv * e.yy * e.yy) + k.uv * e.xx * e.yy + k.shear * e.xy * e.xy
}

/// S = dpsi/dE (N/m): S_uu = k_uu E_uu + k_uv E_vv, S_vv = k_vv E_vv + k_uv E_uu,
/// S_uv = k_shear E_uv. As E_uv stands for both off-diagonal entries, S_uv is half of dpsi/dE_uv.
pub fn stress(k: StretchStiffness, e: SymTensor2) -> SymTensor2 {
    SymTensor2 { xx: k.uu * e.xx + k.uv * e.yy, xy: k.shear * e.xy, yy: k.vv * e.yy + k.uv * e.xx }
}

/// The nearest stiffness whose energy has a lower bound: diagonal entries at least 0 and
/// |k_uv| <= sqrt(k_uu k_vv).
pub fn bounded(k: StretchStiffness) -> StretchStiffness {
    let (uu, vv) = (k.uu.max(0.0), k.vv.max(0.0));
    let limit = (uu * vv).sqrt();
    StretchStiffness { uu, vv, uv: k.uv.clamp(-limit, limit), shear: k.shear.max(0.0) }
}

/// Forces and tangent stiffness of a face, linearised where the step starts.
///
/// The second derivative of A psi by corners i and j is
/// A [ sum_pq C_pq b_p(i) b_q(j)^T + (g_i^T S g_j) I ] with b_p(i) the gradient of strain component
/// p. Its projection to positive semi-definite takes no 9x9 eigenvalues:
/// - The first part is B^T C B with the stiffness C constant: semi-definite if C is ([`bounded`]).
/// - The second is (G^T S G) x I. With S replaced by S+, its part with non-negative eigenvalues, it
///   is semi-definite as well. That drops exactly what compression takes away, and leaves the
///   tangent exact wherever both principal stresses pull.
#[derive(Clone, Copy, Debug)]
pub struct MembraneTangent {
    area: f64,
    deformation: Mat3x2,
    stress: SymTensor2,
    pulling_stress: SymTensor2,
    stiffness: StretchStiffness,
    /// What the tangent of `stiffness` is multiplied by.
    material: f64,
    /// The second derivative of what is not orthotropic.
    principal: Option<[[f64; 3]; 3]>,
    squares: [DMat3; 4],
}

impl MembraneTangent {
    pub fn new(area: f64, k: StretchStiffness, deformation: Mat3x2) -> Self {
        let stress = stress(k, green_strain(deformation));
        let (fu, fv) = (deformation.x_axis, deformation.y_axis);
        Self {
            area,
            deformation,
            stress,
            pulling_stress: pulling_part(stress),
            stiffness: bounded(k),
            material: 1.0,
            principal: None,
            squares: [outer(fu, fu), outer(fv, fv), outer(fu, fv), outer(fv, fu)],
        }
    }

    /// Of a face that buckles between its nodes: see
    /// [`compensated_strain`](super::principal::compensated_strain).
    pub fn compensated(
        area: f64,
        k: StretchStiffness,
        deformation: Mat3x2,
        root_alpha: f64,
    ) -> Self {
        let plain = Self::new(area, k, deformation);
        let strain = green_strain(deformation);
        let derivatives = compensated_derivatives(plain.stiffness, strain, root_alpha);
        let cleared = Self { stress: SymTensor2::ZERO, material: 0.0, ..plain };
        cleared.and(&derivatives)
    }

    /// Adds an energy of the strain.
    pub fn and(mut self, energy: &StrainDerivatives) -> Self {
        self.stress += energy.stress();
        self.pulling_stress = pulling_part(self.stress);
        let sum = self.principal.get_or_insert_default();
        for (row, more) in sum.iter_mut().zip(energy.second) {
            row.iter_mut().zip(more).for_each(|(entry, m)| *entry += m);
        }
        self
    }

    /// Adds the stress of a viscosity against the strain since the start of the step:
    /// S + ratio C (E - E_0), and the material part of the tangent grows by 1 + ratio.
    pub fn damped(mut self, viscosity: Viscosity, strain_at_start: SymTensor2) -> Self {
        let increment = green_strain(self.deformation) - strain_at_start;
        self.stress += stress(self.stiffness, increment) * viscosity.ratio;
        self.pulling_stress = pulling_part(self.stress);
        self.material += viscosity.ratio;
        self
    }

    /// -A dpsi/dF = -A F S (N m): the force on a corner is this times the corner's gradient.
    pub fn force_density(&self) -> Mat3x2 {
        times(self.deformation, self.stress, -self.area)
    }

    /// The block of corners with gradients g_i and g_j (N/m).
    pub fn block(&self, gi: DVec2, gj: DVec2) -> DMat3 {
        let k = self.stiffness;
        let shear = 0.5 * k.shear;
        let scale = self.area * self.material;
        let [uu, vv, uv, vu] = self.squares;
        uu * (scale * (k.uu * gi.x * gj.x + shear * gi.y * gj.y))
            + vv * (scale * (k.vv * gi.y * gj.y + shear * gi.x * gj.x))
            + uv * (scale * (k.uv * gi.x * gj.y + shear * gi.y * gj.x))
            + vu * (scale * (k.uv * gi.y * gj.x + shear * gi.x * gj.y))
            + DMat3::from_diagonal(DVec3::splat(
                self.area * self.pulling_stress.bilinear_form(gi, gj),
            ))
            + self.principal_block(gi, gj)
    }

    /// A sum_pq C_pq b_p(i) b_q(j)^T of a general C, with b_uu = g_u F_u, b_vv = g_v F_v and
    /// b_uv = 1/2 (g_u F_v + g_v F_u).
    fn principal_block(&self, gi: DVec2, gj: DVec2) -> DMat3 {
        let Some(second) = &self.principal else { return DMat3::ZERO };
        let (fu, fv) = (self.deformation.x_axis, self.deformation.y_axis);
        let changes = |g: DVec2| [fu * g.x, fv * g.y, (fu * g.y + fv * g.x) * 0.5];
        let (bi, bj) = (changes(gi), changes(gj));
        let rows = bi.iter().zip(second).map(|(b, row)| {
            outer(*b * self.area, bj[0] * row[0] + bj[1] * row[1] + bj[2] * row[2])
        });
        rows.fold(DMat3::ZERO, |sum, block| sum + block)
    }
}

/// The tensor without its negative eigenvalues.
fn pulling_part(stress: SymTensor2) -> SymTensor2 {
    if stress.xx >= 0.0 && stress.determinant() >= 0.0 {
        return stress;
    }
    stress.map_eigenvalues(|value| value.max(0.0))
}

/// s A S.
fn times(a: Mat3x2, s: SymTensor2, scale: f64) -> Mat3x2 {
    Mat3x2 {
        x_axis: (a.x_axis * s.xx + a.y_axis * s.xy) * scale,
        y_axis: (a.x_axis * s.xy + a.y_axis * s.yy) * scale,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, SMatrix};

    use super::*;
    use crate::dynamics::testing::Random;

    const STIFFNESS: StretchStiffness =
        StretchStiffness { uu: 900.0, uv: 250.0, vv: 600.0, shear: 300.0 };

    fn membrane() -> Membrane {
        Membrane {
            nodes: [2, 1, 0],
            gradients: [DVec2::new(8.0, 3.0), DVec2::new(-9.0, 2.0), DVec2::new(1.0, -5.0)],
            area: 0.012,
        }
    }

    /// Corners whose deformation gradient is the given one.
    fn positions(f: Mat3x2) -> [DVec3; 3] {
        // Two corners suffice: the third stays at the origin, and its gradient is not used.
        let [_, gb, gc] = membrane().gradients;
        let inverse = glam::DMat2::from_cols(gb, gc).transpose().inverse();
        let corner = |k: usize| f.mul_vec2(inverse.col(k));
        [corner(1), corner(0), DVec3::ZERO]
    }

    fn hessian(x: &[DVec3]) -> SMatrix<f64, 9, 9> {
        let face = membrane();
        let tangent = MembraneTangent::new(face.area, STIFFNESS, face.gradient_of(x));
        let mut matrix = SMatrix::<f64, 9, 9>::zeros();
        for (k, gi) in face.gradients.into_iter().enumerate() {
            for (l, gj) in face.gradients.into_iter().enumerate() {
                let block = tangent.block(gi, gj).to_cols_array();
                matrix
                    .fixed_view_mut::<3, 3>(3 * k, 3 * l)
                    .copy_from(&Matrix3::from_iterator(block));
            }
        }
        matrix
    }

    fn forces(x: &[DVec3]) -> [DVec3; 3] {
        let face = membrane();
        let tangent = MembraneTangent::new(face.area, STIFFNESS, face.gradient_of(x));
        face.gradients.map(|g| tangent.force_density().mul_vec2(g))
    }

    #[test]
    fn force_is_minus_the_gradient_of_the_energy() {
        let mut random = Random::new(1);
        for _ in 0..50 {
            let x = [0; 3].map(|_| random.vector() * 0.2);
            for (k, force) in forces(&x).into_iter().enumerate() {
                for axis in DVec3::AXES {
                    let energy = |step: f64| {
                        let mut moved = x;
                        moved[2 - k] += axis * step;
                        membrane().area * energy_density(STIFFNESS, membrane().strain(&moved))
                    };
                    let difference = (energy(1e-6) - energy(-1e-6)) / 2e-6;
                    let scale = 1.0 + force.length();
                    assert!((force.dot(axis) + difference).abs() < 1e-6 * scale);
                }
            }
        }
    }

    #[test]
    fn tangent_is_the_derivative_of_the_force_in_tension() {
        let stretched =
            Mat3x2 { x_axis: DVec3::new(1.10, 0.05, 0.02), y_axis: DVec3::new(-0.03, 1.05, 0.10) };
        let x = positions(stretched);
        let hessian = hessian(&x);
        for node in 0..3 {
            for axis in 0..3 {
                let at = |step: f64| {
                    let mut moved = x;
                    moved[2 - node][axis] += step;
                    forces(&moved)
                };
                let (plus, minus) = (at(1e-6), at(-1e-6));
                for k in 0..3 {
                    let difference = (minus[k] - plus[k]) / 2e-6;
                    for row in 0..3 {
                        let exact = hessian[(3 * k + row, 3 * node + axis)];
                        assert!((difference[row] - exact).abs() < 1e-5 * hessian.norm());
                    }
                }
            }
        }
    }

    #[test]
    fn tangent_is_positive_semi_definite_everywhere() {
        let mut random = Random::new(2);
        for _ in 0..200 {
            let x = [0; 3].map(|_| random.vector() * 0.15);
            let matrix = hessian(&x);
            let least = matrix.symmetric_eigenvalues().min();
            assert!(least > -1e-10 * matrix.norm(), "eigenvalue {least}");
        }
    }

    #[test]
    fn a_viscous_force_is_minus_the_gradient_of_energy_and_dissipation() {
        let mut random = Random::new(3);
        let viscosity = Viscosity { ratio: 0.7 };
        let face = membrane();
        for _ in 0..50 {
            let (start, x) =
                ([0; 3].map(|_| random.vector() * 0.2), [0; 3].map(|_| random.vector() * 0.2));
            let e0 = face.strain(&start);
            let tangent = MembraneTangent::new(face.area, STIFFNESS, face.gradient_of(&x))
                .damped(viscosity, e0);
            let forces = face.gradients.map(|g| tangent.force_density().mul_vec2(g));
            let energy = |x: &[DVec3]| {
                let density = energy_density(STIFFNESS, face.strain(x))
                    + viscosity.ratio * energy_density(STIFFNESS, face.strain(x) - e0);
                face.area * density
            };
            for (k, force) in forces.into_iter().enumerate() {
                for axis in DVec3::AXES {
                    let at = |step: f64| {
                        let mut moved = x;
                        moved[2 - k] += axis * step;
                        energy(&moved)
                    };
                    let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
                    assert!((force.dot(axis) + difference).abs() < 1e-6 * (1.0 + force.length()));
                }
            }
        }
    }

    #[test]
    fn a_coupling_beyond_the_bound_is_cut_to_it() {
        let cut = bounded(StretchStiffness { uu: 4.0, uv: 9.0, vv: 1.0, shear: -1.0 });
        assert_eq!(cut, StretchStiffness { uu: 4.0, uv: 2.0, vv: 1.0, shear: 0.0 });
        assert_eq!(bounded(STIFFNESS), STIFFNESS);
    }
}
