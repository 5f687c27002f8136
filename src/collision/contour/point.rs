//! One edge through one face: where, and which way the contour there grows shorter.

use glam::DVec3;

use crate::collision::cloth::Crossing;
use crate::collision::topology::Topology;

/// Faces whose planes meet at a smaller sine have no line of intersection to speak of.
const PLANES_SINE_MIN: f64 = 1e-6;

/// An edge that leans over a face more than this (cosine to the face's normal) is taken to lean this
/// much: its point of intersection runs away from it, and the pull along the normal grows past all
/// bounds.
const UPRIGHT_MIN: f64 = 0.05;

/// An edge that passes through a face, and where.
#[derive(Clone, Copy, Debug)]
pub struct CrossingPoint {
    pub crossing: Crossing,
    /// Ends of the edge, then corners of the face.
    pub nodes: [usize; 5],
    /// Of the edge's point minus the face's: they add up to 0.
    pub weights: [f64; 5],
    /// (m, world).
    pub point: DVec3,
    /// Unit, along the edge.
    along: DVec3,
    /// Unit, of the face.
    normal: DVec3,
}

/// How the length of the contour around a point falls (m per m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pull {
    /// With the motion of the edge's point.
    pub on_edge: DVec3,
    /// With the motion of the face's point.
    pub on_face: DVec3,
}

impl CrossingPoint {
    /// `None` where face or edge have no extent, or lie in one plane.
    pub fn of(topology: &Topology, positions: &[DVec3], crossing: Crossing) -> Option<Self> {
        let ends = topology.edges()[crossing.edge as usize].corners.map(|n| n as usize);
        let corners = topology.triangles()[crossing.face as usize].map(|n| n as usize);
        let [start, end] = ends.map(|n| positions[n]);
        let [a, b, c] = corners.map(|n| positions[n]);
        let across = (b - a).cross(c - a);
        let normal = across.try_normalize()?;
        let along = (end - start).try_normalize()?;
        let [low, high] = [start, end].map(|p| normal.dot(p - a));
        if low == high {
            return None;
        }
        let share = (low / (low - high)).clamp(0.0, 1.0);
        let point = start.lerp(end, share);
        let part = |from: DVec3, to: DVec3| {
            (from - point).cross(to - point).dot(across) / across.length_squared()
        };
        let weights = [1.0 - share, share, -part(b, c), -part(c, a), -part(a, b)];
        let nodes = [ends[0], ends[1], corners[0], corners[1], corners[2]];
        weights.iter().all(|w| w.is_finite()).then_some(Self {
            crossing,
            nodes,
            weights,
            point,
            along,
            normal,
        })
    }

    /// Of a motion of the edge's point against the face's, each node's share, by weights and inverse
    /// masses (kg): (w_i / m_i) / sum_k (w_k^2 / m_k). Nothing moves if no node can.
    pub fn shares(&self, mass: &[f64]) -> [f64; 5] {
        let mobility =
            [0, 1, 2, 3, 4].map(|k| self.weights[k] / mass[self.nodes[k]].max(f64::MIN_POSITIVE));
        let whole: f64 = (0..5).map(|k| self.weights[k] * mobility[k]).sum();
        if whole > 0.0 && whole.is_finite() { mobility.map(|m| m / whole) } else { [0.0; 5] }
    }

    /// The gradient of the contour's length, its sign turned: with R the unit directions from the point
    /// into each face at the edge, within the plane of the crossed face; E along the edge and N the
    /// normal of the crossed face,
    /// ```text
    /// on edge  sum R - (E.R)/(E.N) N        on face  sum (E.R)/(E.N) N
    /// ```
    /// Each node has its barycentric share of it: exact, but for what the limit on E.N keeps small.
    pub fn pull(&self, topology: &Topology, positions: &[DVec3]) -> Pull {
        let edge = &topology.edges()[self.crossing.edge as usize];
        let mut pull = Pull::default();
        for side in [Some(edge.first), edge.second].into_iter().flatten() {
            let into = positions[side.opposite as usize] - self.point;
            let Some(line) = self.line_into(into) else { continue };
            let upright = self.along.dot(self.normal);
            let upright = upright.abs().max(UPRIGHT_MIN).copysign(upright);
            let along_normal = self.normal * (self.along.dot(line) / upright);
            pull.on_edge += line - along_normal;
            pull.on_face += along_normal;
        }
        pull
    }

    /// Which way the edge goes against the face for the contour to grow shorter when both move by
    /// half, [`VMT06`](crate::papers::VMT06):
    /// ```text
    /// G = sum R - 2 (E.R)/(E.N) N
    /// ```
    pub fn way_out(&self, topology: &Topology, positions: &[DVec3]) -> DVec3 {
        let pull = self.pull(topology, positions);
        pull.on_edge - pull.on_face
    }

    /// Along the face's normal, unit: which way the edge goes against the face so that its nearer end
    /// comes back, and how deep that is (m).
    pub fn way_to_nearer_side(&self, positions: &[DVec3]) -> (DVec3, f64) {
        let [start, end] = [0, 1].map(|k| self.normal.dot(positions[self.nodes[k]] - self.point));
        let depth = if start.abs() < end.abs() { start } else { end };
        (self.normal * -depth.signum(), depth.abs())
    }

    /// Unit, of the face, on the side of the edge's second end.
    pub fn normal_towards_end(&self) -> DVec3 {
        if self.along.dot(self.normal) < 0.0 { -self.normal } else { self.normal }
    }

    /// Unit, along the line of both planes, from the edge into the face at it that leads `into` (m).
    fn line_into(&self, into: DVec3) -> Option<DVec3> {
        let inward = (into - self.along * into.dot(self.along)).try_normalize()?;
        let line = self.normal.cross(self.along.cross(inward));
        let line = (line.length() > PLANES_SINE_MIN).then(|| line.normalize())?;
        Some(if line.dot(inward) < 0.0 { -line } else { line })
    }
}
