//! Sheets that pass through one another, to be taken apart.
//!
//! Nothing is known exactly but the aim: no crossings. How near methods come to it, and in how many
//! rounds, is a matter of measurement.

use glam::{DVec2, DVec3};

use super::sheet::{Layout, Sheet};
use crate::collision::{
    ClothContact, FaceTree, Limits, Method, Round, TangledCloth, Untangling, crossings, untangle,
};
use crate::math::Random;
use crate::mesh::{Id, Mesh};

/// Meshes of two sheets should have nothing in common.
const CELLS: [f64; 3] = [1.0 / 16.0, 1.0 / 20.0, 1.0 / 18.0];

/// Of cotton (kg/m^2).
const DENSITY: f64 = 0.2;

/// Half a contact thickness of 5 mm a round, for as long as it takes, up to 300 rounds.
pub const LIMITS: Limits = Limits { step: 2.5e-3, way: 0.5, rounds: 300, patience: 300 };

/// Sheets of 1 m that pass through one another.
pub struct Tangle {
    pub name: &'static str,
    pub sheets: Vec<Mesh>,
}

/// What became of a tangle.
pub struct Outcome {
    pub untangling: Untangling,
    /// Where nodes were, and are (m).
    pub ways: [Vec<DVec3>; 2],
}

impl Outcome {
    pub fn rounds(&self) -> &[Round] {
        &self.untangling.rounds
    }

    /// The longest way of a node (m).
    pub fn longest_way(&self) -> f64 {
        let [start, end] = &self.ways;
        start.iter().zip(end).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    }
}

impl Tangle {
    /// What a method makes of it.
    pub fn taken_apart(&self, method: Method, limits: Limits) -> Outcome {
        let start: Vec<DVec3> =
            self.sheets.iter().flat_map(|m| m.position.as_slice().to_vec()).collect();
        let mut position = start.clone();
        let mut tree = self.tree(&position);
        let own = ClothContact::new(&self.sheets, &tree, &position);
        let flat_lengths = own.flat_lengths(&tree);
        let areas = self.sheets.iter().flat_map(|m| m.node_areas().into_vec());
        let mass: Vec<f64> = areas.map(|area| area * DENSITY).collect();
        let found = crossings(&tree, &position);
        let mut cloth = TangledCloth {
            position: &mut position,
            tree: &mut tree,
            mass: &mass,
            flat_lengths: &flat_lengths,
        };
        let untangling = untangle(&mut cloth, found, method, limits);
        Outcome { untangling, ways: [start, position] }
    }

    /// Over the faces of all sheets, where their nodes are.
    pub fn tree(&self, position: &[DVec3]) -> FaceTree {
        let mut faces = Vec::new();
        let mut first = 0;
        for mesh in &self.sheets {
            let global = |f| mesh.face_nodes(f).map(|n| (first + n.index()) as u32);
            faces.extend(mesh.face_ids().map(global));
            first += mesh.node_count();
        }
        FaceTree::new(position, &faces)
    }
}

/// From the mildest to the wildest.
pub fn tangles() -> Vec<Tangle> {
    let flat = |u: DVec2| u.extend(0.0);
    vec![
        tangle("corner", &[&flat, &corner(0.08)]),
        tangle("bump", &[&flat, &bump(0.05)]),
        tangle("high bump", &[&flat, &bump(0.12)]),
        tangle("boundary to boundary", &[&flat, &dipping]),
        tangle("three sheets", &[&flat, &bump(0.06), &bump(-0.08)]),
        tangle("random waves", &[&flat, &waves(1, 0.01)]),
        tangle("three random sheets", &[&waves(2, 0.01), &waves(3, 0.01), &waves(4, 0.01)]),
    ]
}

fn tangle(name: &'static str, places: &[&dyn Fn(DVec2) -> DVec3]) -> Tangle {
    let sheet = |(cell, place): (f64, &&dyn Fn(DVec2) -> DVec3)| {
        let layout = Layout::Irregular;
        let sheet =
            Sheet { origin: DVec2::ZERO, size: DVec2::ONE, cell, layout, columns: Vec::new() };
        sheet.mesh(place)
    };
    Tangle { name, sheets: CELLS.into_iter().zip(places).map(sheet).collect() }
}

/// A corner bent down through what is below, by a depth (m).
fn corner(depth: f64) -> impl Fn(DVec2) -> DVec3 {
    move |u| {
        let beyond = (0.35 - u.x - u.y).max(0.0) / 0.35;
        u.extend(0.01 - depth * beyond)
    }
}

/// A sheet below what is above, with a bump through it (m); with a negative height the other way round.
fn bump(height: f64) -> impl Fn(DVec2) -> DVec3 {
    move |u| {
        let r = u.distance(DVec2::splat(0.5)) / 0.25;
        u.extend(height * (-r * r).exp() - 0.01 * height.signum())
    }
}

/// A narrower sheet that dips through another along its whole width.
fn dipping(u: DVec2) -> DVec3 {
    DVec3::new(u.x + 0.3, 0.2 + 0.6 * u.y, 0.3 * (0.3 - u.x))
}

/// Waves in random directions (m).
fn waves(seed: u64, amplitude: f64) -> impl Fn(DVec2) -> DVec3 {
    let mut random = Random::new(seed);
    let waves: Vec<(f64, DVec3)> = (0..12).map(|k| (f64::from(k), random.vector())).collect();
    move |u| {
        let wave = |(phase, w): &(f64, DVec3)| (9.0 * w.truncate().dot(u) + phase).sin() * w.z;
        u.extend(amplitude * waves.iter().map(wave).sum::<f64>())
    }
}
