//! The lines along which cloth passes through cloth.
//!
//! Two faces that cross share a piece of line, from one crossing of an edge and a face to another.
//! Crossings that share pieces form a contour. It is closed, or it ends: where an edge at a boundary
//! passes through, or in a fold, where both faces have a node in common.

use std::collections::BTreeMap;

use glam::DVec3;

use super::point::CrossingPoint;
use crate::collision::cloth::Crossing;
use crate::collision::face_tree::FaceTree;
use crate::collision::topology::Topology;

/// Which of the two layers that cross along a contour an edge belongs to. The names mean nothing
/// beyond one contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    One,
    Other,
}

impl Layer {
    fn opposite(self) -> Self {
        match self {
            Layer::One => Layer::Other,
            Layer::Other => Layer::One,
        }
    }

    /// 1 or -1: motions of the first layer against the other count as they are.
    pub fn sign(self) -> f64 {
        match self {
            Layer::One => 1.0,
            Layer::Other => -1.0,
        }
    }
}

/// Whether a contour has ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    Closed,
    Open,
}

/// A line of intersection.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// Indices of the crossing points in the order of the line, and the layer of each one's edge.
    pub points: Vec<(usize, Layer)>,
    pub ends: Ends,
    /// (m, world).
    pub length: f64,
}

/// Two faces that cross, smaller number first.
type FacePair = [u32; 2];

/// All contours; each point is on one. In the order of their first points.
pub fn contours(
    topology: &Topology,
    positions: &[DVec3],
    points: &[CrossingPoint],
) -> Vec<Contour> {
    let pieces = Pieces::new(topology, positions, points);
    let mut is_walked = vec![false; points.len()];
    let mut found = Vec::new();
    // From ends first: what is left then is closed.
    let starts = (0..points.len()).filter(|&p| pieces.neighbours(p).count() < 2);
    for (start, ends) in
        starts.map(|p| (p, Ends::Open)).chain((0..points.len()).map(|p| (p, Ends::Closed)))
    {
        if !is_walked[start] {
            found.push(pieces.walk(start, ends, &mut is_walked));
        }
    }
    found.sort_by_key(|c| c.points.iter().map(|p| p.0).min());
    found
}

/// How many contours crossings form.
pub fn contour_count(tree: &FaceTree, positions: &[DVec3], found: &[Crossing]) -> usize {
    let point = |c: &Crossing| CrossingPoint::of(tree.topology(), positions, *c);
    let points: Vec<CrossingPoint> = found.iter().filter_map(point).collect();
    contours(tree.topology(), positions, &points).len()
}

struct Pieces<'a> {
    positions: &'a [DVec3],
    topology: &'a Topology,
    points: &'a [CrossingPoint],
    /// The first two points of each pair of faces: more are what rounding makes of a touch.
    ends: BTreeMap<FacePair, (usize, Option<usize>)>,
}

impl<'a> Pieces<'a> {
    fn new(topology: &'a Topology, positions: &'a [DVec3], points: &'a [CrossingPoint]) -> Self {
        let mut ends: BTreeMap<FacePair, (usize, Option<usize>)> = BTreeMap::new();
        for (index, point) in points.iter().enumerate() {
            for pair in pairs(topology, point) {
                ends.entry(pair)
                    .and_modify(|e| _ = e.1.get_or_insert(index))
                    .or_insert((index, None));
            }
        }
        Self { positions, topology, points, ends }
    }

    /// The points at the other ends of the pieces at a point.
    fn neighbours(&self, point: usize) -> impl Iterator<Item = (usize, FacePair)> {
        pairs(self.topology, &self.points[point]).filter_map(move |pair| {
            let &(first, second) = self.ends.get(&pair)?;
            let second = second?;
            if point == first {
                Some((second, pair))
            } else {
                (point == second).then_some((first, pair))
            }
        })
    }

    fn walk(&self, start: usize, ends: Ends, is_walked: &mut [bool]) -> Contour {
        let mut points = vec![(start, Layer::One)];
        let mut length = self.length_in_folds(start);
        is_walked[start] = true;
        let (mut at, mut layer) = (start, Layer::One);
        while let Some((next, _)) = self.neighbours(at).find(|(n, _)| !is_walked[*n]) {
            length += self.points[at].point.distance(self.points[next].point);
            length += self.length_in_folds(next);
            layer = self.layer_of_next(at, next, layer);
            is_walked[next] = true;
            points.push((next, layer));
            at = next;
        }
        if ends == Ends::Closed && points.len() > 1 {
            length += self.points[at].point.distance(self.points[start].point);
        }
        Contour { points, ends, length }
    }

    /// Edges of one face through the same other are of one layer.
    fn layer_of_next(&self, at: usize, next: usize, layer: Layer) -> Layer {
        let is_same = self.points[at].crossing.face == self.points[next].crossing.face;
        if is_same { layer } else { layer.opposite() }
    }

    /// Of the pieces at a point that end in a node which both faces have (m).
    fn length_in_folds(&self, point: usize) -> f64 {
        let of = |pair: FacePair| {
            let &(_, second) = self.ends.get(&pair)?;
            let [one, other] = pair.map(|f| self.topology.triangles()[f as usize]);
            let common = one.iter().find(|n| other.contains(n)).filter(|_| second.is_none())?;
            Some(self.positions[*common as usize].distance(self.points[point].point))
        };
        pairs(self.topology, &self.points[point]).filter_map(of).sum()
    }
}

/// The pairs of faces whose line a point lies on.
fn pairs(topology: &Topology, point: &CrossingPoint) -> impl Iterator<Item = FacePair> + use<> {
    let (edge, face) = (topology.edges()[point.crossing.edge as usize], point.crossing.face);
    [Some(edge.first), edge.second].into_iter().flatten().map(move |side| {
        let other = side.triangle;
        [face.min(other), face.max(other)]
    })
}
