//! The parts of a shot file that set numbers: air, contact, stages, sizing, view.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use crate::scene::{
    Air, Contact, Dynamics, SizingSettings, SolverChoice, StageSwitches, ViewRule, ViewSettings,
};

/// The air around the cloth.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct AirFile {
    /// Density (kg/m^3). Default 1; 0 is a vacuum: no drag and no wind.
    pub density: f64,
    /// Wind (m/s). Default at rest.
    pub velocity: [f64; 3],
    /// Drag along the surface per area and relative speed (N s/m^3). Default 0.
    pub tangential_drag: f64,
}

impl Default for AirFile {
    fn default() -> Self {
        let Air { density, velocity, tangential_drag } = Air::default();
        Self { density, velocity: velocity.to_array(), tangential_drag }
    }
}

impl AirFile {
    pub(in crate::scene) fn air(self) -> Air {
        let Self { density, velocity, tangential_drag } = self;
        Air { density, velocity: DVec3::from_array(velocity), tangential_drag }
    }
}

/// Contact between cloth and obstacles, and cloth and cloth.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactFile {
    /// Distance at which cloth is held off (m). Default 0.005. Thinner: closer contact, and more
    /// work to keep it. At least 1e-5, and at most 1/20 of the square root of a garment's area.
    pub thickness: f64,
    /// Stiffness of the contact layer per area of cloth (N/m per m^2). Default 1e6. Softer: heavy
    /// cloth sinks deeper into the layer.
    pub stiffness: f64,
    /// Coefficient of friction, cloth against cloth. Default 0.6.
    pub friction_cloth: f64,
    /// Coefficient of friction, cloth against obstacles. Default 0.3.
    pub friction_obstacle: f64,
}

impl Default for ContactFile {
    fn default() -> Self {
        let Contact { thickness, stiffness, friction_cloth, friction_obstacle } =
            Contact::default();
        Self { thickness, stiffness, friction_cloth, friction_obstacle }
    }
}

impl ContactFile {
    pub(in crate::scene) fn contact(self) -> Contact {
        let Self { thickness, stiffness, friction_cloth, friction_obstacle } = self;
        Contact { thickness, stiffness, friction_cloth, friction_obstacle }
    }
}

/// How the equations of a step are solved.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct DynamicsFile {
    /// Newton iterations a step at most. Default 1: one linearised step. More: stiff cloth and hard
    /// contact at large steps, each at the price of another solution.
    pub iterations: u32,
    /// Iterations end when none changes a velocity by more than this (m/s). Default 0.0001.
    pub tolerance: f64,
    /// How linear equations are solved. Default auto: by conjugate gradients to 5 digits, or by
    /// factorisation where that is cheaper; direct: always by factorisation, to rounding.
    pub solver: SolverChoice,
}

impl Default for DynamicsFile {
    fn default() -> Self {
        let Dynamics { iterations, tolerance, solver } = Dynamics::default();
        Self { iterations, tolerance, solver }
    }
}

impl DynamicsFile {
    pub(in crate::scene) fn dynamics(self) -> Dynamics {
        let Self { iterations, tolerance, solver } = self;
        Dynamics { iterations, tolerance, solver }
    }
}

/// A stage of the simulation that a scene may leave out.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StageName {
    /// Forces: the cloth only follows its handles.
    Dynamics,
    /// The soft layer that holds surfaces apart.
    Proximity,
    /// The continuous test that keeps surfaces from passing through each other.
    Collision,
    /// Contact of cloth with cloth: garments pass through one another and through themselves.
    SelfContact,
    /// Adaptive resolution: the mesh stays as given.
    Remeshing,
    /// The bound on stretch.
    StrainLimiting,
    /// The repair of intersections.
    Untangling,
}

pub(in crate::scene) fn stages(disabled: &[StageName]) -> StageSwitches {
    let mut stages = StageSwitches::default();
    for name in disabled {
        *match name {
            StageName::Dynamics => &mut stages.dynamics,
            StageName::Proximity => &mut stages.proximity,
            StageName::Collision => &mut stages.collision,
            StageName::SelfContact => &mut stages.self_contact,
            StageName::Remeshing => &mut stages.remeshing,
            StageName::StrainLimiting => &mut stages.strain_limiting,
            StageName::Untangling => &mut stages.untangling,
        } = false;
    }
    stages
}

