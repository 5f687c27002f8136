//! Settings with unit, default and consequence.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The air around the cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// (kg/m^3). 0 is a vacuum and costs nothing.
    pub density: f64,
    /// Wind (m/s).
    pub velocity: DVec3,
    /// Drag along the surface, per area and relative speed (N s/m^3).
    pub tangential_drag: f64,
}

impl Default for Air {
    fn default() -> Self {
        Self { density: 1.0, velocity: DVec3::ZERO, tangential_drag: 0.0 }
    }
}

/// Contact between cloth and obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Distance at which cloth is held off (m).
    pub thickness: f64,
    /// Stiffness of the layer per area of cloth (N/m per m^2).
    pub stiffness: f64,
    /// Coulomb friction, cloth against cloth.
    pub friction_cloth: f64,
    /// Coulomb friction, cloth against obstacles.
    pub friction_obstacle: f64,
}

impl Default for Contact {
    fn default() -> Self {
        Self { thickness: 5e-3, stiffness: 1e6, friction_cloth: 0.6, friction_obstacle: 0.3 }
    }
}

/// How the equations of a step are solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// Newton iterations a step at most; 1 is one linearised step, which is what most shots need.
    /// More: stiff cloth and hard contact at large steps, each at the price of another solution.
    pub iterations: u32,
    /// Iterations end when none changes a velocity by more than this (m/s).
    pub tolerance: f64,
    pub solver: SolverChoice,
}

/// How a step's linear equations are solved.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverChoice {
    /// By conjugate gradients to 5 digits, or by factorisation where that is cheaper.
    #[default]
    Auto,
    /// By factorisation: to rounding, and several times slower.
    Direct,
}

impl Default for Dynamics {
    fn default() -> Self {
        Self { iterations: 1, tolerance: 1e-4, solver: SolverChoice::Auto }
    }
}

/// Stages that a scene may leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StageSwitches {
    pub dynamics: bool,
    pub proximity: bool,
    pub collision: bool,
    pub self_contact: bool,
    pub remeshing: bool,
    pub strain_limiting: bool,
    pub untangling: bool,
}

impl Default for StageSwitches {
    fn default() -> Self {
        Self {
            dynamics: true,
            proximity: true,
            collision: true,
            self_contact: true,
            remeshing: true,
            strain_limiting: true,
            untangling: true,
        }
    }
}

/// How fine a garment must be, whoever looks ([`NSO12`](crate::papers::NSO12)).
///
/// An infinite tolerance switches its criterion off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SizingSettings {
    /// Largest change of normal along an edge (rad). Smaller: finer folds, more faces.
    pub refine_angle: f64,
    /// Largest compression that buckles below the mesh's resolution (m). Smaller: finer where
    /// cloth is about to wrinkle.
    pub refine_compression: f64,
    /// Largest change of velocity along an edge (m/s). Smaller: finer where cloth moves.
    pub refine_velocity: f64,
    /// Shortest edge worth having (m, material).
    pub edge_length_min: f64,
    /// Longest edge allowed before the view coarsens it (m, material).
    pub edge_length_max: f64,
    /// Least aspect 12 sqrt(3) A / P^2 of a triangle, and least ratio of its edge lengths asked
    /// for, 0..1.
    pub aspect_min: f64,
}

impl Default for SizingSettings {
    fn default() -> Self {
        Self {
            refine_angle: 0.3,
            refine_compression: 0.01,
            refine_velocity: 0.5,
            edge_length_min: 10e-3,
            edge_length_max: 200e-3,
            aspect_min: 0.2,
        }
    }
}

/// How the view coarsens a garment ([`VD15`](crate::papers::VD15)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ViewSettings {
    /// View factor of what faces the camera, 0..1; edge lengths grow by its inverse.
    pub nu_front: f64,
    /// View factor of the far side of a garment that is not two-sided.
    pub nu_back: f64,
    /// View factor far outside the frame.
    pub nu_out: f64,
    /// Width of the fall-off from the frame's edge to `nu_out` (m, world); 0 is a hard edge.
    pub margin_m: f64,
    /// How many frames ahead refinement begins (frames of the shot); 0 looks only at the present.
    pub anticipation_frames: f64,
    /// Shortest edge worth having on the image (pixels of the shot's own resolution).
    pub min_screen_edge_px: f64,
    /// Exponent k of the buckling compensation (eq. 11).
    pub buckling_exponent: f64,
    /// Difference of view factor across an edge above which the hidden face is resampled (3.3).
    pub silhouette_threshold: f64,
    pub rule: ViewRule,
}

/// What the time window anticipates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViewRule {
    /// The whole view-dependent metric of every viewer over [t, t+T]: a cut from a wide shot to a
    /// close-up is prepared as well.
    #[default]
    WholeMetric,
    /// The view factor alone, with the screen clamp of the present camera, as in
    /// [`VD15`](crate::papers::VD15) eqs. 4 to 8; the first viewer only.
    Papers,
}

impl Default for ViewSettings {
    fn default() -> Self {
        Self {
            nu_front: 1.0,
            nu_back: 0.2,
            nu_out: 0.01,
            margin_m: 0.4,
            anticipation_frames: 5.0,
            min_screen_edge_px: 4.0,
            buckling_exponent: 10.0,
            silhouette_threshold: 0.1,
            rule: ViewRule::WholeMetric,
        }
    }
}
