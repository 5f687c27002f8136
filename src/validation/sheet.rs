//! Flat rectangular sheets, triangulated in different ways.

use std::f64::consts::FRAC_PI_4;

use glam::{DVec2, DVec3, Vec2Swizzles};

use super::triangulate::delaunay;
use crate::math::Random;
use crate::mesh::{Mesh, RawMesh};

/// How the triangles lie in the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// Squares along the sides, all cut along the same diagonal.
    Aligned,
    /// The same, turned against the sides by an angle (rad).
    Rotated(f64),
    /// Nodes moved at random by up to 0.35 cells.
    Irregular,
}

/// A rectangle of cloth in material space.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// The corner with the least coordinates (m).
    pub origin: DVec2,
    /// (m).
    pub size: DVec2,
    /// Side of a square of two triangles (m), fitted to the sides.
    pub cell: f64,
    pub layout: Layout,
    /// Further lines u = const with a row of nodes, in ascending order (m).
    pub columns: Vec<f64>,
}

/// Inner nodes of a layout keep this distance from sides and columns, in cells.
const CLEARANCE: f64 = 0.6;

/// How far irregular nodes are moved, in cells.
const JITTER: f64 = 0.35;

/// What makes circles through lattice points decide for one diagonal, and sides strictly convex, as
/// the triangulation wants it.
const SHEAR: f64 = 1e-2;
const BULGE: f64 = 1e-3;

impl Layout {
    /// The layouts that an experiment should not be able to tell apart.
    pub const ALL: [Layout; 5] = [
        Layout::Aligned,
        Layout::Rotated(FRAC_PI_4 / 3.0),
        Layout::Rotated(FRAC_PI_4 * 2.0 / 3.0),
        Layout::Rotated(FRAC_PI_4),
        Layout::Irregular,
    ];

    /// For the names of claims.
    pub fn name(self) -> String {
        match self {
            Layout::Aligned => "aligned".into(),
            Layout::Rotated(angle) => format!("rotated-{:.0}", angle.to_degrees()),
            Layout::Irregular => "irregular".into(),
        }
    }
}

impl Sheet {
    /// The sheet as a mesh, each material position placed in the world.
    ///
    /// # Panics
    /// If the sheet is no mesh: it has no area, or columns outside.
    pub fn mesh(&self, place: impl Fn(DVec2) -> DVec3) -> Mesh {
        Mesh::from_raw(&self.raw(place), &[]).expect("a sheet is a mesh")
    }

    /// The sheet before its connectivity is built, so that nodes can be pinned.
    pub fn raw(&self, place: impl Fn(DVec2) -> DVec3) -> RawMesh {
        let points = self.points();
        let generic: Vec<DVec2> = points.iter().map(|&u| self.in_general_position(u)).collect();
        RawMesh {
            positions: points.iter().map(|&u| place(u)).collect(),
            vertices: (0..).zip(points).collect(),
            faces: delaunay(&generic),
            ..RawMesh::default()
        }
    }

    fn points(&self) -> Vec<DVec2> {
        let mut points = self.outline();
        let inner = self.lattice();
        points.extend(inner.into_iter().filter(|&u| self.has_room(u)));
        points
    }

    /// Nodes on the sides and on the columns.
    fn outline(&self) -> Vec<DVec2> {
        let [low, high] = [self.origin, self.origin + self.size];
        let mut stops = vec![low.x];
        stops.extend(&self.columns);
        stops.push(high.x);
        let mut points = Vec::new();
        for pair in stops.windows(2) {
            let u = divided(pair[0], pair[1], self.cell);
            points
                .extend(u[1..].iter().flat_map(|&u| [DVec2::new(u, low.y), DVec2::new(u, high.y)]));
        }
        points.extend([low, DVec2::new(low.x, high.y)]);
        let v = divided(low.y, high.y, self.cell);
        let inner = &v[1..v.len() - 1];
        points.extend(stops.iter().flat_map(|&u| inner.iter().map(move |&v| DVec2::new(u, v))));
        points
    }