/// How fine a garment must be, whoever looks. `null` is infinity: the criterion is off.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct SizingFile {
    /// Largest change of normal along an edge (rad). Default 0.3. Smaller: finer folds, more
    /// faces.
    #[serde(deserialize_with = "null_is_infinite")]
    pub refine_angle: Option<f64>,
    /// Largest compression that buckles below the mesh's resolution (m). Default 0.01. Smaller:
    /// finer where cloth is about to wrinkle.
    #[serde(deserialize_with = "null_is_infinite")]
    pub refine_compression: Option<f64>,
    /// Largest change of velocity along an edge (m/s). Default 0.5. Smaller: finer where cloth
    /// moves.
    #[serde(deserialize_with = "null_is_infinite")]
    pub refine_velocity: Option<f64>,
    /// Shortest edge worth having (m, material). Default 0.01.
    #[serde(deserialize_with = "null_is_infinite")]
    pub edge_length_min: Option<f64>,
    /// Longest edge allowed before the view coarsens it (m, material). Default 0.2.
    #[serde(deserialize_with = "null_is_infinite")]
    pub edge_length_max: Option<f64>,
    /// Least aspect of a triangle and least ratio of the edge lengths asked for, above 0 and up to
    /// 1. Default 0.2. Larger: rounder triangles, more of them.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub aspect_min: Option<f64>,
}

impl SizingFile {
    pub(in crate::scene) fn sizing(self) -> SizingSettings {
        let base = SizingSettings::default();
        SizingSettings {
            refine_angle: self.refine_angle.unwrap_or(base.refine_angle),
            refine_compression: self.refine_compression.unwrap_or(base.refine_compression),
            refine_velocity: self.refine_velocity.unwrap_or(base.refine_velocity),
            edge_length_min: self.edge_length_min.unwrap_or(base.edge_length_min),
            edge_length_max: self.edge_length_max.unwrap_or(base.edge_length_max),
            aspect_min: self.aspect_min.unwrap_or(base.aspect_min),
        }
    }
}

fn null_is_infinite<'de, D: Deserializer<'de>>(source: D) -> Result<Option<f64>, D::Error> {
    Ok(Some(Option::<f64>::deserialize(source)?.unwrap_or(f64::INFINITY)))
}

/// What is said is a value: `null` would be taken for "off" or "infinite" by some, for the default by
/// others.
fn given<'de, T: Deserialize<'de>, D: Deserializer<'de>>(source: D) -> Result<Option<T>, D::Error> {
    T::deserialize(source).map(Some)
}

/// How the view coarsens cloth; only what is named differs from the shot's own setting.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ViewFile {
    /// View factor of what faces the camera, above 0 and up to 1; edge lengths grow by its
    /// inverse. Default 1.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub nu_front: Option<f64>,
    /// View factor of the far side of a garment that is not two-sided. Default 0.2.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub nu_back: Option<f64>,
    /// View factor far outside the frame. Default 0.01; 0.1 is safer for layered garments.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub nu_out: Option<f64>,
    /// Width of the fall-off from the frame's edge to `nu_out` (m, world). Default 0.4; 0 is a
    /// hard edge.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub margin_m: Option<f64>,
    /// How many frames ahead refinement begins. Default 5; 0 looks only at the present, and cloth
    /// pops as it comes into frame.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub anticipation_frames: Option<f64>,
    /// Shortest edge worth having on the image (pixels of the shot's own resolution). Default 4;
    /// 0 switches the limit off.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub min_screen_edge_px: Option<f64>,
    /// Exponent of the buckling compensation outside the frame. Default 10; 0 switches it off.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub buckling_exponent: Option<f64>,
    /// Difference of view factor across an edge above which the hidden face is resampled.
    /// Default 0.1.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub silhouette_threshold: Option<f64>,
    /// What the time window anticipates: `whole-metric` or, to reproduce the papers, `papers`.
    #[serde(deserialize_with = "given", skip_serializing_if = "Option::is_none")]
    pub rule: Option<ViewRule>,
}

impl ViewFile {
    pub(in crate::scene) fn over(self, base: ViewSettings) -> ViewSettings {
        ViewSettings {
            nu_front: self.nu_front.unwrap_or(base.nu_front),
            nu_back: self.nu_back.unwrap_or(base.nu_back),
            nu_out: self.nu_out.unwrap_or(base.nu_out),
            margin_m: self.margin_m.unwrap_or(base.margin_m),
            anticipation_frames: self.anticipation_frames.unwrap_or(base.anticipation_frames),
            min_screen_edge_px: self.min_screen_edge_px.unwrap_or(base.min_screen_edge_px),
            buckling_exponent: self.buckling_exponent.unwrap_or(base.buckling_exponent),
            silhouette_threshold: self.silhouette_threshold.unwrap_or(base.silhouette_threshold),
            rule: self.rule.unwrap_or(base.rule),
        }
    }
}
