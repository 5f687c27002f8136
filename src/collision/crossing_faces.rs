//! Which faces of the cloth pass through other cloth or through obstacles, to be shown.

use glam::DVec3;
use rayon::prelude::*;

use super::cloth::crossings;
use super::face_tree::FaceTree;
use super::nearest::bounds;
use crate::math::triangles_cross;
use crate::mesh::{FaceId, Id, Mesh};

/// A face of one of several garments; in order of garments, then faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GarmentFace {
    /// Number of the garment.
    pub garment: usize,
    pub face: FaceId,
}

/// What [`crossing_faces`] finds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CrossingFaces {
    /// Pairs of faces of cloth that cross, the smaller face first; in order, each pair once.
    pub pairs: Vec<[GarmentFace; 2]>,
    /// Faces of cloth and numbers of the obstacles they cross; in order, each once.
    pub cuts: Vec<(GarmentFace, usize)>,
}

/// All crossings of garments with themselves, one another and obstacles, whose triangles are given in
/// the world (m). Two faces of cloth cross if an edge of one passes through the other: what
/// [`crossings`] counts by edges. An edge that has a node in common with a face does not cross it.
/// Where a node is not finite nothing is found.
///
/// Builds a tree over all faces, which is most of the cost: O(n log n) for n faces of cloth, and a
/// query for each edge and each triangle of an obstacle.
pub fn crossing_faces(garments: &[&Mesh], obstacles: &[Vec<[DVec3; 3]>]) -> CrossingFaces {
    let all = AllFaces::of(garments);
    if all.faces.is_empty() {
        return CrossingFaces::default();
    }
    let tree = FaceTree::new(&all.positions, &all.corners);
    CrossingFaces { pairs: all.pairs(&tree), cuts: all.cuts(&tree, obstacles) }
}

/// The faces of all garments, one after the other.
struct AllFaces {
    positions: Vec<DVec3>,
    /// Numbers of positions.
    corners: Vec<[u32; 3]>,
    faces: Vec<GarmentFace>,
}

impl AllFaces {
    fn of(garments: &[&Mesh]) -> Self {
        let mut all = Self { positions: Vec::new(), corners: Vec::new(), faces: Vec::new() };
        for (garment, mesh) in garments.iter().enumerate() {
            let first = all.positions.len();
            for face in mesh.face_ids() {
                all.corners.push(mesh.face_nodes(face).map(|n| (first + n.index()) as u32));
                all.faces.push(GarmentFace { garment, face });
            }
            all.positions.extend(mesh.position.iter());
        }
        all
    }

    fn pairs(&self, tree: &FaceTree) -> Vec<[GarmentFace; 2]> {
        let mut pairs: Vec<[GarmentFace; 2]> = Vec::new();
        for crossing in crossings(tree, &self.positions) {
            let edge = tree.topology().edges()[crossing.edge as usize];
            let through = self.faces[crossing.face as usize];
            for side in [Some(edge.first), edge.second].into_iter().flatten() {
                let face = self.faces[side.triangle as usize];
                pairs.push([face.min(through), face.max(through)]);
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    fn cuts(&self, tree: &FaceTree, obstacles: &[Vec<[DVec3; 3]>]) -> Vec<(GarmentFace, usize)> {
        let crossed_by = |triangle: &[DVec3; 3]| -> Vec<u32> {
            let is_cut = |&face: &u32| {
                let corners = self.corners[face as usize].map(|n| self.positions[n as usize]);
                triangles_cross(corners, *triangle)
            };
            tree.faces_in(&bounds(triangle)).filter(is_cut).collect()
        };
        let of = |(number, triangles): (usize, &Vec<[DVec3; 3]>)| {
            let found = triangles.par_iter().with_min_len(256).flat_map_iter(crossed_by);
            let cut = |face: u32| (self.faces[face as usize], number);
            found.map(cut).collect::<Vec<_>>()
        };
        let mut cuts: Vec<_> = obstacles.iter().enumerate().flat_map(of).collect();
        cuts.sort_unstable();
        cuts.dedup();
        cuts
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::mesh::RawMesh;

    /// Triangles that share no corners.
    fn cloth(triangles: &[[DVec3; 3]]) -> Mesh {
        let points: Vec<DVec3> = triangles.iter().flatten().copied().collect();
        // Flat cloth of the same shape, whichever way it stands.
        let flat = |i: usize| match i % 3 {
            0 => DVec2::ZERO,
            1 => DVec2::X,
            _ => DVec2::Y,
        };
        let raw = RawMesh {
            vertices: (0..points.len()).map(|i| (i as u32, flat(i))).collect(),
            faces: (0..triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
            positions: points,
            ..Default::default()
        };
        Mesh::from_raw(&raw, &[]).expect("the triangles are a mesh")
    }

    fn triangle(points: [[f64; 3]; 3]) -> [DVec3; 3] {
        points.map(DVec3::from_array)
    }

    fn lying(height: f64) -> [DVec3; 3] {
        triangle([[-1.0, -1.0, height], [1.0, -1.0, height], [0.0, 1.0, height]])
    }

    /// Upright, from `low` to 1 m above it.
    fn standing(low: f64) -> [DVec3; 3] {
        triangle([[-0.2, 0.0, low], [0.2, 0.0, low], [0.0, 0.1, low + 1.0]])
    }

    fn face(garment: usize, number: usize) -> GarmentFace {
        GarmentFace { garment, face: FaceId::from_index(number) }
    }

    #[test]
    fn faces_that_cross_are_found_within_a_garment_and_between_two() {
        let within = cloth(&[lying(0.0), standing(-0.5), standing(2.0)]);
        let found = crossing_faces(&[&within], &[]);
        assert_eq!(found.pairs, [[face(0, 0), face(0, 1)]]);

        let (one, other) = (cloth(&[standing(3.0), standing(-0.5)]), cloth(&[lying(0.0)]));
        let found = crossing_faces(&[&one, &other], &[]);
        assert_eq!(found, CrossingFaces { pairs: vec![[face(0, 1), face(1, 0)]], cuts: vec![] });
    }

    #[test]
    fn cloth_that_is_apart_does_not_cross() {
        let apart = cloth(&[lying(0.0), standing(0.01), standing(-1.01)]);
        assert_eq!(crossing_faces(&[&apart], &[]), CrossingFaces::default());
        assert_eq!(crossing_faces(&[], &[vec![lying(0.0)]]), CrossingFaces::default());
    }

    #[test]
    fn cloth_through_an_obstacle_is_found_with_the_obstacles_number() {
        let garment = cloth(&[standing(4.0), standing(-0.5)]);
        // Two triangles of one obstacle cut the face: it is named once.
        let obstacles = [vec![lying(9.0)], vec![lying(0.0), lying(0.1)]];
        let found = crossing_faces(&[&garment], &obstacles);
        assert_eq!(found, CrossingFaces { pairs: vec![], cuts: vec![(face(0, 1), 1)] });
    }

    #[test]
    fn a_node_that_is_not_finite_does_no_harm() {
        let mut garment = cloth(&[lying(0.0), standing(-0.5), standing(-0.4)]);
        let node = garment.face_nodes(FaceId::from_index(2))[0];
        garment.position[node] = DVec3::NAN;
        let found = crossing_faces(&[&garment], &[vec![lying(0.1)]]);
        assert!(found.pairs.contains(&[face(0, 0), face(0, 1)]), "{found:?}");
        assert!(found.cuts.contains(&(face(0, 1), 0)), "{found:?}");
    }
}
