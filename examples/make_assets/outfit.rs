//! The cuts of the layered outfit: a shirt over the waistband of a skirt, and a jacket over both.

use super::top::{Neck, Top};

/// With short sleeves, closed.
pub const SHIRT: Top = Top {
    yoke: 0.235,
    hem: -0.14,
    radius: 0.130,
    plane: 0.128,
    bulge: 0.052,
    flare: 0.33,
    armhole: 0.055,
    sleeve: 0.27,
    neck: Neck { half_width: 0.075, front: 0.17, back: 0.10, gap: 0.0 },
};

/// With wide sleeves to above the elbows, open all the way down.
pub const JACKET: Top = Top {
    yoke: 0.235,
    hem: -0.21,
    radius: 0.150,
    plane: 0.135,
    bulge: 0.070,
    flare: 0.42,
    armhole: 0.085,
    sleeve: 0.42,
    neck: Neck { half_width: 0.075, front: 0.30, back: 0.10, gap: 0.045 },
};
