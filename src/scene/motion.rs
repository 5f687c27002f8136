//! Motions of obstacles and handles.

use std::ops::{Add, Mul, Sub};

use glam::{DQuat, DVec3};
use thiserror::Error;

use super::{Pose, PoseVelocity};

/// Spacing of keys that differs less than this (relative) counts as uniform.
const UNIFORM_TOLERANCE: f64 = 1e-9;

/// A pose over time: cubic Hermite curves between keys, constant before the first and after the
/// last. Scale and translation are interpolated by component. So are rotations, as quaternions that
/// are normalised afterwards: this follows the shorter way between neighbouring keys, so that a
/// turn needs a key at least every half revolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    keys: Vec<MotionKey>,
    /// Each key as the curve sees it, and its slope there (per second).
    values: Vec<Components>,
    slopes: Vec<Components>,
    /// Seconds between keys, if it is always the same.
    spacing: Option<f64>,
}

/// Where a motion is at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionKey {
    /// (s).
    pub time: f64,
    pub pose: Pose,
    /// `None`: as the neighbouring keys suggest, (p_{i+1} - p_{i-1}) / (t_{i+1} - t_{i-1}), and zero
    /// at both ends.
    pub velocity: Option<PoseVelocity>,
}

/// Why keys are no motion.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum MotionError {
    #[error("it has no keys")]
    Empty,
    #[error("key {key} is not finite")]
    NonFinite { key: usize },
    #[error("the motion through key {key} is not finite: its neighbours are too far apart")]
    Slope { key: usize },
    #[error("key {key} has scale {scale}, but it must be greater than 0")]
    Scale { key: usize, scale: f64 },
    #[error("key {key} at {time} s does not come after the one before it, at {before} s")]
    Order { key: usize, time: f64, before: f64 },
}

impl MotionError {
    /// The key at fault.
    pub fn key(self) -> Option<usize> {
        match self {
            MotionError::Empty => None,
            MotionError::NonFinite { key }
            | MotionError::Slope { key }
            | MotionError::Scale { key, .. }
            | MotionError::Order { key, .. } => Some(key),
        }
    }
}

impl Motion {
    /// # Errors
    /// Without keys; unless the keys are finite, of positive scale and in strict order of time, and
    /// the curve through them is finite.
    pub fn from_keys(keys: Vec<MotionKey>) -> Result<Self, MotionError> {
        check(&keys)?;
        let values = continuous(&keys);
        let slopes: Vec<Components> = (0..keys.len()).map(|k| slope(&keys, &values, k)).collect();
        // Finite keys may still be too far apart.
        if let Some(key) = slopes.iter().position(|slope| !slope.is_finite()) {
            return Err(MotionError::Slope { key });
        }
        let spacing = uniform_spacing(&keys);
        Ok(Self { keys, values, slopes, spacing })
    }

    /// Sample k is at k / fps.
    ///
    /// # Errors
    /// As [`from_keys`](Self::from_keys).
    pub fn from_samples(
        fps: f64,
        samples: impl IntoIterator<Item = Pose>,
    ) -> Result<Self, MotionError> {
        let key = |(k, pose)| MotionKey { time: k as f64 / fps, pose, velocity: None };
        Self::from_keys(samples.into_iter().enumerate().map(key).collect())
    }

    /// At a time (s).
    pub fn pose(&self, time: f64) -> Pose {
        let last = self.keys.len() - 1;
        // Written so that a NaN takes the first branch.
        if !(time > self.keys[0].time) {
            return self.values[0].pose();
        }
        if time >= self.keys[last].time {
            return self.values[last].pose();
        }
        let k = self.interval(time);
        let (t0, t1) = (self.keys[k].time, self.keys[k + 1].time);
        let ends = [self.values[k], self.values[k + 1]];
        let slopes = [self.slopes[k], self.slopes[k + 1]];
        hermite(ends, slopes, t1 - t0, (time - t0) / (t1 - t0)).pose()
    }

    pub fn keys(&self) -> &[MotionKey] {
        &self.keys
    }

    /// The last key at or before a time inside the motion.
    fn interval(&self, time: f64) -> usize {
        let last = self.keys.len() - 2;
        let Some(spacing) = self.spacing else {
            return self.keys.partition_point(|key| key.time <= time) - 1;
        };
        let mut k = (((time - self.keys[0].time) / spacing) as usize).min(last);
        // The quotient may round across a key.
        if k > 0 && time < self.keys[k].time {
            k -= 1;
        } else if k < last && time >= self.keys[k + 1].time {
            k += 1;
        }
        k
    }
}

