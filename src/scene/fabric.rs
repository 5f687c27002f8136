//! Fabrics as measured.

use crate::math::{Mat3x2, SymTensor2};

/// What a garment is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Fabric {
    Measured(MeasuredFabric),
}

/// A fabric from the tables of [`WOR11`](crate::papers::WOR11): orthotropic stretch which depends
/// on strain, bending which depends on curvature.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredFabric {
    /// (kg/m^2).
    pub density: f64,
    /// Rows of (k_uu, k_uv, k_vv, k_shear) (N/m): row 0 at rest, rows 1 to 5 for the larger
    /// principal stretch at 0, 22.5, 45, 67.5, 90 degrees from u and a stretch of 1 + 1/6.
    pub stretching: [[f64; 4]; 6],
    /// Rows: edge at 0, 45, 90 degrees in material space; columns: curvature 0, 5, 10, 15, 20 1/m
    /// (N m).
    pub bending: [[f64; 5]; 3],
    /// Damping proportional to stiffness (s).
    pub damping: f64,
    /// Least and largest principal stretch the garment may show.
    pub strain_limits: Option<[f64; 2]>,
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
        }
    }

    /// Damping proportional to stiffness (s).
    pub fn damping(&self) -> f64 {
        match self {
            Fabric::Measured(fabric) => fabric.damping,
        }
    }

    /// The stretch stiffness at a deformation gradient.
    pub fn stretch_stiffness(&self, deformation: Mat3x2) -> StretchStiffness {
        match self {
            Fabric::Measured(fabric) => fabric.stretch_stiffness(deformation.gram()),
        }
    }

    /// The bending stiffness (N m) of an edge at an angle from u (rad, any) and a curvature (1/m,
    /// its sign of no consequence).
    pub fn bending_stiffness(&self, edge_angle: f64, curvature: f64) -> f64 {
        match self {
            Fabric::Measured(fabric) => fabric.bending_stiffness(edge_angle, curvature),
        }
    }
}

impl MeasuredFabric {
    /// Linear in (stretch - 1) x 6 clamped to [0, 1) and in the angle of the larger principal
    /// stretch; negative entries count as 0, then everything is doubled. k_uv is held below
    /// sqrt(k_uu k_vv): above it the energy has no lower bound.
    pub fn stretch_stiffness(&self, _right_cauchy_green: SymTensor2) -> StretchStiffness {
        todo!()
    }

    pub fn bending_stiffness(&self, _edge_angle: f64, _curvature: f64) -> f64 {
        todo!()
    }
}
