//! An obstacle's OBJ: positions and polygons.

use std::sync::Arc;

use super::{Counts, fan, lines};
use crate::scene::Surface;
use crate::scene::error::{LoadError, Place, Problem};

/// A triangle whose double area is below this share of its longest edge squared has none.
const FLATNESS: f64 = 1e-14;

/// What becomes of triangles without area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) enum Flat {
    /// Left out, with a warning.
    LeftOut,
    /// Kept: they may have area at another time.
    Kept,
}

/// Polygons as triangle fans.
///
/// # Errors
/// Numbers and indices that are none, with their line; a file without triangles.
pub(in crate::scene) fn surface_from_obj(
    file: &str,
    text: &str,
    flatness: Flat,
    warnings: &mut Vec<String>,
) -> Result<Surface, LoadError> {
    let file: Arc<str> = file.into();
    let counts = Counts::of(&file, text);
    let mut surface = Surface::default();
    let mut polygons = Vec::new();
    for mut line in lines(&file, text) {
        match line.keyword {
            "v" => surface.positions.push(line.point()?),
            "f" => polygons.push((line.number, line.corners(counts)?)),
            _ => {}
        }
    }
    let mut flat = Vec::new();
    for (line, corners) in &polygons {
        for triangle in fan(corners) {
            let triangle = triangle.map(|(node, _)| node);
            if flatness == Flat::Kept || has_area(&surface, triangle) {
                surface.triangles.push(triangle);
            } else {
                flat.push(*line);
            }
        }
    }
    if let Some(first) = flat.first() {
        let count = flat.len();
        warnings.push(format!("{file}:{first}: {count} triangles without area are left out"));
    }
    if surface.triangles.is_empty() {
        let (thing, needed) = ("an obstacle".into(), "at least one triangle");
        return Err(Problem::Missing { thing, needed }.at(Place::File { file }));
    }
    Ok(surface)
}

fn has_area(surface: &Surface, triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|k| surface.positions[k as usize]);
    let longest = (b - a).length_squared().max((c - b).length_squared());
    (b - a).cross(c - a).length() > FLATNESS * longest.max((a - c).length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_become_fans_and_flat_ones_are_reported() {
        let text = "o x\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1//1 2//1 3//1 4//1\nf 1 2 2\n";
        let mut warnings = Vec::new();
        let surface = surface_from_obj("a.obj", text, Flat::LeftOut, &mut warnings).unwrap();
        assert_eq!(surface.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(warnings, ["a.obj:7: 1 triangles without area are left out"]);
    }

    #[test]
    fn an_empty_or_broken_surface_is_refused() {
        let read = |text| {
            let read = surface_from_obj("a.obj", text, Flat::LeftOut, &mut Vec::new());
            read.unwrap_err().to_string()
        };
        assert_eq!(read("v 0 0 0\n"), "a.obj: an obstacle needs at least one triangle");
        assert!(read("v 0 0 0\nf 1 2 3\n").starts_with("a.obj:2: a face names node 2"));
        assert!(read("v 0 inf 0\n").starts_with("a.obj:1: expected a finite number"));
        let many = format!("v 0 0 0\nf{}\n", " 1".repeat(33));
        assert!(read(&many).contains("is 33, but must be 3 to 32"));
    }
}
