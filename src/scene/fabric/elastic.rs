//! Linear elastic sheets in real units: isotropic, or orthotropic along warp and weft.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::StretchStiffness;
use crate::math::SymTensor2;

/// A sheet whose stiffness depends neither on strain nor on curvature. Warp runs along u, weft
/// along v; where a value has two, they are those of warp and weft.
///
/// Stretching is that of a Saint Venant-Kirchhoff sheet under plane stress, bending that of a thin
/// plate. Both have one Poisson's ratio nu = sqrt(nu_uv nu_vu), so that an energy of either sign of
/// coupling has a lower bound for all |nu| < 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticFabric {
    /// (kg/m^2).
    pub density: f64,
    /// E h (N/m): the pull per width at a small strain of 1 of a strip that is free to narrow.
    pub membrane_stiffness: [f64; 2],
    /// G h (N/m): the shear force per length at a small angle of 1.
    pub shear_stiffness: f64,
    /// nu, in (-1, 1).
    pub poisson_ratio: f64,
    /// D (N m): the moment per width at a curvature of 1/m, of a sheet that stays flat across;
    /// E h^3 / (12 (1 - nu^2)) of a homogeneous one.
    pub bending_rigidity: [f64; 2],
    /// D_xy (N m): the twisting moment per length at a twist of 1/m; (1 - nu) D if isotropic.
    pub twist_rigidity: f64,
    pub bending_model: BendingModel,
    /// Damping proportional to stiffness (s).
    pub damping: f64,
    /// Least and largest principal stretch the garment may show.
    pub strain_limits: Option<[f64; 2]>,
}

/// How the bending of an elastic sheet is taken from its mesh.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BendingModel {
    /// Each edge by itself: stiffer or softer by what the mesh looks like.
    Hinges,
    /// The curvature of a face from the normals at its edges, each between those of the edge's
    /// faces ([`GGRZ06`](crate::papers::GGRZ06)): too stiff on irregular meshes.
    MidEdge,
    /// The curvature of a face from the quadratic surface through its folds: too soft on irregular
    /// meshes.
    Quadratic,
    /// Moments in balance across edges ([`NS19`](crate::papers::NS19)): as stiff on any mesh.
    #[default]
    Moments,
}

/// D^-1 of a plate (1/(N m)): curvature = D^-1 moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlateCompliance {
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
    pub twist: f64,
}

impl PlateCompliance {
    /// a : D^-1 : b.
    pub fn product(self, a: SymTensor2, b: SymTensor2) -> f64 {
        self.uu * a.xx * b.xx
            + self.vv * a.yy * b.yy
            + self.uv * (a.xx * b.yy + a.yy * b.xx)
            + 2.0 * self.twist * a.xy * b.xy
    }
}

/// What an isotropic sheet is given by; the rest of [`ElasticFabric`] follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsotropicSheet {
    /// (kg/m^2).
    pub density: f64,
    /// E h (N/m).
    pub membrane_stiffness: f64,
    /// nu, in (-1, 1).
    pub poisson_ratio: f64,
    /// D (N m).
    pub bending_rigidity: f64,
}

impl IsotropicSheet {
    /// Undamped.
    pub fn fabric(self) -> ElasticFabric {
        let nu = self.poisson_ratio;
        ElasticFabric {
            density: self.density,
            membrane_stiffness: [self.membrane_stiffness; 2],
            shear_stiffness: isotropic_shear_stiffness([self.membrane_stiffness; 2], nu),
            poisson_ratio: nu,
            bending_rigidity: [self.bending_rigidity; 2],
            twist_rigidity: isotropic_twist_rigidity([self.bending_rigidity; 2], nu),
            bending_model: BendingModel::default(),
            damping: 0.0,
            strain_limits: None,
        }
    }
}

/// D = E h^3 / (12 (1 - nu^2)) (N m), E in Pa, h in m.
pub fn homogeneous_bending_rigidity(young_modulus: f64, thickness: f64, poisson_ratio: f64) -> f64 {
    young_modulus * thickness.powi(3) / (12.0 * (1.0 - poisson_ratio * poisson_ratio))
}

/// G h = E h / (2 (1 + nu)) (N/m), E the geometric mean of warp and weft.
pub fn isotropic_shear_stiffness(membrane_stiffness: [f64; 2], poisson_ratio: f64) -> f64 {
    geometric_mean(membrane_stiffness) / (2.0 * (1.0 + poisson_ratio))
}

/// D_xy = (1 - nu) D (N m), D the geometric mean of warp and weft.
pub fn isotropic_twist_rigidity(bending_rigidity: [f64; 2], poisson_ratio: f64) -> f64 {
    geometric_mean(bending_rigidity) * (1.0 - poisson_ratio)
}

