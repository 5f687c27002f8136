//! What a step needs to know of the meshes, laid out for it once per topology.

use std::ops::Range;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::bending::{Hinge, dihedral_angle};
use super::breakaway::Finding;
use super::folds::FoldLaw;
use super::matrix::{BlockMatrix, Pattern};
use super::principal::compensated_strain;
use super::solve::{LinearSolver, Patience, SolverCounts};
use super::step::StepState;
use super::strain_limit::StrainLimit;
use super::stretch::{Membrane, energy_density};
use crate::math::SymTensor2;
use crate::mesh::{CornerId, FaceId, Id, Mesh};
use crate::scene::{Dynamics, Fabric, StretchStiffness};

/// All garments of a scene as one system of nodes, numbered through garment after garment.
///
/// Valid while the meshes keep their topology and material positions. Elements are arrays of small
/// records, for a step reads each record whole.
#[derive(Debug)]
pub struct System {
    pub(super) garments: Vec<GarmentRanges>,
    /// Per node (kg).
    pub(super) masses: Vec<f64>,
    pub(super) membranes: Vec<Membrane>,
    pub(super) membrane_slots: Vec<[u32; 6]>,
    /// Per membrane the root of alpha; empty where no face is compensated.
    pub(super) root_alphas: Vec<f64>,
    pub(super) hinges: Vec<Hinge>,
    pub(super) hinge_slots: Vec<HingeSlots>,
    pub(super) frozen: FrozenStiffness,
    pub(super) matrix: BlockMatrix,
    /// Whether the pattern holds more pairs than the elements need.
    has_extra_pairs: bool,
    pub(super) right_side: Vec<DVec3>,
    /// The last solution (m/s).
    pub(super) change: Vec<DVec3>,
    /// Scratch: the matrix times something.
    pub(super) product: Vec<DVec3>,
    /// Blocks as they were before contacts were added, oldest first.
    pub(super) touched: Vec<(u32, DMat3)>,
    pub(super) settings: Dynamics,
    pub(super) solver: LinearSolver,
    /// Per contact of the step in work; empty while all are taken for what they were.
    pub(super) findings: Vec<Finding>,
}

/// A garment's share of the arrays.
#[derive(Debug)]
pub(super) struct GarmentRanges {
    pub fabric: Fabric,
    pub nodes: Range<usize>,
    pub membranes: Range<usize>,
    pub hinges: Range<usize>,
    /// What resists strain beyond the fabric's limits.
    pub strain_limit: Option<StrainLimit>,
    /// What the hinges' moments are if not each hinge's own.
    pub fold_law: Option<FoldLaw>,
}

/// Where a hinge's blocks go.
#[derive(Clone, Copy, Debug)]
pub(super) struct HingeSlots {
    /// The hinge's node positions by descending node number.
    pub descending: [u8; 4],
    pub slots: [u32; 10],
}

/// Stiffness of every element, as it was when last frozen.
#[derive(Clone, Debug, Default)]
pub(super) struct FrozenStiffness {
    /// Per membrane.
    pub stretch: Vec<StretchStiffness>,
    /// Per hinge, d2W/dtheta2 as the matrix has it (N m).
    pub bending: Vec<f64>,
}

impl System {
    /// A system of one fabric per mesh, its stiffness frozen at the meshes' positions.
    ///
    /// # Panics
    /// If there are not as many fabrics as meshes.
    pub fn new(meshes: &[&Mesh], fabrics: &[&Fabric]) -> Self {
        let mut system = Self::unfrozen(meshes, fabrics);
        system.freeze_stiffness(&StepState::gathered(meshes).position);
        system
    }

    /// A system without any stiffness yet.
    pub(super) fn unfrozen(meshes: &[&Mesh], fabrics: &[&Fabric]) -> Self {
        assert_eq!(meshes.len(), fabrics.len(), "every garment has one mesh and one fabric");
        let empty = Arc::new(Pattern::from_pairs(0, std::iter::empty()));
        let mut system = Self {
            garments: Vec::new(),
            masses: Vec::new(),
            membranes: Vec::new(),
            membrane_slots: Vec::new(),
            root_alphas: Vec::new(),
            hinges: Vec::new(),
            hinge_slots: Vec::new(),
            frozen: FrozenStiffness::default(),
            matrix: BlockMatrix::zero(empty),
            has_extra_pairs: false,
            right_side: Vec::new(),
            change: Vec::new(),
            product: Vec::new(),
            touched: Vec::new(),
            settings: Dynamics::default(),
            solver: LinearSolver::default(),
            findings: Vec::new(),
        };
        for (mesh, fabric) in meshes.iter().zip(fabrics) {
            system.append(mesh, fabric);
        }
        system.right_side = vec![DVec3::ZERO; system.node_count()];
        system.change = system.right_side.clone();
        system.set_pattern(&[]);
        system
    }

    /// Takes steps as these settings ask, from now on.
    pub fn set_dynamics(&mut self, settings: Dynamics) {
        self.settings = settings;
        self.solver.set_choice(settings.solver);
        self.solver.set_patience(match self.is_limited() {
            true => Patience::Short,
            false => Patience::Long,
        });
    }

