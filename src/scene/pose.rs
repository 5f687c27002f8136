//! Where something stands, and how fast that changes.

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

    /// Of a direction or a velocity: without the translation.
    pub fn transform_vector(self, vector: DVec3) -> DVec3 {
        self.scale * (self.rotation * vector)
    }

    pub fn inverse(self) -> Self {
        let rotation = self.rotation.inverse();
        let scale = 1.0 / self.scale;
        Self { scale, rotation, translation: -scale * (rotation * self.translation) }
    }

    pub fn is_finite(self) -> bool {
        self.scale.is_finite() && self.rotation.is_finite() && self.translation.is_finite()
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

/// How fast a pose changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseVelocity {
    /// (1/s).
    pub scale: f64,
    /// Axis times angular speed, in the world (rad/s).
    pub angular: DVec3,
    /// (m/s).
    pub translation: DVec3,
}
