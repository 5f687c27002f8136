//! Where cloth passes through cloth or obstacles, marked so that nobody overlooks it.

use std::sync::Arc;

use glam::DVec3;

use crate::collision::{CrossingFaces, GarmentFace, crossing_faces};
use crate::mesh::Mesh;
use crate::scene::Surface;
use crate::sim::Frame;

use super::colour::Srgb;
use super::draw_list::{DrawList, FillVertex};

/// The faces of a frame's cloth that pass through other cloth or through obstacles.
///
/// Finding them builds a tree over all faces, which takes 90 ms of CPU for 20,000 faces, a third of
/// what drawing them in software takes (a test measures both): a window finds them once a frame, and
/// not on the thread that answers the user.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crossings {
    found: CrossingFaces,
    /// Every face of the above once, in order.
    faces: Vec<GarmentFace>,
}

/// Of no table and no fabric, and seen on all of them. The outline keeps a crossing of small faces in
/// sight; a wider one would make a blot of a tangle.
const MAGENTA: Srgb = Srgb([232, 0, 148]);
const FILL_ALPHA: u8 = 130;
const OUTLINE_WIDTH_PX: f32 = 1.5;

/// How far an outline is raised from the cloth, as a share of the way to the eye: a wide line on a
/// slanted surface would sink into it. From the eye it stands where it stood.
const RAISED_SHARE: f64 = 1e-3;

impl Crossings {
    /// `surfaces` are the obstacles', in the order of the frame's poses.
    pub fn of(frame: &Frame, surfaces: &[Arc<Surface>]) -> Self {
        let garments: Vec<&Mesh> = frame.garments.iter().map(Arc::as_ref).collect();
        let placed = surfaces.iter().zip(&frame.obstacle_poses).enumerate();
        let obstacles: Vec<Vec<[DVec3; 3]>> = placed
            .map(|(number, (surface, pose))| {
                let points = frame.points_of_obstacle(number, surface);
                let at = |p: u32| pose.transform_point(points[p as usize]);
                surface.triangles.iter().map(|t| t.map(at)).collect()
            })
            .collect();
        let found = crossing_faces(&garments, &obstacles);
        let mut faces: Vec<GarmentFace> = found.pairs.iter().flatten().copied().collect();
        faces.extend(found.cuts.iter().map(|&(face, _)| face));
        faces.sort_unstable();
        faces.dedup();
        Self { found, faces }
    }

    /// Pairs of faces of cloth, and faces of cloth with obstacles.
    pub fn found(&self) -> &CrossingFaces {
        &self.found
    }

    /// Every face that passes through something, once, in order of garments.
    pub fn faces(&self) -> &[GarmentFace] {
        &self.faces
    }
}

impl DrawList {
    /// Marks crossings of these garments in magenta, for an eye (m): filled, with an outline that keeps
    /// its width on the image, both shining through what is in front.
    pub fn push_crossings(&mut self, crossings: &Crossings, garments: &[Arc<Mesh>], eye: DVec3) {
        for at in crossings.faces() {
            let Some(mesh) = garments.get(at.garment) else { continue };
            let corners = mesh.face_positions(at.face);
            let colour = MAGENTA.with_alpha(FILL_ALPHA);
            self.fills.extend(corners.map(|corner| FillVertex {
                position: self.point_in_local(corner).to_array(),
                colour,
            }));
            let raised = corners.map(|corner| corner.lerp(eye, RAISED_SHARE));
            for k in 0..3 {
                let colour = MAGENTA.with_alpha(255);
                self.push_line(raised[k], raised[(k + 1) % 3], colour, OUTLINE_WIDTH_PX);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{flat, frame};
    use super::super::options::PictureOptions;
    use super::*;
    use crate::scene::Pose;

    /// One face lies at 0 m, the other one stands in it.
    fn crossed() -> Frame {
        let lying = flat(&[[[-0.4, -0.4, 0.0], [0.4, -0.4, 0.0], [0.0, 0.4, 0.0]]]);
        let mut standing = flat(&[[[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.0, 0.1, 0.0]]]);
        let heights = [-0.1, -0.1, 0.2];
        standing.position.iter_mut().zip(heights).for_each(|(p, z)| p.z = z);
        frame([lying, standing])
    }

    #[test]
    fn each_crossing_face_is_filled_and_outlined_once() {
        let frame = crossed();
        let crossings = Crossings::of(&frame, &[]);
        assert_eq!((crossings.found().pairs.len(), crossings.faces().len()), (1, 2));
        let mut list = DrawList::new(&frame, &[], &PictureOptions::default());
        list.push_crossings(&crossings, &frame.garments, DVec3::Z);
        assert_eq!((list.fills.len(), list.overlay_lines.len()), (6, 6));
    }

    #[test]
    fn an_obstacle_counts_where_it_stands() {
        let mut frame = crossed();
        frame.garments.remove(0);
        let [a, b, c] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
        let floor = Arc::new(Surface {
            positions: [a, b, c].map(DVec3::from_array).to_vec(),
            triangles: vec![[0, 1, 2]],
        });
        for (height, count) in [(0.0, 1), (5.0, 0)] {
            let pose = Pose { translation: DVec3::Z * height, ..Pose::IDENTITY };
            frame.obstacle_poses = vec![pose];
            let crossings = Crossings::of(&frame, std::slice::from_ref(&floor));
            assert_eq!(crossings.found().cuts.len(), count, "{height} m");
        }
    }

    #[test]
    fn marks_of_another_frames_garments_are_left_out() {
        let crossings = Crossings::of(&crossed(), &[]);
        let mut list = DrawList::new(&frame([]), &[], &PictureOptions::default());
        list.push_crossings(&crossings, &[], DVec3::Z);
        assert!(list.fills.is_empty() && list.overlay_lines.is_empty());
    }
}
