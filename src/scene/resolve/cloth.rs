//! Garments and the fabrics they are made of.

use serde::Deserialize;

use super::{Limit, Resolver, pinned, stem};
use crate::mesh::Mesh;
use crate::scene::document::{Node, Value};
use crate::scene::error::{LoadError, Problem, nearest};
use crate::scene::native::{FabricFile, GarmentFile};
use crate::scene::obj::ClothObj;
use crate::scene::resolve::limit::{check, check_transform};
use crate::scene::{Fabric, Garment, Handle, MeasuredFabric, SizingSettings, ViewSettings};

/// The tables of a material file.
#[derive(Deserialize)]
struct Tables {
    density: f64,
    stretching: [[f64; 4]; 6],
    bending: [[f64; 5]; 3],
}

const TABLE_NAMES: [&str; 3] = ["density", "stretching", "bending"];

impl Resolver<'_> {
    pub(super) fn garments(
        &mut self,
        view: ViewSettings,
        handles: &[Handle],
    ) -> Result<Vec<Garment>, LoadError> {
        let mut garments: Vec<Garment> = Vec::new();
        for (index, file) in self.file.garments.clone().into_iter().enumerate() {
            let view = self.garment_view(index, view, file.view)?;
            let mut garment = self.garment(index, &file, view, handles)?;
            if file.name.is_none() && garments.iter().any(|g| g.name == garment.name) {
                garment.name = format!("{}-{index}", garment.name);
            }
            garments.push(garment);
        }
        Ok(garments)
    }

    fn garment(
        &mut self,
        index: usize,
        file: &GarmentFile,
        view: ViewSettings,
        handles: &[Handle],
    ) -> Result<Garment, LoadError> {
        let path = format!("garments.{index}");
        let name = file.name.clone().unwrap_or_else(|| stem(&file.mesh));
        let sizing = file.sizing.sizing();
        self.check_sizing(&format!("{path}.sizing"), &sizing)?;
        check_transform(self.document, &format!("{path}.transform"), &file.transform)?;
        let fabric = self.fabric(&format!("{path}.fabric"), &file.fabric)?;
        let (mesh_path, text) = self.text_at(&format!("{path}.mesh"), &file.mesh)?;
        let mut obj = ClothObj::parse(&mesh_path.to_string_lossy(), &text)?;
        self.check_handles_of(index, &obj, handles)?;
        obj.transform(file.transform.pose());
        let mesh = Mesh::from_raw(&obj.raw, &pinned(handles, index)).map_err(|error| {
            let place = obj.place_of(&error);
            Problem::Mesh { thing: format!("garment {name:?}"), error }.at(place)
        })?;
        let two_sided = file.two_sided.unwrap_or_else(|| !obj.has_seams());
        Ok(Garment { name, mesh, fabric, sizing, view, two_sided })
    }

    fn check_sizing(&self, path: &str, sizing: &SizingSettings) -> Result<(), LoadError> {
        for (name, value, limit) in [
            ("refine_angle", sizing.refine_angle, Limit::PositiveOrInfinite),
            ("refine_compression", sizing.refine_compression, Limit::PositiveOrInfinite),
            ("refine_velocity", sizing.refine_velocity, Limit::PositiveOrInfinite),
            ("edge_length_min", sizing.edge_length_min, Limit::PositiveOrInfinite),
            ("edge_length_max", sizing.edge_length_max, Limit::PositiveOrInfinite),
            ("edge_length_min", sizing.edge_length_min, Limit::AtMost(sizing.edge_length_max)),
            ("aspect_min", sizing.aspect_min, Limit::Share),
        ] {
            self.check(&format!("{path}.{name}"), value, limit)?;
        }
        Ok(())
    }

    /// Every held node must exist and belong to a face.
    fn check_handles_of(
        &self,
        garment: usize,
        obj: &ClothObj,
        handles: &[Handle],
    ) -> Result<(), LoadError> {
        let count = obj.raw.positions.len();
        let mut in_face = vec![false; count];
        for &vertex in obj.raw.faces.iter().flatten() {
            in_face[obj.raw.vertices[vertex as usize].0 as usize] = true;
        }
        for (h, handle) in handles.iter().enumerate().filter(|(_, h)| h.garment == garment) {
            for (k, &node) in handle.nodes.iter().enumerate() {
                let path = format!("handles.{h}.nodes.{k}");
                match in_face.get(node as usize) {
                    Some(true) => {}
                    Some(false) => {
                        return Err(self.out_of_range(&path, node, "a node of at least one face"));
                    }
                    None => {
                        let limit = format!("less than {count}, the garment's number of nodes");
                        return Err(self.out_of_range(&path, node, &limit));
                    }
                }
            }
        }
        Ok(())
    }

    /// The fabric of a name that is written at `path`.
    fn fabric(&mut self, path: &str, name: &str) -> Result<Fabric, LoadError> {
        let Some(file) = self.file.fabrics.get(name).cloned() else {
            let nearest = nearest(name, self.file.fabrics.keys().map(String::as_str));
            let problem = Problem::UnknownName { kind: "fabric", name: name.to_owned(), nearest };
            return Err(problem.at(self.document.place_of(path)));
        };
        let path = format!("fabrics.{name}");
        self.check_factors(&path, &file)?;
        let tables = match &file.file {
            Some(relative) => self.tables_of_file(&path, relative, &file)?,
            None => self.inline_tables(&path, &file)?,
        };
        if file.strain_limits.is_some() {
            let warning = format!("{path}.strain_limits are kept but not enforced yet");
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
        let stretching = file.stretching_mult * file.thicken;
        let bending = file.bending_mult * file.thicken;
        Ok(Fabric::Measured(MeasuredFabric {
            density: tables.density * file.density_mult * file.thicken,
            stretching: tables.stretching.map(|row| row.map(|k| k * stretching)),
            bending: tables.bending.map(|row| row.map(|k| k * bending)),
            damping: file.damping,
            strain_limits: file.strain_limits,
        }))
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
        if let Some([least, largest]) = file.strain_limits {
            self.check(&format!("{path}.strain_limits.0"), least, Limit::Share)?;
            self.check(&format!("{path}.strain_limits.1"), largest, Limit::AtLeast(1.0))?;
        }
        Ok(())
    }

    fn inline_tables(&self, path: &str, file: &FabricFile) -> Result<Tables, LoadError> {
        let missing = |needed| {
            Problem::Missing { thing: path.to_owned(), needed }.at(self.document.place_of(path))
        };
        let tables = Tables {
            density: file.density.ok_or_else(|| missing("a file, or its density"))?,
            stretching: file.stretching.ok_or_else(|| missing("a file, or its stretching"))?,
            bending: file.bending.ok_or_else(|| missing("a file, or its bending"))?,
        };
        check_tables(self.document, &format!("{path}."), &tables)?;
        Ok(tables)
    }

    fn tables_of_file(
        &mut self,
        path: &str,
        relative: &str,
        file: &FabricFile,
    ) -> Result<Tables, LoadError> {
        let inline = [file.density.is_some(), file.stretching.is_some(), file.bending.is_some()];
        if let Some(k) = inline.iter().position(|&given| given) {
            let (first, second) = ("file", TABLE_NAMES[k]);
            let problem = Problem::Exclusive { thing: path.to_owned(), first, second };
            return Err(problem.at(self.document.place_of(&format!("{path}.{second}"))));
        }
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
