//! The figure's parts, like a wooden mannequin's: where they join, and their profiles.
//!
//! A part's origin is the joint it hangs from; limbs extend downward.

use glam::DVec3;

use super::loft::{Axis, Loft, Ring};

/// The parts in the order of the motion file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Pelvis,
    Chest,
    Head,
    Thigh(Side),
    Shin(Side),
    Foot(Side),
    UpperArm(Side),
    Forearm(Side),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
}

impl Part {
    pub const ALL: [Part; 13] = [
        Part::Pelvis,
        Part::Chest,
        Part::Head,
        Part::Thigh(Side::Left),
        Part::Shin(Side::Left),
        Part::Foot(Side::Left),
        Part::Thigh(Side::Right),
        Part::Shin(Side::Right),
        Part::Foot(Side::Right),
        Part::UpperArm(Side::Left),
        Part::Forearm(Side::Left),
        Part::UpperArm(Side::Right),
        Part::Forearm(Side::Right),
    ];
}

impl Side {
    pub const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// 1 to the right, -1 to the left.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => -1.0,
            Side::Right => 1.0,
        }
    }
}

/// Hip joint in the pelvis.
pub fn hip(side: Side) -> DVec3 {
    DVec3::new(0.088 * side.sign(), 0.0, -0.03)
}

/// Shoulder joint in the chest.
pub fn shoulder(side: Side) -> DVec3 {
    DVec3::new(0.172 * side.sign(), -0.005, 0.275)
}

/// Where the chest joins the pelvis, and the head the chest.
pub const WAIST: DVec3 = DVec3::new(0.0, 0.0, 0.17);
pub const NECK: DVec3 = DVec3::new(0.0, -0.01, 0.328);
pub const THIGH_LENGTH: f64 = 0.42;
pub const SHIN_LENGTH: f64 = 0.41;
pub const UPPER_ARM_LENGTH: f64 = 0.28;
/// Of the ankle above the sole.
pub const ANKLE_HEIGHT: f64 = 0.075;

const fn ring(along: f64, right: f64, across: f64, offset: f64) -> Ring {
    Ring { along, right, across, offset }
}

/// The meshes; left and right share one.
pub const MESHES: [Loft; 8] = [
    Loft {
        name: "pelvis",
        axis: Axis::Up,
        rings: &[
            ring(-0.14, 0.130, 0.095, -0.012),
            ring(-0.04, 0.164, 0.115, -0.012),
            ring(0.04, 0.146, 0.105, -0.006),
            ring(0.12, 0.118, 0.088, 0.0),
            ring(0.20, 0.096, 0.070, 0.0),
        ],
        caps: [0.12, 0.07],
        segments: [28, 18],
    },
    Loft {
        name: "chest",
        axis: Axis::Up,
        rings: &[
            ring(-0.08, 0.092, 0.068, 0.0),
            ring(0.02, 0.108, 0.080, 0.0),
            ring(0.12, 0.132, 0.096, 0.006),
            ring(0.21, 0.150, 0.103, 0.006),
            ring(0.29, 0.150, 0.084, -0.004),
            ring(0.36, 0.085, 0.055, -0.010),
        ],
        caps: [0.08, 0.075],
        segments: [28, 18],
    },
    Loft {
        name: "head",
        axis: Axis::Up,
        rings: &[
            ring(-0.05, 0.056, 0.054, 0.0),
            ring(0.02, 0.043, 0.047, 0.002),
            ring(0.06, 0.047, 0.058, 0.010),
            ring(0.10, 0.064, 0.080, 0.018),
            ring(0.16, 0.077, 0.098, 0.013),
            ring(0.22, 0.081, 0.103, 0.006),
            ring(0.285, 0.078, 0.098, 0.0),
        ],
        caps: [0.03, 0.115],
        segments: [24, 20],
    },
    Loft {
        name: "thigh",
        axis: Axis::Up,
        rings: &[
            ring(-0.475, 0.050, 0.052, 0.0),
            ring(-0.41, 0.054, 0.057, 0.0),
            ring(-0.28, 0.064, 0.068, 0.004),
            ring(-0.12, 0.082, 0.086, 0.002),
            ring(0.0, 0.088, 0.094, -0.004),
            ring(0.085, 0.080, 0.088, -0.006),
        ],
        caps: [0.055, 0.09],
        segments: [18, 16],
    },
    Loft {
        name: "shin",
        axis: Axis::Up,
        rings: &[
            ring(-0.45, 0.032, 0.034, -0.004),
            ring(-0.37, 0.032, 0.035, -0.006),
            ring(-0.24, 0.043, 0.046, -0.012),
            ring(-0.12, 0.053, 0.058, -0.014),
            ring(-0.02, 0.047, 0.049, -0.002),
            ring(0.05, 0.040, 0.042, 0.0),
        ],
        caps: [0.035, 0.055],
        segments: [16, 14],
    },
    Loft {
        name: "foot",
        axis: Axis::Forward,
        rings: &[
            ring(-0.075, 0.030, 0.032, -0.041),
            ring(-0.01, 0.035, 0.044, -0.031),
            ring(0.07, 0.040, 0.031, -0.044),
            ring(0.13, 0.044, 0.021, -0.054),
            ring(0.185, 0.034, 0.014, -0.061),
        ],
        caps: [0.045, 0.05],
        segments: [16, 14],
    },
    Loft {
        name: "upper-arm",
        axis: Axis::Up,
        rings: &[
            ring(-0.315, 0.034, 0.035, 0.0),
            ring(-0.26, 0.036, 0.037, 0.0),
            ring(-0.13, 0.041, 0.044, 0.002),
            ring(0.0, 0.047, 0.050, 0.0),
            ring(0.048, 0.046, 0.048, 0.0),
        ],
        caps: [0.038, 0.05],
        segments: [14, 12],
    },
    Loft {
        name: "forearm",
        axis: Axis::Up,
        rings: &[
            ring(-0.425, 0.010, 0.024, 0.012),
            ring(-0.34, 0.016, 0.038, 0.006),
            ring(-0.29, 0.020, 0.034, 0.002),
            ring(-0.235, 0.022, 0.026, 0.0),
            ring(-0.07, 0.038, 0.038, 0.0),
            ring(0.0, 0.033, 0.033, 0.0),
            ring(0.036, 0.028, 0.029, 0.0),
        ],
        caps: [0.05, 0.038],
        segments: [14, 16],
    },
];
