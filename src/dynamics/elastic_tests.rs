//! Stretching of elastic sheets: pulls, shears and turns with known answers.

use glam::DVec2;

use super::stretch::{energy_density, stress};
use crate::math::SymTensor2;
use crate::scene::testing::{SHEET, woven};

#[test]
fn a_strip_free_to_narrow_pulls_with_its_membrane_stiffness() {
    for fabric in [SHEET.fabric(), woven()] {
        let k = fabric.stretch_stiffness();
        let [warp, weft] = fabric.membrane_stiffness;
        let along = SymTensor2 { xx: 1e-3, xy: 0.0, yy: -1e-3 * k.uv / k.vv };
        assert!((stress(k, along).xx / (1e-3 * warp) - 1.0).abs() < 1e-12);
        assert!(stress(k, along).yy.abs() < 1e-12);
        let across = SymTensor2 { xx: -1e-3 * k.uv / k.uu, xy: 0.0, yy: 1e-3 };
        assert!((stress(k, across).yy / (1e-3 * weft) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn shear_stores_half_its_stiffness_times_the_angle_squared() {
    let (angle, fabric) = (1e-3, woven());
    let sheared = SymTensor2 { xx: 0.0, xy: 0.5 * angle, yy: 0.0 };
    let energy = energy_density(fabric.stretch_stiffness(), sheared);
    assert!((energy / (0.5 * fabric.shear_stiffness * angle * angle) - 1.0).abs() < 1e-12);
}

#[test]
fn an_isotropic_sheet_stretches_as_stiffly_in_all_directions() {
    let fabric = SHEET.fabric();
    let k = fabric.stretch_stiffness();
    let strain = SymTensor2 { xx: 2e-3, xy: 7e-4, yy: -1e-3 };
    let energy = energy_density(k, strain);
    for turn in 0..12 {
        let axis = DVec2::from_angle(0.3 * f64::from(turn));
        let turned = SymTensor2 {
            xx: strain.bilinear_form(axis, axis),
            xy: strain.bilinear_form(axis, axis.perp()),
            yy: strain.bilinear_form(axis.perp(), axis.perp()),
        };
        assert!((energy_density(k, turned) / energy - 1.0).abs() < 1e-12);
    }
}
