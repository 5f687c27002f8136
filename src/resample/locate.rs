//! Where in a mesh a point of the flat cloth is.
//!
//! The search is for the nearest face of the point's piece: a face which holds the point is at
//! distance zero, and a point that rounding has pushed over the outline, or between two faces, is
//! found as well.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::math::closest_point_on_triangle;
use crate::mesh::{FaceId, Mesh, Panel, Panels};

/// A point of the flat cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialPoint {
    pub panel: Panel,
    /// (m).
    pub position: DVec2,
}

/// Where a point of the flat cloth was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    pub face: FaceId,
    pub barycentric: [f64; 3],
    /// From the point to the face in the flat cloth (m); 0 inside.
    pub distance: f64,
}

/// A tree over the faces of each piece.
#[derive(Debug)]
pub struct Locator {
    mesh: Arc<Mesh>,
    panels: Panels,
    trees: Vec<Tree>,
}

impl Locator {
    pub fn new(mesh: Arc<Mesh>) -> Self {
        let panels = Panels::of(&mesh);
        let mut faces: Vec<Vec<FaceId>> = vec![Vec::new(); panels.count()];
        for face in mesh.face_ids() {
            faces[panels.of_face(face)].push(face);
        }
        let trees = faces.into_iter().map(|faces| Tree::new(&mesh, faces)).collect();
        Self { mesh, panels, trees }
    }

    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub fn panels(&self) -> &Panels {
        &self.panels
    }

    /// The point of the flat cloth at a place of a face.
    pub fn material_point(&self, face: FaceId, barycentric: [f64; 3]) -> MaterialPoint {
        let corners = self.mesh.face_material(face);
        let position = (0..3).map(|k| corners[k] * barycentric[k]).sum();
        MaterialPoint { panel: self.panels.of_face(face), position }
    }

    /// The face nearest to a point, of those equally near the first that the tree meets.
    ///
    /// # Panics
    /// If the garment has no such panel.
    pub fn locate(&self, point: MaterialPoint) -> Located {
        self.trees[point.panel].nearest(&self.mesh, point.position)
    }

    /// Where in the world a point of the flat cloth is (m).
    ///
    /// # Panics
    /// If the garment has no such panel.
    pub fn point_in_world(&self, point: MaterialPoint) -> DVec3 {
        let Located { face, barycentric, .. } = self.locate(point);
        let corners = self.mesh.face_positions(face);
        (0..3).map(|k| corners[k] * barycentric[k]).sum()
    }
}

/// Boxes in the flat cloth, halved at the median face of their longer side.
#[derive(Debug)]
struct Tree {
    faces: Vec<FaceId>,
    /// The root first; empty only for a piece without faces, which no mesh has.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    min: DVec2,
    max: DVec2,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    /// Two nodes.
    Halves([usize; 2]),
    /// Faces `start..end` of the tree's list.
    Faces { start: usize, end: usize },
}

/// Faces that are tried one by one.
const LEAF_FACES: usize = 4;

impl Tree {
    fn new(mesh: &Mesh, faces: Vec<FaceId>) -> Self {
        let end = faces.len();
        let mut tree = Self { faces, nodes: Vec::new() };
        tree.grow(mesh, 0, end);
        tree
    }

    /// Makes the node over a range of faces and those below it; returns its index.
    fn grow(&mut self, mesh: &Mesh, start: usize, end: usize) -> usize {
        let corners = self.faces[start..end].iter().flat_map(|&f| mesh.face_material(f));
        let (min, max) =
            corners.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
        let index = self.nodes.len();
        self.nodes.push(Node { min, max, content: Content::Faces { start, end } });
        if end - start > LEAF_FACES {
            let axis = usize::from(max.y - min.y > max.x - min.x);
            let middle = start + (end - start) / 2;
            let along = |face: &FaceId| mesh.face_material(*face).map(|p| p[axis]).iter().sum();
            self.faces[start..end].select_nth_unstable_by(middle - start, |a, b| {
                f64::total_cmp(&along(a), &along(b)).then(a.cmp(b))
            });
            let halves = [self.grow(mesh, start, middle), self.grow(mesh, middle, end)];
            self.nodes[index].content = Content::Halves(halves);
        }
        index
    }