fn check(keys: &[MotionKey]) -> Result<(), MotionError> {
    if keys.is_empty() {
        return Err(MotionError::Empty);
    }
    for (key, k) in keys.iter().enumerate() {
        if !(k.time.is_finite() && k.pose.is_finite()) {
            return Err(MotionError::NonFinite { key });
        }
        if !(k.pose.scale > 0.0) {
            return Err(MotionError::Scale { key, scale: k.pose.scale });
        }
        if key > 0 && k.time <= keys[key - 1].time {
            let before = keys[key - 1].time;
            return Err(MotionError::Order { key, time: k.time, before });
        }
    }
    Ok(())
}

/// The keys' components, quaternions on the same side as their predecessors.
fn continuous(keys: &[MotionKey]) -> Vec<Components> {
    let mut values: Vec<Components> = Vec::with_capacity(keys.len());
    for key in keys {
        let Pose { scale, mut rotation, translation } = key.pose;
        if values.last().is_some_and(|before| before.rotation.dot(rotation) < 0.0) {
            rotation = -rotation;
        }
        values.push(Components { scale, rotation, translation });
    }
    values
}

fn slope(keys: &[MotionKey], values: &[Components], k: usize) -> Components {
    if let Some(velocity) = keys[k].velocity {
        // dq/dt = 1/2 (0, angular) q.
        let w = velocity.angular * 0.5;
        let rotation = DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * values[k].rotation;
        return Components { scale: velocity.scale, rotation, translation: velocity.translation };
    }
    if k == 0 || k + 1 == keys.len() {
        return Components::ZERO;
    }
    (values[k + 1] - values[k - 1]) * (1.0 / (keys[k + 1].time - keys[k - 1].time))
}

fn uniform_spacing(keys: &[MotionKey]) -> Option<f64> {
    let (first, last) = (keys.first()?.time, keys.last()?.time);
    let spacing = (last - first) / (keys.len().checked_sub(1).filter(|&n| n > 0)? as f64);
    let is_even = |(k, key): (usize, &MotionKey)| {
        (key.time - (first + k as f64 * spacing)).abs() <= UNIFORM_TOLERANCE * spacing
    };
    keys.iter().enumerate().all(is_even).then_some(spacing)
}

/// H(s) = h00 p0 + h10 T m0 + h01 p1 + h11 T m1, s in 0..1 over an interval of T seconds.
fn hermite(ends: [Components; 2], slopes: [Components; 2], span: f64, s: f64) -> Components {
    let (s2, s3) = (s * s, s * s * s);
    ends[0] * (2.0 * s3 - 3.0 * s2 + 1.0)
        + slopes[0] * (span * (s3 - 2.0 * s2 + s))
        + ends[1] * (3.0 * s2 - 2.0 * s3)
        + slopes[1] * (span * (s3 - s2))
}

/// The numbers of a pose, or their rates; the quaternion need not be of unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Components {
    scale: f64,
    rotation: DQuat,
    translation: DVec3,
}

impl Components {
    const ZERO: Self = Self {
        scale: 0.0,
        rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0),
        translation: DVec3::ZERO,
    };

    fn is_finite(self) -> bool {
        self.scale.is_finite() && self.rotation.is_finite() && self.translation.is_finite()
    }

    fn pose(self) -> Pose {
        let Self { scale, rotation, translation } = self;
        Pose { scale, rotation: rotation.normalize(), translation }
    }
}

impl Add for Components {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self {
            scale: self.scale + o.scale,
            rotation: self.rotation + o.rotation,
            translation: self.translation + o.translation,
        }
    }
}

impl Sub for Components {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + o * -1.0
    }
}

impl Mul<f64> for Components {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self {
            scale: self.scale * s,
            rotation: self.rotation * s,
            translation: self.translation * s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn key(time: f64, translation: DVec3, angle: f64) -> MotionKey {
        let pose = Pose { scale: 1.0, rotation: DQuat::from_rotation_z(angle), translation };
        MotionKey { time, pose, velocity: None }
    }

    fn sample() -> Motion {
        Motion::from_keys(vec![
            key(1.0, DVec3::ZERO, 0.0),
            key(2.0, DVec3::X, 0.5),
            key(4.0, DVec3::new(2.0, 1.0, 0.0), 1.5),
            key(4.5, DVec3::Y, 1.0),
        ])
        .unwrap()
    }

