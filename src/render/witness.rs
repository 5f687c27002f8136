//! Where to stand to see both the cloth and the camera that watches it.
//!
//! One place serves a whole run: it is found from the space the cloth takes up over all frames and
//! from the shot camera's views over the run, so a sheet does not jump. Candidates go around the subject, a
//! little above it; at each the camera is drawn back just so far that everything is in frame.
//! The best shows the subject large and the shot camera's axis from the side.
//!
//! A far camera would make the cloth a dot. Eyes further from the subject than
//! [`EYE_DISTANCE_MAX`] times its radius are therefore moved in along the line of sight before
//! framing: they stay outside the picture, and their frustum enters it from the right direction.
//! In the same way the edge of the shot's frame is kept in the picture where it passes the cloth,
//! up to [`GATE_DISTANCE_MAX`] radii away: what is in and out of frame is what the witness shows.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::scene::{Pose, Surface};
use crate::shot::{CameraPath, View};
use crate::sim::Frame;

use super::bounds::Bounds;
use super::camera_glyph::gate_corners;

/// What the witness should see.
#[derive(Clone, Debug, PartialEq)]
pub struct WitnessSubject {
    /// Around the cloth over the whole range of frames.
    pub cloth: Bounds,
    /// The shot camera over the run, at least the current view; every few frames is enough.
    pub views: Vec<View>,
}

/// Eyes beyond this many radii of the subject are not framed.
const EYE_DISTANCE_MAX: f64 = 4.5;
/// Corners of the shot's frame beyond this many radii of the subject are not framed.
const GATE_DISTANCE_MAX: f64 = 1.1;
/// Room for the camera's body behind its eye, as a share of the eye's distance.
const BODY_ROOM: f64 = 0.06;
/// Above the horizon (rad): three-quarter view, floors seen as floors.
const ELEVATION: f64 = 0.42;
const AZIMUTHS: usize = 48;
/// Vertical field of view (rad): long enough that little is distorted.
pub const WITNESS_FOV_Y: f64 = 0.6;
/// Part of the frame that is left free on each side.
const MARGIN: f64 = 0.05;
/// Radius of a subject without extent (m).
const RADIUS_MIN: f64 = 0.05;

/// Views that are enough to know a camera's way, and few enough to be quick.
const VIEWS_MAX: usize = 24;

impl WitnessSubject {
    /// Cloth, and the shot camera, if there is one, over a range of frames.
    pub fn of(
        cloth: Bounds,
        camera: Option<&CameraPath>,
        frames: impl ExactSizeIterator<Item = u32>,
    ) -> Self {
        let stride = frames.len().div_ceil(VIEWS_MAX).max(1);
        let view = |path: &CameraPath| {
            frames.step_by(stride).map(|frame| path.view(f64::from(frame))).collect()
        };
        Self { cloth, views: camera.map_or(Vec::new(), view) }
    }

    /// Adds the parts of all obstacles of a frame that are near the cloth.
    #[must_use]
    pub fn with_obstacles(self, frame: &Frame, surfaces: &[Arc<Surface>]) -> Self {
        let posed = surfaces.iter().zip(&frame.obstacle_poses).enumerate();
        posed.fold(self, |subject, (number, (surface, &pose))| {
            subject.with_obstacle(frame.points_of_obstacle(number, surface), pose)
        })
    }

    /// Adds the part of an obstacle that is near the cloth: a body shows where the cloth hangs,
    /// a floor of 20 m should not make it small.
    #[must_use]
    pub fn with_obstacle(mut self, points: &[DVec3], pose: Pose) -> Self {
        let near = self.cloth.grown(0.5 * self.cloth.radius());
        let obstacle = Bounds::of_points(points.iter().map(|&p| pose.transform_point(p)));
        let part = obstacle.intersection(near);
        if !part.is_empty() {
            self.cloth = self.cloth.union(part);
        }
        self
    }

    /// All points that must be in frame.
    fn points(&self) -> Vec<DVec3> {
        let centre = self.cloth.centre();
        let within = |point: DVec3, radii: f64| {
            centre + (point - centre).clamp_length_max(radii * self.radius())
        };
        let mut points = self.cloth.corners().to_vec();
        for view in &self.views {
            let rear = view.eye + view.back * (BODY_ROOM * view.eye.distance(centre));
            points.extend([view.eye, rear].map(|p| within(p, EYE_DISTANCE_MAX)));
            let depth = -view.point_in_camera(centre).z;
            if depth > view.near {
                let corners = gate_corners(view, depth);
                points.extend(corners.map(|p| within(p, GATE_DISTANCE_MAX)));
            }
        }
        points
    }

    fn radius(&self) -> f64 {
        self.cloth.radius().max(RADIUS_MIN)
    }
}

