//! Fabrics by name, in real units.
//!
//! Where no source is named the values are typical of fabrics of that kind, chosen within what fabric
//! tests of the Kawabata (KES-F) and FAST kind report, and are no single cloth's. Rigidities along
//! the bias follow from the twist rigidity: a weave hardly resists twist ([`C60`](crate::papers::C60)).

use super::{BendingModel, ElasticFabric};

/// A fabric with a name.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    pub name: &'static str,
    /// What it is, and where the values are from.
    pub about: &'static str,
    /// (kg/m^2).
    density: f64,
    /// E h along warp and weft (N/m).
    membrane_stiffness: [f64; 2],
    /// G h (N/m).
    shear_stiffness: f64,
    poisson_ratio: f64,
    /// D along warp and weft (N m).
    bending_rigidity: [f64; 2],
    /// D_xy (N m).
    twist_rigidity: f64,
}

/// All presets.
pub const PRESETS: [Preset; 6] = [
    Preset {
        name: "cotton",
        about: "plain-weave shirting, 120 g/m^2; typical values",
        density: 0.12,
        membrane_stiffness: [4000.0, 2500.0],
        shear_stiffness: 80.0,
        poisson_ratio: 0.2,
        bending_rigidity: [9e-6, 6e-6],
        twist_rigidity: 2.6e-6,
    },
    Preset {
        name: "silk",
        about: "crepe de Chine, 65 g/m^2; typical values",
        density: 0.065,
        membrane_stiffness: [1500.0, 1000.0],
        shear_stiffness: 20.0,
        poisson_ratio: 0.2,
        bending_rigidity: [1.2e-6, 0.8e-6],
        twist_rigidity: 0.35e-6,
    },
    Preset {
        name: "denim",
        about: "11 oz/yd^2 (373 g/m^2) twill; typical values",
        density: 0.373,
        membrane_stiffness: [9000.0, 5000.0],
        shear_stiffness: 200.0,
        poisson_ratio: 0.2,
        bending_rigidity: [7e-5, 3.5e-5],
        twist_rigidity: 1.7e-5,
    },
    Preset {
        name: "wool",
        about: "worsted suiting, 220 g/m^2; typical values",
        density: 0.22,
        membrane_stiffness: [3500.0, 2500.0],
        shear_stiffness: 45.0,
        poisson_ratio: 0.2,
        bending_rigidity: [1.1e-5, 0.8e-5],
        twist_rigidity: 3.3e-6,
    },
    Preset {
        name: "leather",
        about: "sheep garment leather of 0.8 mm, the same in all directions; as stiff as it drapes \
                (Memon et al. 2021: 47 to 70 %)",
        density: 0.6,
        membrane_stiffness: [12000.0, 12000.0],
        shear_stiffness: 12000.0 / 2.8,
        poisson_ratio: 0.4,
        bending_rigidity: [3e-5, 3e-5],
        twist_rigidity: 1.8e-5,
    },
    // E 2 MPa, density 930 kg/m^3 and nu 0.49 of soft natural rubber, h 0.5 mm.
    Preset {
        name: "rubber",
        about: "sheet of soft natural rubber of 0.5 mm: E 2 MPa, 930 kg/m^3 (Ashby: Materials \
                Selection in Mechanical Design, 2005), a homogeneous plate",
        density: 0.465,
        membrane_stiffness: [1000.0, 1000.0],
        shear_stiffness: 1000.0 / 2.98,
        poisson_ratio: 0.49,
        bending_rigidity: [RUBBER_RIGIDITY, RUBBER_RIGIDITY],
        twist_rigidity: 0.51 * RUBBER_RIGIDITY,
    },
];

/// E h^3 / (12 (1 - nu^2)) (N m).
const RUBBER_RIGIDITY: f64 = 2e6 * 1.25e-10 / (12.0 * (1.0 - 0.49 * 0.49));

impl Preset {
    pub fn named(name: &str) -> Option<Preset> {
        PRESETS.into_iter().find(|preset| preset.name == name)
    }

    /// Undamped.
    pub fn fabric(self) -> ElasticFabric {
        ElasticFabric {
            density: self.density,
            membrane_stiffness: self.membrane_stiffness,
            shear_stiffness: self.shear_stiffness,
            poisson_ratio: self.poisson_ratio,
            bending_rigidity: self.bending_rigidity,
            twist_rigidity: self.twist_rigidity,
            bending_model: BendingModel::default(),
            damping: 0.0,
            strain_limits: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_weave_is_softest_on_the_bias_and_never_gains_from_being_bent() {
        for preset in PRESETS {
            let fabric = preset.fabric();
            let [warp, weft] = fabric.bending_rigidity;
            let bias = fabric.cylinder_rigidity([0.5f64.sqrt(); 2]);
            let mean = 0.5 * (warp + weft);
            assert!(bias > 0.5 * weft && bias <= 1.0001 * mean, "{}: {bias}", preset.name);
        }
    }
}
