//! What the iterations of a step leave beyond strain limits, taken back face after face.
//!
//! That is little: one face in a thousand, of those that snapped or turned within the step. Each is
//! put back on its limits as position-based dynamics projects constraints
//! ([`MHHR07`](crate::papers::MHHR07)): along the gradients of its principal stretches and by mass,
//! which changes neither momentum nor angular momentum. What that costs the faces around it is
//! passed on in turn.
//!
//! Where handles or loads leave no way within the limits, faces would hand what is too much to and
//! fro. A patch of cloth that does not come within its limits is therefore left as it was: there the
//! energy alone holds.

use glam::DVec3;

use super::handles::HandleSpring;
use super::principal::StrainBounds;
use super::strain_limit::ratios_beyond;
use super::stretch::Membrane;
use super::system::{GarmentRanges, System};
use crate::math::DisjointSets;

/// Faces come back to a limit but for this share of it: less would fight the energy, which lets faces
/// go up to 1 % beyond under loads.
const KEPT_TO: f64 = 8e-3;

/// Faces are beyond a limit that are so by more than this share of it.
const NOTICED_FROM: f64 = 9e-3;

/// A limit is met if it is exceeded by no more than this share of it.
const MET_TO: f64 = 1e-2;

/// Rounds over the faces beyond limits. What they pass on travels a face a round.
const ROUNDS_MAX: u32 = 200;

/// Projections in all, per face that the garments have: where a whole garment is beyond its limits,
/// more rounds would take longer than the step.
const PROJECTIONS_PER_FACE_MAX: usize = 10;

/// Shorter images of a unit length have no direction.
const STRETCH_MIN: f64 = 1e-9;

/// A face is left alone that yields less than this share of what it would with all its nodes free:
/// those that handles hold would make the others go many times as far as it is too long.
const YIELDING_SHARE_MIN: f64 = 0.05;

/// What became of faces beyond their strain limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TakenBack {
    /// By over 0.9 % of a ratio, at first.
    pub found: usize,
    /// By so much still, in patches that would not come within their limits and stay as they were.
    pub left: usize,
}

impl System {
    /// Takes faces back within the strain limits of their fabrics, where that takes moving nodes
    /// within a step of `dt` (s) as far as their masses and handles yield. Garments without limits
    /// keep their bits. Velocities are the caller's business.
    ///
    /// # Panics
    /// If there are not as many positions as nodes, or `dt` is not positive.
    pub fn take_back_within_limits(
        &self,
        positions: &mut [DVec3],
        handles: &[HandleSpring],
        dt: f64,
    ) -> TakenBack {
        assert_eq!(positions.len(), self.node_count(), "positions are those of the system");
        assert!(dt > 0.0, "a step takes time, not {dt} s");
        let mut beyond = self.faces_beyond(NOTICED_FROM, positions);
        let found = beyond.len();
        if found == 0 {
            return TakenBack::default();
        }
        let around = FacesAround::new(self.node_count(), &self.membranes);
        let mobility = self.mobility(handles, dt);
        let before = positions.to_vec();
        let mut patches = DisjointSets::new(self.node_count());
        let mut projections_left = PROJECTIONS_PER_FACE_MAX * self.membranes.len();
        for _ in 0..ROUNDS_MAX {
            if beyond.is_empty() || beyond.len() > projections_left {
                break;
            }
            projections_left -= beyond.len();
            for &(face, limits) in &beyond {
                let face = &self.membranes[face as usize];
                limits.project(face, [&mobility, &self.masses], positions);
                let [a, b, c] = face.nodes.map(|n| n as usize);
                patches.join(a, b);
                patches.join(b, c);
            }
            beyond = self.beyond_around(&beyond, &around, positions);
        }
        if beyond.is_empty() {
            return TakenBack { found, left: 0 };
        }
        self.give_up(&beyond, &mut patches, &before, positions);
        TakenBack { found, left: self.faces_beyond(NOTICED_FROM, positions).len() }
    }

    /// Faces beyond a strain limit by more than 1 % of the ratio.
    pub fn count_beyond_limits(&self, positions: &[DVec3]) -> usize {
        self.faces_beyond(MET_TO, positions).len()
    }

    /// Puts the nodes back of patches in which a face is still beyond its limits.
    fn give_up(
        &self,
        beyond: &[(u32, StretchLimits)],
        patches: &mut DisjointSets,
        before: &[DVec3],
        positions: &mut [DVec3],
    ) {
        let mut is_given_up = vec![false; positions.len()];
        for &(face, _) in beyond {
            for node in self.membranes[face as usize].nodes {
                is_given_up[patches.root(node as usize)] = true;
            }
        }
        for (node, (now, before)) in positions.iter_mut().zip(before).enumerate() {
            if is_given_up[patches.root(node)] {
                *now = *before;
            }
        }
    }

    /// How far a node goes in a step per impulse (1/kg), handles included as they resist it:
    /// 1 / (m + k dt^2).
    fn mobility(&self, handles: &[HandleSpring], dt: f64) -> Vec<f64> {
        let mut inertia = self.masses.clone();
        handles.iter().for_each(|handle| inertia[handle.node] += handle.stiffness * dt * dt);
        inertia.iter().map(|inertia| inertia.max(f64::MIN_POSITIVE).recip()).collect()
    }

