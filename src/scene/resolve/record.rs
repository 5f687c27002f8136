//! All settings of a scene with nothing left to defaults, for the record of a run.

use serde_json::{Value, json};

use crate::scene::native::{CameraFile, ShotFile};
use crate::scene::{Fabric, Scene};

/// The shot file as if everything had been written out: no import, every default filled in,
/// cameras and fabrics in place. Meshes and motions stay file names.
pub(super) fn settings(file: ShotFile, scene: &Scene, cameras: Vec<CameraFile>) -> Value {
    let file = ShotFile { import: None, camera: None, ..file };
    let mut record = serde_json::to_value(&file).expect("a shot file is plain data");
    record["name"] = json!(scene.name);
    record["viewers"] = json!(cameras);
    for (name, garment) in file.garments.iter().zip(&scene.garments).map(|(f, g)| (&f.fabric, g)) {
        record["fabrics"][name] = fabric(&garment.fabric);
        if let Some(own) = file.fabrics.get(name).and_then(|f| f.contact_thickness) {
            record["fabrics"][name]["contact_thickness"] = json!(own);
        }
    }
    for (index, garment) in scene.garments.iter().enumerate() {
        let written = &mut record["garments"][index];
        written["name"] = json!(garment.name);
        written["sizing"] = json!(garment.sizing);
        written["view"] = json!(garment.view);
        written["two_sided"] = json!(garment.two_sided);
    }
    record
}

fn fabric(fabric: &Fabric) -> Value {
    match fabric {
        Fabric::Measured(measured) => json!({
            "density": measured.density,
            "stretching": measured.stretching,
            "bending": measured.bending,
            "damping": measured.damping,
            "strain_limits": measured.strain_limits,
        }),
        Fabric::Elastic(elastic) => json!({
            "elastic": {
                "density": elastic.density,
                "membrane_stiffness": elastic.membrane_stiffness,
                "shear_stiffness": elastic.shear_stiffness,
                "poisson_ratio": elastic.poisson_ratio,
                "bending_rigidity": elastic.bending_rigidity,
                "twist_rigidity": elastic.twist_rigidity,
            },
            "bending_model": elastic.bending_model,
            "damping": elastic.damping,
            "strain_limits": elastic.strain_limits,
        }),
    }
}
