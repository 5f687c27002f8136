//! The mesh's edges as lines, coloured by what the shot camera's frame makes of the faces at them.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use crate::mesh::{Mesh, NodeId};
use crate::scene::ViewSettings;
use crate::shot::{Frustum, View};
use crate::view::{Facing, facing};

use super::colour::Srgb;
use super::draw_list::{DrawList, Line};

/// How far a line is raised from the cloth, as a share of the way to the eye: a wide line on a slanted
/// surface would sink into it. From the eye it stands where it stood.
const RAISED_SHARE: f64 = 1e-3;

/// Where a face is to the shot camera, the best of its places first: an edge has the colour of the
/// better of its two faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FramePlace {
    /// In frame, its front to the camera.
    Visible,
    /// In frame, its back to the camera.
    TurnedAway,
    /// Out of frame by less than the margin.
    Margin,
    /// Further out of frame.
    Beyond,
}

impl FramePlace {
    /// Of a triangle in the world (m), for a shot camera.
    pub fn of(triangle: [DVec3; 3], view: &View, frustum: &Frustum, margin: f64) -> Self {
        let distance = frustum.distance_to_triangle_up_to(margin, triangle);
        match facing(view.eye, triangle) {
            Facing::Front if distance == 0.0 => Self::Visible,
            Facing::Back if distance == 0.0 => Self::TurnedAway,
            _ if distance < margin => Self::Margin,
            _ => Self::Beyond,
        }
    }

    /// As the papers colour them: blue in view, cyan in the margin, green far out of frame.
    pub fn colour(self) -> Srgb {
        match self {
            Self::Visible => Srgb([34, 74, 190]),
            Self::TurnedAway => Srgb([112, 116, 128]),
            Self::Margin => Srgb([0, 160, 190]),
            Self::Beyond => Srgb([60, 150, 40]),
        }
    }

    /// What a legend calls it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Visible => "visible",
            Self::TurnedAway => "turned away",
            Self::Margin => "within the margin",
            Self::Beyond => "far out of frame",
        }
    }

    pub const ALL: [Self; 4] = [Self::Visible, Self::TurnedAway, Self::Margin, Self::Beyond];
}

impl DrawList {
    /// Adds the edges of all garments as an eye will see them; each garment has its own margin.
    /// Surfaces hide them.
    pub fn push_frame_edges(
        &mut self,
        garments: &[Arc<Mesh>],
        settings: &[ViewSettings],
        shot: &View,
        eye: DVec3,
        width_px: f32,
    ) {
        let frustum = Frustum::of(shot);
        let papers = ViewSettings::default();
        for (index, mesh) in garments.iter().enumerate() {
            let margin = settings.get(index).unwrap_or(&papers).margin_m;
            for ([a, b], place) in edge_places(mesh, shot, &frustum, margin) {
                let colour = place.colour().with_alpha(255);
                let end = |node: NodeId| {
                    let raised = mesh.position[node].lerp(eye, RAISED_SHARE);
                    self.point_in_local(raised).to_array()
                };
                let (start, end) = (end(a), end(b));
                self.ground_lines.push(Line {
                    start,
                    end,
                    start_colour: colour,
                    end_colour: colour,
                    width_px,
                });
            }
        }
    }
}

/// Every edge once, by its nodes.
fn edge_places(
    mesh: &Mesh,
    shot: &View,
    frustum: &Frustum,
    margin: f64,
) -> BTreeMap<[NodeId; 2], FramePlace> {
    let mut places = BTreeMap::new();
    for face in mesh.face_ids() {
        let [a, b, c] = mesh.face_nodes(face);
        let triangle = [a, b, c].map(|node| mesh.position[node]);
        let place = FramePlace::of(triangle, shot, frustum, margin);
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let best = places.entry([a.min(b), a.max(b)]).or_insert(place);
            *best = place.min(*best);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{flat, overhead};
    use super::super::options::PictureOptions;
    use super::*;

    const MARGIN: f64 = 0.4;

    /// What the overhead camera, which sees half a metre to each side, makes of a triangle there.
    fn place(x: f64, turned: bool) -> FramePlace {
        let mut triangle = [[x, 0.0], [x + 0.1, 0.0], [x, 0.1]].map(|[x, y]| DVec3::new(x, y, 0.0));
        if turned {
            triangle.reverse();
        }
        let view = overhead([100, 100]);
        FramePlace::of(triangle, &view, &Frustum::of(&view), MARGIN)
    }

    #[test]
    fn a_face_is_where_frame_margin_and_side_put_it() {
        assert_eq!(place(0.0, false), FramePlace::Visible);
        assert_eq!(place(0.0, true), FramePlace::TurnedAway);
        assert_eq!(place(0.7, false), FramePlace::Margin);
        assert_eq!(place(0.7, true), FramePlace::Margin);
        assert_eq!(place(1.2, false), FramePlace::Beyond);
    }

    #[test]
    fn a_common_edge_is_drawn_once_and_as_its_better_face() {
        let view = overhead([100, 100]);
        let seen = [[0.4, 0.0, 0.0], [0.8, 0.0, 0.0], [0.4, 0.1, 0.0]];
        let out = [[0.8, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.1, 0.0]];
        let mesh = flat(&[seen, out]);
        let places = edge_places(&mesh, &view, &Frustum::of(&view), MARGIN);
        let count = |wanted| places.values().filter(|&&place| place == wanted).count();
        assert_eq!([count(FramePlace::Visible), count(FramePlace::Margin)], [3, 3]);
    }

    #[test]
    fn every_edge_becomes_a_line_of_its_colour() {
        let mesh = flat(&[[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]]]);
        let mut list = DrawList {
            origin: DVec3::ZERO,
            surfaces: Vec::new(),
            fills: Vec::new(),
            ground_lines: Vec::new(),
            overlay_lines: Vec::new(),
            background: PictureOptions::default().background,
            wire_width_px: 1.0,
        };
        list.push_frame_edges(&[Arc::new(mesh)], &[], &overhead([100, 100]), DVec3::Z, 1.5);
        let blue = FramePlace::Visible.colour().with_alpha(255);
        assert_eq!(list.ground_lines.len(), 3);
        assert!(list.ground_lines.iter().all(|l| l.start_colour == blue && l.width_px == 1.5));
    }
}
