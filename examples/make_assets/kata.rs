//! What the figure in the layered outfit does: it stands with its arms out to the sides, takes them
//! into a guard, kicks, turns about, kicks with the other leg, and turns back.

use super::gait::{ArmKey, Choreography};
use super::kick::Kick;
use super::parts::Side;
use super::steps::{Steps, step};

pub const KATA: Choreography = Choreography {
    steps: Steps {
        way_deg: -75.0,
        first_heading_deg: 0.0,
        list: &[
            step(Side::Right, [26.0, 50.0], 0.00, 0.0),
            step(Side::Left, [54.0, 60.0], 0.00, 60.0),
            step(Side::Right, [59.0, 65.0], 0.00, 120.0),
            step(Side::Left, [64.0, 70.0], 0.00, 180.0),
            step(Side::Right, [69.0, 75.0], 0.00, 180.0),
            step(Side::Left, [76.0, 100.0], 0.00, 180.0),
            step(Side::Right, [100.0, 106.0], 0.00, 240.0),
            step(Side::Left, [105.0, 111.0], 0.00, 300.0),
            step(Side::Right, [110.0, 116.0], 0.00, 360.0),
            step(Side::Left, [115.0, 121.0], 0.00, 360.0),
        ],
    },
    kicks: &[
        Kick { side: Side::Right, frames: [26.0, 50.0] },
        Kick { side: Side::Left, frames: [76.0, 100.0] },
    ],
    arms: &[
        // Straight out to the sides, as the sleeves are cut.
        ArmKey { frame: 3.0, out: 1.57, forward: 0.0, elbow: 0.05 },
        ArmKey { frame: 24.0, out: 0.95, forward: 0.45, elbow: 0.75 },
        ArmKey { frame: 36.0, out: 1.15, forward: 0.25, elbow: 0.55 },
        ArmKey { frame: 54.0, out: 0.90, forward: 0.45, elbow: 0.75 },
        ArmKey { frame: 86.0, out: 1.15, forward: 0.25, elbow: 0.55 },
        ArmKey { frame: 104.0, out: 0.90, forward: 0.45, elbow: 0.75 },
    ],
};