    fn nearest(&self, mesh: &Mesh, point: DVec2) -> Located {
        let first = self.faces[0];
        let mut best = Located { face: first, barycentric: [1.0, 0.0, 0.0], distance: f64::MAX };
        let mut open = vec![(0, 0.0)];
        while let Some((index, distance)) = open.pop() {
            if distance >= best.distance {
                continue;
            }
            match self.nodes[index].content {
                Content::Faces { start, end } => {
                    for &face in &self.faces[start..end] {
                        let found = closest(mesh, face, point);
                        if found.distance < best.distance {
                            best = found;
                        }
                    }
                }
                Content::Halves(halves) => {
                    let mut halves = halves.map(|half| (half, self.distance(half, point)));
                    // The nearer one is taken from the end.
                    halves.sort_by(|a, b| b.1.total_cmp(&a.1));
                    open.extend(halves);
                }
            }
        }
        best
    }

    /// From a point to a node's box (m).
    fn distance(&self, node: usize, point: DVec2) -> f64 {
        let Node { min, max, .. } = self.nodes[node];
        point.distance(point.clamp(min, max))
    }
}

fn closest(mesh: &Mesh, face: FaceId, point: DVec2) -> Located {
    let [a, b, c] = mesh.face_material(face);
    // Relative to a corner: the flat cloth may lie far from its origin.
    let corners = [DVec3::ZERO, (b - a).extend(0.0), (c - a).extend(0.0)];
    let found = closest_point_on_triangle((point - a).extend(0.0), corners);
    let distance = found.point.truncate().distance(point - a);
    Located { face, barycentric: found.barycentric, distance }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::testing::{sheet, stretched};
    use super::*;

    fn brute_force(mesh: &Mesh, point: DVec2) -> f64 {
        mesh.face_ids().map(|f| closest(mesh, f, point).distance).fold(f64::MAX, f64::min)
    }

    proptest! {
        #[test]
        fn no_face_is_nearer_than_the_one_found(x in -1.0..2.0, y in -1.0..2.0) {
            let mesh = sheet(7, 5);
            let locator = Locator::new(Arc::new(mesh.clone()));
            let point = MaterialPoint { panel: 0, position: DVec2::new(x, y) };
            let found = locator.locate(point);
            prop_assert!((found.distance - brute_force(&mesh, point.position)).abs() < 1e-15);
            let inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
            prop_assert_eq!(found.distance < 1e-15, inside);
        }

        #[test]
        fn a_point_of_a_face_is_found_where_it_is(x in 0.0..1.0, y in 0.0..1.0) {
            let mesh = Arc::new(stretched(&sheet(4, 9)));
            let locator = Locator::new(mesh.clone());
            let position = DVec2::new(x, y);
            let Located { face, barycentric, .. } =
                locator.locate(MaterialPoint { panel: 0, position });
            let back = locator.material_point(face, barycentric);
            prop_assert!(back.position.distance(position) < 1e-14);
            let expected = DVec3::new(2.0 * x, y, 0.0);
            prop_assert!(locator.point_in_world(back).distance(expected) < 1e-14);
        }
    }

    #[test]
    fn corners_edges_and_outline_belong_to_some_face() {
        let mesh = Arc::new(sheet(3, 3));
        let locator = Locator::new(mesh.clone());
        for vertex in mesh.vertex_ids() {
            let position = mesh.material(vertex);
            let world = locator.point_in_world(MaterialPoint { panel: 0, position });
            assert!(world.distance(mesh.vertex_position(vertex)) < 1e-15);
        }
    }
}
