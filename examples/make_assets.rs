//! Writes the generated files of the shots in `assets`.
//!
//! `cargo run --example make_assets` from the project's folder. Everything is drawn from the
//! numbers in `make_assets/`; the same numbers give the same files.

use std::path::Path;
use std::{fs, io};

#[path = "make_assets/mod.rs"]
mod make_assets;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    for (name, text) in make_assets::files() {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("every file is in the folder"))?;
        fs::write(&path, text)?;
        println!("{}", path.display());
    }
    Ok(())
}
