//! Fabrics as they are written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::BendingModel;

/// A fabric: measured tables, here or in a material file, an elastic sheet or a preset of one; and
/// factors on them.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct FabricFile {
    /// A material file with `density`, `stretching` and `bending`; instead of the tables here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// One of `cotton`, `silk`, `denim`, `wool`, `leather`, `rubber`, instead of tables.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// A linear elastic sheet, instead of tables.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elastic: Option<ElasticFile>,
    /// How the bending of an elastic sheet is taken from its mesh. Default `moments`; the others are
    /// there to compare with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending_model: Option<BendingModel>,
    /// Mass per area (kg/m^2).
    pub density: Option<f64>,
    /// Six rows of (k_uu, k_uv, k_vv, k_shear) (N/m): at rest, then for the larger principal
    /// stretch at 0, 22.5, 45, 67.5 and 90 degrees from u and a stretch of 1 + 1/6.
    pub stretching: Option<[[f64; 4]; 6]>,
    /// Three rows (edge at 0, 45, 90 degrees from u) of five (curvature 0, 5, 10, 15, 20 1/m)
    /// bending stiffnesses (N m).
    pub bending: Option<[[f64; 5]; 3]>,
    /// Factor on the mass. Default 1.
    pub density_mult: f64,
    /// Factor on the stretching stiffness. Default 1.
    pub stretching_mult: f64,
    /// Factor on the bending stiffness. Default 1.
    pub bending_mult: f64,
    /// Layers of the same fabric: a factor on mass, stretching and bending. Default 1.
    pub thicken: f64,
    /// Damping proportional to stiffness (s). Default 0.
    pub damping: f64,
    /// Least and largest stretch ratio, for example [0.95, 1.05]. Default none. Cloth
    /// beyond them is stiff, its steps are iterated, and what is left beyond is projected.
    pub strain_limits: Option<[f64; 2]>,
    /// Distance at which cloth of this fabric is held off obstacles (m); off other cloth it is the mean
    /// of both fabrics'. Default `contact.thickness`. The thickest is at most five times the thinnest.
    /// Limits as those of `contact.thickness`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_thickness: Option<f64>,
}

impl Default for FabricFile {
    fn default() -> Self {
        Self {
            file: None,
            preset: None,
            elastic: None,
            bending_model: None,
            density: None,
            stretching: None,
            bending: None,
            density_mult: 1.0,
            stretching_mult: 1.0,
            bending_mult: 1.0,
            thicken: 1.0,
            damping: 0.0,
            strain_limits: None,
            contact_thickness: None,
        }
    }
}

/// A linear elastic sheet: its stiffness depends neither on strain nor on curvature.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ElasticFile {
    /// Mass per area (kg/m^2).
    pub density: Option<f64>,
    /// Young's modulus E (Pa), of a homogeneous sheet that has a `thickness`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub young_modulus: Option<WarpWeft>,
    /// h (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<f64>,
    /// E h (N/m), instead of `young_modulus`: pull per width and strain of a strip that is free to
    /// narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub membrane_stiffness: Option<WarpWeft>,
    /// G h (N/m): shear force per length and angle (rad). Default E h / (2 (1 + nu)).
    pub shear_stiffness: Option<f64>,
    /// nu, the geometric mean of both directions': above -1 and below 1; at most 0.5 for a
    /// homogeneous sheet with one `young_modulus` and no `shear_stiffness` of its own. Default 0.3.
    pub poisson_ratio: Option<f64>,
    /// D (N m): moment per width and curvature of a sheet that stays flat across. Default
    /// E h^3 / (12 (1 - nu^2)), where `young_modulus` and `thickness` are given.
    pub bending_rigidity: Option<WarpWeft>,
    /// Twisting moment per length and twist (N m). Default (1 - nu) D.
    pub twist_rigidity: Option<f64>,
}

/// One value for all directions, or [warp, weft]: along u and along v.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged, expecting = "expected a number or a list of two: [warp, weft]")]
pub enum WarpWeft {
    Same(f64),
    Each([f64; 2]),
}

impl WarpWeft {
    pub(in crate::scene) fn values(self) -> [f64; 2] {
        match self {
            WarpWeft::Same(value) => [value; 2],
            WarpWeft::Each(values) => values,
        }
    }
}
