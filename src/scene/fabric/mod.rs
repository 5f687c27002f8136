//! Fabrics: how heavy cloth is, and how it resists being stretched and bent.

mod elastic;
#[cfg(test)]
mod load_tests;
mod measured;
mod preset;
#[cfg(test)]
pub mod testing;

pub use elastic::{BendingModel, ElasticFabric, IsotropicSheet, PlateCompliance};
pub(in crate::scene) use elastic::{
    homogeneous_bending_rigidity, isotropic_shear_stiffness, isotropic_twist_rigidity,
};
pub use measured::MeasuredFabric;
pub use preset::{PRESETS, Preset};

use crate::math::Mat3x2;

/// What a garment is made of.
#[expect(
    clippy::large_enum_variant,
    reason = "there is one a garment, and it is hardly ever moved"
)]
#[derive(Clone, Debug, PartialEq)]
pub enum Fabric {
    Measured(MeasuredFabric),
    Elastic(ElasticFabric),
}

/// Stiffness of one face, frozen over a step (N/m):
/// psi = 1/2 (k_uu E_uu^2 + k_vv E_vv^2) + k_uv E_uu E_vv + k_shear E_uv^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StretchStiffness {
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
    pub shear: f64,
}

impl Fabric {
    /// (kg/m^2).
    pub fn density(&self) -> f64 {
        match self {
            Fabric::Measured(fabric) => fabric.density,
            Fabric::Elastic(fabric) => fabric.density,
        }
    }

    /// Damping proportional to stiffness (s).
    pub fn damping(&self) -> f64 {
        match self {
            Fabric::Measured(fabric) => fabric.damping,
            Fabric::Elastic(fabric) => fabric.damping,
        }
    }

    /// Least and largest principal stretch the garment may show.
    pub fn strain_limits(&self) -> Option<[f64; 2]> {
        match self {
            Fabric::Measured(fabric) => fabric.strain_limits,
            Fabric::Elastic(fabric) => fabric.strain_limits,
        }
    }

    /// The stretch stiffness at a deformation gradient.
    pub fn stretch_stiffness(&self, deformation: Mat3x2) -> StretchStiffness {
        match self {
            Fabric::Measured(fabric) => fabric.stretch_stiffness(deformation.gram()),
            Fabric::Elastic(fabric) => fabric.stretch_stiffness(),
        }
    }

    /// How it bends, where that is more than hinges.
    pub fn plate(&self) -> Option<(PlateCompliance, BendingModel)> {
        match self {
            Fabric::Measured(_) => None,
            Fabric::Elastic(fabric) => Some((fabric.plate_compliance()?, fabric.bending_model)),
        }
    }

    /// The stiffness of a hinge (N m): of an edge at an angle from u (rad, any) and a curvature
    /// (1/m, its sign of no consequence).
    pub fn hinge_stiffness(&self, edge_angle: f64, curvature: f64) -> f64 {
        match self {
            Fabric::Measured(fabric) => fabric.bending_stiffness(edge_angle, curvature),
            Fabric::Elastic(fabric) => fabric.hinge_stiffness(edge_angle),
        }
    }
}
