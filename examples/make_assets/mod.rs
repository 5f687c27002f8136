//! The shots' meshes and motions, from numbers to files: a figure in a skirt, and
//! in a layered outfit, and a curtain.
//!
//! ```text
//! loft   closed surfaces from profiles        parts  the profiles of the figure's parts
//! steps  where and when the feet are set      kick   how a leg kicks
//! body, gait  the parts' poses that follow    walk, kata  what the two figures do
//! skirt  flat gores and the cone they make    top    shirts and jackets, from planes and cones
//! sew    panels unfolded and sewn             outfit  the cuts of the layered outfit
//! curtain  a wave of cloth, and its tape      text   the files
//! ```
//!
//! Lengths in metres, angles in radians, z up; a part's own y is forward, its x to the right.

mod body;
mod curtain;
mod gait;
mod kata;
mod kick;
mod loft;
mod outfit;
mod parts;
mod sew;
mod skirt;
mod steps;
mod text;
mod top;
mod walk;

use shotsilk::scene::Pose;

use gait::{Choreography, Figure};
use parts::Part;

/// The motion goes on past the shot's last frame, 100, so that it is not at rest there.
const LAST_SAMPLE: u32 = 112;
/// The same for the layered outfit, whose last frame is 125.
const LAST_LAYERED_SAMPLE: u32 = 137;

/// A generated file: its path in the folder of assets, and its text.
pub type File = (String, String);

/// Every generated file.
pub fn files() -> Vec<File> {
    let in_folder = |folder: &'static str, files: Vec<File>| {
        files.into_iter().map(move |(path, text)| (format!("{folder}/{path}"), text))
    };
    in_folder("own-shot", own_shot())
        .chain(in_folder("layered", layered()))
        .chain(in_folder("curtain", curtain()))
        .collect()
}

fn curtain() -> Vec<File> {
    vec![
        ("curtain.obj".to_owned(), text::cloth(&curtain::curtain())),
        ("tape.mot".to_owned(), text::motions(&curtain::tape())),
    ]
}

fn own_shot() -> Vec<File> {
    let figures = figures(&walk::WALK, LAST_SAMPLE);
    let mut files: Vec<File> = parts::MESHES
        .iter()
        .map(|mesh| (format!("meshes/{}.obj", mesh.name), text::surface(&mesh.surface())))
        .collect();
    let skirt = skirt::skirt(figures[0].pose(Part::Pelvis));
    files.push(("meshes/skirt.obj".to_owned(), text::cloth(&skirt)));
    files.push(("figure.mot".to_owned(), motion(&figures)));
    files
}

/// The figure's parts are the own shot's.
fn layered() -> Vec<File> {
    let figures = figures(&kata::KATA, LAST_LAYERED_SAMPLE);
    let [pelvis, chest] = [Part::Pelvis, Part::Chest].map(|part| figures[0].pose(part));
    vec![
        ("skirt.obj".to_owned(), text::cloth(&skirt::skirt(pelvis))),
        ("shirt.obj".to_owned(), text::cloth(&outfit::SHIRT.mesh(chest))),
        ("jacket.obj".to_owned(), text::cloth(&outfit::JACKET.mesh(chest))),
        ("figure.mot".to_owned(), motion(&figures)),
    ]
}

fn figures(choreography: &'static Choreography, last: u32) -> Vec<Figure> {
    (0..=last).map(|frame| Figure::at(choreography, f64::from(frame))).collect()
}

fn motion(figures: &[Figure]) -> String {
    let body = |part: &Part| figures.iter().map(|figure| figure.pose(*part)).collect();
    text::motions(&Part::ALL.iter().map(body).collect::<Vec<Vec<Pose>>>())
}
