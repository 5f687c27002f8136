//! Fabrics: tables, elastic sheets, and the factors on both.

use serde::Deserialize;

use super::limit::check;
use super::{Limit, Resolver};
use crate::scene::document::{Node, Value};
use crate::scene::error::{LoadError, Problem, nearest, preset_names};
use crate::scene::fabric::{
    homogeneous_bending_rigidity, isotropic_shear_stiffness, isotropic_twist_rigidity,
};
use crate::scene::native::{ElasticFile, FabricFile, WarpWeft};
use crate::scene::{BendingModel, ElasticFabric, Fabric, MeasuredFabric, Preset};

/// The tables of a material file.
#[derive(Deserialize)]
struct Tables {
    density: f64,
    stretching: [[f64; 4]; 6],
    bending: [[f64; 5]; 3],
}

const TABLE_NAMES: [&str; 3] = ["density", "stretching", "bending"];

/// Thickest over thinnest contact of a scene: what is led out of an obstacle is led out to a tenth
/// of the thickest, which must be well within the thinnest.
const THICKNESS_RATIO_MAX: f64 = 5.0;

/// Thickest contact over the square root of a garment's area: a node's neighbours as far as the cloth is
/// held off, all of which are looked at in each step, are then at most pi / 400 of the garment. A ribbon of
/// 10 mm a metre long may have the 5 mm that are usual, a square metre 50 mm.
const CONTACT_THICKNESS_SHARE_MAX: f64 = 0.05;

/// Thinnest contact (m), thinner than any fabric: what touches is told apart to a thousandth of it, and
/// has no direction nearer than a nanometre.
pub(super) const CONTACT_THICKNESS_LIMIT: Limit = Limit::AtLeast(1e-5);

/// That of most solids that are neither rubber nor cork.
const POISSON_RATIO: f64 = 0.3;

/// That of a solid whose volume does not change.
const SOLID_POISSON_RATIO_MAX: f64 = 0.5;

/// How far cloth of a garment may be held off (m), by the garment's flat area (m^2).
pub fn contact_thickness_most(area: f64) -> f64 {
    area.sqrt() * CONTACT_THICKNESS_SHARE_MAX
}