    fn assert_same(a: Pose, b: Pose) {
        let turn = a.rotation.dot(b.rotation).abs();
        assert!(a.translation.distance(b.translation) < 1e-12, "{a:?} and {b:?} differ");
        assert!(turn > 1.0 - 1e-12 && (a.scale - b.scale).abs() < 1e-12, "{a:?}, {b:?}");
    }

    #[test]
    fn a_motion_passes_its_keys_and_rests_outside_them() {
        let motion = sample();
        for key in motion.keys() {
            assert_same(motion.pose(key.time), key.pose);
        }
        assert_same(motion.pose(-1.0), motion.keys()[0].pose);
        assert_same(motion.pose(100.0), motion.keys()[3].pose);
    }

    #[test]
    fn slopes_at_inner_keys_follow_the_neighbours_and_end_at_rest() {
        let motion = sample();
        let h = 1e-6;
        let rate =
            |t: f64| (motion.pose(t + h).translation - motion.pose(t - h).translation) / (2.0 * h);
        assert!(rate(2.0).distance(DVec3::new(2.0, 1.0, 0.0) / 3.0) < 1e-5);
        assert!(rate(1.0 + h).length() < 1e-5 && rate(4.5 - h).length() < 1e-4);
    }

    #[test]
    fn a_given_velocity_replaces_the_slope() {
        let velocity = PoseVelocity {
            scale: 0.0,
            angular: DVec3::new(0.0, 0.0, 2.0),
            translation: DVec3::new(0.0, 0.0, 3.0),
        };
        let mut keys = vec![key(0.0, DVec3::ZERO, 0.3), key(1.0, DVec3::ZERO, 0.3)];
        keys[0].velocity = Some(velocity);
        let motion = Motion::from_keys(keys).unwrap();
        let h = 1e-7;
        let moved = motion.pose(h);
        assert!((moved.translation / h).distance(velocity.translation) < 1e-5);
        let turned = moved.rotation * motion.pose(0.0).rotation.inverse();
        assert!((turned.to_scaled_axis() / h).distance(velocity.angular) < 1e-5);
    }

    #[test]
    fn rotations_take_the_shorter_way_and_stay_unit() {
        let mut turned = key(1.0, DVec3::ZERO, FRAC_PI_2);
        turned.pose.rotation = -turned.pose.rotation;
        let motion = Motion::from_keys(vec![key(0.0, DVec3::ZERO, 0.0), turned]).unwrap();
        let half = motion.pose(0.5);
        assert!((half.rotation.length() - 1.0).abs() < 1e-12);
        assert!(half.rotation.angle_between(DQuat::from_rotation_z(PI / 4.0)) < 1e-6);
    }

    #[test]
    fn uniform_samples_are_found_by_index_with_the_same_result() {
        let poses: Vec<Pose> = (0..20)
            .map(|k| key(0.0, DVec3::new((k as f64).sin(), 0.0, 0.0), k as f64 * 0.1).pose)
            .collect();
        let motion = Motion::from_samples(30.0, poses).unwrap();
        assert!(motion.spacing.is_some());
        let searched = Motion { spacing: None, ..motion.clone() };
        for i in 0..2000 {
            let time = i as f64 * (0.7 / 2000.0);
            assert_eq!(motion.pose(time), searched.pose(time), "at {time} s");
        }
        for key in motion.keys() {
            assert_eq!(motion.pose(key.time), searched.pose(key.time));
        }
    }

    #[test]
    fn bad_keys_are_refused_by_number() {
        assert_eq!(Motion::from_keys(vec![]), Err(MotionError::Empty));
        let at = |time| key(time, DVec3::ZERO, 0.0);
        let error = Motion::from_keys(vec![at(0.0), at(2.0), at(2.0)]).unwrap_err();
        assert_eq!(error, MotionError::Order { key: 2, time: 2.0, before: 2.0 });
        let error = Motion::from_keys(vec![at(f64::NAN)]).unwrap_err();
        assert_eq!(error, MotionError::NonFinite { key: 0 });
        let far = |time, x| key(time, DVec3::new(x, 0.0, 0.0), 0.0);
        let error =
            Motion::from_keys(vec![far(0.0, -1e308), at(1.0), far(2.0, 1e308)]).unwrap_err();
        assert_eq!(error, MotionError::Slope { key: 1 });
        let mut flat = at(1.0);
        flat.pose.scale = 0.0;
        let error = Motion::from_keys(vec![at(0.0), flat]).unwrap_err();
        assert_eq!(error, MotionError::Scale { key: 1, scale: 0.0 });
    }
}
