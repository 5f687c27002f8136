//! Fabrics for experiments.

use crate::scene::{BendingModel, ElasticFabric, Fabric, IsotropicSheet};

/// An isotropic sheet without damping: D (N m), E h (N/m), density (kg/m^2), and no Poisson's ratio.
pub fn plain(bending: f64, stretching: f64, density: f64) -> Fabric {
    isotropic(bending, stretching, 0.0, density)
}

/// The same with a Poisson's ratio.
pub fn isotropic(bending: f64, stretching: f64, poisson_ratio: f64, density: f64) -> Fabric {
    let sheet = IsotropicSheet {
        density,
        membrane_stiffness: stretching,
        poisson_ratio,
        bending_rigidity: bending,
    };
    Fabric::Elastic(sheet.fabric())
}

/// A sheet without damping that bends by a model of choice.
pub fn bending_by(bending_model: BendingModel, sheet: IsotropicSheet) -> Fabric {
    Fabric::Elastic(ElasticFabric { bending_model, ..sheet.fabric() })
}

/// E h = 12 (1 - nu^2) D / h^2 (N/m) of a homogeneous sheet of thickness h (m).
pub fn homogeneous_stretching(bending: f64, poisson_ratio: f64, thickness: f64) -> f64 {
    12.0 * (1.0 - poisson_ratio * poisson_ratio) * bending / (thickness * thickness)
}
