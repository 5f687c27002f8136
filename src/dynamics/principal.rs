//! Energies that depend on principal strains: limits that stiffen, compression that is let off.
//!
//! With E = sum_i lambda_i a_i a_i^T and a change dE whose components along the axes are d_11, d_22
//! and d_12, a function of the eigenvalues alone changes to first order by sum_i f'(lambda_i) d_ii,
//! and to second order by
//! 1/2 sum_i f''(lambda_i) d_ii^2 + (f'_1 - f'_2) / (lambda_1 - lambda_2) d_12^2.

use std::ops::AddAssign;

use crate::math::{Eigen2, SymTensor2};
use crate::scene::StretchStiffness;

/// First and second derivative of an energy density by (E_uu, E_vv, E_uv).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrainDerivatives {
    /// (N/m).
    pub first: [f64; 3],
    /// (N/m); symmetric, positive semi-definite.
    pub second: [[f64; 3]; 3],
}

/// Bounds that stiffen a face: 1/2 K (lambda - bound)^2 per principal strain beyond a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainBounds {
    /// Least and largest principal Green strain.
    pub least: f64,
    pub largest: f64,
    /// K (N/m).
    pub stiffness: f64,
}

/// Principal strains nearer than this count as equal: a difference quotient of them would be noise.
const EQUAL_STRAINS: f64 = 1e-9;

impl StrainDerivatives {
    /// S, with S_uv half of the derivative by E_uv, which stands for both off-diagonal entries.
    pub fn stress(&self) -> SymTensor2 {
        let [uu, vv, uv] = self.first;
        SymTensor2 { xx: uu, xy: 0.5 * uv, yy: vv }
    }

    /// Those of psi, at a strain; `k` is one whose energy has a lower bound.
    pub fn elastic(k: StretchStiffness, e: SymTensor2) -> Self {
        Self {
            first: [k.uu * e.xx + k.uv * e.yy, k.vv * e.yy + k.uv * e.xx, 2.0 * k.shear * e.xy],
            second: [[k.uu, k.uv, 0.0], [k.uv, k.vv, 0.0], [0.0, 0.0, 2.0 * k.shear]],
        }
    }

    /// Adds weight l l^T to the second derivative.
    fn add_square(&mut self, form: [f64; 3], weight: f64) {
        for (row, a) in self.second.iter_mut().zip(form) {
            for (entry, b) in row.iter_mut().zip(form) {
                *entry += weight * a * b;
            }
        }
    }
}

impl AddAssign for StrainDerivatives {
    fn add_assign(&mut self, other: Self) {
        for k in 0..3 {
            self.first[k] += other.first[k];
            for l in 0..3 {
                self.second[k][l] += other.second[k][l];
            }
        }
    }
}

impl StrainBounds {
    /// Of a fabric whose principal stretches are to stay within ratios.
    pub fn of_stretch([least, largest]: [f64; 2], stiffness: f64) -> Self {
        let green = |stretch: f64| 0.5 * (stretch * stretch - 1.0);
        Self { least: green(least), largest: green(largest), stiffness }
    }

    /// Whether a principal strain may be beyond a bound; cheaper than to ask which.
    pub fn may_be_felt(&self, strain: SymTensor2) -> bool {
        let mean = 0.5 * strain.trace();
        let radius = (0.5 * (strain.xx - strain.yy)).hypot(strain.xy);
        mean + radius > self.largest || mean - radius < self.least
    }

    /// (J/m^2).
    pub fn energy_density(&self, strain: SymTensor2) -> f64 {
        let beyond = |value: f64| (value - self.largest).max(self.least - value).max(0.0);
        let beyond = strain.eigen().values.map(beyond);
        0.5 * self.stiffness * (beyond[0] * beyond[0] + beyond[1] * beyond[1])
    }

