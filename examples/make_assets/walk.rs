//! What the figure of the own shot does: it stands, turns about on the spot, and walks away.

use super::gait::{ArmKey, Choreography};
use super::parts::Side;
use super::steps::{Steps, step};

pub const WALK: Choreography = Choreography {
    steps: Steps {
        // Past the key light of the pictures.
        way_deg: -75.0,
        first_heading_deg: 180.0,
        list: &[
            step(Side::Left, [10.0, 17.0], 0.00, 235.0),
            step(Side::Right, [17.0, 24.0], 0.00, 285.0),
            step(Side::Left, [24.0, 30.0], 0.00, 330.0),
            step(Side::Right, [30.0, 35.0], 0.00, 345.0),
            step(Side::Left, [35.0, 41.0], 0.00, 362.0),
            step(Side::Right, [42.0, 53.0], 0.30, 360.0),
            step(Side::Left, [53.0, 64.0], 0.80, 360.0),
            step(Side::Right, [64.0, 75.0], 1.30, 360.0),
            step(Side::Left, [75.0, 86.0], 1.80, 360.0),
            step(Side::Right, [86.0, 97.0], 2.30, 360.0),
            step(Side::Left, [97.0, 108.0], 2.80, 360.0),
            step(Side::Right, [108.0, 119.0], 3.30, 360.0),
        ],
    },
    kicks: &[],
    arms: &[ArmKey { frame: 0.0, out: 0.50, forward: 0.0, elbow: 0.38 }],
};
