//! The shot camera as the witness sees it: its frustum, its body, its path.

use glam::DVec3;

use crate::shot::{CameraPath, View};

use super::bounds::Bounds;
use super::colour::Srgb;
use super::draw_list::{DrawList, Material, SurfaceBatch, SurfaceVertex};

/// The shot camera at one time, and where it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct ShotCamera<'a> {
    pub view: &'a View,
    pub trail: &'a CameraTrail,
    /// How far in front of the eye the frustum is drawn (m). The far plane is usually far beyond
    /// anything worth seeing: [`ShotCamera::frustum_depth_past`] stops behind the cloth.
    pub frustum_depth: f64,
    /// Where the camera will be: its frustum is drawn paler and thinner. One that is where the camera
    /// is already is not drawn.
    pub ghost: Option<&'a View>,
}

/// A camera's way through the shot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraTrail {
    /// The eye at each frame, in the world (m).
    pub eyes: Vec<DVec3>,
    /// Indices of the eyes at keys.
    pub keys: Vec<usize>,
    /// Indices of the eyes the camera jumps to.
    pub cuts: Vec<usize>,
}

const FRUSTUM_COLOUR: [u8; 4] = [20, 21, 24, 255];
/// Paler and thinner than the frustum that is, and bluish: it reads as the same thing, later.
const GHOST_COLOUR: [u8; 4] = [70, 96, 150, 150];
const GHOST_WIDTH_PX: f32 = 0.9;
const TRAIL_COLOUR: [u8; 4] = [60, 66, 76, 200];
const CUT_COLOUR: [u8; 4] = [196, 90, 20, 255];
const PAPER: [u8; 4] = [250, 250, 250, 255];
const FRUSTUM_WIDTH_PX: f32 = 1.2;
const TRAIL_WIDTH_PX: f32 = 1.6;
const KEY_DOT_PX: f32 = 6.0;
const CUT_DOT_PX: f32 = 8.0;
const CUT_HOLE_PX: f32 = 4.0;

const BODY: Material = Material {
    tint: [Srgb([52, 55, 62]), Srgb([52, 55, 62])],
    table: None,
    wire_strength: 0.0,
    sheen: 0.0,
    modelling: 1.0,
};

/// Length of the camera's body as a share of its distance from the witness: the same size on the
/// image in every shot.
const BODY_SHARE: f64 = 0.045;

/// Colour (sRGB and opacity) and width (px) of lines.
type Stroke = ([u8; 4], f32);

impl CameraTrail {
    /// The way from frame 0 to a frame, with the keys and cuts on it.
    ///
    /// # Panics
    /// If the path has no keys.
    pub fn of(path: &CameraPath, last: u32) -> Self {
        let index = |frames: Vec<f64>| {
            frames.into_iter().map(|f| f.round() as usize).filter(|&f| f <= last as usize).collect()
        };
        Self {
            eyes: (0..=last).map(|frame| path.view(f64::from(frame)).eye).collect(),
            keys: index(path.key_frames()),
            cuts: index(path.cuts()),
        }
    }
}

impl ShotCamera<'_> {
    /// A frustum depth (m) that ends a little behind the subject, within near and far plane.
    pub fn frustum_depth_past(view: &View, subject: Bounds) -> f64 {
        /// Beyond the subject, as a share of the distance to its far side.
        const BEYOND: f64 = 1.08;
        let depths = subject.corners().map(|corner| -view.point_in_camera(corner).z);
        let last = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
        // A subject behind the camera still deserves a frustum that can be seen.
        let least = 0.5 * subject.radius();
        (last * BEYOND).max(least).clamp(view.near, view.far.max(view.near))
    }
}

impl DrawList {
    /// Adds the shot camera, for a witness at `witness_eye` (m).
    pub fn push_shot_camera(&mut self, camera: &ShotCamera<'_>, witness_eye: DVec3) {
        self.push_trail(camera.trail);
        if let Some(ghost) = camera.ghost.filter(|&ghost| ghost != camera.view) {
            self.push_frustum(ghost, camera.frustum_depth, (GHOST_COLOUR, GHOST_WIDTH_PX));
        }
        let stroke = (FRUSTUM_COLOUR, FRUSTUM_WIDTH_PX);
        self.push_frustum(camera.view, camera.frustum_depth, stroke);
        let size = BODY_SHARE * camera.view.eye.distance(witness_eye);
        let body = body_vertices(camera.view, size, self.origin);
        self.surfaces.push(SurfaceBatch { material: BODY, vertices: body });
    }

