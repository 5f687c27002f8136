//! What keeps the faces of a fabric within its strain limits; the rest is done by
//! [`System::take_back_within_limits`](super::System::take_back_within_limits).

use super::principal::{StrainBounds, StrainDerivatives};
use crate::math::SymTensor2;

/// Two energies for each limit, so that faces are no stiffer than they must be: where many faces are
/// at a limit a soft one holds them, and few pass on to the hard one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainLimit {
    soft: StrainBounds,
    hard: StrainBounds,
}

/// K at a limit (N/m): it takes what spread loads ask for, 50 N/m within the slack.
const SOFT_STIFFNESS: f64 = 1e4;

/// K of what sets in behind it (N/m), soft and hard together 65 times the soft: it takes a load of
/// 2.9 kN/m, as of a flag in the wind 2 cm from a node that holds it, within 1 % of the ratio.
const HARD_STIFFNESS: f64 = 6.4e5;

/// Share of a limiting ratio beyond it at which the hard energy sets in.
const SLACK: f64 = 5e-3;

impl StrainLimit {
    /// Of a fabric whose principal stretches are to stay within ratios.
    pub fn of_stretch(ratios: [f64; 2]) -> Self {
        Self {
            soft: StrainBounds::of_stretch(ratios, SOFT_STIFFNESS),
            hard: StrainBounds::of_stretch(ratios_beyond(ratios, SLACK), HARD_STIFFNESS),
        }
    }

    /// (J/m^2).
    pub fn energy_density(&self, strain: SymTensor2) -> f64 {
        self.soft.energy_density(strain) + self.hard.energy_density(strain)
    }

    /// Those of the energy density at a strain, `None` where no limit is felt; see
    /// [`StrainBounds::derivatives`] for `expected`.
    pub fn derivatives(
        &self,
        strain: SymTensor2,
        expected: SymTensor2,
    ) -> Option<StrainDerivatives> {
        if !self.soft.may_be_felt(expected) {
            return None;
        }
        let mut sum = self.soft.derivatives(strain, expected);
        if self.hard.may_be_felt(expected) {
            sum += self.hard.derivatives(strain, expected);
        }
        Some(sum)
    }
}

/// Limiting ratios that leave so much more room, a share of either.
pub(super) fn ratios_beyond([least, largest]: [f64; 2], share: f64) -> [f64; 2] {
    [least * (1.0 - share), largest * (1.0 + share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: [f64; 2] = [0.95, 1.05];

    fn strain_of(stretch: f64) -> SymTensor2 {
        SymTensor2 { xx: 0.5 * (stretch * stretch - 1.0), xy: 0.0, yy: 0.0 }
    }

    #[test]
    fn one_percent_beyond_a_limit_takes_a_load_of_2_900_newtons_a_metre_either_way() {
        let limit = StrainLimit::of_stretch(LIMITS);
        for stretch in ratios_beyond(LIMITS, 0.01) {
            let strain = strain_of(stretch);
            let found = limit.derivatives(strain, strain).expect("the limit is felt");
            assert!(found.first[0].abs() > 2.9e3, "{} N/m", found.first[0]);
            assert!(found.first[0].signum() == strain.xx.signum());
        }
    }

    #[test]
    fn the_stress_is_the_slope_of_the_energy_across_both_bounds() {
        let limit = StrainLimit::of_stretch(LIMITS);
        for stretch in [0.93, 0.9475, 1.0, 1.0525, 1.0574, 1.07] {
            let (strain, by) = (strain_of(stretch), 1e-7);
            let at = |by: f64| limit.energy_density(SymTensor2 { xx: strain.xx + by, ..strain });
            let slope = (at(by) - at(-by)) / (2.0 * by);
            let exact = limit.derivatives(strain, strain).map_or(0.0, |d| d.first[0]);
            assert!((slope - exact).abs() < 1e-3 * (1.0 + exact.abs()), "{slope}, not {exact}");
        }
    }
}