    /// Points all over the rectangle and beyond, before those without room are left out.
    fn lattice(&self) -> Vec<DVec2> {
        let steps = self.fitted_steps();
        let reach = (self.size.length() / steps.min_element()).ceil() as i32 + 1;
        let start = self.origin.with_x(self.columns.last().copied().unwrap_or(self.origin.x));
        let mut random = Random::new(0);
        let mut points = Vec::new();
        for i in -reach..=reach {
            for j in -reach..=reach {
                let step = DVec2::new(f64::from(i), f64::from(j));
                points.push(match self.layout {
                    Layout::Aligned => start + step * steps,
                    Layout::Rotated(angle) => {
                        start + DVec2::from_angle(angle).rotate(step * self.cell)
                    }
                    Layout::Irregular => start + (step + random.in_square() * JITTER) * steps,
                });
            }
        }
        points
    }

    /// The cell as it divides the sheet behind the last column evenly.
    fn fitted_steps(&self) -> DVec2 {
        let start = self.columns.last().copied().unwrap_or(self.origin.x);
        let rest = DVec2::new(self.origin.x + self.size.x - start, self.size.y);
        rest / (rest / self.cell).round().max(DVec2::ONE)
    }

    fn has_room(&self, u: DVec2) -> bool {
        let least = CLEARANCE * self.fitted_steps().min_element();
        let end = self.origin + self.size;
        self.columns.iter().all(|column| (u.x - column).abs() > least)
            && u.x > self.origin.x + least
            && u.x < end.x - least
            && u.y > self.origin.y + least
            && u.y < end.y - least
    }

    /// The point sheared along the layout's lattice, in a rectangle with sides that bulge.
    fn in_general_position(&self, u: DVec2) -> DVec2 {
        let angle = if let Layout::Rotated(angle) = self.layout { angle } else { 0.0 };
        let along = DVec2::from_angle(angle);
        let from_middle = u - (self.origin + 0.5 * self.size);
        let sheared = from_middle + along * (SHEAR * from_middle.dot(along.perp()));
        let share = 2.0 * from_middle / self.size;
        sheared + from_middle * BULGE * (DVec2::ONE - (share * share).yx())
    }
}

/// From `start` to `end` in equal steps of about `step`.
fn divided(start: f64, end: f64, step: f64) -> Vec<f64> {
    let count = ((end - start) / step).round().max(1.0);
    (0..=count as u32).map(|k| start + (end - start) * f64::from(k) / count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::aspect_ratio;

    #[test]
    fn every_layout_covers_the_sheet_with_triangles_of_good_shape() {
        for layout in Layout::ALL {
            let (origin, size) = (DVec2::new(-0.01, -0.05), DVec2::new(0.41, 0.1));
            let sheet = Sheet { origin, size, cell: 0.02, layout, columns: vec![0.01] };
            let mesh = sheet.mesh(|u| u.extend(0.0));
            mesh.check().unwrap();
            assert!((mesh.total_material_area() / (0.41 * 0.1) - 1.0).abs() < 1e-12, "{layout:?}");
            let worst = mesh.face_ids().map(|f| aspect_ratio(mesh.face_material(f)));
            let worst = worst.fold(1.0, f64::min);
            assert!(worst > 0.3, "{layout:?}: {worst}");
            let on_column = mesh.vertex_ids().filter(|&v| mesh.material(v).x == 0.01).count();
            assert_eq!(on_column, 6, "{layout:?}");
            let squares = 20.5 * 5.0;
            assert!((mesh.face_count() as f64 / (2.0 * squares) - 1.0).abs() < 0.25, "{layout:?}");
        }
    }

    #[test]
    fn an_aligned_sheet_has_all_diagonals_the_same_way() {
        let sheet = Sheet {
            origin: DVec2::ZERO,
            size: DVec2::new(0.6, 0.3),
            cell: 0.1,
            layout: Layout::Aligned,
            columns: vec![],
        };
        let mesh = sheet.mesh(|u| u.extend(0.0));
        assert_eq!((mesh.node_count(), mesh.face_count()), (28, 36));
        for corner in mesh.edges() {
            let [a, b] = mesh.edge_vertices(corner).map(|v| mesh.material(v));
            let along = (b - a) / 0.1;
            let is_side = along.x.abs() < 1e-9 || along.y.abs() < 1e-9;
            assert!(is_side || along.x * along.y < 0.0, "{along}");
        }
    }
}
