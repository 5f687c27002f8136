//! The figure, its motion and its skirt, from numbers to files.
//!
//! ```text
//! loft   closed surfaces from profiles        parts  the profiles of the figure's parts
//! steps  where and when the feet are set      gait   the parts' poses that follow from them
//! skirt  flat gores and the cone they make    text   the files
//! ```
//!
//! Lengths in metres, angles in radians, z up; a part's own y is forward, its x to the right.

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

/// Every generated file: its path in the shot's folder, and its text.
pub fn files() -> Vec<(String, String)> {
    let figures: Vec<Figure> = (0..=LAST_SAMPLE).map(|f| Figure::at(f64::from(f))).collect();
    let mut files: Vec<(String, String)> = parts::MESHES
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
