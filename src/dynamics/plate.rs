//! A face as a bent plate: how far the folds at its edges give way to the moments there.
//!
//! Within a face the moment per length M (N) and the curvature kappa (1/m) are constant, and
//! kappa = D^-1 M. What is stored is the face's compliance P: folds = P moments, one of each an
//! edge. Compliances suit what is missing at the boundary: an edge without a second face carries no
//! moment, so that its row and column are merely left out.

use glam::{DMat3, DVec2};

use crate::math::SymTensor2;
use crate::mesh::{CornerId, FaceId, Mesh, signed_area};
use crate::scene::PlateCompliance;

/// Least height of a face over its longest edge, in shares of that edge. A thinner face counts as
/// one of this height. With its edges' moments scaled to compliances of one, the determinant goes
/// with the sixth power of the height: at 1e-2 it is 1e-12, of which rounding leaves four digits, at
/// 1e-3 none. Faces made by remeshing are about ten times as high.
const HEIGHT_SHARE_MIN: f64 = 1e-2;

/// Determinant of a compliance scaled to a diagonal of ones below which the folds hardly tell some
/// curvature: then six nodes lie almost on a conic. It is 1 at best, 0.4 in a regular mesh.
const WELL_POSED: f64 = 1e-4;

/// Where the compliance of a face comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// The face's share of the fold at an edge turns its normal there by
    /// h / (h + h') of the fold, heights of both faces over the edge; and these turns give its
    /// curvature ([`GGRZ06`](crate::papers::GGRZ06)).
    MidEdge,
    /// The face bends as the quadratic surface through its nodes and those across its edges.
    Quadratic,
}

/// P_ij = A S_i : D^-1 : S_j (1/(N m)): the turn of the face's normal towards that at edge i, if a
/// moment of 1 N m acts on edge j.
pub(super) fn turn_compliance(mesh: &Mesh, face: FaceId, plate: PlateCompliance) -> DMat3 {
    let corners = thickened(mesh.face_material(face));
    let area = signed_area(corners);
    symmetric(moment_shapes(corners, area), plate, area)
}

/// How the folds at a face's edges follow the moments there (1/(N m)), as a shape says; the rows
/// and columns of edges at the boundary are of no meaning.
pub(super) fn fold_compliance(
    mesh: &Mesh,
    face: FaceId,
    plate: PlateCompliance,
    shape: Shape,
) -> DMat3 {
    let sides = face.corners().map(|corner| Side::new(mesh, corner));
    if shape == Shape::Quadratic {
        let folds = sides.map(|side| side.map_or(SymTensor2::ZERO, |s| s.fold_of_curvature()));
        let compliance =
            symmetric(folds, plate, 1.0 / signed_area(thickened(mesh.face_material(face))));
        if is_well_posed(compliance, sides.map(|side| side.is_some())) {
            return compliance;
        }
    }
    let turns = turn_compliance(mesh, face, plate);
    let folds_per_turn = sides.map(|side| side.map_or(1.0, |s| s.folds_per_turn()));
    DMat3::from_cols_array_2d(&std::array::from_fn(|j| {
        std::array::from_fn(|i| turns.col(j)[i] * folds_per_turn[i] * folds_per_turn[j])
    }))
}

/// The inverse of a compliance (N m) over the edges which are there; 0 at the others.
pub(super) fn stiffness(compliance: DMat3, present: [bool; 3]) -> DMat3 {
    let entry = |i: usize, j: usize| match (present[i] && present[j], i == j) {
        (true, _) => compliance.col(j)[i],
        (false, true) => 1.0,
        (false, false) => 0.0,
    };
    let kept =
        DMat3::from_cols_array_2d(&std::array::from_fn(|j| std::array::from_fn(|i| entry(i, j))));
    let inverse = kept.inverse();
    DMat3::from_cols_array_2d(&std::array::from_fn(|j| {
        std::array::from_fn(|i| if present[i] && present[j] { inverse.col(j)[i] } else { 0.0 })
    }))
}

/// A face, its apex moved away from its longest edge to [`HEIGHT_SHARE_MIN`] where it is lower.
fn thickened(mut corners: [DVec2; 3]) -> [DVec2; 3] {
    let edge = |k: usize| corners[(k + 2) % 3] - corners[(k + 1) % 3];
    let longer = |a: usize, b: usize| if edge(b).length() > edge(a).length() { b } else { a };
    let apex = longer(longer(0, 1), 2);
    let along = edge(apex);
    let length = along.length();
    let height = along.perp_dot(corners[apex] - corners[(apex + 1) % 3]) / length;
    let lack = HEIGHT_SHARE_MIN * length - height;
    if lack > 0.0 {
        corners[apex] += along.perp() * (lack / length);
    }
    corners
}