/// A camera for the subject, with a picture of `resolution` (px).
pub fn witness_view(subject: &WitnessSubject, resolution: [u32; 2]) -> View {
    let points = subject.points();
    let centre = subject.cloth.centre();
    let at = |azimuth: f64| {
        let (sin, cos) = azimuth.sin_cos();
        let (up, out) = ELEVATION.sin_cos();
        fitted(DVec3::new(cos * out, sin * out, up), &points, resolution)
    };
    let score = |view: &View| {
        let size = subject.radius() / view.eye.distance(centre);
        let to_witness = (view.eye - centre).normalize_or_zero();
        let side_on =
            |view: &View| to_witness.cross((view.eye - centre).normalize_or_zero()).length();
        let worst = subject.views.iter().map(side_on).fold(1.0, f64::min);
        let mean =
            subject.views.iter().map(side_on).sum::<f64>() / subject.views.len().max(1) as f64;
        size * (0.15 + 0.35 * worst + 0.5 * mean)
    };
    (0..AZIMUTHS)
        .map(|i| at(TAU * i as f64 / AZIMUTHS as f64))
        .max_by(|a, b| score(a).total_cmp(&score(b)))
        .expect("there are candidates")
}

/// The closest camera in direction `back` that has all points in frame.
///
/// With x, z coordinates along right and back, t the half gate and c the eye, a point is in frame
/// when |x - c_x| <= t (c_z - z). So c_x + t c_z = max(x + t z) and -c_x + t c_z = max(-x + t z).
fn fitted(back: DVec3, points: &[DVec3], resolution: [u32; 2]) -> View {
    let right = DVec3::Z.cross(back).normalize();
    let up = back.cross(right);
    let [width, height] = resolution.map(|px| f64::from(px.max(1)));
    let half_gate = DVec2::new(width / height, 1.0) * (0.5 * WITNESS_FOV_Y).tan();
    let inner = half_gate * (1.0 - 2.0 * MARGIN);
    let z = |p: &DVec3| p.dot(back);
    let axis = |axis: DVec3, t: f64| {
        let greatest = |sign: f64| {
            points.iter().map(|p| sign * p.dot(axis) + t * z(p)).fold(f64::NEG_INFINITY, f64::max)
        };
        let (plus, minus) = (greatest(1.0), greatest(-1.0));
        (0.5 * (plus - minus), (plus + minus) / (2.0 * t))
    };
    let (x, z_for_x) = axis(right, inner.x);
    let (y, z_for_y) = axis(up, inner.y);
    let eye = right * x + up * y + back * z_for_x.max(z_for_y);
    let depths = points.iter().map(|p| (eye - *p).dot(back));
    let furthest = depths.fold(RADIUS_MIN, f64::max);
    View {
        eye,
        right,
        up,
        back,
        gate_min: -half_gate,
        gate_max: half_gate,
        near: 2e-3 * furthest,
        far: 50.0 * furthest,
        resolution,
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::look_at;
    use super::*;
    use crate::scene::Surface;

    fn from_eye(eye: DVec3) -> Vec<View> {
        vec![look_at(eye, dress().centre(), 35.0, [1920, 1080])]
    }

    const SIZE: [u32; 2] = [640, 360];

    fn dress() -> Bounds {
        Bounds { min: DVec3::new(-0.5, -0.5, 0.0), max: DVec3::new(0.5, 0.5, 1.6) }
    }

    fn in_frame(view: &View, point: DVec3) -> bool {
        view.point_in_image(point)
            .is_some_and(|p| (0.0..=640.0).contains(&p.x) && (0.0..=360.0).contains(&p.y))
    }

    #[test]
    fn cloth_and_camera_are_in_frame_from_the_side() {
        for eye in [[3.0, 0.0, 1.0], [-2.0, 2.0, 1.5], [0.0, -4.0, 0.5], [0.1, 0.0, 3.5]] {
            let eye = DVec3::from_array(eye);
            let subject = WitnessSubject { cloth: dress(), views: from_eye(eye) };
            let view = witness_view(&subject, SIZE);
            assert!(dress().corners().into_iter().all(|c| in_frame(&view, c)));
            assert!(in_frame(&view, eye));
            let centre = dress().centre();
            let cos = (view.eye - centre).normalize().dot((eye - centre).normalize());
            assert!(cos.abs() < 0.8, "the witness looks along the shot camera: {cos}");
        }
    }

    #[test]
    fn a_camera_far_away_does_not_make_the_cloth_a_dot() {
        let subject =
            WitnessSubject { cloth: dress(), views: from_eye(DVec3::new(70.0, 0.0, 2.0)) };
        let view = witness_view(&subject, SIZE);
        let rows = dress().corners().map(|c| view.point_in_image(c).unwrap().y);
        let height =
            rows.iter().fold(0.0, |m, y| y.max(m)) - rows.iter().fold(1e9, |m, y| y.min(m));
        assert!(height > 0.25 * 360.0, "the cloth is {height} px high");
    }

    #[test]
    fn a_floor_far_larger_than_the_cloth_is_seen_in_part() {
        let floor = Surface {
            positions: vec![DVec3::new(-50.0, -50.0, 0.0), DVec3::new(50.0, 50.0, 0.0)],
            triangles: Vec::new(),
        };
        let subject = WitnessSubject { cloth: dress(), views: from_eye(DVec3::X * 3.0) };
        let with_floor = subject.with_obstacle(&floor.positions, Pose::IDENTITY);
        assert!(with_floor.cloth.radius() < 2.0 * dress().radius());
    }
}