/// On a mesh of equilateral triangles, hinges of stiffness 4 D store, on average over directions, a
/// cylinder's 1/2 D curvature^2 per area: with edges of length l and faces of area A, a hinge at an
/// angle phi from the axis folds by theta = curvature l (1 + 2 cos 2 phi) / (2 sqrt 3), and a face
/// has one and a half hinges of energy 4 D l^2 theta^2 / (16 A). To other shapes they answer as a
/// sheet with a Poisson's ratio of -1/3, and on other meshes they follow the mesh.
const HINGE_PER_PLATE: f64 = 4.0;

/// The least rigidity, in shares of the largest, for which a compliance is made up: a sheet that can
/// be bent or twisted at no cost has none.
const RIGIDITY_SHARE_MIN: f64 = 1e-3;

impl ElasticFabric {
    /// `None` if nothing resists bending.
    pub fn plate_compliance(&self) -> Option<PlateCompliance> {
        let [u, v] = self.bending_rigidity;
        let least = RIGIDITY_SHARE_MIN * u.max(v).max(self.twist_rigidity);
        if least == 0.0 {
            return None;
        }
        let (u, v, twist) = (u.max(least), v.max(least), self.twist_rigidity.max(least));
        let nu = self.poisson_ratio;
        let free = 1.0 - nu * nu;
        Some(PlateCompliance {
            uu: 1.0 / (free * u),
            uv: -nu / (free * (u * v).sqrt()),
            vv: 1.0 / (free * v),
            twist: 1.0 / twist,
        })
    }

    /// k_uu = E_u h / (1 - nu^2), k_vv likewise, k_uv = nu sqrt(k_uu k_vv), k_shear = 2 G h: E_uv
    /// is half the angle of shear.
    pub fn stretch_stiffness(&self) -> StretchStiffness {
        let nu = self.poisson_ratio;
        let [uu, vv] = self.membrane_stiffness.map(|k| k / (1.0 - nu * nu));
        StretchStiffness { uu, uv: nu * (uu * vv).sqrt(), vv, shear: 2.0 * self.shear_stiffness }
    }

    /// The stiffness (N m) of a hinge whose edge is at an angle from u (rad): it bends the sheet
    /// across the edge.
    pub fn hinge_stiffness(&self, edge_angle: f64) -> f64 {
        let (cos, sin) = edge_angle.sin_cos();
        HINGE_PER_PLATE * self.cylinder_rigidity([cos, sin])
    }

    /// D(n) = D_u n_u^4 + D_v n_v^4 + 2 (nu sqrt(D_u D_v) + D_xy) n_u^2 n_v^2 (N m): the moment per
    /// width at a curvature of 1/m along the unit direction n.
    pub fn cylinder_rigidity(&self, [along_u, along_v]: [f64; 2]) -> f64 {
        let [u, v] = self.bending_rigidity;
        let (uu, vv) = (along_u * along_u, along_v * along_v);
        let mixed = self.poisson_ratio * (u * v).sqrt() + self.twist_rigidity;
        u * uu * uu + v * vv * vv + 2.0 * mixed * uu * vv
    }

    /// The fabric in as many layers which slide on one another, its stiffness and mass multiplied.
    #[must_use]
    pub fn scaled(mut self, density: f64, stretching: f64, bending: f64) -> Self {
        self.density *= density;
        self.membrane_stiffness = self.membrane_stiffness.map(|k| k * stretching);
        self.shear_stiffness *= stretching;
        self.bending_rigidity = self.bending_rigidity.map(|d| d * bending);
        self.twist_rigidity *= bending;
        self
    }
}

fn geometric_mean([a, b]: [f64; 2]) -> f64 {
    (a * b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::testing::{SHEET, woven};

    #[test]
    fn an_isotropic_sheet_bends_as_stiffly_in_all_directions() {
        let fabric = SHEET.fabric();
        for turn in 0..12 {
            let axis = glam::DVec2::from_angle(0.3 * f64::from(turn));
            assert!((fabric.cylinder_rigidity(axis.to_array()) / 2e-5 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_hinge_along_the_warp_bends_the_weft() {
        let fabric = woven();
        let [warp, weft] = fabric.bending_rigidity;
        assert!((fabric.hinge_stiffness(0.0) / (4.0 * weft) - 1.0).abs() < 1e-12);
        let quarter_turn = std::f64::consts::FRAC_PI_2;
        assert!((fabric.hinge_stiffness(quarter_turn) / (4.0 * warp) - 1.0).abs() < 1e-12);
    }
}