/// S_i = -sym(e_j e_k^T) l_i / (4 A^2): the M which puts a moment of 1 N m on edge i and none on the
/// other two, e the edges and l their lengths.
fn moment_shapes([a, b, c]: [DVec2; 3], area: f64) -> [SymTensor2; 3] {
    let edges = [c - b, a - c, b - a];
    std::array::from_fn(|i| {
        let (along, next) = (edges[(i + 1) % 3], edges[(i + 2) % 3]);
        sym(along, next) * (-edges[i].length() / (4.0 * area * area))
    })
}

/// scale a_i : D^-1 : a_j.
fn symmetric(a: [SymTensor2; 3], plate: PlateCompliance, scale: f64) -> DMat3 {
    DMat3::from_cols_array_2d(&std::array::from_fn(|j| {
        std::array::from_fn(|i| scale * plate.product(a[i], a[j]))
    }))
}

fn is_well_posed(compliance: DMat3, present: [bool; 3]) -> bool {
    let scale = |k: usize| compliance.col(k)[k].sqrt();
    let scaled = DMat3::from_cols_array_2d(&std::array::from_fn(|j| {
        std::array::from_fn(|i| match present[i] && present[j] {
            true => compliance.col(j)[i] / (scale(i) * scale(j)),
            false => f64::from(u8::from(i == j)),
        })
    }));
    scaled.determinant() > WELL_POSED
}

/// 1/2 (a b^T + b a^T).
fn sym(a: DVec2, b: DVec2) -> SymTensor2 {
    SymTensor2 { xx: a.x * b.x, xy: 0.5 * (a.x * b.y + a.y * b.x), yy: a.y * b.y }
}

/// A face's edge and the face across it, laid flat beside it: the edge from the origin, both apexes.
#[derive(Clone, Copy, Debug)]
struct Side {
    edge: DVec2,
    own: DVec2,
    across: DVec2,
}

impl Side {
    /// `None` at the boundary. Across a seam the other panel is turned to where this one's edge is.
    fn new(mesh: &Mesh, corner: CornerId) -> Option<Self> {
        let other = mesh.opposite(corner)?;
        let [(edge, own), (other_edge, arm)] = [corner, other].map(|c| edge_and_apex(mesh, c));
        // The other face runs along the edge the other way.
        let turn = rotation_between(-other_edge, edge);
        Some(Self { edge, own, across: turn.rotate(arm - other_edge) })
    }

    /// Heights of both apexes over the edge (m).
    fn heights(self) -> [f64; 2] {
        let length = self.edge.length();
        [self.edge.perp_dot(self.own) / length, -self.edge.perp_dot(self.across) / length]
    }

    /// (h + h') / h.
    fn folds_per_turn(self) -> f64 {
        let [own, across] = self.heights();
        (own + across) / own
    }

    /// Q (m) with fold = Q : kappa on a surface of height 1/2 u^T kappa u: the sum over both faces
    /// of how high the apex is over the edge's straight line, by the apex's distance from it.
    fn fold_of_curvature(self) -> SymTensor2 {
        let [own, across] = self.heights();
        self.rise(self.own, own) + self.rise(self.across, across)
    }

    fn rise(self, apex: DVec2, height: f64) -> SymTensor2 {
        let foot = apex.dot(self.edge) / self.edge.length_squared();
        (SymTensor2::outer(apex) - SymTensor2::outer(self.edge) * foot) * (0.5 / height)
    }
}

/// The edge opposite to a corner, and the corner as seen from the edge's start (m).
fn edge_and_apex(mesh: &Mesh, corner: CornerId) -> (DVec2, DVec2) {
    let corners = thickened(mesh.face_material(corner.face()));
    let [apex, start, end] =
        [corner, corner.next(), corner.previous()].map(|c| corners[c.position()]);
    (end - start, apex - start)
}

/// The unit complex number that turns one direction to another.
fn rotation_between(from: DVec2, to: DVec2) -> DVec2 {
    DVec2::new(from.dot(to), from.perp_dot(to)).normalize_or(DVec2::X)
}
