//! Cloths and their materials: garments and fabrics.

use super::Import;
use super::fields::{Fields, array, json, list, object};
use crate::scene::document::Node;
use crate::scene::error::{LoadError, Problem};

impl Import<'_> {
    /// The garments, and the fabric of each.
    pub(super) fn cloths(&mut self, scene: &mut Fields<'_>) -> Result<(Node, Node), LoadError> {
        let place = scene.place();
        let nothing = array(&place, Vec::new());
        let mut garments = Vec::new();
        let mut fabrics = Vec::new();
        for (index, cloth) in list(scene.take("cloths").unwrap_or(&nothing)).iter().enumerate() {
            let name = format!("cloth{index}");
            let mut fields = Fields::new(cloth, "a cloth")?;
            let mut garment = vec![("fabric", json(&cloth.place, &name))];
            if let Some(mesh) = fields.take("mesh") {
                garment.push(("mesh", self.path(mesh)));
            }
            if let Some(transform) = fields.take("transform") {
                garment.push(("transform", self.transform(transform)?));
            }
            garment.push(("sizing", self.sizing(&mut fields)?));
            fabrics.push((name, self.material(&mut fields)?));
            fields.finish(self.warnings);
            garments.push(object(&cloth.place, garment));
        }
        let fabrics = fabrics.iter().map(|(name, fabric)| (name.as_str(), fabric.clone()));
        Ok((array(&place, garments), object(&place, fabrics)))
    }

    /// Translation, rotation and scale have the same form there and here.
    pub(super) fn transform(&mut self, node: &Node) -> Result<Node, LoadError> {
        let mut fields = Fields::new(node, "a transform")?;
        let names = ["translate", "rotate", "scale"];
        let known = names.into_iter().filter_map(|name| Some((name, fields.take(name)?.clone())));
        let transform = object(&node.place, known.collect::<Vec<_>>());
        fields.finish(self.warnings);
        Ok(transform)
    }

    /// A criterion that is not named is off, and so is a bound.
    fn sizing(&mut self, cloth: &mut Fields<'_>) -> Result<Node, LoadError> {
        let place = cloth.place();
        let nothing = object(&place, []);
        let remeshing = cloth.take("remeshing");
        if remeshing.is_none() {
            let warning = "a cloth without \"remeshing\" is only as fine as its outline";
            self.warnings.push(format!("{place}: {warning}"));
        }
        let mut fields = Fields::new(remeshing.unwrap_or(&nothing), "remeshing")?;
        let mut sizing: Vec<(&str, Node)> =
            ["refine_angle", "refine_compression", "refine_velocity"]
                .into_iter()
                .map(|name| (name, fields.take_or(name, ())))
                .collect();
        let [shortest, longest] = match fields.take("size") {
            Some(size) => match list(size) {
                [shortest, longest] => [shortest.clone(), longest.clone()],
                _ => {
                    let what = "size must be a list of two lengths".to_owned();
                    return Err(Problem::Shape(what).at(size.place.clone()));
                }
            },
            None => [json(&place, ()), json(&place, ())],
        };
        sizing.extend([("edge_length_min", shortest), ("edge_length_max", longest)]);
        sizing.extend(fields.take("aspect_min").map(|node| ("aspect_min", node.clone())));
        fields.finish(self.warnings);
        Ok(object(remeshing.map_or(&place, |node| &node.place), sizing))
    }

    fn material(&mut self, cloth: &mut Fields<'_>) -> Result<Node, LoadError> {
        let materials = cloth.take("materials").map(list).unwrap_or_default();
        let Some(material) = materials.first() else {
            let (thing, needed) = ("a cloth".into(), "materials");
            return Err(Problem::Missing { thing, needed }.at(cloth.place()));
        };
        if let Some(second) = materials.get(1) {
            let warning = "only the first material of a cloth is used";
            self.warnings.push(format!("{}: {warning}", second.place));
        }
        let mut fields = Fields::new(material, "a material")?;
        let mut fabric = Vec::new();
        if let Some(data) = fields.take("data") {
            fabric.push(("file", self.path(data)));
        }
        for name in [
            "density_mult",
            "stretching_mult",
            "bending_mult",
            "thicken",
            "damping",
            "strain_limits",
        ] {
            fabric.extend(fields.take(name).map(|node| (name, node.clone())));
        }
        for name in ["yield_curv", "weakening", "damage"] {
            fields.leave(name, "is not supported: cloth stays elastic", self.warnings);
        }
        fields.finish(self.warnings);
        Ok(object(&material.place, fabric))
    }
}
