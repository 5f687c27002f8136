//! Folds of all edges at once: bending of elastic sheets whose stiffness does not follow the mesh.
//!
//! A sheet's bending energy is a quadratic form of its folds, W = 1/2 folds . K folds, and the
//! moment at an edge is the sum of K folds over edges around it. K comes from the flat sheet alone,
//! once per topology. What is not constant, how folds follow the nodes, is that of
//! [`bending`](super::bending)'s hinges, so that seams and rest angles are nothing special here.
//!
//! The step's matrix takes K for diagonal: as many blocks as hinges need, and always
//! semi-definite. The forces are exact. A linearised step is stable if its tangent is at least half
//! of the true one; [`FoldLaw::tangent`] is.

use glam::DMat3;

use super::factor::Factor;
use super::plate::{self, Shape};
use crate::mesh::{CornerId, FaceId, IdVec, Mesh};
use crate::scene::{BendingModel, PlateCompliance};

/// The moments of a garment's hinges, by their folds.
#[derive(Debug)]
pub(super) struct FoldLaw {
    kind: Kind,
    tangent: Vec<f64>,
    is_fallback: bool,
}

#[derive(Debug)]
enum Kind {
    /// K is a sum over faces.
    Faces(Vec<FaceStiffness>),
    /// K^-1 is a sum over faces.
    Moments(Box<Factor>),
}

/// What a face adds to K (N m), for those of its edges that are hinges.
#[derive(Clone, Copy, Debug)]
struct FaceStiffness {
    hinges: [Option<u32>; 3],
    stiffness: DMat3,
}

/// A linearised step is stable down to a tangent of half the true one.
const SAFE_SHARE: f64 = 0.5;

impl FoldLaw {
    /// Of a mesh's interior edges, numbered as they come. `None` where each hinge stands for itself.
    /// Where moments cannot be had, mid-edge normals stand in for them; see
    /// [`is_fallback`](Self::is_fallback).
    pub fn new(mesh: &Mesh, plate: PlateCompliance, model: BendingModel) -> Option<Self> {
        let numbers = hinge_numbers(mesh);
        let mid_edge = faces(mesh, plate, Shape::MidEdge, &numbers);
        let count = mesh.edges().filter(|&c| !mesh.is_boundary(c)).count();
        let law = |kind, majorant: &[FaceStiffness], share| Self {
            kind,
            tangent: diagonal(majorant, count, share),
            is_fallback: false,
        };
        Some(match model {
            BendingModel::Hinges => return None,
            BendingModel::MidEdge => law(Kind::Faces(mid_edge.clone()), &mid_edge, 1.0),
            BendingModel::Quadratic => {
                let faces = faces(mesh, plate, Shape::Quadratic, &numbers);
                law(Kind::Faces(faces.clone()), &faces, 1.0)
            }
            BendingModel::Moments => match moments(mesh, plate, &numbers, count) {
                Some(kind) => law(kind, &mid_edge, SAFE_SHARE),
                None => {
                    Self { is_fallback: true, ..law(Kind::Faces(mid_edge.clone()), &mid_edge, 1.0) }
                }
            },
        })
    }

    /// Whether this is the law of mid-edge normals because the compliance of moments has no factor.
    pub fn is_fallback(&self) -> bool {
        self.is_fallback
    }

    /// What the step's matrix has for K, per hinge (N m): a diagonal that is nowhere softer, made of
    /// the sums over the rows' magnitudes in K; or, for moments, the safe share of these sums in the
    /// stiffness of mid-edge normals, which is nowhere softer than theirs.
    pub fn tangent(&self) -> &[f64] {
        &self.tangent
    }

    /// Replaces folds (rad) by moments (N m).
    pub fn moments(&self, folds: &mut Vec<f64>) {
        match &self.kind {
            Kind::Faces(faces) => *folds = product(faces, folds),
            Kind::Moments(compliance) => compliance.solve(folds),
        }
    }

    /// W (J).
    pub fn energy(&self, folds: &[f64]) -> f64 {
        let mut moments = folds.to_vec();
        self.moments(&mut moments);
        0.5 * moments.iter().zip(folds).map(|(moment, fold)| moment * fold).sum::<f64>()
    }
}

/// Per corner the number of the hinge at the edge opposite to it; `None` at the boundary.
fn hinge_numbers(mesh: &Mesh) -> IdVec<CornerId, Option<u32>> {
    let mut numbers = IdVec::filled(None, 3 * mesh.face_count());
    let interior = mesh.edges().filter_map(|corner| Some([corner, mesh.opposite(corner)?]));
    for (number, [corner, other]) in interior.enumerate() {
        numbers[corner] = Some(number as u32);
        numbers[other] = Some(number as u32);
    }
    numbers
}

fn faces(
    mesh: &Mesh,
    plate: PlateCompliance,
    shape: Shape,
    numbers: &IdVec<CornerId, Option<u32>>,
) -> Vec<FaceStiffness> {
    let stiffness = |face: FaceId| {
        let hinges = face.corners().map(|corner| numbers[corner]);
        let compliance = plate::fold_compliance(mesh, face, plate, shape);
        let stiffness = plate::stiffness(compliance, hinges.map(|hinge| hinge.is_some()));
        FaceStiffness { hinges, stiffness }
    };
    mesh.face_ids().map(stiffness).collect()
}

/// The method of Hellan, Herrmann and Johnson ([`NS19`](crate::papers::NS19)): moments constant in
/// each face, and the moment across an edge the same on both sides; the normal at the edge stands
/// where this asks it to stand. Exact for constant moments on any mesh, where
/// [`Shape::MidEdge`] is too stiff and [`Shape::Quadratic`] too soft. `None` if the compliance of
/// all edges has no factor: the sheet is almost free to bend in some way, or too large for the
/// memory.
fn moments(
    mesh: &Mesh,
    plate: PlateCompliance,
    numbers: &IdVec<CornerId, Option<u32>>,
    count: usize,
) -> Option<Kind> {
    let mut entries = Vec::with_capacity(9 * mesh.face_count());
    for face in mesh.face_ids() {
        let compliance = plate::turn_compliance(mesh, face, plate);
        let hinges = face.corners().map(|corner| numbers[corner]);
        for (i, row) in hinges.into_iter().enumerate() {
            for (j, column) in hinges.into_iter().enumerate() {
                let Some((row, column)) = row.zip(column) else { continue };
                entries.push((row, column, compliance.col(j)[i]));
            }
        }
    }
    Some(Kind::Moments(Box::new(Factor::new(count, entries)?)))
}

/// K folds.
fn product(faces: &[FaceStiffness], folds: &[f64]) -> Vec<f64> {
    let mut moments = vec![0.0; folds.len()];
    for face in faces {
        for (i, row) in face.hinges.iter().enumerate() {
            for (j, column) in face.hinges.iter().enumerate() {
                let (Some(row), Some(column)) = (row, column) else { continue };
                moments[*row as usize] += face.stiffness.col(j)[i] * folds[*column as usize];
            }
        }
    }
    moments
}

fn diagonal(faces: &[FaceStiffness], count: usize, share: f64) -> Vec<f64> {
    let mut diagonal = vec![0.0; count];
    for face in faces {
        for (i, row) in face.hinges.iter().enumerate() {
            let Some(row) = row else { continue };
            diagonal[*row as usize] += share * face.stiffness.row(i).abs().element_sum();
        }
    }
    diagonal
}
