//! How long the edges are that a camera sees: in the flat cloth and on the image.

use std::sync::Arc;

use crate::mesh::Mesh;
use crate::shot::{Frustum, View};
use crate::view::{Facing, facing};

/// Mean lengths of the edges of all visible faces: in frame, their fronts to the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenEdges {
    pub face_count: usize,
    /// In the flat cloth (m).
    pub length: f64,
    /// On an image of the view's own resolution (px).
    pub length_px: f64,
}

/// `None` if nothing is visible. Each face counts its three edges; faces that reach behind the near
/// plane have no size on the image and are left out.
pub fn screen_edges(garments: &[Arc<Mesh>], view: &View) -> Option<ScreenEdges> {
    let frustum = Frustum::of(view);
    let mut sum = ScreenEdges { face_count: 0, length: 0.0, length_px: 0.0 };
    for mesh in garments {
        for face in mesh.face_ids() {
            let corners = mesh.face_nodes(face).map(|node| mesh.position[node]);
            let in_frame = frustum.distance_to_triangle_up_to(f64::MIN_POSITIVE, corners) == 0.0;
            if !in_frame || facing(view.eye, corners) == Facing::Back {
                continue;
            }
            let [Some(a), Some(b), Some(c)] = corners.map(|p| view.point_in_image(p)) else {
                continue;
            };
            let around = |lengths: [f64; 3]| lengths.into_iter().sum::<f64>() / 3.0;
            let flat = mesh.face_material(face);
            sum.face_count += 1;
            sum.length += around([0, 1, 2].map(|k| flat[k].distance(flat[(k + 1) % 3])));
            sum.length_px += around([a.distance(b), b.distance(c), c.distance(a)]);
        }
    }
    let count = sum.face_count as f64;
    let mean = ScreenEdges { length: sum.length / count, length_px: sum.length_px / count, ..sum };
    (sum.face_count > 0).then_some(mean)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{flat, overhead};
    use super::*;

    #[test]
    fn edges_on_the_image_are_as_long_as_the_camera_makes_them() {
        // A metre is 200 px there.
        let view = overhead([200, 200]);
        let seen = [[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.4, 0.0]];
        // It falls away from the camera, steeply.
        let turned = [[0.3, 0.0, 0.1], [0.31, 0.0, -0.3], [0.3, 0.05, 0.1]];
        let out = [[3.0, 0.0, 0.0], [4.0, 0.0, 0.0], [3.0, 1.0, 0.0]];
        let edges = screen_edges(&[Arc::new(flat(&[seen, turned, out]))], &view).unwrap();
        assert_eq!(edges.face_count, 1);
        assert!((edges.length - 0.4).abs() < 1e-9, "{edges:?}");
        assert!((edges.length_px - 80.0).abs() < 1e-6, "{edges:?}");
    }

    #[test]
    fn where_nothing_is_visible_there_is_no_length() {
        assert_eq!(screen_edges(&[], &overhead([100, 100])), None);
    }
}
