//! Motions of obstacles and handles.

use std::ops::Mul;

use glam::{DQuat, DVec3};

/// A similarity: x' = translation + scale (rotation x).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub scale: f64,
    /// Unit.
    pub rotation: DQuat,
    /// (m).
    pub translation: DVec3,
}

impl Pose {
    pub const IDENTITY: Self =
        Self { scale: 1.0, rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    pub fn transform_point(self, point: DVec3) -> DVec3 {
        self.translation + self.scale * (self.rotation * point)
    }

    pub fn inverse(self) -> Self {
        let rotation = self.rotation.inverse();
        let scale = 1.0 / self.scale;
        Self { scale, rotation, translation: -scale * (rotation * self.translation) }
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// `(a * b).transform_point(x)` is `a.transform_point(b.transform_point(x))`.
impl Mul for Pose {
    type Output = Pose;
    fn mul(self, inner: Pose) -> Pose {
        Pose {
            scale: self.scale * inner.scale,
            rotation: (self.rotation * inner.rotation).normalize(),
            translation: self.transform_point(inner.translation),
        }
    }
}

/// A pose over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    keys: Vec<MotionKey>,
}

/// Where a motion is at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionKey {
    /// (s).
    pub time: f64,
    pub pose: Pose,
}

impl Motion {
    pub fn pose(&self, _time: f64) -> Pose {
        todo!()
    }

    pub fn keys(&self) -> &[MotionKey] {
        &self.keys
    }
}
