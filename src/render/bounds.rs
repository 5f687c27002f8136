//! Axis-aligned boxes.

use glam::DVec3;

use crate::sim::Frame;

/// An axis-aligned box in the world (m); empty until something is put in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bounds {
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    pub fn of_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with_point)
    }

    /// Around all garments of a frame.
    pub fn of_cloth(frame: &Frame) -> Self {
        Self::of_points(frame.garments.iter().flat_map(|mesh| mesh.position.iter().copied()))
    }

    #[must_use]
    pub fn with_point(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// What both contain; may be empty.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Larger by a distance on every side (m).
    #[must_use]
    pub fn grown(self, distance: f64) -> Self {
        Self { min: self.min - distance, max: self.max + distance }
    }

    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    pub fn centre(self) -> DVec3 {
        if self.is_empty() { DVec3::ZERO } else { 0.5 * (self.min + self.max) }
    }

    /// Half the diagonal (m).
    pub fn radius(self) -> f64 {
        if self.is_empty() { 0.0 } else { 0.5 * self.min.distance(self.max) }
    }

    pub fn corners(self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
            DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }
}
