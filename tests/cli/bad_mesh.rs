//! Meshes that cannot be simulated, with the file, the line and what is wrong.

use super::small_shot::{CLOTH, SmallShot, refused_after};

/// A square of two triangles, and three more material positions, beside it.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 3 0\n\
    vt 4 0\nvt 4 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

#[track_caller]
fn cloth_is_refused(cloth: &str, parts: &[&str]) {
    let shot = SmallShot::new();
    shot.write("cloth.obj", cloth);
    shot.is_refused_with("--set handles=[]", parts);
}

#[test]
fn numbers_that_are_none_or_not_finite_are_shown() {
    for word in ["nan", "inf", "-1e999", "one"] {
        let found = format!("found \"{word}\"");
        let parts = ["cloth.obj:5: expected a finite number", &found];
        refused_after("cloth.obj", "v 0.5 0.5 1", &format!("v 0.5 {word} 1"), &parts);
    }
    refused_after("solid.obj", "v 0.5 0.8 0.6", "v 0.5 NaN 0.6", &["solid.obj:3:", "\"NaN\""]);
}

#[test]
fn faces_that_name_what_is_not_there_are_refused() {
    refused_after("cloth.obj", "f 5 9 8", "f 5 9 77", &["cloth.obj:17", "node 77", "there are 9"]);
    refused_after("solid.obj", "f 3 1 4", "f 3 1 0", &["solid.obj:8", "node 0", "there are 4"]);
    refused_after("cloth.obj", "f 5 9 8", "f 5 9", &["cloth.obj:17", "is 2", "3 to 32"]);
}

#[test]
fn a_face_without_area_is_refused() {
    let square = SQUARE.replace("vt 1 0", "vt 0.5 0.5");
    cloth_is_refused(&square, &["cloth.obj:12: garment \"cloth\": face 0", "1e-14 m^2"]);
    cloth_is_refused(&CLOTH.replace("f 5 9 8", "f 5 9 9"), &["cloth.obj:17", "face 7"]);
}

#[test]
fn an_edge_with_three_faces_is_refused() {
    let fin = format!("{SQUARE}v 0 0 1\nf 3/5 1/6 5/7\n");
    cloth_is_refused(&fin, &["cloth.obj:15", "more than two faces", "the third is face 2"]);
}

#[test]
fn faces_that_disagree_about_the_outside_are_refused() {
    let clockwise = SQUARE.replace("f 1/1 3/3 4/4", "f 1/1 4/4 3/3");
    cloth_is_refused(&clockwise, &["cloth.obj:13: garment \"cloth\": face 1 is clockwise"]);
    let inside_out = SQUARE.replace("f 1/1 3/3 4/4", "f 3/5 1/6 4/7");
    let parts = ["cloth.obj:13", "faces 0 and 1", "between nodes", "one of them is inside out"];
    cloth_is_refused(&inside_out, &parts);
}

#[test]
fn a_mesh_without_faces_is_refused() {
    cloth_is_refused("", &["cloth.obj: garment \"cloth\": the mesh has no faces"]);
    let shot = SmallShot::new();
    shot.write("solid.obj", "v 0 0 0\n");
    shot.is_refused(&["solid.obj: an obstacle needs at least one triangle"]);
}
