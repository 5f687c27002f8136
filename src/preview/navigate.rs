//! Moving a camera by hand: pure moves of an eye and of what it looks at. Z is up.

use glam::{DVec2, DVec3};

use crate::shot::{CameraKey, CameraPath, Lens, Track, View};

/// An eye and what it looks at, two places, in the world (m). Moves keep it upright and never
/// straight above or below the target.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
pub struct EyeAndTarget {
    pub eye: DVec3,
    pub target: DVec3,
}

/// How a view becomes an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePlane {
    pub lens: Lens,
    /// Width and height (px).
    pub resolution: [u32; 2],
    /// Width over height of a pixel.
    pub pixel_aspect: f64,
}

/// Steepest look up or down (rad): a degree short of the poles, where up has no meaning.
const ELEVATION_MAX: f64 = 89.0 * std::f64::consts::PI / 180.0;

/// Between eye and target (m): nearer, single threads would fill the image; farther, a shot is a dot.
const DISTANCE_MIN: f64 = 1e-3;
const DISTANCE_MAX: f64 = 1e5;

/// Distances of the near and the far plane over that of the target: what lies well before and behind
/// it is seen, and depth keeps its digits.
const NEAR: f64 = 1e-3;
const FAR: f64 = 1e3;

impl EyeAndTarget {
    /// Around the target, as if on a turntable: the azimuth grows counter-clockwise seen from above,
    /// the elevation upwards (rad). The distance stays.
    #[must_use]
    pub fn orbited(self, azimuth: f64, elevation: f64) -> Self {
        let arm = turned(self.eye - self.target, azimuth, elevation);
        Self { eye: self.target + arm, ..self }
    }

    /// Around the eye: to the left by the yaw, upwards by the pitch (rad). The distance stays.
    #[must_use]
    pub fn looked(self, yaw: f64, pitch: f64) -> Self {
        let sight = turned(self.target - self.eye, yaw, pitch);
        Self { target: self.eye + sight, ..self }
    }

    /// In the image plane, so that what was under the pointer at the target's depth follows it over
    /// `drag` (px, x to the right, y down) of the view's image.
    #[must_use]
    pub fn panned(self, view: &View, drag: DVec2) -> Self {
        let gate = (view.gate_max - view.gate_min) * self.distance();
        let [width, height] = view.resolution.map(|pixels| f64::from(pixels.max(1)));
        let shift = view.up * (drag.y * gate.y / height) - view.right * (drag.x * gate.x / width);
        self.shifted(shift)
    }

    /// Towards the target by a factor e^-amount on the distance: never through it, and back by the
    /// same amount.
    #[must_use]
    pub fn dollied(self, amount: f64) -> Self {
        let distance = self.distance() * (-amount).exp();
        self.at_distance(distance.clamp(DISTANCE_MIN, DISTANCE_MAX))
    }

    /// Along its own axes, x to the right, y up in the image, z into it (m).
    #[must_use]
    pub fn flown(self, along: DVec3) -> Self {
        let [right, up, forward] = self.axes();
        self.shifted(right * along.x + up * along.y + forward * along.z)
    }

    /// Looking in the same direction, from where a box (its least and its greatest corner, m, world)
    /// fills the image but for a share `margin` of it, below 1, at each pair of sides. A box of no
    /// extent is looked at from as far as before; one that is empty or not finite changes nothing.
    #[must_use]
    pub fn framed(self, [min, max]: [DVec3; 2], image: &ImagePlane, margin: f64) -> Self {
        if !(min.is_finite() && max.is_finite() && min.cmple(max).all()) {
            return self;
        }
        let centred = self.shifted(0.5 * (min + max) - self.target);
        let inside = (1.0 - margin).clamp(0.05, 1.0);
        let [gate_min, gate_max] = image.lens.gate(image.aspect());
        // An off-centre lens has less room on one side.
        let half = gate_max.min(-gate_min).max(DVec2::splat(1e-3)) * inside;
        let axes = centred.axes();
        let fitting = corners(min, max).map(|corner| {
            let [x, y, depth] = axes.map(|axis| axis.dot(corner - centred.target));
            (x.abs() / half.x).max(y.abs() / half.y) - depth
        });
        let distance = fitting.into_iter().fold(0.0, f64::max);
        if distance > DISTANCE_MIN {
            centred.at_distance(distance.min(DISTANCE_MAX))
        } else {
            centred
        }
    }

    /// What is seen through a lens.
    pub fn view(self, image: &ImagePlane) -> View {
        let key = CameraKey {
            frame: 0.0,
            eye: self.eye,
            target: self.target,
            up: DVec3::Z,
            lens: image.lens,
            cut: false,
        };
        let path = CameraPath {
            name: String::new(),
            resolution: image.resolution,
            pixel_aspect: image.pixel_aspect,
            near: NEAR * self.distance(),
            far: FAR * self.distance(),
            track: Track::Keys(vec![key]),
        };
        path.view(0.0)
    }

    /// Of a view, with a target this far in front of it (m). A roll is lost.
    pub fn of_view(view: &View, distance: f64) -> Self {
        let sight = turned(-view.back * distance, 0.0, 0.0);
        Self { eye: view.eye, target: view.eye + sight }
    }

    /// Between eye and target (m).
    pub fn distance(self) -> f64 {
        self.eye.distance(self.target).clamp(DISTANCE_MIN, DISTANCE_MAX)
    }

    /// To the right, up in the image, and to the target: orthonormal.
    fn axes(self) -> [DVec3; 3] {
        let forward = (self.target - self.eye).normalize_or(DVec3::Y);
        let right = forward.cross(DVec3::Z).normalize_or(DVec3::X);
        [right, right.cross(forward), forward]
    }

    fn shifted(self, by: DVec3) -> Self {
        if by.is_finite() { Self { eye: self.eye + by, target: self.target + by } } else { self }
    }

    fn at_distance(self, distance: f64) -> Self {
        let [_, _, forward] = self.axes();
        if distance.is_finite() {
            Self { eye: self.target - forward * distance, ..self }
        } else {
            self
        }
    }
}

impl ImagePlane {
    fn aspect(&self) -> f64 {
        let [width, height] = self.resolution.map(|pixels| f64::from(pixels.max(1)));
        width * self.pixel_aspect / height
    }
}

/// An arm of the same length, turned about Z and raised, short of the poles.
fn turned(arm: DVec3, azimuth: f64, elevation: f64) -> DVec3 {
    let length = arm.length().clamp(DISTANCE_MIN, DISTANCE_MAX);
    let flat = arm.truncate().length();
    let azimuth = arm.y.atan2(arm.x) + azimuth;
    let elevation = (arm.z.atan2(flat) + elevation).clamp(-ELEVATION_MAX, ELEVATION_MAX);
    if !(azimuth.is_finite() && elevation.is_finite()) {
        return arm;
    }
    let (sine, cosine) = elevation.sin_cos();
    length * DVec3::new(cosine * azimuth.cos(), cosine * azimuth.sin(), sine)
}

fn corners(min: DVec3, max: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|k| {
        let pick = |axis: usize| if k >> axis & 1 == 0 { min[axis] } else { max[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

#[cfg(test)]
#[path = "navigate_tests.rs"]
mod tests;