impl Resolver<'_> {
    /// The fabric of a name that is written at `path`.
    pub(super) fn fabric(&mut self, path: &str, name: &str) -> Result<Fabric, LoadError> {
        let Some(file) = self.file.fabrics.get(name).cloned() else {
            let nearest = nearest(name, self.file.fabrics.keys().map(String::as_str));
            let problem = Problem::UnknownName { kind: "fabric", name: name.to_owned(), nearest };
            return Err(problem.at(self.document.place_of(path)));
        };
        let path = format!("fabrics.{name}");
        self.check_factors(&path, &file)?;
        self.check_one_source(&path, &file)?;
        let density = file.density_mult * file.thicken;
        let stretching = file.stretching_mult * file.thicken;
        let bending = file.bending_mult * file.thicken;
        let (damping, strain_limits) = (file.damping, file.strain_limits);
        if let Some(sheet) = self.sheet(&path, &file)? {
            let sheet = sheet.scaled(density, stretching, bending);
            let bending_model = file.bending_model.unwrap_or_default();
            let sheet = ElasticFabric { bending_model, damping, strain_limits, ..sheet };
            return Ok(Fabric::Elastic(sheet));
        }
        if file.bending_model.is_some() {
            return Err(self.missing(&format!("{path}.bending_model"), "an elastic sheet"));
        }
        let tables = match &file.file {
            Some(relative) => self.tables_of_file(&path, relative)?,
            None => self.inline_tables(&path, &file)?,
        };
        Ok(Fabric::Measured(MeasuredFabric {
            density: tables.density * density,
            stretching: tables.stretching.map(|row| row.map(|k| k * stretching)),
            bending: tables.bending.map(|row| row.map(|k| k * bending)),
            damping,
            strain_limits,
        }))
    }

    /// The elastic sheet or preset, if it is one.
    fn sheet(&self, path: &str, file: &FabricFile) -> Result<Option<ElasticFabric>, LoadError> {
        if let Some(elastic) = &file.elastic {
            return self.elastic(&format!("{path}.elastic"), elastic).map(Some);
        }
        let Some(name) = &file.preset else { return Ok(None) };
        let Some(preset) = Preset::named(name) else {
            let nearest = nearest(name, preset_names());
            let problem = Problem::UnknownPreset { name: name.clone(), nearest };
            return Err(problem.at(self.document.place_of(&format!("{path}.preset"))));
        };
        Ok(Some(preset.fabric()))
    }

    /// Of a fabric by its name (m).
    pub(super) fn contact_thickness(&self, name: &str) -> f64 {
        let own = self.file.fabrics.get(name).and_then(|fabric| fabric.contact_thickness);
        own.unwrap_or(self.file.contact.thickness)
    }

    /// The thickest contact of all garments' (m): how far contact is looked for.
    ///
    /// # Errors
    /// If a garment's is less than a fifth of it: the thin one would lie within what is left to
    /// rounding of the thick one.
    pub(super) fn thickest_contact(&self) -> Result<f64, LoadError> {
        let names = || self.file.garments.iter().map(|garment| &garment.fabric);
        let of_all = names().map(|name| self.contact_thickness(name));
        let thickest = of_all.reduce(f64::max).unwrap_or(self.file.contact.thickness);
        let least = thickest / THICKNESS_RATIO_MAX;
        for name in names() {
            let own = self.contact_thickness(name);
            if own < least {
                let path = format!("fabrics.{name}.contact_thickness");
                let limit = format!("at least {least}, a fifth of the thickest");
                return Err(self.out_of_range(&path, own, &limit));
            }
        }
        Ok(thickest)
    }

    /// # Errors
    /// If cloth of this fabric is held off farther than suits the size of a garment (m^2, flat).
    pub(super) fn check_contact_thickness(
        &self,
        name: &str,
        garment: &str,
        area: f64,
    ) -> Result<(), LoadError> {
        let thickness = self.contact_thickness(name);
        let most = contact_thickness_most(area);
        if thickness <= most {
            return Ok(());
        }
        let own = self.file.fabrics.get(name).and_then(|fabric| fabric.contact_thickness);
        let path = match own {
            Some(_) => format!("fabrics.{name}.contact_thickness"),
            None => "contact.thickness".to_owned(),
        };
        let limit = format!(
            "at most {most:.4}: {CONTACT_THICKNESS_SHARE_MAX} of the side of a square as large as garment {garment:?}"
        );
        Err(self.out_of_range(&path, thickness, &limit))
    }

    fn check_factors(&self, path: &str, file: &FabricFile) -> Result<(), LoadError> {
        for (name, value, limit) in [
            ("density_mult", file.density_mult, Limit::Positive),
            ("stretching_mult", file.stretching_mult, Limit::Positive),
            ("bending_mult", file.bending_mult, Limit::AtLeastZero),
            ("thicken", file.thicken, Limit::Positive),
            ("damping", file.damping, Limit::AtLeastZero),
        ] {
            self.check(&format!("{path}.{name}"), value, limit)?;
        }
        if let Some(thickness) = file.contact_thickness {
            self.check(&format!("{path}.contact_thickness"), thickness, CONTACT_THICKNESS_LIMIT)?;
        }
        if let Some([least, largest]) = file.strain_limits {
            self.check(&format!("{path}.strain_limits.0"), least, Limit::Share)?;
            self.check(&format!("{path}.strain_limits.1"), largest, Limit::AtLeast(1.0))?;
        }
        Ok(())
    }

    /// A material file, a preset, an elastic sheet or tables: never two of them.
    fn check_one_source(&self, path: &str, file: &FabricFile) -> Result<(), LoadError> {
        let given = [
            ("file", file.file.is_some()),
            ("preset", file.preset.is_some()),
            ("elastic", file.elastic.is_some()),
            (TABLE_NAMES[0], file.density.is_some()),
            (TABLE_NAMES[1], file.stretching.is_some()),
            (TABLE_NAMES[2], file.bending.is_some()),
        ];
        let mut given = given.into_iter().filter_map(|(name, given)| given.then_some(name));
        match (given.next(), given.next()) {
            (Some(first), Some(second)) if !TABLE_NAMES.contains(&first) => {
                Err(self.exclusive(path, first, second))
            }
            _ => Ok(()),
        }
    }

    fn elastic(&self, path: &str, file: &ElasticFile) -> Result<ElasticFabric, LoadError> {
        self.check_elastic(path, file)?;
        let poisson_ratio = file.poisson_ratio.unwrap_or(POISSON_RATIO);
        // One of them alone says nothing.
        let material = match (file.young_modulus, file.thickness) {
            (Some(modulus), Some(thickness)) => Some((modulus.values(), thickness)),
            (None, None) => None,
            (Some(_), None) => {
                return Err(self.missing(&format!("{path}.young_modulus"), "thickness beside it"));
            }
            (None, Some(_)) => {
                return Err(self.missing(&format!("{path}.thickness"), "young_modulus beside it"));
            }
        };
        let membrane_stiffness = match (file.membrane_stiffness, material) {
            (Some(_), Some(_)) => {
                return Err(self.exclusive(path, "membrane_stiffness", "young_modulus"));
            }
            (Some(stiffness), None) => stiffness.values(),
            (None, Some((modulus, thickness))) => modulus.map(|e| e * thickness),
            (None, None) => {
                return Err(
                    self.missing(path, "membrane_stiffness, or young_modulus and thickness")
                );
            }
        };
        let bending_rigidity = match (file.bending_rigidity, material) {
            (Some(rigidity), _) => rigidity.values(),
            (None, Some((modulus, thickness))) => {
                modulus.map(|e| homogeneous_bending_rigidity(e, thickness, poisson_ratio))
            }
            (None, None) => {
                return Err(self.missing(path, "bending_rigidity, or young_modulus and thickness"));
            }
        };
        let density = file.density.ok_or_else(|| self.missing(path, "density"))?;
        Ok(ElasticFabric {
            density,
            membrane_stiffness,
            shear_stiffness: file
                .shear_stiffness
                .unwrap_or_else(|| isotropic_shear_stiffness(membrane_stiffness, poisson_ratio)),
            poisson_ratio,
            bending_rigidity,
            twist_rigidity: file
                .twist_rigidity
                .unwrap_or_else(|| isotropic_twist_rigidity(bending_rigidity, poisson_ratio)),
            bending_model: BendingModel::default(),
            damping: 0.0,
            strain_limits: None,
        })
    }

    fn check_elastic(&self, path: &str, file: &ElasticFile) -> Result<(), LoadError> {
        for (name, value, limit) in [
            ("density", file.density, Limit::Positive),
            ("thickness", file.thickness, Limit::Positive),
            ("shear_stiffness", file.shear_stiffness, Limit::AtLeastZero),
            ("twist_rigidity", file.twist_rigidity, Limit::AtLeastZero),
        ] {
            if let Some(value) = value {
                self.check(&format!("{path}.{name}"), value, limit)?;
            }
        }
        if let Some(value) = file.poisson_ratio {
            self.check(&format!("{path}.poisson_ratio"), value, poisson_ratio_limit(file))?;
        }
        for (name, value, limit) in [
            ("young_modulus", file.young_modulus, Limit::Positive),
            ("membrane_stiffness", file.membrane_stiffness, Limit::Positive),
            ("bending_rigidity", file.bending_rigidity, Limit::AtLeastZero),
        ] {
            let path = format!("{path}.{name}");
            match value {
                Some(WarpWeft::Same(value)) => self.check(&path, value, limit)?,
                Some(WarpWeft::Each([warp, weft])) => {
                    self.check(&format!("{path}.0"), warp, limit)?;
                    self.check(&format!("{path}.1"), weft, limit)?;
                }
                None => {}
            }
        }
        Ok(())
    }

    fn missing(&self, path: &str, needed: &'static str) -> LoadError {
        Problem::Missing { thing: path.to_owned(), needed }.at(self.document.place_of(path))
    }

    fn exclusive(&self, path: &str, first: &'static str, second: &'static str) -> LoadError {
        let place = self.document.place_of(&format!("{path}.{second}"));
        Problem::Exclusive { thing: path.to_owned(), first, second }.at(place)
    }

    fn inline_tables(&self, path: &str, file: &FabricFile) -> Result<Tables, LoadError> {
        if file.density.is_none() && file.stretching.is_none() && file.bending.is_none() {
            return Err(self.missing(path, "a file, a preset, an elastic sheet, or its tables"));
        }
        let tables = Tables {
            density: file.density.ok_or_else(|| self.missing(path, "a file, or its density"))?,
            stretching: file
                .stretching
                .ok_or_else(|| self.missing(path, "a file, or its stretching"))?,
            bending: file.bending.ok_or_else(|| self.missing(path, "a file, or its bending"))?,
        };
        check_tables(self.document, &format!("{path}."), &tables)?;
        Ok(tables)
    }

    fn tables_of_file(&mut self, path: &str, relative: &str) -> Result<Tables, LoadError> {
        let (file, text) = self.text_at(&format!("{path}.file"), relative)?;
        let document = Node::parse(&file.to_string_lossy(), &text)?;
        if let Value::Object(members) = &document.value {
            for member in members.iter().filter(|m| !TABLE_NAMES.contains(&m.name.as_str())) {
                self.warnings.push(format!("{}: {:?} is not used", member.place, member.name));
            }
        }
        let tables: Tables = document.deserialize()?;
        check_tables(&document, "", &tables)?;
        Ok(tables)
    }
}

/// A solid that is alike in all directions has the bulk modulus E / (3 (1 - 2 nu)), which is not
/// negative: nu is at most 1/2. A weave, and a sheet of which only the membrane is known, need but
/// store energy however they are stretched in their plane: nu^2 < 1.
fn poisson_ratio_limit(file: &ElasticFile) -> Limit {
    let is_alike = file.young_modulus.is_some_and(|e| e.values()[0] == e.values()[1]);
    if is_alike && file.shear_stiffness.is_none() {
        Limit::AboveUpTo(-1.0, SOLID_POISSON_RATIO_MAX)
    } else {
        Limit::Between(-1.0, 1.0)
    }
}

fn check_tables(document: &Node, prefix: &str, tables: &Tables) -> Result<(), LoadError> {
    check(document, &format!("{prefix}density"), tables.density, Limit::Positive)?;
    for (i, row) in tables.stretching.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            check(document, &format!("{prefix}stretching.{i}.{j}"), value, Limit::Finite)?;
        }
    }
    for (i, row) in tables.bending.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            check(document, &format!("{prefix}bending.{i}.{j}"), value, Limit::AtLeastZero)?;
        }
    }
    Ok(())
}
