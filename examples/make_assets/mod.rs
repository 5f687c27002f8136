//! The shots' meshes and motions, from numbers to files: a figure with its skirt, and a curtain.
//!
//! ```text
//! loft   closed surfaces from profiles        parts  the profiles of the figure's parts
//! steps  where and when the feet are set      gait   the parts' poses that follow from them
//! skirt  flat gores and the cone they make    curtain  a wave of cloth, and its tape
//! text   the files
//! ```
//!
//! Lengths in metres, angles in radians, z up; a part's own y is forward, its x to the right.

mod curtain;
mod gait;
mod loft;
mod parts;
mod skirt;
mod steps;
mod text;

use shotsilk::scene::Pose;

use gait::Figure;
use parts::Part;

/// The motion goes on past the shot's last frame, 100, so that it is not at rest there.
const LAST_SAMPLE: u32 = 112;

/// A generated file: its path in the folder of assets, and its text.
pub type File = (String, String);

/// Every generated file.
pub fn files() -> Vec<File> {
    let in_folder = |folder: &'static str, files: Vec<File>| {
        files.into_iter().map(move |(path, text)| (format!("{folder}/{path}"), text))
    };
    in_folder("own-shot", own_shot()).chain(in_folder("curtain", curtain())).collect()
}

fn curtain() -> Vec<File> {
    vec![
        ("curtain.obj".to_owned(), text::cloth(&curtain::curtain())),
        ("tape.mot".to_owned(), text::motions(&curtain::tape())),
    ]
}

fn own_shot() -> Vec<File> {
    let figures: Vec<Figure> = (0..=LAST_SAMPLE).map(|f| Figure::at(f64::from(f))).collect();
    let mut files: Vec<File> = parts::MESHES
        .iter()
        .map(|mesh| (format!("meshes/{}.obj", mesh.name), text::surface(&mesh.surface())))
        .collect();
    let skirt = skirt::skirt(figures[0].pose(Part::Pelvis));
    files.push(("meshes/skirt.obj".to_owned(), text::cloth(&skirt)));
    let body = |part: &Part| figures.iter().map(|figure| figure.pose(*part)).collect();
    let bodies: Vec<Vec<Pose>> = Part::ALL.iter().map(body).collect();
    files.push(("figure.mot".to_owned(), text::motions(&bodies)));
    files
}
