//! Keeps the remesher from putting faces through other cloth.

use std::cell::RefCell;
use std::collections::HashMap;

use glam::DVec3;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use crate::collision::nearest::bounds;
use crate::math::segment_passes_through;
use crate::remesh::{Change, EditGuard};

/// Refuses edits after which more faces cross other cloth than before.
///
/// Knows all garments' faces by where they are in the world, and follows the edits: faces have a
/// common node if they have a common corner. Of faces that lie in the same place, as where a lining
/// begins as the shell, each is known by itself; which of them an edit takes away makes no difference.
pub struct ClothGuard {
    known: RefCell<Known>,
}

struct Known {
    tree: Bvh,
    /// By the leaf's number; faces that are gone stay here without a leaf.
    faces: Vec<[DVec3; 3]>,
    leaves_of: HashMap<Key, Vec<u32>>,
}

/// A face by its corners' bits, in ascending order.
type Key = [[u64; 3]; 3];

impl ClothGuard {
    pub fn new(faces: Vec<[DVec3; 3]>) -> Self {
        let boxes: Vec<_> = faces.iter().map(|f| bounds(f)).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        let mut leaves_of: HashMap<Key, Vec<u32>> = HashMap::new();
        for (leaf, face) in faces.iter().enumerate() {
            leaves_of.entry(key(face)).or_default().push(leaf as u32);
        }
        Self { known: RefCell::new(Known { tree, faces, leaves_of }) }
    }
}

impl EditGuard for ClothGuard {
    fn allows(&self, change: &Change) -> bool {
        let known = self.known.borrow();
        let old = known.leaves(&change.old_faces);
        let new = known.crossings(&change.new_faces, &old);
        new == 0 || new <= known.crossings(&change.old_faces, &old)
    }

    fn note(&self, change: &Change) {
        let known = &mut *self.known.borrow_mut();
        for face in &change.old_faces {
            if let Some(leaf) = known.leaves_of.get_mut(&key(face)).and_then(Vec::pop) {
                known.tree.remove(leaf);
            }
        }
        for face in &change.new_faces {
            let leaf = known.faces.len() as u32;
            known.faces.push(*face);
            known.leaves_of.entry(key(face)).or_default().push(leaf);
            known.tree.insert(bounds(face), leaf);
        }
    }
}

impl Known {
    /// A leaf for each of these faces that is known.
    fn leaves(&self, faces: &[[DVec3; 3]]) -> Vec<u32> {
        let mut taken: Vec<u32> = Vec::with_capacity(faces.len());
        for face in faces {
            let mut leaves = self.leaves_of.get(&key(face)).into_iter().flatten();
            taken.extend(leaves.find(|leaf| !taken.contains(leaf)));
        }
        taken
    }

    /// How often these faces cross one another, and others but for the leaves `without`.
    fn crossings(&self, faces: &[[DVec3; 3]], without: &[u32]) -> usize {
        let of = |(k, face): (usize, &[DVec3; 3])| {
            let is_crossed = |leaf: &u32| {
                let other = &self.faces[*leaf as usize];
                cross(face, other) && !without.contains(leaf)
            };
            let others = self.tree.intersect_aabb(&bounds(face)).filter(is_crossed).count();
            others + faces[..k].iter().filter(|other| cross(face, other)).count()
        };
        faces.iter().enumerate().map(of).sum()
    }
}

/// Whether an edge of one face passes through the other; edges do not cross faces that have one of
/// their ends.
fn cross(one: &[DVec3; 3], other: &[DVec3; 3]) -> bool {
    let passes = |edges_of: &[DVec3; 3], face: &[DVec3; 3]| {
        [[0, 1], [1, 2], [2, 0]].into_iter().any(|edge| {
            let line = edge.map(|k| edges_of[k]);
            !line.iter().any(|p| face.contains(p)) && segment_passes_through(line, *face)
        })
    };
    passes(one, other) || passes(other, one)
}

fn key(face: &[DVec3; 3]) -> Key {
    let mut corners = face.map(|p| p.to_array().map(f64::to_bits));
    corners.sort_unstable();
    corners
}
