//! 3x2 matrices: derivatives of world-space quantities by material coordinates.

use glam::{DVec2, DVec3};

use super::SymTensor2;

/// A 3x2 matrix by its two columns, d/du and d/dv.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3x2 {
    pub x_axis: DVec3,
    pub y_axis: DVec3,
}

impl Mat3x2 {
    pub const ZERO: Self = Self { x_axis: DVec3::ZERO, y_axis: DVec3::ZERO };

    /// The sum over i of value_i gradient_i^T: the derivative of a linearly interpolated quantity.
    pub fn from_gradients(values: [DVec3; 3], gradients: [DVec2; 3]) -> Self {
        let column = |axis: fn(DVec2) -> f64| {
            values[0] * axis(gradients[0])
                + values[1] * axis(gradients[1])
                + values[2] * axis(gradients[2])
        };
        Self { x_axis: column(|g| g.x), y_axis: column(|g| g.y) }
    }

    /// A u.
    pub fn mul_vec2(self, u: DVec2) -> DVec3 {
        self.x_axis * u.x + self.y_axis * u.y
    }

    /// A^T w.
    pub fn transpose_mul_vec3(self, w: DVec3) -> DVec2 {
        DVec2::new(self.x_axis.dot(w), self.y_axis.dot(w))
    }

    /// A^T A.
    pub fn gram(self) -> SymTensor2 {
        SymTensor2 {
            xx: self.x_axis.length_squared(),
            xy: self.x_axis.dot(self.y_axis),
            yy: self.y_axis.length_squared(),
        }
    }

    /// Largest and smallest singular value.
    pub fn singular_values(self) -> [f64; 2] {
        self.gram().eigen().values.map(|squared| squared.max(0.0).sqrt())
    }
}
