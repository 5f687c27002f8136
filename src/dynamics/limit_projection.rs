//! What the iterations of a step leave beyond strain limits, taken back face after face.
//!
//! That is little: one face in a thousand, of those that snapped or turned within the step. Each is
//! put back on its limits as position-based dynamics projects constraints
//! ([`MHHR07`](crate::papers::MHHR07)): along the gradients of its principal stretches and by mass,
//! which changes neither momentum nor angular momentum. What that costs the faces around it is
//! passed on in turn. As a replacement of the energy it loses: what a whole sheet hangs on would be
//! passed on from face to face.

use glam::DVec3;

use super::handles::HandleSpring;
use super::step::StepState;
use super::stretch::Membrane;
use super::system::{GarmentRanges, System};

/// Faces come back to a limit but for this share of it: less would fight the energy, which lets faces
/// go up to 1 % beyond under loads.
const KEPT_TO: f64 = 8e-3;

/// Faces are beyond a limit that are so by more than this share of it.
const NOTICED_FROM: f64 = 9e-3;

/// Rounds over the faces beyond limits. What they pass on travels a face a round.
const ROUNDS_MAX: u32 = 200;

/// Projections in all, per face that the garments have: where a whole garment is beyond its limits,
/// more rounds would take longer than the step.
const PROJECTIONS_PER_FACE_MAX: usize = 10;

/// Shorter images of a unit length have no direction.
const STRETCH_MIN: f64 = 1e-9;

/// How many faces were beyond their strain limits by over 0.9 % of the ratio.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BeyondLimits {
    pub found: usize,
    /// Still, when the rounds had been used up.
    pub left: usize,
}

impl System {
    /// Takes faces back within the strain limits of their fabrics, and gives nodes the velocity of
    /// what that moves them by in `dt` (s). Nodes in handles stay. Nothing is done to garments
    /// without limits.
    ///
    /// # Panics
    /// If the state has another node count than the system.
    pub fn keep_within_limits(
        &self,
        state: &mut StepState,
        handles: &[HandleSpring],
        dt: f64,
    ) -> BeyondLimits {
        assert_eq!(state.position.len(), self.node_count(), "positions are those of the system");
        let mut beyond = self.faces_beyond_limits(&state.position);
        let found = beyond.len();
        if found == 0 {
            return BeyondLimits::default();
        }
        let around = FacesAround::new(self.node_count(), &self.membranes);
        let mut mobility: Vec<f64> = self.masses.iter().map(|mass| mass.recip()).collect();
        handles.iter().for_each(|handle| mobility[handle.node] = 0.0);
        let before = state.position.clone();
        let mut projections_left = PROJECTIONS_PER_FACE_MAX * self.membranes.len();
        for _ in 0..ROUNDS_MAX {
            if beyond.is_empty() || beyond.len() > projections_left {
                break;
            }
            projections_left -= beyond.len();
            for &(face, limits) in &beyond {
                limits.project(&self.membranes[face as usize], &mobility, &mut state.position);
            }
            beyond = self.beyond_around(&beyond, &around, &state.position);
        }
        let ways = state.position.iter().zip(&before).map(|(now, before)| *now - *before);
        state.velocity.iter_mut().zip(ways).for_each(|(v, way)| *v += way / dt);
        BeyondLimits { found, left: beyond.len() }
    }

    /// By number, of all garments.
    fn faces_beyond_limits(&self, positions: &[DVec3]) -> Vec<(u32, StretchLimits)> {
        let of_garment = |garment: &GarmentRanges| {
            let limits = StretchLimits::of(garment)?;
            let faces = garment.membranes.clone();
            let is_beyond =
                move |&face: &usize| limits.are_exceeded(&self.membranes[face], positions);
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
            limits.are_exceeded(&self.membranes[*face as usize], positions)
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

    fn loosened(&self, share: f64) -> [f64; 2] {
        let [least, largest] = self.ratios;
        [least * (1.0 - share), largest * (1.0 + share)]
    }

    fn are_exceeded(&self, face: &Membrane, positions: &[DVec3]) -> bool {
        let gram = face.gradient_of(positions).gram();
        let mean = 0.5 * gram.trace();
        let radius = (0.5 * (gram.xx - gram.yy)).hypot(gram.xy);
        let [least, largest] = self.loosened(NOTICED_FROM).map(|ratio| ratio * ratio);
        mean + radius > largest || mean - radius < least
    }

    /// Of C = sigma - limit the gradient by corner i is (g_i . a) F a / sigma, with a the principal
    /// axis: dx_i = -w_i C dC/dx_i / sum_k w_k |dC/dx_k|^2.
    fn project(&self, face: &Membrane, mobility: &[f64], positions: &mut [DVec3]) {
        let [least, largest] = self.loosened(KEPT_TO);
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
            let yielding = [0, 1, 2].map(|k| mobility[face.nodes[k] as usize] * slopes[k]);
            let whole: f64 = yielding.iter().zip(&slopes).map(|(y, slope)| y * slope).sum();
            // Nothing yields where handles hold all that could.
            if whole <= 0.0 {
                continue;
            }
            for (&node, share) in face.nodes.iter().zip(yielding) {
                positions[node as usize] -= image * (excess * share / (whole * stretch));
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