    /// By number, of all garments; beyond by more than a share of the limiting ratio.
    fn faces_beyond(&self, share: f64, positions: &[DVec3]) -> Vec<(u32, StretchLimits)> {
        let of_garment = |garment: &GarmentRanges| {
            let limits = StretchLimits::of(garment)?;
            let bounds = limits.bounds_beyond(share);
            let faces = garment.membranes.clone();
            let is_beyond =
                move |&face: &usize| bounds.may_be_felt(self.membranes[face].strain(positions));
            Some(faces.filter(is_beyond).map(move |face| (face as u32, limits)))
        };
        self.garments.iter().filter_map(of_garment).flatten().collect()
    }

    /// Which of some faces and those around their nodes are beyond limits. Nodes are of one garment,
    /// so are the faces around them.
    fn beyond_around(
        &self,
        faces: &[(u32, StretchLimits)],
        around: &FacesAround,
        positions: &[DVec3],
    ) -> Vec<(u32, StretchLimits)> {
        let mut near: Vec<(u32, StretchLimits)> = faces
            .iter()
            .flat_map(|&(face, limits)| {
                let nodes = self.membranes[face as usize].nodes.into_iter();
                nodes.flat_map(|n| around.of(n)).map(move |&other| (other, limits))
            })
            .collect();
        near.sort_unstable_by_key(|&(face, _)| face);
        near.dedup_by_key(|&mut (face, _)| face);
        near.retain(|(face, limits)| {
            let bounds = limits.bounds_beyond(NOTICED_FROM);
            bounds.may_be_felt(self.membranes[*face as usize].strain(positions))
        });
        near
    }
}

/// Ratios that principal stretches are kept between.
#[derive(Clone, Copy, Debug, PartialEq)]
struct StretchLimits {
    ratios: [f64; 2],
}

impl StretchLimits {
    /// `None` where stretch is not limited.
    fn of(garment: &GarmentRanges) -> Option<Self> {
        garment.strain_limit?;
        garment.fabric.strain_limits().map(|ratios| Self { ratios })
    }

    /// Felt where a principal stretch is beyond by more than a share; nothing resists there.
    fn bounds_beyond(&self, share: f64) -> StrainBounds {
        StrainBounds::of_stretch(ratios_beyond(self.ratios, share), 0.0)
    }

    /// Of C = sigma - limit the gradient by corner i is (g_i . a) F a / sigma, with a the principal
    /// axis: dx_i = -w_i C dC/dx_i / sum_k w_k |dC/dx_k|^2, w the mobility.
    fn project(&self, face: &Membrane, [mobility, masses]: [&[f64]; 2], positions: &mut [DVec3]) {
        let [least, largest] = ratios_beyond(self.ratios, KEPT_TO);
        for is_major in [true, false] {
            let deformation = face.gradient_of(positions);
            let major = deformation.gram().eigen().major_axis;
            let axis = if is_major { major } else { major.perp() };
            let image = deformation.x_axis * axis.x + deformation.y_axis * axis.y;
            let stretch = image.length();
            let excess = stretch - stretch.clamp(least, largest);
            if excess == 0.0 || stretch < STRETCH_MIN {
                continue;
            }
            let slopes = face.gradients.map(|g| g.dot(axis));
            let own = face.nodes.map(|n| mobility[n as usize]);
            let whole: f64 = (0..3).map(|k| own[k] * slopes[k] * slopes[k]).sum();
            let free = face.nodes.map(|n| masses[n as usize].max(f64::MIN_POSITIVE).recip());
            let all_free: f64 = (0..3).map(|k| free[k] * slopes[k] * slopes[k]).sum();
            if !(whole > YIELDING_SHARE_MIN * all_free && whole.is_finite()) {
                continue;
            }
            for k in 0..3 {
                let share = own[k] * slopes[k] / (whole * stretch);
                positions[face.nodes[k] as usize] -= image * (excess * share);
            }
        }
    }
}

/// The faces around every node.
#[derive(Clone, Debug)]
struct FacesAround {
    /// Per node where its faces start, and one more.
    starts: Vec<u32>,
    faces: Vec<u32>,
}

impl FacesAround {
    fn new(node_count: usize, membranes: &[Membrane]) -> Self {
        let mut starts = vec![0; node_count + 1];
        for node in membranes.iter().flat_map(|face| face.nodes) {
            starts[node as usize + 1] += 1;
        }
        for node in 0..node_count {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut faces = vec![0; 3 * membranes.len()];
        for (face, membrane) in membranes.iter().enumerate() {
            for node in membrane.nodes {
                let place = &mut next[node as usize];
                faces[*place as usize] = face as u32;
                *place += 1;
            }
        }
        Self { starts, faces }
    }

    fn of(&self, node: u32) -> &[u32] {
        let [start, end] = [node, node + 1].map(|n| self.starts[n as usize] as usize);
        &self.faces[start..end]
    }
}