    /// To a depth (m), in a colour and a width (px).
    fn push_frustum(&mut self, view: &View, depth: f64, stroke: Stroke) {
        let View { eye, near, .. } = *view;
        let (colour, width_px) = stroke;
        let far = gate_corners(view, depth);
        let near = gate_corners(view, near);
        for i in 0..4 {
            self.push_line(eye, far[i], colour, width_px);
            for gate in [near, far] {
                self.push_line(gate[i], gate[(i + 1) % 4], colour, width_px);
            }
        }
        self.push_up_mark(view, far, stroke);
    }

    /// A small triangle above the far gate: which way the camera's up is.
    fn push_up_mark(&mut self, view: &View, gate: [DVec3; 4], (colour, width_px): Stroke) {
        let (left, right) = (gate[3], gate[2]);
        let width = left.distance(right);
        let middle = 0.5 * (left + right) + view.up * (0.02 * width);
        let side = (right - left) * 0.06;
        let tip = middle + view.up * (0.07 * width);
        for [a, b] in [[middle - side, middle + side], [middle + side, tip], [tip, middle - side]] {
            self.push_line(a, b, colour, width_px);
        }
    }

    /// The path as a line with gaps at cuts, a dot at each key and a ring where a cut lands.
    fn push_trail(&mut self, trail: &CameraTrail) {
        for (i, pair) in trail.eyes.windows(2).enumerate() {
            if pair[0] != pair[1] && !trail.cuts.contains(&(i + 1)) {
                self.push_line(pair[0], pair[1], TRAIL_COLOUR, TRAIL_WIDTH_PX);
            }
        }
        let eyes = |indices: &[usize]| -> Vec<DVec3> {
            indices.iter().filter_map(|&i| trail.eyes.get(i).copied()).collect()
        };
        for eye in eyes(&trail.keys) {
            self.push_line(eye, eye, TRAIL_COLOUR, KEY_DOT_PX);
        }
        for eye in eyes(&trail.cuts) {
            self.push_line(eye, eye, CUT_COLOUR, CUT_DOT_PX);
            self.push_line(eye, eye, PAPER, CUT_HOLE_PX);
        }
    }
}

/// Corners of the gate at a depth (m), counter-clockwise from the lower left, in the world.
pub(super) fn gate_corners(view: &View, depth: f64) -> [DVec3; 4] {
    let (min, max) = (view.gate_min, view.gate_max);
    [(min.x, min.y), (max.x, min.y), (max.x, max.y), (min.x, max.y)]
        .map(|(x, y)| view.eye + depth * (view.right * x + view.up * y - view.back))
}

/// A box behind the eye and a hood that opens towards the scene, `size` long (m).
fn body_vertices(view: &View, size: f64, origin: DVec3) -> Vec<SurfaceVertex> {
    let section = |half_width: f64, half_height: f64, back: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            view.eye
                + size * (view.right * (x * half_width) + view.up * (y * half_height))
                + size * view.back * back
        })
    };
    let mut vertices = Vec::new();
    let rear = section(0.26, 0.32, 1.15);
    let front = section(0.26, 0.32, 0.3);
    push_prism(&mut vertices, rear, front, origin);
    push_prism(&mut vertices, section(0.12, 0.12, 0.3), section(0.26, 0.2, 0.0), origin);
    vertices
}

/// A solid between two quadrilaterals; both counter-clockwise seen from the second's side.
fn push_prism(out: &mut Vec<SurfaceVertex>, rear: [DVec3; 4], front: [DVec3; 4], origin: DVec3) {
    let [a, b, c, d] = rear;
    let mut sides = vec![[d, c, b, a], front];
    for i in 0..4 {
        let j = (i + 1) % 4;
        sides.push([rear[i], rear[j], front[j], front[i]]);
    }
    for [a, b, c, d] in sides {
        let normal = (c - a).cross(d - b).normalize_or_zero().as_vec3().to_array();
        for point in [a, b, c, a, c, d] {
            let position = (point - origin).as_vec3().to_array();
            out.push(SurfaceVertex { position, normal, colour_coordinate: 0.0 });
        }
    }
}
