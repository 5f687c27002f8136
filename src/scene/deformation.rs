//! Obstacles whose points move by themselves: bodies as animation hands them over.

use glam::DVec3;
use thiserror::Error;

/// The points of a surface over time (m, in the obstacle's own space): linear between keys, constant
/// before the first and after the last. The triangles stay what they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Deformation {
    keys: Vec<PointKey>,
}

/// Where all points are at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct PointKey {
    /// (s).
    pub time: f64,
    pub positions: Vec<DVec3>,
}

/// Why keys are no deformation.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum DeformationError {
    #[error("it has no keys")]
    Empty,
    #[error("key {key} is not finite")]
    NonFinite { key: usize },
    #[error("key {key} has {found} points, but the first key has {expected}")]
    PointCount { key: usize, found: usize, expected: usize },
    #[error("key {key} at {time} s does not come after the one before it, at {before} s")]
    Order { key: usize, time: f64, before: f64 },
}

impl Deformation {
    /// # Errors
    /// Without keys; unless the keys are finite, in strict order of time, and of as many points.
    pub fn from_keys(keys: Vec<PointKey>) -> Result<Self, DeformationError> {
        let Some(first) = keys.first() else { return Err(DeformationError::Empty) };
        let expected = first.positions.len();
        for (key, k) in keys.iter().enumerate() {
            if !k.time.is_finite() || !k.positions.iter().all(|p| p.is_finite()) {
                return Err(DeformationError::NonFinite { key });
            }
            let found = k.positions.len();
            if found != expected {
                return Err(DeformationError::PointCount { key, found, expected });
            }
            if key > 0 && k.time <= keys[key - 1].time {
                let before = keys[key - 1].time;
                return Err(DeformationError::Order { key, time: k.time, before });
            }
        }
        Ok(Self { keys })
    }

    pub fn keys(&self) -> &[PointKey] {
        &self.keys
    }

    /// The same, with the time held between the first key and the last (s).
    pub fn clamped(&self, time: f64) -> f64 {
        let [first, last] = [&self.keys[0], &self.keys[self.keys.len() - 1]].map(|k| k.time);
        time.clamp(first, last)
    }

    /// The points at a time (s).
    pub fn positions(&self, time: f64) -> Vec<DVec3> {
        let time = self.clamped(time);
        let after = self.keys.partition_point(|key| key.time <= time);
        let before = &self.keys[after.max(1) - 1];
        let Some(next) = self.keys.get(after) else { return before.positions.clone() };
        let part = (time - before.time) / (next.time - before.time);
        before.positions.iter().zip(&next.positions).map(|(a, b)| a.lerp(*b, part)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time: f64, x: f64) -> PointKey {
        PointKey { time, positions: vec![DVec3::ZERO, DVec3::X * x] }
    }

    #[test]
    fn points_move_on_straight_lines_between_keys_and_rest_outside_them() {
        let deformation =
            Deformation::from_keys(vec![key(1.0, 1.0), key(2.0, 3.0), key(4.0, 0.0)]).unwrap();
        for (time, x) in [(0.0, 1.0), (1.0, 1.0), (1.5, 2.0), (2.0, 3.0), (3.0, 1.5), (9.0, 0.0)] {
            assert!((deformation.positions(time)[1].x - x).abs() < 1e-12, "at {time} s");
        }
    }

    #[test]
    fn flawed_keys_are_refused_by_number() {
        let of = Deformation::from_keys;
        assert_eq!(of(vec![]), Err(DeformationError::Empty));
        assert_eq!(of(vec![key(0.0, f64::NAN)]), Err(DeformationError::NonFinite { key: 0 }));
        let order = DeformationError::Order { key: 1, time: 1.0, before: 1.0 };
        assert_eq!(of(vec![key(1.0, 0.0), key(1.0, 1.0)]), Err(order));
        let fewer = PointKey { time: 2.0, positions: vec![DVec3::ZERO] };
        let count = DeformationError::PointCount { key: 1, found: 1, expected: 2 };
        assert_eq!(of(vec![key(1.0, 0.0), fewer]), Err(count));
    }
}
