//! Stiffness-proportional damping, folded into the moment at which elastic forces are taken.

/// How far beyond the start of a step the elastic forces of a garment are taken (s).
///
/// The force of a backward Euler step with Rayleigh damping is
/// f(x + h v', v') ~ f(x) - h (K_m + K_g) v' - beta K_m v' at the new velocity v'
/// ([`BW98`](crate::papers::BW98)). The part K_m, which is a stiffness times squares of strain
/// gradients, is therefore taken h + beta ahead and the part K_g, which is the present stress times
/// second derivatives of strain, h ahead. K_g is left undamped on purpose: it answers to rigid
/// rotations, and damping it would slow a taut cloth that merely turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lead {
    /// h + beta.
    pub material: f64,
    /// h.
    pub geometric: f64,
}

impl Lead {
    pub fn new(dt: f64, damping: f64) -> Self {
        Self { material: dt + damping, geometric: dt }
    }
}
