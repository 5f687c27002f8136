//! Elastic fabrics as a shot names them.

use std::path::Path;

use super::{BendingModel, ElasticFabric, Fabric, IsotropicSheet, Preset};
use crate::scene::{EmbeddedFiles, LoadError, LoadOptions, LoadedShot, load};

const SHEET: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

fn load_fabric(fabric: &str) -> Result<LoadedShot, LoadError> {
    let shot = format!(
        r#"{{"shotsilk": 1, "fabrics": {{"f": {fabric}}}, "garments": [{{"mesh": "a.obj", "fabric": "f"}}]}}"#
    );
    let source =
        EmbeddedFiles::default().with("a.obj", SHEET.as_bytes()).with("a.json", shot.into_bytes());
    let shot = Path::new("a.json").into();
    load(&LoadOptions { shot, ..LoadOptions::default() }, &source)
}

fn elastic(fabric: &str) -> ElasticFabric {
    match &load_fabric(fabric).unwrap().scene.garments[0].fabric {
        Fabric::Elastic(elastic) => elastic.clone(),
        Fabric::Measured(_) => panic!("{fabric} is elastic"),
    }
}

#[test]
fn an_isotropic_sheet_follows_from_modulus_thickness_and_poisson_ratio() {
    let sheet = elastic(
        r#"{"elastic": {"density": 0.5, "young_modulus": 2e6, "thickness": 1e-3, "poisson_ratio": 0.4}}"#,
    );
    let rigidity = 2e6 * 1e-9 / (12.0 * (1.0 - 0.4 * 0.4));
    let expected = IsotropicSheet {
        density: 0.5,
        membrane_stiffness: 2e3,
        poisson_ratio: 0.4,
        bending_rigidity: rigidity,
    };
    let expected = expected.fabric();
    let pairs = [
        (sheet.membrane_stiffness[1], expected.membrane_stiffness[1]),
        (sheet.shear_stiffness, 2e3 / 2.8),
        (sheet.bending_rigidity[0], rigidity),
        (sheet.twist_rigidity, 0.6 * rigidity),
        (sheet.density, 0.5),
    ];
    for (found, expected) in pairs {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
    }
}

#[test]
fn warp_and_weft_and_all_factors_are_taken() {
    let sheet = elastic(
        r#"{"elastic": {"density": 0.2, "membrane_stiffness": [400, 100], "shear_stiffness": 30,
            "poisson_ratio": 0, "bending_rigidity": [9e-6, 4e-6]},
            "thicken": 2, "density_mult": 3, "stretching_mult": 5, "bending_mult": 7,
            "damping": 0.01, "strain_limits": [0.9, 1.1]}"#,
    );
    assert_eq!(sheet.membrane_stiffness, [4000.0, 1000.0]);
    assert_eq!(sheet.shear_stiffness, 300.0);
    assert!((sheet.density - 1.2).abs() < 1e-12);
    assert!((sheet.bending_rigidity[0] / (14.0 * 9e-6) - 1.0).abs() < 1e-12);
    assert!((sheet.twist_rigidity / (14.0 * 6e-6) - 1.0).abs() < 1e-12);
    assert_eq!((sheet.damping, sheet.strain_limits), (0.01, Some([0.9, 1.1])));
}

