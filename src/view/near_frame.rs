//! How near faces are to the frame, now and soon.

use super::{ViewSample, ViewerWindow, nearness};
use crate::mesh::{FaceId, IdVec, Mesh};

/// How near a face is to the frames of those who look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearFrame {
    /// d now, to the nearest frustum (m): exact below the margin, elsewhere a lower bound not below
    /// it; 0 only for faces in frame.
    pub out_of_frame_distance: f64,
    /// s = max over viewers and tau of w(tau) max(0, 1 - d(t+tau)/m), 0..1: how soon the face is in
    /// frame, 1 when it is.
    pub presence: f64,
}

/// Of every face; where nobody looks nothing is out of frame.
pub fn near_frame(mesh: &Mesh, windows: &[ViewerWindow], margin: f64) -> IdVec<FaceId, NearFrame> {
    let samples = || windows.iter().flat_map(ViewerWindow::samples);
    mesh.face_ids().map(|face| NearFrame::of(mesh, face, samples(), margin)).collect()
}

impl NearFrame {
    fn of<'a>(
        mesh: &Mesh,
        face: FaceId,
        samples: impl Iterator<Item = &'a ViewSample>,
        margin: f64,
    ) -> Self {
        let triangle = mesh.face_positions(face);
        let mut found: Option<Self> = None;
        for sample in samples {
            let before =
                found.unwrap_or(Self { out_of_frame_distance: f64::INFINITY, presence: 0.0 });
            // What weighs no more than is known already cannot add to it. The present weighs 1: it
            // is only left out where the face is in frame.
            if sample.weight > before.presence {
                let distance = sample.frustum.distance_to_triangle_up_to(margin, triangle);
                let now = if sample.tau == 0.0 { distance } else { f64::INFINITY };
                found = Some(Self {
                    out_of_frame_distance: before.out_of_frame_distance.min(now),
                    presence: before.presence.max(sample.weight * nearness(distance, margin)),
                });
            }
        }
        found.unwrap_or(Self { out_of_frame_distance: 0.0, presence: 1.0 })
    }
}
