use glam::{DVec2, DVec3};

use super::*;
use crate::collision::cloth::crossings;
use crate::collision::continuous::{Features, Sweep};
use crate::math::Random;

const CELLS: u32 = 6;
const RADIUS: f64 = 0.08;

/// Two sheets of 1 m over one another, nodes moved at random by up to a way (m).
struct Sheets {
    position: Vec<DVec3>,
    tree: FaceTree,
}

impl Sheets {
    fn new(random: &mut Random, apart: f64, jitter: f64) -> Self {
        let node = |layer: u32, i: u32, j: u32| (layer * (CELLS + 1) + i) * (CELLS + 1) + j;
        let (mut position, mut faces) = (Vec::new(), Vec::new());
        for layer in 0..2 {
            for (i, j) in (0..=CELLS).flat_map(|i| (0..=CELLS).map(move |j| (i, j))) {
                let flat = DVec2::new(f64::from(i), f64::from(j)) / f64::from(CELLS);
                let place = flat.extend(f64::from(layer) * apart);
                position.push(place + random.vector() * jitter);
                if i < CELLS && j < CELLS {
                    let [a, b] = [node(layer, i, j), node(layer, i + 1, j)];
                    let [d, c] = [node(layer, i, j + 1), node(layer, i + 1, j + 1)];
                    faces.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        let tree = FaceTree::new(&position, &faces);
        Self { position, tree }
    }

    fn bounds(&self) -> WayBounds {
        let mut bounds = WayBounds::new(&self.tree, &self.position);
        bounds.find(&self.tree, &self.position, RADIUS);
        bounds
    }

    /// Every node with every face, and every edge with every other, that have no node in common.
    fn all_pairs(&self) -> Vec<(Features, [usize; 4])> {
        let topology = self.tree.topology();
        let of_face = |face: &[u32; 3]| face.map(|n| n as usize);
        let faces: Vec<[usize; 3]> = topology.triangles().iter().map(of_face).collect();
        let edges: Vec<[usize; 2]> =
            topology.edges().iter().map(|e| e.corners.map(|n| n as usize)).collect();
        let with_node = |&[a, b, c]: &[usize; 3]| {
            let others = (0..self.position.len()).filter(move |n| ![a, b, c].contains(n));
            others.map(move |n| (Features::VertexFace, [n, a, b, c])).collect::<Vec<_>>()
        };
        let mut all: Vec<_> = faces.iter().flat_map(with_node).collect();
        for (k, &[a, b]) in edges.iter().enumerate() {
            let later = edges[k + 1..].iter().filter(|e| !e.contains(&a) && !e.contains(&b));
            all.extend(later.map(|&[c, d]| (Features::EdgeEdge, [a, b, c, d])));
        }
        all
    }

    fn crossing_count(&mut self, position: &[DVec3]) -> usize {
        self.tree.refit(position);
        crossings(&self.tree, position).len()
    }
}

/// Every node goes its bound times a factor, at random.
fn moved(random: &mut Random, sheets: &Sheets, bounds: &WayBounds, factor: f64) -> Vec<DVec3> {
    let way = |bound: f64, random: &mut Random| random.vector().normalize_or_zero() * bound;
    let nodes = sheets.position.iter().zip(bounds.by_node());
    nodes.map(|(x, &bound)| *x + way(factor * bound, random)).collect()
}

#[test]
fn bounds_are_those_of_all_pairs_looked_at_one_by_one() {
    let mut random = Random::new(1);
    for _ in 0..4 {
        let sheets = Sheets::new(&mut random, 0.06, 0.028);
        let mut expected = vec![SHARE * RADIUS; sheets.position.len()];
        for (features, nodes) in sheets.all_pairs() {
            let distance = nearest(features, nodes.map(|n| sheets.position[n])).distance;
            for node in nodes {
                expected[node] = expected[node].min(SHARE * distance);
            }
        }
        let found = sheets.bounds();
        let near = expected.iter().filter(|b| **b < 0.5 * SHARE * RADIUS).count();
        assert!(near > 0 && near < expected.len(), "{near} of {}", expected.len());
        for (found, expected) in found.by_node().iter().zip(&expected) {
            // Edges are less than half a metre long.
            assert!((*found - expected).abs() <= 0.5 * TOLERANCE_OF_SIZE_MIN, "{found} {expected}");
        }
    }
}

#[test]
fn nothing_touches_on_ways_within_the_bounds_and_something_does_on_longer_ones() {
    let mut random = Random::new(2);
    let mut touches_beyond = 0;
    for _ in 0..6 {
        let mut sheets = Sheets::new(&mut random, 0.06, 0.028);
        let start = sheets.position.clone();
        assert_eq!(sheets.crossing_count(&start), 0);
        let bounds = sheets.bounds();
        let pairs = sheets.all_pairs();
        let touches = |end: &[DVec3]| {
            let is_touch = |&&(features, nodes): &&(Features, [usize; 4])| {
                let sweep = Sweep { start: nodes.map(|n| start[n]), end: nodes.map(|n| end[n]) };
                sweep.first_touch(features, 0.0).is_some()
            };
            pairs.iter().filter(is_touch).count()
        };
        for _ in 0..4 {
            let within = moved(&mut random, &sheets, &bounds, 1.0);
            assert_eq!(touches(&within), 0);
            assert_eq!(sheets.crossing_count(&within), 0);
            touches_beyond += touches(&moved(&mut random, &sheets, &bounds, 4.0));
        }
    }
    assert!(touches_beyond > 0);
}

#[test]
fn a_sheet_sent_through_another_never_gets_there_however_often_it_is_asked() {
    let mut random = Random::new(3);
    let mut sheets = Sheets::new(&mut random, 0.06, 0.02);
    let (mut position, half) = (sheets.position.clone(), sheets.position.len() / 2);
    let lower = |(n, x): (usize, &DVec3)| *x - DVec3::Z * if n < half { 0.0 } else { 0.2 };
    let ends: Vec<DVec3> = position.iter().enumerate().map(lower).collect();
    let mut bounds = WayBounds::new(&sheets.tree, &position);
    for _ in 0..30 {
        bounds.find(&sheets.tree, &position, RADIUS);
        assert!(bounds.advance(&mut position, &ends) > 0);
        assert_eq!(sheets.crossing_count(&position), 0);
    }
}

#[test]
fn what_all_nodes_have_in_common_takes_nothing_and_arrives_at_once() {
    let mut random = Random::new(4);
    let sheets = Sheets::new(&mut random, 0.06, 0.02);
    let ends: Vec<DVec3> =
        sheets.position.iter().map(|x| *x + DVec3::new(3.0, 0.0, -7.0)).collect();
    let mut position = sheets.position.clone();
    assert_eq!(sheets.bounds().advance(&mut position, &ends), 0);
    assert_eq!(position, ends);
}

#[test]
fn features_that_cross_or_have_no_distance_leave_their_nodes_no_way() {
    let mut random = Random::new(5);
    let mut sheets = Sheets::new(&mut random, 0.06, 0.0);
    let node = sheets.position.len() / 4;
    sheets.position[node].z += 0.06;
    assert_eq!(sheets.bounds().by_node()[node], 0.0);
    sheets.position[node].z = f64::NAN;
    let mut bounds = WayBounds::new(&sheets.tree, &sheets.position);
    bounds.find(&sheets.tree, &sheets.position, RADIUS);
    assert!(bounds.by_node().iter().all(|b| b.is_finite()));
}
