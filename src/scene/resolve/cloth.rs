//! Garments.

use super::limit::check_transform;
use super::{Limit, Resolver, pinned, stem};
use crate::mesh::Mesh;
use crate::scene::error::{LoadError, Problem};
use crate::scene::native::GarmentFile;
use crate::scene::obj::ClothObj;
use crate::scene::{Garment, Handle, SizingSettings, ViewSettings};

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
        self.check_contact_thickness(&file.fabric, &name, mesh.total_material_area())?;
        let two_sided = file.two_sided.unwrap_or_else(|| !obj.has_seams());
        let contact_thickness = Some(self.contact_thickness(&file.fabric));
        Ok(Garment { name, mesh, fabric, contact_thickness, sizing, view, two_sided })
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
}
