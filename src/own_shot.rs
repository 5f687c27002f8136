//! The shot that comes with the program, so that it has something to show wherever it runs.
//!
//! `assets/README.md` says how it is made.

use std::path::PathBuf;

use crate::scene::EmbeddedFiles;

macro_rules! file {
    ($name:literal) => {
        ($name, include_bytes!(concat!("../assets/own-shot/", $name)))
    };
}

/// What the shot file names, by the names it uses.
const FILES: [(&str, &[u8]); 10] = [
    file!("figure.mot"),
    file!("meshes/pelvis.obj"),
    file!("meshes/chest.obj"),
    file!("meshes/head.obj"),
    file!("meshes/thigh.obj"),
    file!("meshes/shin.obj"),
    file!("meshes/foot.obj"),
    file!("meshes/upper-arm.obj"),
    file!("meshes/forearm.obj"),
    file!("meshes/skirt.obj"),
];

/// The shot file, under the name that captions show.
const SHOT: (&str, &[u8]) = ("own-shot.json", include_bytes!("../assets/own-shot/shot.json"));

/// The text of the shot file, and the files that it names, by the names it uses.
pub fn own_shot_parts() -> (&'static [u8], impl Iterator<Item = (&'static str, &'static [u8])>) {
    (SHOT.1, FILES.into_iter())
}

/// The shot's path, and the files among which it is found.
pub fn own_shot() -> (PathBuf, EmbeddedFiles) {
    let files = FILES.into_iter().chain([SHOT]);
    let embedded = files.fold(EmbeddedFiles::default(), |all, (path, bytes)| all.with(path, bytes));
    (PathBuf::from(SHOT.0), embedded)
}
