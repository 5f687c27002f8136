//! Names, units and ranges of what can be tuned.

use super::{Off, ParameterKind, Scale};

/// A setting within a group.
pub(super) struct Row {
    /// Below the group's path.
    pub name: &'static str,
    pub label: &'static str,
    pub unit: &'static str,
    pub kind: ParameterKind,
}

/// Where the ranges of the shortest and the longest edge meet (m): the geometric mean of their
/// defaults, 1 and 20 cm, about.
pub(super) const EDGE_LENGTH_MEETING: f64 = 0.05;

pub(super) const VIEW: [Row; 8] = [
    row("nu_front", "Detail in front", "", logarithmic(0.01, 1.0, 3)),
    row("nu_back", "Detail at the back", "", logarithmic(0.01, 1.0, 3)),
    row("nu_out", "Detail out of frame", "", logarithmic(1e-3, 1.0, 4)),
    row("margin_m", "Margin around the frame", "m", linear(0.0, 3.0, 2)),
    row("anticipation_frames", "Look ahead", "frames", linear(0.0, 50.0, 1)),
    row("min_screen_edge_px", "Smallest edge on screen", "px", linear(0.0, 50.0, 1)),
    row("buckling_exponent", "Buckling compensation", "", linear(0.0, 30.0, 1)),
    row("silhouette_threshold", "Silhouette threshold", "", linear(0.0, 1.0, 2)),
];

pub(super) const SIZING: [Row; 6] = [
    row("refine_angle", "Fold angle", "rad", or_off(logarithmic(0.02, 3.0, 3))),
    row("refine_compression", "Wrinkle compression", "m", or_off(logarithmic(1e-4, 0.5, 4))),
    row("refine_velocity", "Change of speed", "m/s", or_off(logarithmic(0.01, 20.0, 2))),
    row("edge_length_min", "Shortest edge", "m", logarithmic(1e-3, EDGE_LENGTH_MEETING, 4)),
    row("edge_length_max", "Longest edge", "m", or_off(logarithmic(EDGE_LENGTH_MEETING, 2.0, 3))),
    row("aspect_min", "Roundness of triangles", "", linear(0.02, 1.0, 2)),
];

pub(super) const AIR: [Row; 4] = [
    row("steps_per_frame", "Steps per frame", "", ParameterKind::Integer { min: 1, max: 64 }),
    row(
        "air.velocity",
        "Wind",
        "m/s",
        ParameterKind::Vector3 { min: -30.0, max: 30.0, decimals: 2 },
    ),
    row("air.density", "Density of the air", "kg/m^3", linear(0.0, 5.0, 2)),
    row("air.tangential_drag", "Drag along the cloth", "N s/m^3", linear(0.0, 2.0, 3)),
];

pub(super) const CONTACT: [Row; 3] = [
    row("thickness", "Thickness", "m", logarithmic(5e-4, 0.05, 4)),
    row("friction_cloth", "Friction, cloth on cloth", "", linear(0.0, 2.0, 2)),
    row("friction_obstacle", "Friction, cloth on body", "", linear(0.0, 2.0, 2)),
];

pub(super) const FABRIC: [Row; 5] = [
    row("density_mult", "Weight", "x", logarithmic(0.1, 10.0, 3)),
    row("stretching_mult", "Stretch stiffness", "x", logarithmic(0.01, 100.0, 3)),
    row("bending_mult", "Bend stiffness", "x", logarithmic(0.01, 100.0, 3)),
    row("thicken", "Layers", "", logarithmic(0.1, 10.0, 2)),
    row("damping", "Damping", "s", linear(0.0, 0.1, 4)),
];

const fn row(
    name: &'static str,
    label: &'static str,
    unit: &'static str,
    kind: ParameterKind,
) -> Row {
    Row { name, label, unit, kind }
}

const fn linear(min: f64, max: f64, decimals: usize) -> ParameterKind {
    ParameterKind::Number { min, max, scale: Scale::Linear, decimals, off: Off::Never }
}

const fn logarithmic(min: f64, max: f64, decimals: usize) -> ParameterKind {
    ParameterKind::Number { min, max, scale: Scale::Logarithmic, decimals, off: Off::Never }
}

const fn or_off(kind: ParameterKind) -> ParameterKind {
    match kind {
        ParameterKind::Number { min, max, scale, decimals, .. } => {
            ParameterKind::Number { min, max, scale, decimals, off: Off::Null }
        }
        other => other,
    }
}