#[test]
fn a_preset_is_a_fabric_by_name_which_factors_change() {
    let cotton = elastic(r#"{"preset": "cotton", "thicken": 2, "bending_model": "quadratic"}"#);
    let single = Preset::named("cotton").unwrap().fabric();
    assert_eq!(cotton.density, 2.0 * single.density);
    assert_eq!(cotton.bending_model, BendingModel::Quadratic);
    let error = load_fabric(r#"{"preset": "coton"}"#).unwrap_err().to_string();
    assert!(error.contains("no preset \"coton\" among cotton, silk"), "{error}");
    assert!(error.contains("rubber: did you mean \"cotton\"?"), "{error}");
    let error = load_fabric(r#"{"preset": "cashmere"}"#).unwrap_err().to_string();
    assert!(error.ends_with("leather, rubber"), "{error}");
}

#[test]
fn only_a_solid_that_is_alike_in_all_directions_keeps_its_volume() {
    let sheet = r#""density": 0.2, "thickness": 1e-3, "bending_rigidity": 1e-6"#;
    for (modulus, poisson_ratio) in [
        (r#""young_modulus": 1e6"#, 0.5),
        (r#""young_modulus": [1e6, 2e6]"#, 0.7),
        (r#""young_modulus": 1e6, "shear_stiffness": 20"#, 0.7),
    ] {
        let fabric =
            format!(r#"{{"elastic": {{{sheet}, {modulus}, "poisson_ratio": {poisson_ratio}}}}}"#);
        assert_eq!(elastic(&fabric).poisson_ratio, poisson_ratio);
    }
    let membrane = r#"{"elastic": {"density": 0.2, "membrane_stiffness": 100,
        "bending_rigidity": 1e-6, "poisson_ratio": -0.9}}"#;
    assert_eq!(elastic(membrane).poisson_ratio, -0.9);
}

#[test]
fn a_fabric_has_its_own_contact_thickness_or_the_scenes() {
    let scene = |fabric: &str| load_fabric(fabric).unwrap().scene;
    let thick = scene(r#"{"preset": "denim", "contact_thickness": 0.008}"#);
    assert_eq!((thick.garments[0].contact_thickness, thick.contact.thickness), (Some(8e-3), 8e-3));
    let plain = scene(r#"{"preset": "denim"}"#);
    assert_eq!((plain.garments[0].contact_thickness, plain.contact.thickness), (Some(5e-3), 5e-3));
    let record = load_fabric(r#"{"preset": "silk", "contact_thickness": 0.002}"#).unwrap().resolved;
    assert_eq!(record["fabrics"]["f"]["contact_thickness"], 0.002);
}

#[test]
fn contact_is_thicker_than_rounding_and_thin_beside_the_garment() {
    let error = |thickness: &str| {
        let fabric = format!(r#"{{"preset": "silk", "contact_thickness": {thickness}}}"#);
        load_fabric(&fabric).unwrap_err().to_string()
    };
    for thin in ["0", "-1", "1e-300", "9.9e-6"] {
        let error = error(thin);
        let expected = "but must be at least 0.00001";
        assert!(
            error.contains("fabrics.f.contact_thickness is ") && error.contains(expected),
            "{error}"
        );
    }
    // The sheet is a square metre.
    for thick in ["0.0501", "5", "1e300"] {
        let error = error(thick);
        let expected =
            "but must be at most 0.0500: 0.05 of the side of a square as large as garment \"a\"";
        assert!(
            error.contains("fabrics.f.contact_thickness is ") && error.contains(expected),
            "{error}"
        );
    }
    for held_off in [1e-5, 0.05] {
        let fabric = format!(r#"{{"preset": "silk", "contact_thickness": {held_off}}}"#);
        assert_eq!(load_fabric(&fabric).unwrap().scene.contact.thickness, held_off);
    }
}

#[test]
fn contact_thicknesses_differ_by_five_times_at_most() {
    let shot = r#"{"shotsilk": 1, "fabrics": {
        "thin": {"preset": "silk", "contact_thickness": 0.001}, "thick": {"preset": "wool", "contact_thickness": 0.006}},
        "garments": [{"mesh": "a.obj", "fabric": "thin"}, {"mesh": "a.obj", "fabric": "thick"}]}"#;
    let source =
        EmbeddedFiles::default().with("a.obj", SHEET.as_bytes()).with("a.json", shot.as_bytes());
    let options = LoadOptions { shot: Path::new("a.json").into(), ..LoadOptions::default() };
    let error = load(&options, &source).unwrap_err().to_string();
    assert!(
        error.contains("fabrics.thin.contact_thickness is 0.001, but must be at least 0.0012"),
        "{error}"
    );
}

#[test]
fn the_record_of_an_elastic_fabric_means_the_same() {
    let fabric = r#"{"elastic": {"density": 0.2, "membrane_stiffness": [400, 100],
        "bending_rigidity": 4e-6}, "thicken": 2, "damping": 0.01}"#;
    let record = &load_fabric(fabric).unwrap().resolved["fabrics"]["f"];
    assert_eq!(elastic(&record.to_string()), elastic(fabric));
}

#[test]
fn bad_elastic_fabrics_are_answered_with_the_place() {
    let sheet = r#""density": 0.2, "membrane_stiffness": 100, "bending_rigidity": 1e-6"#;
    let solid = |modulus: &str, poisson_ratio: &str| {
        format!(
            r#"{{"elastic": {{"density": 1, "young_modulus": {modulus}, "thickness": 1e-3,
                "poisson_ratio": {poisson_ratio}}}}}"#
        )
    };
    let cases = [
        (r#"{}"#.to_owned(), "fabrics.f needs a file, a preset, an elastic sheet"),
        (r#"{"elastic": {}}"#.to_owned(), "f.elastic needs membrane_stiffness, or young_modulus"),
        (
            r#"{"elastic": {"membrane_stiffness": 1}}"#.to_owned(),
            "f.elastic needs bending_rigidity, or young_modulus and thickness",
        ),
        (
            r#"{"elastic": {"young_modulus": 1e6, "thickness": 1e-3}}"#.to_owned(),
            "f.elastic needs density",
        ),
        (
            format!(r#"{{"elastic": {{{sheet}, "young_modulus": 1, "thickness": 1}}}}"#),
            "f.elastic has both membrane_stiffness and young_modulus",
        ),
        (
            format!(r#"{{"elastic": {{{sheet}, "young_modulus": 1}}}}"#),
            "f.elastic.young_modulus needs thickness beside it",
        ),
        (
            format!(r#"{{"elastic": {{{sheet}, "thickness": 1}}}}"#),
            "f.elastic.thickness needs young_modulus beside it",
        ),
        (format!(r#"{{"elastic": {{{sheet}}}, "file": "a"}}"#), "f has both file and elastic"),
        (format!(r#"{{"elastic": {{{sheet}}}, "density": 1}}"#), "has both elastic and density"),
        (r#"{"preset": "silk", "elastic": {}}"#.to_owned(), "f has both preset and elastic"),
        (r#"{"bending_model": "moments", "file": "a"}"#.to_owned(), "f.bending_model needs"),
        (
            format!(r#"{{"elastic": {{{sheet}, "poisson_ratio": 1}}}}"#),
            "poisson_ratio is 1, but must be greater than -1 and less than 1",
        ),
        (
            solid("1e6", "0.6"),
            "f.elastic.poisson_ratio is 0.6, but must be greater than -1 and at most 0.5",
        ),
        (solid("[1e6, 1e6]", "-1"), "poisson_ratio is -1, but must be greater than -1"),
        (solid("[1e6, 2e6]", "1"), "poisson_ratio is 1, but must be greater than -1 and less"),
        (
            r#"{"elastic": {"membrane_stiffness": [1, 0]}}"#.to_owned(),
            "elastic.membrane_stiffness.1 is 0, but must be greater than 0",
        ),
        (
            r#"{"elastic": {"membrane_stiffness": [1, 2, 3]}}"#.to_owned(),
            "a.json:1:46: expected a number or a list of two: [warp, weft]",
        ),
    ];
    for (fabric, expected) in cases {
        let error = load_fabric(&fabric).expect_err("the fabric is bad").to_string();
        assert!(error.contains(expected), "{fabric}: {error}");
    }
}
