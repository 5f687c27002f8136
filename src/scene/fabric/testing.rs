//! Sheets for tests of this module and of what it does to cloth.

use super::{ElasticFabric, IsotropicSheet};

pub const SHEET: IsotropicSheet = IsotropicSheet {
    density: 0.2,
    membrane_stiffness: 300.0,
    poisson_ratio: 0.3,
    bending_rigidity: 2e-5,
};

/// Stiffer along the warp than along the weft, and easily sheared and twisted.
pub fn woven() -> ElasticFabric {
    ElasticFabric {
        membrane_stiffness: [400.0, 100.0],
        bending_rigidity: [9e-6, 4e-6],
        shear_stiffness: 20.0,
        twist_rigidity: 1e-6,
        ..SHEET.fabric()
    }
}
