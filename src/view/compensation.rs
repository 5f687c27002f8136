//! How far faces that nobody looks at are taken to have buckled between their nodes
//! ([`VD15`](crate::papers::VD15) 3.5).

use super::{ViewerWindow, near_frame};
use crate::mesh::{FaceId, IdVec, Mesh};
use crate::scene::ViewSettings;

/// Alpha is at least this: at 0 a face would resist no compression at all, and nothing would say
/// where its nodes belong.
const ALPHA_MIN: f64 = 1e-3;

/// Areas that differ by less than this share are the same: of equal faces rounding must not choose.
const EQUAL_AREAS: f64 = 1e-6;

/// Alpha of every face of a garment, in [1e-3, 1]: what its compressive stiffness is multiplied by.
///
/// Out of frame alpha = ((A_max - A) / (A_max - A_min))^k (eq. 11), with A the material areas of
/// the garment's faces out of frame; 1 in frame, where all areas are the same, and where nobody
/// looks. A face that comes into frame gets its stiffness back by and by: what is used is
/// 1 - (1 - alpha)(1 - s), with s how soon it will be in frame.
pub fn buckling_alphas(
    mesh: &Mesh,
    windows: &[ViewerWindow],
    settings: &ViewSettings,
) -> IdVec<FaceId, f64> {
    if settings.buckling_exponent == 0.0 {
        return IdVec::filled(1.0, mesh.face_count());
    }
    let near = near_frame(mesh, windows, settings.margin_m);
    let is_in_frame = |face: FaceId| near[face].out_of_frame_distance == 0.0;
    let areas = mesh.face_ids().filter(|&f| !is_in_frame(f)).map(|f| mesh.material_area(f));
    let (least, most) =
        areas.fold((f64::INFINITY, 0.0_f64), |(low, high), area| (low.min(area), high.max(area)));
    let alpha = |face: FaceId| {
        if is_in_frame(face) || most - least <= EQUAL_AREAS * most {
            return 1.0;
        }
        let fineness = (most - mesh.material_area(face)) / (most - least);
        let alpha = fineness.powf(settings.buckling_exponent).max(ALPHA_MIN);
        1.0 - (1.0 - alpha) * (1.0 - near[face].presence)
    };
    mesh.face_ids().map(alpha).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::mesh::RawMesh;
    use crate::shot::tests::still;

    /// Two large triangles and two small ones, side by side from x on.
    fn faces(x: f64) -> Mesh {
        let mut raw = RawMesh::default();
        for (start, size) in [(0.0, 0.4), (1.0, 0.1)] {
            let first = raw.positions.len() as u32;
            for (dx, dy) in [(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)] {
                raw.vertices.push((raw.positions.len() as u32, DVec2::new(start + dx, dy)));
                raw.positions.push(DVec3::new(x + start + dx, dy, 0.0));
            }
            raw.faces.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        Mesh::from_raw(&raw, &[]).expect("the faces are a mesh")
    }

    fn alphas(x: f64, settings: &ViewSettings) -> Vec<f64> {
        let path = still(DVec3::new(0.5, 0.0, 4.0), DVec3::new(0.5, 0.0, 0.0));
        let window = ViewerWindow::new(&path, 0.0, settings.anticipation_frames);
        buckling_alphas(&faces(x), &[window], settings).into_vec()
    }

    #[test]
    fn faces_in_frame_keep_their_stiffness() {
        assert_eq!(alphas(0.0, &ViewSettings::default()), [1.0; 4]);
    }

    #[test]
    fn far_out_of_frame_large_faces_lose_it_and_the_smallest_keep_it() {
        let found = alphas(50.0, &ViewSettings::default());
        for (alpha, expected) in found.into_iter().zip([ALPHA_MIN, ALPHA_MIN, 1.0, 1.0]) {
            assert!((alpha - expected).abs() < 1e-9, "{alpha}, not {expected}");
        }
    }

    #[test]
    fn an_exponent_of_zero_switches_it_off() {
        let settings = ViewSettings { buckling_exponent: 0.0, ..ViewSettings::default() };
        assert_eq!(alphas(50.0, &settings), [1.0; 4]);
    }

    #[test]
    fn stiffness_comes_back_across_the_margin_without_a_jump() {
        let settings = ViewSettings { margin_m: 2.0, ..ViewSettings::default() };
        let of_first = |x: f64| alphas(x, &settings)[0];
        let mut before = of_first(20.0);
        let mut x = 20.0;
        let mut seen = 0;
        while x > 0.0 {
            x -= 0.05;
            let alpha = of_first(x);
            assert!((alpha - before).abs() < 0.05, "from {before} to {alpha} at {x} m");
            seen += usize::from(alpha > 0.1 && alpha < 0.9);
            before = alpha;
        }
        assert!(seen > 10 && before == 1.0);
    }

    #[test]
    fn without_a_margin_faces_are_in_or_out() {
        let settings = ViewSettings { margin_m: 0.0, ..ViewSettings::default() };
        assert_eq!(alphas(0.0, &settings), [1.0; 4]);
        assert!(alphas(50.0, &settings)[0] < 2e-3);
    }
}
