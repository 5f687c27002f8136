//! Cloth against cloth, of one garment or of several.
//!
//! Before the step, features of the cloth that come near one another become contacts
//! ([`cloth_contacts`]). After it, whatever would have passed through other cloth is stopped
//! ([`stop`]): first by impacts one by one, then, where these go on and on, by letting what touches
//! move as one ([`zones`]).

mod bounds;
mod contacts;
mod crossings;
mod guard;
mod impact;
mod layers;
mod pairs;
mod stop;
mod tangled;
mod zones;

pub use bounds::WayBounds;
pub use crossings::{Crossing, crossing_pairs, crossings};
pub use guard::ClothGuard;
pub(super) use stop::{ClothSearch, stop_cloth};
pub(super) use zones::Zones;

use glam::DVec3;

use contacts::cloth_contacts;
use layers::Layers;
use pairs::ClothPairs;
use tangled::tangled_nodes;

use super::face_tree::FaceTree;
use super::proximity::Cloth;
use crate::dynamics::ContactPoint;
use crate::mesh::Mesh;
use crate::scene::Contact;

/// Nodes may stray from where they are expected to go by this, in contact thicknesses, before
/// their surroundings are looked up again.
const ROOM_IN_THICKNESSES: f64 = 0.1;

/// Of slow cloth around where it is expected, in contact thicknesses, so that what is near it need not
/// be looked up in every step.
const KEEPING_ROOM_IN_THICKNESSES: f64 = 0.2;

/// All that contact of cloth with cloth keeps: made anew with every topology, and with every frame.
pub struct ClothContact {
    layers: Layers,
    pairs: ClothPairs,
    /// Per node whether it is at a place where cloth passes through cloth; `None` if none is.
    tangled: Option<Vec<bool>>,
}

impl ClothContact {
    /// Of all garments, in the order of the tree's faces.
    pub fn new(garments: &[Mesh], tree: &FaceTree, positions: &[DVec3]) -> Self {
        let topology = tree.topology();
        Self {
            layers: Layers::new(garments, topology, positions.len()),
            pairs: ClothPairs::new(positions, topology),
            tangled: None,
        }
    }

    /// Becomes what a new one of the same garments would be.
    pub fn forget(&mut self, tree: &FaceTree, positions: &[DVec3]) {
        self.pairs = ClothPairs::new(positions, tree.topology());
        self.tangled = None;
    }

    /// Leaves out what holds the cloth where it passes through itself: at a crossing either side may
    /// be the right one, and contact would hold all nodes on the side where they are.
    pub fn let_go_of(&mut self, tree: &FaceTree, crossings: &[Crossing]) {
        self.tangled = tangled_nodes(tree.topology(), &self.layers, crossings);
        // Those left out before may count again.
        self.pairs.keep_no_longer();
    }

    /// Of the tree's edges, in the flat cloth (m).
    pub fn flat_lengths(&self, tree: &FaceTree) -> Vec<f64> {
        self.layers.flat_lengths(tree.topology())
    }

    /// Makes ready to look for contacts at the start of a step (s) and for impacts after it, if
    /// everything goes on about as it goes.
    pub fn expect_motion(
        &mut self,
        cloth: Cloth<'_>,
        tree: &FaceTree,
        settings: &Contact,
        duration: f64,
    ) {
        let way = |node: usize| cloth.velocity[node] * duration;
        let reach = (0.5 + ROOM_IN_THICKNESSES) * settings.thickness;
        let room = KEEPING_ROOM_IN_THICKNESSES * settings.thickness;
        self.pairs.find_or_keep(tree.topology(), cloth.position, way, reach, room);
        self.leave_out_tangled(tree);
    }

    /// Pairs that are nearer than they should be, or would be within the step (s) that has been made
    /// ready for.
    pub fn contacts(
        &self,
        cloth: Cloth<'_>,
        tree: &FaceTree,
        settings: &Contact,
        duration: f64,
    ) -> Vec<ContactPoint> {
        let (topology, pairs) = (tree.topology(), self.pairs.found());
        cloth_contacts(cloth, topology, &self.layers, pairs, settings, duration)
    }

    /// Makes ready to look for impacts on ways from `start`, whatever they are.
    pub fn expect_rest(&mut self, tree: &FaceTree, start: &[DVec3], settings: &Contact) {
        let reach = ROOM_IN_THICKNESSES * settings.thickness;
        self.pairs.find(tree.topology(), start, |_| DVec3::ZERO, reach);
        self.leave_out_tangled(tree);
    }

    pub(super) fn search<'a>(
        &'a mut self,
        tree: &'a FaceTree,
        settings: &'a Contact,
    ) -> ClothSearch<'a> {
        let Self { layers, pairs, tangled } = self;
        let tangled = tangled.as_deref();
        ClothSearch { topology: tree.topology(), pairs, layers, tangled, settings }
    }

    fn leave_out_tangled(&mut self, tree: &FaceTree) {
        if let Some(tangled) = &self.tangled {
            self.pairs.leave_out(tree.topology(), tangled);
        }
    }
}

#[cfg(test)]
mod tests;