    /// At a strain; which bounds are felt is judged at another, `expected`, about that of the end of
    /// the step: a bound that the step is going to reach resists from its start.
    pub fn derivatives(&self, strain: SymTensor2, expected: SymTensor2) -> StrainDerivatives {
        let eigen = strain.eigen();
        let forms = Axes::new(eigen).forms();
        let ahead =
            forms.map(|[uu, vv, uv]| uu * expected.xx + vv * expected.yy + uv * expected.xy);
        let of_axis = |k: usize| match ahead[k] {
            value if value > self.largest => (eigen.values[k] - self.largest, 1.0),
            value if value < self.least => (eigen.values[k] - self.least, 1.0),
            _ => (0.0, 0.0),
        };
        let mut found = StrainDerivatives::default();
        let axes = [of_axis(0), of_axis(1)];
        for (form, (beyond, felt)) in forms.into_iter().zip(axes) {
            for (first, share) in found.first.iter_mut().zip(form) {
                *first += self.stiffness * beyond * share;
            }
            found.add_square(form, self.stiffness * felt);
        }
        let gap = eigen.values[0] - eigen.values[1];
        let turning = match gap > EQUAL_STRAINS {
            true => ((axes[0].0 - axes[1].0) / gap).clamp(0.0, 1.0),
            false => 0.5 * (axes[0].1 + axes[1].1),
        };
        found.add_square(forms[2], 2.0 * self.stiffness * turning);
        found
    }
}

/// The principal axes as linear forms.
struct Axes {
    /// x^2, y^2 and x y of the major axis.
    squares: [f64; 3],
}

impl Axes {
    fn new(eigen: Eigen2) -> Self {
        let a = eigen.major_axis;
        Self { squares: [a.x * a.x, a.y * a.y, a.x * a.y] }
    }

    /// d_11, d_22 and d_12 as forms of (E_uu, E_vv, E_uv).
    fn forms(&self) -> [[f64; 3]; 3] {
        let [xx, yy, xy] = self.squares;
        [[xx, yy, 2.0 * xy], [yy, xx, -2.0 * xy], [-xy, xy, xx - yy]]
    }

    /// (E_uu, E_vv, E_uv) as forms of d_11, d_22 and d_12.
    fn inverse_forms(&self) -> [[f64; 3]; 3] {
        let [xx, yy, xy] = self.squares;
        [[xx, yy, -2.0 * xy], [yy, xx, 2.0 * xy], [xy, -xy, xx - yy]]
    }
}

/// The strain that a face which buckles between its nodes is taken to have: negative principal
/// strains times the root of alpha ([`VD15`](crate::papers::VD15) 3.5, as an energy).
///
/// VD15 scales strains by alpha and takes their stress for the force. As psi(E^) weighs compression
/// by the square of the factor, its root gives the same exponent k in eq. 11.
pub fn compensated_strain(strain: SymTensor2, root_alpha: f64) -> SymTensor2 {
    let eigen = strain.eigen();
    if eigen.values[1] >= 0.0 {
        return strain;
    }
    let values = eigen.values.map(|value| scaled(value, root_alpha));
    SymTensor2::from_eigen(Eigen2 { values, ..eigen })
}

fn scaled(value: f64, root_alpha: f64) -> f64 {
    if value < 0.0 { root_alpha * value } else { value }
}

/// Those of W(E) = psi(E^(E)), with J = dE^/dE: J^T dpsi/dE^ and J^T C J. The second derivative of
/// E^ is left out: it has an indefinite part (Gauss-Newton).
pub fn compensated_derivatives(
    k: StretchStiffness,
    strain: SymTensor2,
    root_alpha: f64,
) -> StrainDerivatives {
    let eigen = strain.eigen();
    let plain = StrainDerivatives::elastic(k, compensated_strain(strain, root_alpha));
    if eigen.values[1] >= 0.0 {
        return plain;
    }
    let jacobian = compensation_jacobian(eigen, root_alpha);
    let mut found = StrainDerivatives::default();
    for row in 0..3 {
        found.first[row] = (0..3).map(|p| jacobian[p][row] * plain.first[p]).sum();
        for column in 0..3 {
            let entry =
                |p: usize, q: usize| jacobian[p][row] * plain.second[p][q] * jacobian[q][column];
            found.second[row][column] = (0..9).map(|i| entry(i / 3, i % 3)).sum();
        }
    }
    found
}

