//! Stiffness-proportional damping, as a potential of what a step changes.

/// How strongly a step resists the strain it adds.
///
/// Rayleigh damping dissipates beta/2 dE/dt : C : dE/dt. Over a step of h the rate is
/// (E - E_0) / h, so the force of the step is minus the gradient of
/// W(x) + beta / (2 h) (E - E_0) : C : (E - E_0): an energy like any other, with which line searches
/// work. Strain does not see rigid rotations: a taut cloth that merely turns is not slowed, as
/// it would be by damping the geometric stiffness ([`BW98`](crate::papers::BW98)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscosity {
    /// beta / h.
    pub ratio: f64,
}

impl Viscosity {
    /// Of a damping beta (s) over a step of `dt` (s).
    pub fn new(damping: f64, dt: f64) -> Self {
        Self { ratio: damping / dt }
    }

    pub fn is_felt(self) -> bool {
        self.ratio > 0.0
    }
}