    /// Lets fabrics be strained beyond their limits.
    pub fn lift_strain_limits(&mut self) {
        self.garments.iter_mut().for_each(|garment| garment.strain_limit = None);
    }

    /// Takes faces for buckled between their nodes as far as 1 - alpha says, from now on; alpha is
    /// in [0, 1], face after face through all garments ([`VD15`](crate::papers::VD15) eq. 11).
    ///
    /// # Panics
    /// If there are not as many as faces.
    pub fn set_compensation(&mut self, alphas: &[f64]) {
        assert_eq!(alphas.len(), self.membranes.len(), "every face has its alpha");
        self.root_alphas.clear();
        if alphas.iter().any(|&alpha| alpha < 1.0) {
            self.root_alphas.extend(alphas.iter().map(|alpha| alpha.max(0.0).sqrt()));
        }
    }

    /// Takes no face for buckled, from now on.
    pub fn lift_compensation(&mut self) {
        self.root_alphas.clear();
    }

    /// Whether any fabric has strain limits.
    pub fn is_limited(&self) -> bool {
        self.garments.iter().any(|garment| garment.strain_limit.is_some())
    }

    /// The root of a face's alpha; `None` where nothing is compensated.
    pub(super) fn root_alpha(&self, membrane: usize) -> Option<f64> {
        self.root_alphas.get(membrane).copied().filter(|&root| root < 1.0)
    }

    /// Goes on with another system's solver: where the pattern is the same, its analysis is kept.
    pub fn set_solver(&mut self, solver: LinearSolver) {
        self.solver = solver;
        self.solver.forget();
    }

    pub fn into_solver(self) -> LinearSolver {
        self.solver
    }

    /// Makes what follows independent of the steps so far. An analysis may stay: it is a function
    /// of its pattern.
    pub fn forget_the_past(&mut self) {
        self.solver.forget();
        if self.has_extra_pairs {
            self.set_pattern(&[]);
        }
    }

    pub fn node_count(&self) -> usize {
        self.masses.len()
    }

    /// Global numbers of a garment's nodes.
    pub fn nodes_of(&self, garment: usize) -> Range<usize> {
        self.garments[garment].nodes.clone()
    }

    /// Garments which were to bend by moments in balance, but bend by mid-edge normals, because the
    /// compliance of their moments cannot be factorised.
    pub fn bending_fallbacks(&self) -> impl Iterator<Item = usize> {
        let fell_back = |law: &FoldLaw| law.is_fallback();
        let garments = self.garments.iter().enumerate();
        garments.filter_map(move |(k, g)| g.fold_law.as_ref().is_some_and(fell_back).then_some(k))
    }

    /// Per node: density times a third of the material area of the faces around it (kg).
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// What solving has taken so far.
    pub fn solver_counts(&self) -> SolverCounts {
        self.solver.counts()
    }

    /// Sets every element's stiffness to what the fabrics say of a deformation.
    pub fn freeze_stiffness(&mut self, positions: &[DVec3]) {
        let FrozenStiffness { stretch, bending } = &mut self.frozen;
        stretch.clear();
        bending.clear();
        for garment in &self.garments {
            let fabric = &garment.fabric;
            stretch.extend(
                self.membranes[garment.membranes.clone()]
                    .iter()
                    .map(|face| fabric.stretch_stiffness(face.gradient_of(positions))),
            );
            if let Some(law) = &garment.fold_law {
                bending.extend_from_slice(law.tangent());
                continue;
            }
            bending.extend(self.hinges[garment.hinges.clone()].iter().map(|hinge| {
                // A hinge without an angle has no force either, whatever its stiffness.
                let angle = dihedral_angle(hinge.corners(positions)).unwrap_or(0.0);
                let law = |edge, curve| fabric.hinge_stiffness(edge, curve);
                hinge.moment_per_fold(hinge.stiffness(angle, law))
            }));
        }
    }

    /// Stretch and bending at the stiffness last frozen (J).
    pub fn potential_energy(&self, state: &StepState) -> f64 {
        let positions = &state.position;
        let of_garment = |garment: &GarmentRanges| {
            let of_face = |index: usize| {
                let face = &self.membranes[index];
                face.area * self.elastic_density(garment, index, face.strain(positions))
            };
            let stretch: f64 = garment.membranes.clone().map(of_face).sum();
            stretch + self.elastic_bending(garment, positions)
        };
        self.garments.iter().map(of_garment).sum()
    }

    /// psi of a face at a strain, with compensation and limits (J/m^2).
    pub(super) fn elastic_density(
        &self,
        garment: &GarmentRanges,
        membrane: usize,
        strain: SymTensor2,
    ) -> f64 {
        let k = self.frozen.stretch[membrane];
        let compensated = match self.root_alpha(membrane) {
            Some(root) => compensated_strain(strain, root),
            None => strain,
        };
        let limit = garment.strain_limit.map_or(0.0, |limit| limit.energy_density(strain));
        energy_density(k, compensated) + limit
    }

