//! Fabrics for experiments.

use crate::scene::{Fabric, MeasuredFabric};

/// A fabric of constant stiffness without Poisson coupling: bending rigidity D (N m), membrane
/// stiffness k (N/m), density (kg/m^2).
pub fn plain(bending: f64, stretching: f64, density: f64) -> Fabric {
    // Table entries are doubled when they are read.
    let half = 0.5 * stretching;
    Fabric::Measured(MeasuredFabric {
        density,
        stretching: [[half, 0.0, half, half]; 6],
        bending: [[bending; 5]; 3],
        damping: 0.0,
        strain_limits: None,
    })
}