/// dE^/dE: along the axes diag(g'_1, g'_2, (g_1 - g_2) / (lambda_1 - lambda_2)).
fn compensation_jacobian(eigen: Eigen2, root_alpha: f64) -> [[f64; 3]; 3] {
    let slopes = eigen.values.map(|value| if value < 0.0 { root_alpha } else { 1.0 });
    let gap = eigen.values[0] - eigen.values[1];
    let turning = match gap > EQUAL_STRAINS {
        true => (scaled(eigen.values[0], root_alpha) - scaled(eigen.values[1], root_alpha)) / gap,
        false => 0.5 * (slopes[0] + slopes[1]),
    };
    let factors = [slopes[0], slopes[1], turning];
    let axes = Axes::new(eigen);
    let (forms, inverse) = (axes.forms(), axes.inverse_forms());
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            (0..3).map(|k| inverse[row][k] * factors[k] * forms[k][column]).sum()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::stretch::energy_density;
    use crate::dynamics::testing::Random;

    const STIFFNESS: StretchStiffness =
        StretchStiffness { uu: 900.0, uv: 250.0, vv: 600.0, shear: 300.0 };
    const BOUNDS: StrainBounds = StrainBounds { least: -0.05, largest: 0.05, stiffness: 1e4 };

    fn components(e: SymTensor2) -> [f64; 3] {
        [e.xx, e.yy, e.xy]
    }

    fn moved(e: SymTensor2, component: usize, by: f64) -> SymTensor2 {
        let mut c = components(e);
        c[component] += by;
        SymTensor2 { xx: c[0], xy: c[2], yy: c[1] }
    }

    fn strains() -> impl Iterator<Item = SymTensor2> {
        let mut random = Random::new(7);
        (0..200).map(move |_| {
            let v = random.vector() * 0.3;
            SymTensor2 { xx: v.x, xy: v.y, yy: v.z }
        })
    }

    fn assert_first_is_the_gradient(
        energy: impl Fn(SymTensor2) -> f64,
        first: impl Fn(SymTensor2) -> [f64; 3],
    ) {
        for strain in strains() {
            for (k, exact) in first(strain).into_iter().enumerate() {
                let by = 1e-6;
                let difference =
                    (energy(moved(strain, k, by)) - energy(moved(strain, k, -by))) / (2.0 * by);
                let scale = 1.0 + exact.abs();
                assert!((difference - exact).abs() < 1e-4 * scale, "{difference}, not {exact}");
            }
        }
    }

    #[test]
    fn the_stress_of_a_limit_is_the_gradient_of_its_energy() {
        assert_first_is_the_gradient(
            |e| BOUNDS.energy_density(e),
            |e| BOUNDS.derivatives(e, e).first,
        );
    }

    #[test]
    fn the_stress_of_compensated_strain_is_the_gradient_of_its_energy() {
        for root_alpha in [0.03, 0.5, 1.0] {
            assert_first_is_the_gradient(
                |e| energy_density(STIFFNESS, compensated_strain(e, root_alpha)),
                |e| compensated_derivatives(STIFFNESS, e, root_alpha).first,
            );
        }
    }

    #[test]
    fn the_tangent_of_a_limit_is_the_derivative_of_its_stress() {
        for strain in strains() {
            // At a bound the stress has a kink, and no derivative.
            let is_near = |value: f64| (value.abs() - BOUNDS.largest).abs() < 1e-4;
            if strain.eigen().values.into_iter().any(is_near) {
                continue;
            }
            let exact = BOUNDS.derivatives(strain, strain).second;
            for column in 0..3 {
                let at = |by: f64| {
                    let e = moved(strain, column, by);
                    BOUNDS.derivatives(e, e).first
                };
                let (plus, minus) = (at(1e-7), at(-1e-7));
                for row in 0..3 {
                    let difference = (plus[row] - minus[row]) / 2e-7;
                    // Of two limits pulling against one another the turning part is cut off.
                    let error = (difference - exact[row][column]).abs();
                    assert!(error < 1e-3 * BOUNDS.stiffness, "{difference} {exact:?} {strain:?}");
                }
            }
        }
    }

    #[test]
    fn tangents_are_positive_semi_definite() {
        for strain in strains() {
            let bounds = BOUNDS.derivatives(strain, strain).second;
            let compensated = compensated_derivatives(STIFFNESS, strain, 0.1).second;
            for matrix in [bounds, compensated] {
                let matrix = nalgebra::Matrix3::from_fn(|r, c| matrix[r][c]);
                assert!(matrix.symmetric_eigenvalues().min() > -1e-9 * (1.0 + matrix.norm()));
            }
        }
    }

    #[test]
    fn full_compensation_leaves_strain_as_it_is() {
        for strain in strains() {
            let difference = compensated_strain(strain, 1.0) - strain;
            assert!(components(difference).iter().all(|d| d.abs() < 1e-12));
        }
    }
}