    /// (J).
    pub(super) fn elastic_bending(&self, garment: &GarmentRanges, positions: &[DVec3]) -> f64 {
        let folds = self.folds(garment, positions);
        match &garment.fold_law {
            Some(law) => law.energy(&folds),
            None => {
                let stiffness = &self.frozen.bending[garment.hinges.clone()];
                stiffness.iter().zip(&folds).map(|(k, fold)| 0.5 * k * fold * fold).sum()
            }
        }
    }

    /// theta - theta_0 of a garment's hinges (rad); zero of those without an angle.
    pub(super) fn folds(&self, garment: &GarmentRanges, positions: &[DVec3]) -> Vec<f64> {
        let hinges = self.hinges[garment.hinges.clone()].iter();
        hinges.map(|hinge| hinge.fold_at(positions)).collect()
    }

    /// 1/2 sum m v^2 (J).
    pub fn kinetic_energy(&self, state: &StepState) -> f64 {
        let moving = self.masses.iter().zip(&state.velocity);
        moving.map(|(mass, v)| 0.5 * mass * v.length_squared()).sum()
    }

    /// Gives the matrix blocks for all elements and for `extra` pairs of nodes.
    pub(super) fn set_pattern(&mut self, extra: &[[u32; 2]]) {
        let faces = self.membranes.iter().flat_map(|f| {
            let [a, b, c] = f.nodes;
            [[a, b], [b, c], [a, c]]
        });
        // A hinge's other pairs are edges of its two faces.
        let across = self.hinges.iter().map(|h| [h.nodes[2], h.nodes[3]]);
        let pairs = faces.chain(across).chain(extra.iter().copied());
        let pattern = Arc::new(Pattern::from_pairs(self.node_count(), pairs));
        self.membrane_slots =
            self.membranes.iter().map(|face| pattern.clique_slots(face.nodes)).collect();
        self.hinge_slots =
            self.hinges.iter().map(|hinge| HingeSlots::new(hinge, &pattern)).collect();
        self.matrix = BlockMatrix::zero(pattern);
        self.has_extra_pairs = !extra.is_empty();
    }

    fn append(&mut self, mesh: &Mesh, fabric: &Fabric) {
        let offset = self.node_count();
        let (first_membrane, first_hinge) = (self.membranes.len(), self.hinges.len());
        let density = fabric.density();
        self.masses.extend(mesh.node_areas().iter().map(|area| density * area));
        self.membranes.extend(mesh.face_ids().map(|face| membrane(mesh, face, offset)));
        self.hinges.extend(mesh.edges().filter_map(|corner| hinge(mesh, corner, offset)));
        self.garments.push(GarmentRanges {
            fabric: fabric.clone(),
            nodes: offset..self.node_count(),
            membranes: first_membrane..self.membranes.len(),
            hinges: first_hinge..self.hinges.len(),
            strain_limit: fabric.strain_limits().map(StrainLimit::of_stretch),
            fold_law: fabric.plate().and_then(|(plate, model)| FoldLaw::new(mesh, plate, model)),
        });
    }
}

impl HingeSlots {
    fn new(hinge: &Hinge, pattern: &Pattern) -> Self {
        let mut descending = [0u8, 1, 2, 3];
        descending.sort_unstable_by_key(|&k| std::cmp::Reverse(hinge.nodes[k as usize]));
        let nodes = descending.map(|k| hinge.nodes[k as usize]);
        Self { descending, slots: pattern.clique_slots(nodes) }
    }
}

fn membrane(mesh: &Mesh, face: FaceId, offset: usize) -> Membrane {
    let (nodes, gradients) = (mesh.face_nodes(face), mesh.shape_gradients(face));
    let mut corners = [0, 1, 2];
    corners.sort_unstable_by_key(|&k: &usize| std::cmp::Reverse(nodes[k]));
    Membrane {
        nodes: corners.map(|k| (nodes[k].index() + offset) as u32),
        gradients: corners.map(|k| gradients[k]),
        area: mesh.material_area(face),
    }
}

/// `None` at the boundary.
fn hinge(mesh: &Mesh, corner: CornerId, offset: usize) -> Option<Hinge> {
    let other = mesh.opposite(corner)?;
    let [start, end] = mesh.edge_nodes(corner);
    let nodes = [start, end, mesh.node_at(corner), mesh.node_at(other)];
    let edges = [corner, other].map(|c| {
        let [from, to] = mesh.edge_vertices(c);
        mesh.material(to) - mesh.material(from)
    });
    let areas = [corner, other].map(|c| mesh.material_area(c.face()));
    let (curvature_per_angle, shape) = Hinge::measures(edges.map(|e| e.length()), areas);
    Some(Hinge {
        nodes: nodes.map(|n| (n.index() + offset) as u32),
        rest_angle: mesh.rest_angle(corner),
        edge_angle: edges[0].to_angle(),
        edge_angle_across: mesh.is_seam(corner).then(|| edges[1].to_angle()),
        curvature_per_angle,
        shape,
    })
}
